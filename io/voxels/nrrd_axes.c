#include "io/voxels/nrrd_axes.h"

#include <ctype.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void ang_nrrd_axes_start(ang_nrrd_axes *axes) {
    *axes = (ang_nrrd_axes){.unit_mm = {1, 1, 1}};
    for (int i = 0; i < ANG_NRRD_AXES; i++)
        axes->axis[i] = (ang_nrrd_axis){.spacing = NAN, .thickness = NAN, .least = NAN, .most = NAN};
}

static bool refuse(const char *label, const char *field, const char *value, ang_error *err) {
    return ang_fail(err, ANG_INPUT, "%s: its NRRD header says \"%s: %.200s\", which is not understood", label, field,
                    value);
}

/* A vector "(1,0,0)" of up to 4 numbers; false where it is none. `*text` moves behind it. */
static bool take_vector(const char **text, double vector[4], int *count) {
    char *end = (char *)(uintptr_t)*text;
    for (*count = 0; *count < 4;) {
        vector[(*count)++] = strtod(end + 1, &end); /* begins behind the bracket or the comma */
        while (isspace((unsigned char)*end)) end++;
        if (*end != ',') break;
    }
    *text = end + 1;
    return *end == ')';
}

static bool use_directions(ang_nrrd_axes *axes, const char *value) {
    for (int i = 0; i < axes->dimension; i++) {
        ang_nrrd_axis *axis = &axes->axis[i];
        double vector[4] = {0};
        int count;
        while (isspace((unsigned char)*value)) value++;
        if (strncasecmp(value, "none", 4) == 0) {
            value += 4;
            continue;
        }
        if (*value != '(' || !take_vector(&value, vector, &count) || count != axes->space_dimension) return false;
        memcpy(axis->direction, vector, sizeof axis->direction);
        int finite = 0, in_space = count < 3 ? count : 3;
        for (int c = 0; c < in_space; c++) finite += isfinite(vector[c]);
        bool zero = vector[0] == 0 && vector[1] == 0 && vector[2] == 0;
        /* All or none are numbers, and 0 is a direction of time alone in a space with time. */
        if ((finite > 0 && finite < in_space) || (zero && count < 4)) return false;
        axis->has_direction = finite > 0 && !zero;
    }
    return true;
}

static bool use_space(ang_nrrd_axes *axes, const char *value) {
    static const char *const three[] = {"right-anterior-superior",
                                        "RAS",
                                        "left-anterior-superior",
                                        "LAS",
                                        "left-posterior-superior",
                                        "LPS",
                                        "scanner-xyz",
                                        "3D-right-handed",
                                        "3D-left-handed"};
    static const char *const four[] = {"right-anterior-superior-time",
                                       "RAST",
                                       "left-anterior-superior-time",
                                       "LAST",
                                       "left-posterior-superior-time",
                                       "LPST",
                                       "scanner-xyz-time",
                                       "3D-right-handed-time",
                                       "3D-left-handed-time"};
    for (size_t i = 0; i < sizeof three / sizeof *three; i++) {
        bool timed = ang_header_is(value, four[i]);
        if (!timed && !ang_header_is(value, three[i])) continue;
        axes->space_dimension = timed ? 4 : 3;
        snprintf(axes->space, sizeof axes->space, "%s", three[i]);
        return true;
    }
    return false;
}

static bool use_origin(ang_nrrd_axes *axes, const char *value) {
    double vector[4] = {0};
    int count;
    while (isspace((unsigned char)*value)) value++;
    if (*value != '(' || !take_vector(&value, vector, &count) || count != axes->space_dimension) return false;
    axes->has_origin = isfinite(vector[0]) && isfinite(vector[1]) && isfinite(vector[2]);
    if (axes->has_origin) memcpy(axes->origin, vector, sizeof axes->origin);
    return true;
}

