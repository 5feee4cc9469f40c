#include "io/preset/slicer/property.h"

#include "core/base/memory.h"
#include "io/json.h"
#include "io/preset/slicer/forms.h"

#include <errno.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

const ang_property ang_property_default = {.ambient = 0.1,
                                           .diffuse = 0.7,
                                           .specular = 0.2,
                                           .power = 10,
                                           .unit_distance = 1,
                                           .iso = NAN,
                                           .components = 1,
                                           .opacity = {.channels = 1},
                                           .gradient = {.channels = 1},
                                           .colour = {.channels = 3}};

static bool ends_in(const char *path, const char *ending) {
    size_t length = strlen(path), more = strlen(ending);
    return length > more && strcasecmp(path + length - more, ending) == 0;
}

ang_property_form ang_property_form_of(const char *path) {
    return ends_in(path, ".vp")        ? ANG_PROPERTY_VP
           : ends_in(path, ".vp.json") ? ANG_PROPERTY_JSON
           : ends_in(path, ".xml")     ? ANG_PROPERTY_XML
                                       : ANG_PROPERTY_NONE;
}

void ang_property_clear(ang_property *property) {
    free(property->name);
    free(property->opacity.points);
    free(property->gradient.points);
    free(property->colour.points);
    *property = ang_property_default;
}

void ang_property_list_clear(ang_property_list *list) {
    for (size_t i = 0; i < list->count; i++) ang_property_clear(&list->item[i]);
    free(list->item);
    *list = (ang_property_list){0};
}

ang_property *ang_property_list_add(ang_property_list *list, const char *name, size_t length, ang_error *err) {
    if (list->count >= ANG_PROPERTY_MOST) {
        ang_fail(err, ANG_USAGE, "more than %d volume properties", ANG_PROPERTY_MOST);
        return NULL;
    }
    ang_property *grown = realloc(list->item, (list->count + 1) * sizeof *grown);
    if (grown) list->item = grown;
    char *copy = grown ? strndup(name, length) : NULL;
    if (!copy) {
        ang_fail(err, ANG_LIMIT, "no memory for a volume property");
        return NULL;
    }
    ang_property *added = &list->item[list->count++];
    *added = ang_property_default;
    added->name = copy;
    return added;
}

bool ang_property_function_add(ang_property_function *function, const ang_property_point *point, ang_error *err) {
    bool finite = isfinite(point->x) && isfinite(point->midpoint) && isfinite(point->sharpness);
    for (int c = 0; c < function->channels; c++) finite = finite && isfinite(point->y[c]);
    if (!finite) return ang_fail(err, ANG_USAGE, "point %zu holds what is no finite number", function->count);
    if (function->count >= ANG_PROPERTY_MOST_POINTS)
        return ang_fail(err, ANG_USAGE, "more than %d points", ANG_PROPERTY_MOST_POINTS);
    size_t count = function->count;
    if ((count & (count - 1)) == 0) { /* room for powers of two */
        ang_property_point *grown = realloc(function->points, (count ? 2 * count : 1) * sizeof *grown);
        if (!grown) return ang_fail(err, ANG_LIMIT, "no memory for a volume property");
        function->points = grown;
    }
    function->points[function->count++] = *point;
    return true;
}

bool ang_property_function_read(const char *text, ang_property_function *function, ang_error *err) {
    char *end;
    int size = 1 + function->channels;
    double count = strtod(text, &end);
    if (end == text)
        return text[strspn(text, " \t\r\n")] == '\0' || ang_fail(err, ANG_USAGE, "it is no list of numbers");
    if (!(count >= 0 && count <= (double)size * ANG_PROPERTY_MOST_POINTS) || fmod(count, size) != 0)
        return ang_fail(err, ANG_USAGE, "its first number, %g, must be how many follow: %d for each point", count,
                        size);
    for (size_t i = 0; i < (size_t)count / (size_t)size; i++) {
        ang_property_point point = {.midpoint = 0.5};
        for (int k = 0; k < size; k++) {
            const char *at = end;
            double value = strtod(at, &end);
            if (end == at)
                return ang_fail(err, ANG_USAGE, "it says that %g numbers follow, but number %zu is none", count,
                                i * (size_t)size + (size_t)k + 1);
            *(k == 0 ? &point.x : &point.y[k - 1]) = value;
        }
        if (!ang_property_function_add(function, &point, err)) return false;
    }
    if (end[strspn(end, " \t\r\n")])
        return ang_fail(err, ANG_USAGE, "it says that %g numbers follow, but more do", count);
    ang_property_function_settle(function);
    return true;
}

/* Slicer writes steps as points that are next to one another among doubles. */
static bool at_one_place(double a, double b) {
    return b - a <= 8 * (nextafter(fabs(a), INFINITY) - fabs(a)) || fabs(b - a) < 1e-300;
}

