#include "io/json.h"

#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_BYTES = 4 << 20, SHOWN_CHARACTERS = 40 };

static char *read_text(const char *path, ang_error *err) {
    FILE *file = fopen(path, "rb");
    if (!file) {
        ang_fail(err, ANG_INPUT, "%s: cannot be read: %s", path, strerror(errno));
        return NULL;
    }
    char *text = malloc(MOST_BYTES + 1);
    size_t size = text ? fread(text, 1, MOST_BYTES + 1, file) : 0;
    int error = ferror(file) ? errno : 0;
    fclose(file);
    if (text && !error && size <= MOST_BYTES && !memchr(text, 0, size)) {
        text[size] = 0;
        char *shrunk = realloc(text, size + 1);
        return shrunk ? shrunk : text;
    }
    if (!text)
        ang_fail(err, ANG_LIMIT, "%s: no memory to read it", path);
    else if (error)
        ang_fail(err, ANG_INPUT, "%s: cannot be read: %s", path, strerror(error));
    else if (size > MOST_BYTES)
        ang_fail(err, ANG_USAGE, "%s: is larger than %d MB, too large to be read", path, MOST_BYTES >> 20);
    else
        ang_fail(err, ANG_USAGE, "%s: is not text and so not JSON", path);
    free(text);
    return NULL;
}

static int line_at(const char *text, const char *position) {
    int line = 1;
    for (const char *p = text; p < position && *p; p++) line += *p == '\n';
    return line;
}

static bool parse(ang_json *json, ang_error *err) {
    const char *end = NULL;
    json->root = cJSON_ParseWithLengthOpts(json->text, strlen(json->text) + 1, &end, true);
    if (json->root) return true;
    if (!end) end = json->text;
    int line = line_at(json->text, end);
    int shown = (int)strcspn(end, "\r\n");
    if (*end == 0 || end[strspn(end, " \t\r\n")] == 0)
        return ang_fail(err, ANG_USAGE, "%s:%d: is not valid JSON: it ends too early", json->file, line);
    return ang_fail(err, ANG_USAGE, "%s:%d: is not valid JSON near \"%.*s\"", json->file, line,
                    shown < SHOWN_CHARACTERS ? shown : SHOWN_CHARACTERS, end);
}

static bool open_text(const char *file, char *text, ang_json *json, ang_error *err) {
    *json = (ang_json){.file = strdup(file), .text = text};
    bool opened = json->file && text ? parse(json, err) : ang_fail(err, ANG_LIMIT, "%s: no memory to read it", file);
    if (!opened) ang_json_close(json);
    return opened;
}

bool ang_json_open(const char *path, ang_json *json, ang_error *err) {
    *json = (ang_json){0};
    char *text = read_text(path, err);
    return text && open_text(path, text, json, err);
}

bool ang_json_parse(const char *file, const char *text, ang_json *json, ang_error *err) {
    return open_text(file, strdup(text), json, err);
}

void ang_json_close(ang_json *json) {
    cJSON_Delete(json->root);
    free(json->text);
    free(json->file);
    *json = (ang_json){0};
}

static const char *skip_space(const char *p) { return p + strspn(p, " \t\r\n"); }

/* Past the string whose opening quote is at `p`. */
static const char *skip_string(const char *p) {
    for (p++; *p && *p != '"'; p++)
        if (*p == '\\' && p[1]) p++;
    return *p ? p + 1 : p;
}

static const char *skip_value(const char *p) {
    int depth = 0;
    do {
        p = skip_space(p);
        if (*p == '"')
            p = skip_string(p);
        else if (*p == '{' || *p == '[')
            depth++, p++;
        else if (*p == '}' || *p == ']')
            depth--, p++;
        else if (*p == ',' || *p == ':')
            p++;
        else
            p += strcspn(p, ",:]}[{\" \t\r\n");
    } while (*p && depth > 0);
    return p;
}

/* The value of `key` in the object at `p`, or NULL; `place` receives the key's position. */
static const char *find_key(const char *p, const char *key, size_t length, const char **place) {
    if (*p != '{') return NULL;
    p = skip_space(p + 1);
    while (*p == '"') {
        const char *name = p;
        p = skip_string(p);
        bool found = (size_t)(p - name) == length + 2 && strncmp(name + 1, key, length) == 0;
        p = skip_space(p);
        if (*p != ':') return NULL;
        p = skip_space(p + 1);
        if (found) {
            *place = name;
            return p;
        }
        p = skip_space(skip_value(p));
        if (*p == ',') p = skip_space(p + 1);
    }
    return NULL;
}

static const char *find_element(const char *p, long index) {
    if (*p != '[') return NULL;
    p = skip_space(p + 1);
    while (*p && *p != ']') {
        if (index-- == 0) return p;
        p = skip_space(skip_value(p));
        if (*p == ',') p = skip_space(p + 1);
    }
    return NULL;
}

/* The value at `path`, or NULL; `place` receives where the deepest part of the path that exists begins. */
static const char *find(const char *text, const char *path, const char **place) {
    const char *byte_order_mark = "\xEF\xBB\xBF";
    const char *p = skip_space(strncmp(text, byte_order_mark, 3) == 0 ? text + 3 : text);
    *place = p;
    while (p && *path) {
        if (*path == '[') {
            char *end;
            p = find_element(p, strtol(path + 1, &end, 10));
            if (p) *place = p;
            path = *end == ']' ? end + 1 : end;
        } else {
            if (*path == '.') path++;
            size_t length = strcspn(path, ".[");
            p = find_key(p, path, length, place);
            path += length;
        }
    }
    return p;
}