static void use_space_units(ang_nrrd_axes *axes, const char *value) {
    char word[32];
    for (int i = 0; i < 3 && ang_header_word(&value, word, sizeof word); i++) {
        double mm = ang_header_unit_mm(word);
        if (isfinite(mm)) axes->unit_mm[i] = mm;
    }
}

/* A number for each axis. */
static bool use_numbers(ang_nrrd_axes *axes, const char *value, size_t member) {
    double numbers[ANG_NRRD_AXES];
    if (ang_header_numbers(value, numbers, ANG_NRRD_AXES) != axes->dimension) return false;
    for (int i = 0; i < axes->dimension; i++) memcpy((char *)&axes->axis[i] + member, &numbers[i], sizeof numbers[i]);
    return true;
}

static void use_words(ang_nrrd_axes *axes, const char *value, size_t member) {
    for (int i = 0; i < axes->dimension; i++)
        if (!ang_header_word(&value, (char *)&axes->axis[i] + member, sizeof axes->axis[i].kind)) return;
}

static void use_centres(ang_nrrd_axes *axes, const char *value) {
    char word[16];
    for (int i = 0; i < axes->dimension && ang_header_word(&value, word, sizeof word); i++)
        axes->axis[i].node = ang_header_is(word, "node");
}

static bool use_dimension(ang_nrrd_axes *axes, const char *value) {
    double number;
    if (ang_header_numbers(value, &number, 1) != 1 || !(number >= 1 && number <= ANG_NRRD_AXES)) return false;
    axes->dimension = (int)number;
    return number == floor(number);
}

static bool use_space_dimension(ang_nrrd_axes *axes, const char *value) {
    double number;
    bool ok = ang_header_numbers(value, &number, 1) == 1 && (number == 3 || number == 4 || number == 2);
    if (ok) axes->space_dimension = (int)number;
    return ok;
}

bool ang_nrrd_axes_field(ang_nrrd_axes *axes, const char *label, const char *field, const char *value, bool *known,
                         ang_error *err) {
    static const struct {
        const char *name;
        enum { DIMENSION, SPACE, SPACE_DIMENSION, SPACE_UNITS, DIRECTIONS, ORIGIN, NUMBERS, WORDS, CENTRES } what;
        size_t member;
    } fields[] = {{"dimension", DIMENSION, 0},
                  {"space", SPACE, 0},
                  {"space dimension", SPACE_DIMENSION, 0},
                  {"space units", SPACE_UNITS, 0},
                  {"space directions", DIRECTIONS, 0},
                  {"space origin", ORIGIN, 0},
                  {"sizes", NUMBERS, offsetof(ang_nrrd_axis, size)},
                  {"spacings", NUMBERS, offsetof(ang_nrrd_axis, spacing)},
                  {"thicknesses", NUMBERS, offsetof(ang_nrrd_axis, thickness)},
                  {"axis mins", NUMBERS, offsetof(ang_nrrd_axis, least)},
                  {"axismins", NUMBERS, offsetof(ang_nrrd_axis, least)},
                  {"axis maxs", NUMBERS, offsetof(ang_nrrd_axis, most)},
                  {"axismaxs", NUMBERS, offsetof(ang_nrrd_axis, most)},
                  {"kinds", WORDS, offsetof(ang_nrrd_axis, kind)},
                  {"units", WORDS, offsetof(ang_nrrd_axis, unit)},
                  {"centers", CENTRES, 0},
                  {"centerings", CENTRES, 0}};
    *known = false;
    for (size_t i = 0; i < sizeof fields / sizeof *fields && !*known; i++) {
        if (!ang_header_is(field, fields[i].name)) continue;
        *known = true;
        bool per_axis = fields[i].what >= NUMBERS || fields[i].what == DIRECTIONS;
        if (per_axis && axes->dimension == 0)
            return ang_fail(err, ANG_INPUT, "%s: its NRRD header has \"%s\" before \"dimension\"", label, field);
        bool ok = true;
        switch (fields[i].what) {
        case DIMENSION:
            ok = use_dimension(axes, value);
            break;
        case SPACE:
            ok = use_space(axes, value);
            break;
        case SPACE_DIMENSION:
            ok = use_space_dimension(axes, value);
            break;
        case SPACE_UNITS:
            use_space_units(axes, value);
            break;
        case DIRECTIONS:
            ok = use_directions(axes, value);
            break;
        case ORIGIN:
            ok = use_origin(axes, value);
            break;
        case NUMBERS:
            ok = use_numbers(axes, value, fields[i].member);
            break;
        case WORDS:
            use_words(axes, value, fields[i].member);
            break;
        case CENTRES:
            use_centres(axes, value);
            break;
        }
        if (!ok) return refuse(label, field, value, err);
    }
    return true;
}

