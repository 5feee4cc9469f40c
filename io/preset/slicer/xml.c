/* MRML: a VolumeProperty element for each. As much of XML 1.0 as these files have: elements, attributes, comments,
 * processing instructions, the five named entities and numbered ones. Document types are refused. */
#include "io/json.h"
#include "io/preset/slicer/forms.h"
#include "io/text.h"

#include <stdlib.h>
#include <string.h>

#define BLANKS " \t\r\n"

typedef struct reader {
    const char *file, *text, *at;
    ang_property_list *list;
    ang_property *property; /* the element that is being read; NULL: another one */
    ang_error *err;
} reader;

static bool fail(const reader *r, const char *what) {
    int line = 1;
    for (const char *c = r->text; c < r->at; c++) line += *c == '\n';
    return ang_fail(r->err, ANG_USAGE, "%s:%d: %s", r->file, line, what);
}

static bool skip_past(reader *r, const char *end, const char *what) {
    const char *found = strstr(r->at, end);
    if (!found) return fail(r, what);
    r->at = found + strlen(end);
    return true;
}

static size_t name_length(const char *text) { return strcspn(text, BLANKS "=/><\"'&"); }

/* The character of a numbered entity in UTF-8; its bytes, 0 where it is none. */
static size_t put_character(unsigned long code, char *out) {
    if (code == 0 || code > 0x10FFFF || (code >= 0xD800 && code < 0xE000)) return 0;
    if (code < 0x80) {
        out[0] = (char)code;
        return 1;
    }
    size_t more = code < 0x800 ? 1 : code < 0x10000 ? 2 : 3;
    out[0] = (char)((0xFF00 >> (more + 1) & 0xFF) | code >> (6 * more));
    for (size_t i = 1; i <= more; i++) out[i] = (char)(0x80 | (code >> (6 * (more - i)) & 0x3F));
    return more + 1;
}

/* Replaces entities in place, which never makes it longer. */
static bool decode(const reader *r, char *text) {
    static const char *const names[5][2] = {
        {"&amp;", "&"}, {"&lt;", "<"}, {"&gt;", ">"}, {"&quot;", "\""}, {"&apos;", "'"}};
    char *out = text;
    while (*text) {
        if (*text != '&') {
            *out++ = *text++;
            continue;
        }
        size_t i = 0, written = 1;
        while (i < 5 && strncmp(text, names[i][0], strlen(names[i][0])) != 0) i++;
        if (i < 5) {
            *out = names[i][1][0];
            text += strlen(names[i][0]);
        } else {
            char *end = text;
            bool hex = strncmp(text, "&#x", 3) == 0;
            const char *digits = text + (hex ? 3 : 2);
            bool numbered = text[1] == '#' && strspn(digits, hex ? "0123456789abcdefABCDEF" : "0123456789") > 0;
            unsigned long code = numbered ? strtoul(digits, &end, hex ? 16 : 10) : 0;
            char character[4];
            written = *end == ';' ? put_character(code, character) : 0;
            if (written == 0) return fail(r, "an entity that is none of XML's");
            memcpy(out, character, written);
            text = end + 1;
        }
        out += written;
    }
    *out = '\0';
    return true;
}

static bool read_number(const reader *r, const char *name, const char *text, double *value) {
    char *end, what[128];
    double number = strtod(text, &end);
    if (end == text || end[strspn(end, BLANKS)]) {
        snprintf(what, sizeof what, "%s is no number", name);
        return fail(r, what);
    }
    *value = number;
    return true;
}

static bool read_function(const reader *r, const char *name, const char *text, ang_property_function *function) {
    ang_error own = {0};
    if (function->count > 0) return fail(r, "a function is given twice");
    if (ang_property_function_read(text, function, &own)) return true;
    char what[sizeof own.message + 32];
    snprintf(what, sizeof what, "%s: %s", name, own.message);
    return own.code == ANG_LIMIT ? ang_fail(r->err, ANG_LIMIT, "%s: %s", r->file, own.message) : fail(r, what);
}

/* One attribute of a VolumeProperty; others than these say nothing about the picture. */
static bool take(const reader *r, const char *name, const char *value) {
    ang_property *p = r->property;
    double number = 0;
    struct {
        const char *name;
        double *value;
    } const numbers[] = {
        {"ambient", &p->ambient}, {"diffuse", &p->diffuse}, {"specular", &p->specular}, {"specularPower", &p->power}};
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
        if (strcmp(name, numbers[i].name) == 0) return read_number(r, name, value, numbers[i].value);
    if (strcmp(name, "scalarOpacity") == 0) return read_function(r, name, value, &p->opacity);
    if (strcmp(name, "gradientOpacity") == 0) return read_function(r, name, value, &p->gradient);
    if (strcmp(name, "colorTransfer") == 0) return read_function(r, name, value, &p->colour);
    if (strcmp(name, "interpolation") == 0 || strcmp(name, "shade") == 0) {
        if (!read_number(r, name, value, &number)) return false;
        if (name[0] == 's')
            p->shade = number > 0;
        else
            p->nearest = !(number > 0);
        return true;
    }
    if (strcmp(name, "name") != 0) return true;
    char *copy = strdup(value);
    if (!copy) return ang_fail(r->err, ANG_LIMIT, "%s: no memory to read it", r->file);
    free(p->name);
    p->name = copy;
    return true;
}