int ang_json_line(const char *text, const char *path) {
    const char *place;
    find(text, path, &place);
    return line_at(text, place);
}

char *ang_json_part(const ang_json *json, const char *path) {
    const char *place, *value = find(json->text, path, &place);
    char *part = value ? strndup(json->text, (size_t)(skip_value(value) - json->text)) : NULL;
    for (size_t i = 0; part && json->text + i < value; i++)
        if (part[i] != '\n') part[i] = ' ';
    return part;
}

bool ang_json_fail(const ang_json *json, const char *path, ang_error *err, const char *format, ...) {
    char sentence[700];
    va_list args;
    va_start(args, format);
    vsnprintf(sentence, sizeof sentence, format, args);
    va_end(args);
    return ang_fail(err, ANG_USAGE, "%s:%d: %s", json->file, ang_json_line(json->text, path), sentence);
}

static void list_words(const char *const *words, char *out, size_t size) {
    size_t used = 0;
    out[0] = 0;
    for (size_t i = 0; words[i] && used < size; i++)
        used += (size_t)snprintf(out + used, size - used, "%s%s", i ? ", " : "", words[i]);
}

bool ang_json_check_fields(const ang_json *json, const cJSON *object, const char *prefix, const char *const *known,
                           ang_error *err) {
    for (const cJSON *item = object->child; item; item = item->next) {
        char path[160];
        snprintf(path, sizeof path, "%s%s", prefix, item->string);
        size_t k = 0;
        while (known[k] && strcmp(known[k], item->string) != 0) k++;
        if (!known[k]) {
            const char *nearest = ang_nearest_word(item->string, known);
            if (nearest)
                return ang_json_fail(json, path, err, "%s is not a known field; did you mean %s%s?", path, prefix,
                                     nearest);
            char words[400];
            list_words(known, words, sizeof words);
            return ang_json_fail(json, path, err, "%s is not a known field; known are %s", path, words);
        }
        for (const cJSON *earlier = object->child; earlier != item; earlier = earlier->next)
            if (strcmp(earlier->string, item->string) == 0)
                return ang_json_fail(json, path, err, "%s is given twice; keep one of them", path);
    }
    return true;
}

bool ang_json_number(const ang_json *json, const cJSON *item, const char *path, double low, double high, double *value,
                     ang_error *err) {
    if (!item) return true;
    if (!cJSON_IsNumber(item)) {
        char *text = cJSON_PrintUnformatted(item);
        ang_json_fail(json, path, err, "%s is %.*s; it must be a number", path, SHOWN_CHARACTERS, text ? text : "?");
        cJSON_free(text);
        return false;
    }
    double v = item->valuedouble;
    if (isfinite(v) && v >= low && v <= high) {
        *value = v;
        return true;
    }
    if (isinf(high)) return ang_json_fail(json, path, err, "%s is %g; it must be %g or more", path, v, low);
    return ang_json_fail(json, path, err, "%s is %g; it must lie in %g..%g", path, v, low, high);
}

bool ang_json_numbers(const ang_json *json, const cJSON *list, const char *path, int count, double low, double high,
                      double *values, ang_error *err) {
    if (!cJSON_IsArray(list) || cJSON_GetArraySize(list) != count)
        return ang_json_fail(json, path, err, "%s must be %d numbers in brackets", path, count);
    for (int i = 0; i < count; i++) {
        char place[128];
        snprintf(place, sizeof place, "%.112s[%d]", path, i);
        if (!ang_json_number(json, cJSON_GetArrayItem(list, i), place, low, high, &values[i], err)) return false;
    }
    return true;
}

/* Levenshtein's distance for words of up to 63 characters. */
static size_t edit_distance(const char *a, const char *b) {
    enum { MOST = 64 };
    size_t la = strlen(a), lb = strlen(b), row[MOST];
    if (la >= MOST || lb >= MOST) return MOST;
    for (size_t j = 0; j <= lb; j++) row[j] = j;
    for (size_t i = 1; i <= la; i++) {
        size_t diagonal = row[0];
        row[0] = i;
        for (size_t j = 1; j <= lb; j++) {
            size_t best = diagonal + (a[i - 1] != b[j - 1]);
            diagonal = row[j];
            if (row[j] + 1 < best) best = row[j] + 1;
            if (row[j - 1] + 1 < best) best = row[j - 1] + 1;
            row[j] = best;
        }
    }
    return row[lb];
}

const char *ang_nearest_word(const char *word, const char *const *known) {
    const char *nearest = NULL;
    size_t least = strlen(word) / 2 + 1;
    for (size_t i = 0; known[i]; i++) {
        size_t distance = edit_distance(word, known[i]);
        if (distance < least) least = distance, nearest = known[i];
    }
    return nearest;
}

void ang_json_add_number(cJSON *object, const char *name, double value) {
    if (isfinite(value))
        cJSON_AddNumberToObject(object, name, value);
    else
        cJSON_AddNullToObject(object, name);
}

const char *ang_json_number_text(double value, char text[40]) {
    snprintf(text, 40, "null");
    for (int digits = 15; digits <= 17 && isfinite(value); digits++) {
        snprintf(text, 40, "%.*g", digits, value);
        if (strtod(text, NULL) == value) break;
    }
    return text;
}

cJSON *ang_json_exact(double value) {
    char text[40];
    return cJSON_CreateRaw(ang_json_number_text(value, text));
}
