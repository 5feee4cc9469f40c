/* What an input holds, series by series, without a volume being made of any. */
#ifndef ANG_IO_SURVEY_H
#define ANG_IO_SURVEY_H

#include "core/volume/raw_slice.h"
#include "io/load.h"

/* Is told what is found; borrows only for the call, which comes from the thread of ang_survey. */
typedef struct ang_survey_sink {
    /* The list is made: report->series. Once, before the rest. */
    void (*listed)(void *context, const ang_load_report *report);
    /* Series `index` of the list: its middle slice (NULL: it has no picture that can be read), what loading it would
     * warn of, and why it cannot be loaded (NULL: nothing is known against it). */
    void (*looked_at)(void *context, size_t index, const ang_raw_slice *middle, const ang_notes *warnings,
                      const char *refusal);
    void *context;
} ang_survey_sink;

/* Lists the series of what ang_load_all would read and looks at each: one slice and the geometry of all. `report` is
 * filled as far as listing does. Volumes of other formats than DICOM are listed without a look: there is no slice to be
 * read by itself. Thread safe. False with ANG_INPUT where there is nothing, ANG_LIMIT, ANG_INTERRUPTED. */
bool ang_survey(const char *const *paths, size_t count, const ang_load_options *options, ang_load_report *report,
                const ang_survey_sink *sink, const ang_progress *progress, ang_error *err);

#endif
