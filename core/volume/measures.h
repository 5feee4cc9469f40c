/* Lengths, angles and regions that are measured in the patient. Plain values. */
#ifndef ANG_VOLUME_MEASURES_H
#define ANG_VOLUME_MEASURES_H

#include "core/volume/volume.h"

typedef enum ang_measure_kind {
    ANG_MEASURE_LENGTH,
    ANG_MEASURE_ANGLE,
    ANG_MEASURE_ELLIPSE,
    ANG_MEASURE_RECTANGLE,
    ANG_MEASURE_KINDS
} ang_measure_kind;
const char *ang_measure_kind_name(ang_measure_kind kind); /* "length", ...; NULL beyond the last */
int ang_measure_kind_from_name(const char *name);         /* -1: none */
/* An ellipse or a rectangle. */
bool ang_measure_is_region(ang_measure_kind kind);
/* How many places make one. */
int ang_measure_points(ang_measure_kind kind);

enum { ANG_MEASURES = 32, ANG_MEASURE_POINTS = 3, ANG_MEASURE_HANDLES = 4, ANG_MEASURE_LINES = 3 };

typedef struct ang_measurement {
    ang_measure_kind kind;
    /* LPS mm. Length: its ends. Angle: the end of one arm, the vertex, the end of the other. Region: two opposite
     * corners of its rectangle, in one plane with `right` and `down`. */
    ang_vec3 point[ANG_MEASURE_POINTS];
    ang_vec3 right, down; /* region: unit, orthogonal, the directions of its rectangle's sides; else zero */
    bool label_placed;    /* its label was put somewhere by hand */
    double label_mm[2];   /* then: the label's middle from the measure's, to the right and down in the pane */
} ang_measurement;

typedef struct ang_measures {
    ang_measurement item[ANG_MEASURES];
    int count;
    bool hidden; /* kept, but not shown */
} ang_measures;

/* The new one's index; -1 where there are ANG_MEASURES already. */
int ang_measures_add(ang_measures *measures, const ang_measurement *measurement);
void ang_measures_delete(ang_measures *measures, int index);
bool ang_measures_same(const ang_measures *a, const ang_measures *b);
/* Whether the lengths that are shown, which the volume rendering has as well, are the same. */
bool ang_measures_same_lengths(const ang_measures *a, const ang_measures *b);
/* Whether two measure the same; labels may lie elsewhere. */
bool ang_measurement_same(const ang_measurement *a, const ang_measurement *b);

/* What can be dragged, LPS mm: the points, or a region's corners. Returns their number. */
int ang_measurement_handles(const ang_measurement *measurement, ang_vec3 handle[ANG_MEASURE_HANDLES]);
enum { ANG_MEASURE_OUTLINE = 65 };
/* The measure as a line through places, LPS mm, closed where it is a region's; their number. */
int ang_measurement_outline(const ang_measurement *measurement, ang_vec3 at[ANG_MEASURE_OUTLINE]);
/* Moves a handle; of a region the opposite corner stays, and its plane. */
void ang_measurement_drag(ang_measurement *measurement, int handle, ang_vec3 to);
void ang_measurement_shift(ang_measurement *measurement, ang_vec3 by);
ang_vec3 ang_measurement_middle(const ang_measurement *measurement);

/* Length in mm, angle in degrees (0 to 180), area in mm2. An angle with an arm of no length is 0. */
double ang_measurement_value(const ang_measurement *measurement);
const char *ang_measurement_unit(ang_measure_kind kind); /* "mm", "degrees", "mm2" */

/* Of the values (HU) in a region. */
typedef struct ang_region_values {
    double mean, sd;    /* sd: with n - 1; 0 for one value */
    double least, most; /* all NaN where nothing of the region lies in the volume */
    size_t count;
} ang_region_values;
/* The values of the region's plane, as thick as a slice has no part in it. They are taken where voxel centres are if
 * the plane goes through voxel centres along the volume's axes, so that they are the voxels themselves; else by
 * trilinear interpolation, as close to one another as voxels. A region without any has the value of its middle. Pure.
 */
ang_region_values ang_region_measure(const ang_volume *volume, const ang_measurement *region);

/* What its label says, a line each: "12.3 mm"; "45.0" and a degree sign; mean and SD, least and greatest value, area.
 * `unit`: of values, "HU" or empty. Returns the number of lines. */
int ang_measurement_lines(const ang_measurement *measurement, const ang_region_values *values, const char *unit,
                          char line[ANG_MEASURE_LINES][64]);
/* All of them as a table for a spreadsheet: tabs between columns, a line of headings, UTF-8. `values`: one for each.
 * NULL with ANG_LIMIT. Free with free(). */
char *ang_measures_print(const ang_measures *measures, const ang_region_values *values, const char *unit,
                         ang_error *err);

#endif
