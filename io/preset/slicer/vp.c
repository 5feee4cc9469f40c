/* The form of nine lines. */
#include "io/json.h"
#include "io/preset/slicer/forms.h"

#include <stdlib.h>
#include <string.h>

static const char *const line_names[9] = {"interpolation",  "shade",          "diffuse",          "ambient", "specular",
                                          "specular power", "scalar opacity", "gradient opacity", "colour"};

static bool read_number(const char *text, double *value, ang_error *err) {
    char *end;
    double read = strtod(text, &end);
    if (end == text || end[strspn(end, " \t\r")]) return ang_fail(err, ANG_USAGE, "it is no number");
    *value = read;
    return true;
}

static bool read_line(int line, const char *text, ang_property *p, ang_error *err) {
    double number = 0;
    double *const numbers[4] = {&p->diffuse, &p->ambient, &p->specular, &p->power};
    if (line >= 6)
        return ang_property_function_read(text, line == 6 ? &p->opacity : line == 7 ? &p->gradient : &p->colour, err);
    if (text[strspn(text, " \t\r")] == '\0') return true; /* as by default */
    if (line >= 2) return read_number(text, numbers[line - 2], err);
    if (!read_number(text, &number, err)) return false;
    if (line == 0)
        p->nearest = !(number > 0);
    else
        p->shade = number > 0;
    return true;
}

bool ang_property_parse_vp(const char *file, const char *text, ang_property_list *list, ang_error *err) {
    const char *slash = strrchr(file, '/'), *name = slash ? slash + 1 : file;
    size_t length = strlen(name);
    if (length > 3) length -= 3; /* ".vp" */
    ang_property *property = ang_property_list_add(list, name, length, err);
    char *line = property ? strdup(text) : NULL, *all = line;
    if (!line) return ang_fail(err, ANG_LIMIT, "%s: no memory to read it", file);
    bool read = true;
    for (int i = 0; i < 9 && read; i++) {
        char *end = line ? strchr(line, '\n') : NULL;
        if (end) *end = '\0';
        ang_error own = {0};
        if (!line || (!end && !line[0]))
            read = ang_fail(err, ANG_USAGE, "%s: ends before line %d, %s, of nine", file, i + 1, line_names[i]);
        else if (!read_line(i, line, property, &own))
            read = ang_fail(err, own.code, "%s:%d: %s: %s", file, i + 1, line_names[i], own.message);
        line = end ? end + 1 : NULL;
    }
    if (read && line && line[strspn(line, " \t\r\n")])
        read = ang_fail(err, ANG_USAGE, "%s: goes on after the ninth line; this program knows nine", file);
    free(all);
    return read;
}

/* Slicer reads lines into 1024 bytes. */
static const long longest_line = 1023;

static void write_vp(const ang_property *p, FILE *out, ang_notes *notes) {
    char number[40];
    const double values[4] = {p->diffuse, p->ambient, p->specular, p->power};
    fprintf(out, "%d\n%d\n", p->nearest ? 0 : 1, p->shade ? 1 : 0);
    for (int i = 0; i < 4; i++) fprintf(out, "%s\n", ang_json_number_text(values[i], number));
    const ang_property_function *const functions[3] = {&p->opacity, &p->gradient, &p->colour};
    for (int i = 0; i < 3; i++) {
        long before = ftell(out);
        ang_property_function_write(functions[i], out);
        if (ftell(out) - before > longest_line)
            ang_notes_add(notes,
                          "%s: the line of its %s has more than %ld characters, which 3D Slicer does not read from "
                          "a .vp file; write .vp.json or .xml for it",
                          p->name, line_names[6 + i], longest_line);
        fputc('\n', out);
    }
}

char *ang_property_print(ang_property_form form, const ang_property_list *list, ang_notes *notes, ang_error *err) {
    if (form == ANG_PROPERTY_VP && list->count != 1) {
        ang_fail(err, ANG_USAGE, "a .vp file holds one preset, not %zu; .xml holds several", list->count);
        return NULL;
    }
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    bool done = out != NULL;
    if (done && form == ANG_PROPERTY_VP) write_vp(&list->item[0], out, notes);
    if (done && form == ANG_PROPERTY_XML) ang_property_write_xml(list, out);
    if (done && form == ANG_PROPERTY_JSON) done = ang_property_write_json(list, out, err);
    bool whole = out && fclose(out) == 0;
    if (done && whole) return text;
    if (done || !out) ang_fail(err, ANG_LIMIT, "no memory to write a volume property");
    free(text);
    return NULL;
}
