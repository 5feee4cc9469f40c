/* Opens the libzip module when an archive is met. */
#include "io/archive/zip.h"
#include "io/module.h"

bool ang_zip_unpack(const char *path, const char *label, const char *folder, ang_notes *warnings,
                    const ang_progress *progress, ang_error *err) {
    const ang_zip_functions *zip = ang_module_symbol(ANG_ZIP_MODULE, ANG_ZIP_SYMBOL, "zip archives", ANG_INPUT, err);
    return zip && zip->unzip(path, label, folder, warnings, progress, err);
}