static bool kind_is(const ang_nrrd_axis *axis, const char *const *names) {
    for (; *names; names++)
        if (ang_header_is(axis->kind, *names)) return true;
    return false;
}

/* Whether an axis may be one of the volume's: told by directions where there are any, else by kinds, else by spacings.
 */
static bool is_spatial(const ang_nrrd_axes *axes, int index) {
    static const char *const spatial[] = {"domain", "space", NULL}, *const unknown[] = {"", "???", "none", NULL};
    const ang_nrrd_axis *axis = &axes->axis[index];
    bool directions = false, spacings = false;
    for (int i = 0; i < axes->dimension; i++) {
        directions = directions || axes->axis[i].has_direction;
        spacings = spacings || isfinite(axes->axis[i].spacing);
    }
    if (directions) return axis->has_direction;
    if (kind_is(axis, spatial)) return true;
    return kind_is(axis, unknown) && (axes->dimension <= 3 || !spacings || isfinite(axis->spacing));
}

/* The phases: an axis beside the volume's, whose values belong together as whole volumes. */
static bool take_other(const char *label, const ang_nrrd_axis *axis, size_t run, ang_volume_header *header,
                       ang_error *err) {
    static const char *const phases[] = {"", "???", "none", "list", "time", "domain", "space", NULL};
    if (axis->size == 1) return true;
    if (!kind_is(axis, phases))
        return ang_fail(err, ANG_INPUT, "%s: has %g numbers in each voxel (kind %.31s): a CT has one", label,
                        axis->size, axis->kind);
    if (header->phases > 1)
        return ang_fail(err, ANG_INPUT, "%s: has more than one axis beside the three of its volume", label);
    header->phases = (int)axis->size;
    header->phase_run = run;
    header->phase_step = axis->spacing;
    header->phase_first = isfinite(axis->least) ? axis->least : 0;
    snprintf(header->phase_unit, sizeof header->phase_unit, "%s", ang_header_unit_time(axis->unit));
    return true;
}

/* Which axes are the volume's, in order; phases of the header. Returns how many; 0 with an error. */
static int share_out(const ang_nrrd_axes *axes, const char *label, int spatial[3], ang_volume_header *header,
                     ang_error *err) {
    size_t run = 1;
    int count = 0;
    for (int i = 0; i < axes->dimension; i++) {
        const ang_nrrd_axis *axis = &axes->axis[i];
        if (!(axis->size >= 1 && axis->size <= INT_MAX && axis->size == floor(axis->size))) {
            ang_fail(err, ANG_INPUT, "%s: an axis of %g samples cannot be", label, axis->size);
            return 0;
        }
        if (count < 3 && is_spatial(axes, i)) {
            header->dims[count] = (int)axis->size;
            spatial[count++] = i;
        } else if (!take_other(label, axis, run, header, err)) {
            return 0;
        }
        if (__builtin_mul_overflow(run, (size_t)axis->size, &run)) {
            ang_fail(err, ANG_INPUT, "%s: more samples than there can be", label);
            return 0;
        }
    }
    if (count < 2) ang_fail(err, ANG_INPUT, "%s: has %d axis in space: a volume has three", label, count);
    return count < 2 ? 0 : count;
}