static bool read_attribute(reader *r) {
    size_t length = name_length(r->at);
    char name[64];
    if (length == 0) return fail(r, "an attribute without a name");
    snprintf(name, sizeof name, "%.*s", length < sizeof name ? (int)length : (int)sizeof name - 1, r->at);
    r->at += length;
    r->at += strspn(r->at, BLANKS);
    if (*r->at != '=') return fail(r, "an attribute without a value");
    r->at++;
    r->at += strspn(r->at, BLANKS);
    char quote = *r->at;
    const char *end = quote == '"' || quote == '\'' ? strchr(r->at + 1, quote) : NULL;
    if (!end) return fail(r, "a value must stand in quotes");
    char *value = strndup(r->at + 1, (size_t)(end - r->at) - 1);
    if (!value) return ang_fail(r->err, ANG_LIMIT, "%s: no memory to read it", r->file);
    bool read = !r->property || (decode(r, value) && take(r, name, value));
    free(value);
    r->at = end + 1;
    return read;
}

/* From its "<" to its ">". */
static bool read_element(reader *r) {
    static const char wanted[] = "VolumeProperty";
    r->at++;
    size_t length = name_length(r->at);
    if (length == 0) return fail(r, "a \"<\" that begins no element");
    r->property = NULL;
    if (length == sizeof wanted - 1 && strncmp(r->at, wanted, length) == 0) {
        r->property = ang_property_list_add(r->list, "", 0, r->err);
        if (!r->property) return false;
    }
    r->at += length;
    for (;;) {
        r->at += strspn(r->at, BLANKS);
        if (*r->at == '\0') return fail(r, "the file ends inside an element");
        if (*r->at == '>' || strncmp(r->at, "/>", 2) == 0) break;
        if (!read_attribute(r)) return false;
    }
    r->at += *r->at == '/' ? 2 : 1;
    return !r->property || r->property->name[0] || fail(r, "a VolumeProperty without a name");
}

bool ang_property_parse_xml(const char *file, const char *text, ang_property_list *list, ang_error *err) {
    reader r = {.file = file, .text = text, .at = text, .list = list, .err = err};
    bool read = true;
    while (read && (r.at = strchr(r.at, '<'))) {
        if (strncmp(r.at, "<!--", 4) == 0)
            read = skip_past(&r, "-->", "a comment without an end");
        else if (strncmp(r.at, "<?", 2) == 0)
            read = skip_past(&r, "?>", "a processing instruction without an end");
        else if (r.at[1] == '!')
            read = fail(&r, "a document type or character data, which MRML has not");
        else if (r.at[1] == '/')
            read = skip_past(&r, ">", "the file ends inside an element");
        else
            read = read_element(&r);
    }
    if (read && list->count == 0)
        read = ang_fail(err, ANG_USAGE, "%s: holds no VolumeProperty element, as 3D Slicer's presets.xml does", file);
    return read;
}

static void write_function(const char *name, const ang_property_function *function, FILE *out) {
    fprintf(out, " %s=\"", name);
    ang_property_function_write(function, out);
    fputc('"', out);
}

void ang_property_write_xml(const ang_property_list *list, FILE *out) {
    fputs("<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<MRML>\n", out);
    for (size_t i = 0; i < list->count; i++) {
        const ang_property *p = &list->item[i];
        const double values[4] = {p->ambient, p->diffuse, p->specular, p->power};
        static const char *const names[4] = {"ambient", "diffuse", "specular", "specularPower"};
        char number[40];
        fprintf(out, "  <VolumeProperty id=\"vtkMRMLVolumePropertyNode%zu\" name=\"", i + 1);
        ang_text_put_markup(out, p->name);
        fprintf(out,
                "\" hideFromEditors=\"false\" selectable=\"true\" selected=\"false\" interpolation=\"%d\" shade=\"%d\"",
                p->nearest ? 0 : 1, p->shade ? 1 : 0);
        for (int k = 0; k < 4; k++) fprintf(out, " %s=\"%s\"", names[k], ang_json_number_text(values[k], number));
        write_function("scalarOpacity", &p->opacity, out);
        write_function("gradientOpacity", &p->gradient, out);
        write_function("colorTransfer", &p->colour, out);
        fputs("/>\n", out);
    }
    fputs("</MRML>\n", out);
}