void ang_property_function_settle(ang_property_function *function) {
    ang_property_point *p = function->points;
    /* By insertion, which keeps the order of equals: files are in order but for mistakes. */
    for (size_t i = 1; i < function->count; i++) {
        ang_property_point moved = p[i];
        size_t j = i;
        for (; j > 0 && p[j - 1].x > moved.x; j--) p[j] = p[j - 1];
        p[j] = moved;
    }
    for (size_t i = 1; i < function->count; i++)
        if (at_one_place(p[i - 1].x, p[i].x)) p[i].x = p[i - 1].x;
}

/* How far of the way from one point to the next its value has gone where `s` of the way along x has been gone: see
 * vtkPiecewiseFunction::GetTable. `t` is left for the caller where the piece is a curve. */
static double piece(double s, const ang_property_point *from, double y0, double y1) {
    double m = from->midpoint, sharp = from->sharpness;
    m = fmin(fmax(m, 0.00001), 0.99999);
    s = s < m ? 0.5 * s / m : 0.5 + 0.5 * (s - m) / (1 - m);
    if (sharp > 0.99) return s < 0.5 ? y0 : y1;
    if (sharp < 0.01) return (1 - s) * y0 + s * y1;
    if (s < 0.5)
        s = 0.5 * pow(2 * s, 1 + 10 * sharp);
    else if (s > 0.5)
        s = 1 - 0.5 * pow(2 * (1 - s), 1 + 10 * sharp);
    double s2 = s * s, s3 = s2 * s, slope = (1 - sharp) * (y1 - y0);
    double y = (2 * s3 - 3 * s2 + 1) * y0 + (3 * s2 - 2 * s3) * y1 + (s3 - 2 * s2 + s) * slope + (s3 - s2) * slope;
    return fmin(fmax(y, fmin(y0, y1)), fmax(y0, y1));
}

void ang_property_value(const ang_property_function *function, double x, bool below, double y[3]) {
    const ang_property_point *p = function->points;
    y[0] = y[1] = y[2] = 0;
    if (function->count == 0) return;
    /* The first point that lies beyond x. */
    size_t next = 0, most = function->count;
    while (next < most) {
        size_t middle = next + (most - next) / 2;
        if (p[middle].x > x || (below && p[middle].x >= x))
            most = middle;
        else
            next = middle + 1;
    }
    bool outside = next == 0 || next == function->count;
    const ang_property_point *from = &p[next > 0 ? next - 1 : 0], *to = &p[next < function->count ? next : next - 1];
    for (int c = 0; c < function->channels; c++)
        y[c] = outside ? (next == 0 ? to->y[c] : from->y[c])
                       : piece((x - from->x) / (to->x - from->x), from, from->y[c], to->y[c]);
}

bool ang_property_parse(ang_property_form form, const char *file, const char *text, size_t size,
                        ang_property_list *list, ang_error *err) {
    *list = (ang_property_list){0};
    if (size > ANG_PROPERTY_LONGEST_FILE)
        return ang_fail(err, ANG_USAGE, "%s: is too large for a volume property (more than 4 MB)", file);
    if (memchr(text, 0, size)) return ang_fail(err, ANG_USAGE, "%s: is no text", file);
    char *copy = strndup(text, size);
    if (!copy) return ang_fail(err, ANG_LIMIT, "%s: no memory to read it", file);
    bool read = form == ANG_PROPERTY_VP     ? ang_property_parse_vp(file, copy, list, err)
                : form == ANG_PROPERTY_XML  ? ang_property_parse_xml(file, copy, list, err)
                : form == ANG_PROPERTY_JSON ? ang_property_parse_json(file, copy, list, err)
                                            : ang_fail(err, ANG_USAGE, "%s: is none of .vp, .xml and .vp.json", file);
    free(copy);
    if (!read) ang_property_list_clear(list);
    return read;
}

bool ang_property_read(const char *path, ang_property_list *list, ang_error *err) {
    ang_property_form form = ang_property_form_of(path);
    *list = (ang_property_list){0};
    if (form == ANG_PROPERTY_NONE)
        return ang_fail(err, ANG_USAGE, "%s: is no volume property by its name: .vp, .vp.json or .xml", path);
    FILE *in = fopen(path, "rb");
    if (!in) return ang_fail(err, ANG_USAGE, "%s: cannot be read (%s)", path, strerror(errno));
    enum { room = ANG_PROPERTY_LONGEST_FILE + 1 };
    char *text = ang_alloc(room, 1, "volume property", err);
    size_t size = text ? fread(text, 1, room, in) : 0;
    bool failed = ferror(in) != 0;
    fclose(in);
    bool read = text && !failed && ang_property_parse(form, path, text, size, list, err);
    if (text && failed) ang_fail(err, ANG_USAGE, "%s: cannot be read", path);
    free(text);
    return read;
}

void ang_property_function_write(const ang_property_function *function, FILE *out) {
    char number[40];
    fprintf(out, "%zu", function->count * (size_t)(1 + function->channels));
    for (size_t i = 0; i < function->count; i++) {
        fprintf(out, " %s", ang_json_number_text(function->points[i].x, number));
        for (int c = 0; c < function->channels; c++)
            fprintf(out, " %s", ang_json_number_text(function->points[i].y[c], number));
    }
}