/* Millimetres between samples of an axis without direction, and where the first lies. */
static double spacing_of(const ang_nrrd_axis *axis, ang_volume_header *header, double *first) {
    double spacing = axis->spacing, unit = ang_header_unit_mm(axis->unit);
    double steps = axis->node ? axis->size - 1 : axis->size;
    if (!isfinite(spacing) && isfinite(axis->least) && isfinite(axis->most) && steps > 0)
        spacing = (axis->most - axis->least) / steps;
    if (!isfinite(spacing) && isfinite(axis->thickness)) {
        spacing = axis->thickness;
        ang_notes_add(&header->assumptions, "a spacing is not given: the thickness of %g is taken", spacing);
    }
    if (!isfinite(spacing) || spacing == 0) {
        spacing = 1;
        ang_notes_add(&header->warnings, "a spacing is not given: 1 mm is taken");
    }
    if (!isfinite(unit)) unit = 1;
    *first = isfinite(axis->least) ? (axis->least + (axis->node ? 0 : spacing / 2)) * unit : 0;
    return spacing * unit;
}

/* The patient's axes for those of the space: to left, posterior, superior. */
static void to_patient(const ang_nrrd_axes *axes, ang_mat4 *affine, ang_volume_header *header) {
    bool ras = ang_header_is(axes->space, "RAS") || ang_header_is(axes->space, "right-anterior-superior");
    bool las = ang_header_is(axes->space, "LAS") || ang_header_is(axes->space, "left-anterior-superior");
    bool lps = ang_header_is(axes->space, "LPS") || ang_header_is(axes->space, "left-posterior-superior");
    for (int column = 0; column < 4; column++) {
        if (ras) affine->m[0][column] = -affine->m[0][column];
        if (ras || las) affine->m[1][column] = -affine->m[1][column];
    }
    if (!ras && !las && !lps)
        ang_notes_add(&header->warnings,
                      "its space is %s: orientation is not known, x is taken as left, y as posterior, "
                      "z as superior",
                      axes->space[0] ? axes->space : "not named");
}

/* The third axis of a single slice. */
static void add_normal(ang_mat4 *affine, ang_volume_header *header) {
    ang_vec3 normal = ang_vec3_unit(ang_vec3_cross(ang_mat4_column(affine, 0), ang_mat4_column(affine, 1)));
    affine->m[0][2] = normal.x;
    affine->m[1][2] = normal.y;
    affine->m[2][2] = normal.z;
    header->dims[2] = 1;
    ang_notes_add(&header->assumptions, "it is a single slice: 1 mm thick");
}

bool ang_nrrd_axes_use(const ang_nrrd_axes *axes, const char *label, ang_volume_header *header, ang_error *err) {
    int spatial[3], count = share_out(axes, label, spatial, header, err);
    if (count == 0) return false;
    ang_mat4 affine = {0}, inverse;
    affine.m[3][3] = 1;
    for (int column = 0; column < count; column++) {
        const ang_nrrd_axis *axis = &axes->axis[spatial[column]];
        double first = 0;
        if (!axis->has_direction) affine.m[column][column] = spacing_of(axis, header, &first);
        for (int row = 0; row < 3 && axis->has_direction; row++)
            affine.m[row][column] = axis->direction[row] * axes->unit_mm[row];
        affine.m[column][3] = first;
    }
    if (!axes->has_origin && axes->axis[spatial[0]].has_direction)
        ang_notes_add(&header->assumptions,
                      "its header has no \"space origin\": the first voxel is taken to lie at 0,0,0");
    for (int row = 0; row < 3 && axes->has_origin; row++) affine.m[row][3] = axes->origin[row] * axes->unit_mm[row];
    if (count == 2) add_normal(&affine, header);
    to_patient(axes, &affine, header);
    if (!ang_mat4_inverse(&affine, &inverse))
        return ang_fail(err, ANG_GEOMETRY, "%s: its space directions do not span a volume", label);
    header->affine = affine;
    return true;
}
