#include "io/dicom/series.h"

#include "core/base/memory.h"
#include "io/dicom/geometry.h"
#include "io/dicom/parts.h"
#include "io/dicom/phases.h"
#include "io/dicom/terms.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double same_position_mm = 1e-3, same_cosine = 1e-4;

void ang_dicom_groups_clear(ang_dicom_groups *groups) {
    for (size_t i = 0; i < groups->count; i++) free(groups->group[i].order);
    free(groups->group);
    *groups = (ang_dicom_groups){0};
}

static bool near_vectors(ang_vec3 a, ang_vec3 b) {
    return fabs(a.x - b.x) <= same_cosine && fabs(a.y - b.y) <= same_cosine && fabs(a.z - b.z) <= same_cosine;
}

/* The first three values: further ones are the vendor's and change within one volume (GE: ADD where neighbouring scans
 * were summed). Where they do tell volumes apart, positions repeat, and phases are told by all of them. */
static bool same_image_type(const ang_dicom_slice *a, const ang_dicom_slice *b) {
    for (int i = 0; i < 3; i++) {
        char left[65], right[65];
        ang_dicom_value(a->image_type, i, left, sizeof left);
        ang_dicom_value(b->image_type, i, right, sizeof right);
        if (strcmp(left, right) != 0) return false;
    }
    return true;
}

bool ang_dicom_same_patient(const ang_dicom_slice *a, const ang_dicom_slice *b) {
    if (a->patient_id[0] && b->patient_id[0]) return strcmp(a->patient_id, b->patient_id) == 0;
    return !a->patient[0] || !b->patient[0] || strcmp(a->patient, b->patient) == 0;
}

bool ang_dicom_same_planes(const ang_dicom_slice *a, const ang_dicom_slice *b) {
    if (a->rows != b->rows || a->columns != b->columns) return false;
    if (a->has_orientation != b->has_orientation || a->has_position != b->has_position) return false;
    if (a->has_orientation && (!near_vectors(a->row, b->row) || !near_vectors(a->column, b->column))) return false;
    if (a->has_spacing != b->has_spacing) return false;
    return !a->has_spacing || (fabs(a->row_spacing - b->row_spacing) <= 1e-4 * a->row_spacing &&
                               fabs(a->column_spacing - b->column_spacing) <= 1e-4 * a->column_spacing);
}

/* Whether two slices of one series may belong to one volume (rule 1). */
static bool alike(const ang_dicom_slice *a, const ang_dicom_slice *b) {
    if (strcmp(a->refusal, b->refusal) != 0 || a->image != b->image) return false;
    if (!a->image) return true;
    if (!ang_dicom_same_patient(a, b)) return false; /* one UID for two, as careless de-identification leaves it */
    if (strcmp(a->stack_id, b->stack_id) != 0 || strcmp(a->modality, b->modality) != 0) return false;
    return same_image_type(a, b) && ang_dicom_same_planes(a, b);
}

/* A new group that takes `order` over, also where it fails. */
static ang_dicom_group *add_group(ang_dicom_groups *groups, size_t *order, size_t count, ang_error *err) {
    ang_dicom_group *grown = realloc(groups->group, (groups->count + 1) * sizeof *grown);
    if (!grown) {
        free(order);
        ang_fail(err, ANG_LIMIT, "no memory for the list of series");
        return NULL;
    }
    groups->group = grown;
    grown[groups->count] = (ang_dicom_group){.order = order, .count = count, .phases = 1, .phase = 1};
    return &grown[groups->count++];
}

/* Whether two neighbours of a sorted group may be one slice twice. */
static bool at_one_place(const ang_dicom_slice *a, const ang_dicom_slice *b, ang_vec3 normal) {
    if (a->has_position) return ang_dicom_along(b, normal) - ang_dicom_along(a, normal) <= same_position_mm;
    return a->has_instance_number && b->has_instance_number && a->instance_number == b->instance_number;
}

/* Compares slice `slice` with those kept at its place, from `first` on. Takes unreadable ones among them out; `stays`
 * says whether the slice itself stays. */
static bool compare_at_place(const ang_dicom_slice *slices, ang_dicom_group *group, size_t first, size_t *kept,
                             size_t slice, ang_dicom_compare *compare, void *context, bool *stays, ang_error *err) {
    *stays = true;
    for (size_t j = first; j < *kept && *stays;) {
        if (ang_dicom_phases_differ(&slices[group->order[j]], &slices[slice])) { /* air looks alike in all phases */
            j++;
            continue;
        }
        switch (compare(context, group->order[j], slice, err)) {
        case ANG_DICOM_SAME:
            group->duplicates++;
            *stays = false;
            break;
        case ANG_DICOM_DIFFERENT:
            j++;
            break;
        case ANG_DICOM_FIRST_UNREADABLE:
            memmove(&group->order[j], &group->order[j + 1], (*kept - j - 1) * sizeof *group->order);
            --*kept;
            break;
        case ANG_DICOM_SECOND_UNREADABLE:
            *stays = false;
            break;
        case ANG_DICOM_NOT_COMPARED:
            return false;
        }
    }
    return true;
}

/* Drops duplicates and unreadable doubles from a sorted group and numbers the places that are left in `place`; `phases`
 * becomes how many volumes share them. */
static bool drop_duplicates(const ang_dicom_slice *slices, ang_dicom_group *group, ang_vec3 normal,
                            ang_dicom_compare *compare, void *context, size_t *place, int *phases, ang_error *err) {
    size_t kept = 0;
    for (size_t i = 0; i < group->count; i++) {
        size_t slice = group->order[i], first = kept; /* `first`: of the slices kept at this place */
        bool stays = true;
        while (first > 0 && at_one_place(&slices[group->order[first - 1]], &slices[slice], normal)) first--;
        if (compare && !compare_at_place(slices, group, first, &kept, slice, compare, context, &stays, err))
            return false;
        if (!stays) continue;
        place[kept] = first < kept ? place[kept - 1] : kept ? place[kept - 1] + 1 : 0;
        group->order[kept++] = slice;
    }
    group->count = kept;
    *phases = 1;
    int here = 1;
    for (size_t i = 1; i < kept; i++) {
        here = place[i] == place[i - 1] ? here + 1 : 1;
        if (here > *phases) *phases = here;
    }
    return true;
}

/* Splits group `index` into the slices that have number 0 in `part`, which stay, and those of each other number, which
 * become new groups that are like it. */
static bool split_group(ang_dicom_groups *groups, size_t index, const int *part, int parts, ang_error *err) {
    ang_dicom_group whole = groups->group[index];
    for (int p = 0; p < parts; p++) {
        size_t *order = ang_alloc(whole.count, sizeof *order, "volumes of a series", err), n = 0;
        if (!order) return false;
        for (size_t i = 0; i < whole.count; i++) {
            if (part[i] == p) order[n++] = whole.order[i];
        }
        ang_dicom_group *made = p == 0 ? &groups->group[index] : add_group(groups, order, n, err);
        if (!made) return false;
        ang_dicom_group like = whole;
        like.order = order;
        like.count = n;
        if (p > 0) like.duplicates = 0;
        *made = like;
    }
    return true;
}

/* The phases of one series: group `index` and those from `others` on, in order. A single slice beside volumes is no
 * phase: it was sent again, or never belonged there. */
static void make_set(const ang_dicom_slice *slices, ang_dicom_groups *groups, size_t index, size_t others,
                     ang_dicom_key key) {
    size_t largest = 0, members = 0;
    for (size_t i = index; i < groups->count; i = i == index ? others : i + 1)
        if (groups->group[i].count > largest) largest = groups->group[i].count;
    for (size_t i = index; i < groups->count; i = i == index ? others : i + 1)
        members += groups->group[i].count > 1 || largest == 1;
    const ang_dicom_slice *first = &slices[groups->group[index].order[0]];
    int number = 0;
    for (size_t i = index; members > 1 && i < groups->count; i = i == index ? others : i + 1) {
        ang_dicom_group *group = &groups->group[i];
        if (group->count == 1 && largest > 1) continue;
        group->set = (int)index + 1;
        group->phase = ++number;
        ang_dicom_phase_words(key, &slices[group->order[0]], first, number, group->phase_text,
                              sizeof group->phase_text);
    }
}

/* Sorts group `index`, drops its duplicates and splits it where positions repeat with other pixels (rule 6). */
static bool resolve_positions(const ang_dicom_slice *slices, ang_dicom_groups *groups, size_t index,
                              ang_dicom_compare *compare, void *context, ang_error *err) {
    ang_dicom_group *group = &groups->group[index];
    ang_dicom_sort(slices, group->order, group->count, NULL);
    const ang_dicom_slice first = ang_dicom_with_defaults(&slices[group->order[0]]);
    ang_vec3 normal = ang_dicom_normal(&first);
    if (!first.image || first.refusal[0] || ang_vec3_length(normal) == 0) return true;

    size_t count = group->count;
    size_t *place = ang_alloc(count, sizeof *place, "positions", err);
    int *phase = place ? ang_alloc(count, sizeof *phase, "phases", err) : NULL;
    int phases = 1;
    bool ok = phase && drop_duplicates(slices, group, normal, compare, context, place, &phases, err);
    /* One InstanceNumber twice, without positions, does not tell where a second volume would lie. */
    if (ok && phases > 1 && first.has_position) {
        ang_dicom_key key = ang_dicom_number_phases(slices, group->order, place, group->count, phases, phase);
        group->phases = phases;
        size_t *old = group->order, others = groups->count;
        ok = split_group(groups, index, phase, phases, err);
        if (groups->group[index].order != old) free(old);
        if (ok) make_set(slices, groups, index, others, key);
    }
    free(place);
    free(phase);
    return ok;
}

/* Splits group `index` where its slices, all at places of their own, are no one volume (rule 1). `split` says whether
 * there was anything to split. */
static bool part_volumes(const ang_dicom_slice *slices, ang_dicom_groups *groups, size_t index, bool *split,
                         ang_error *err) {
    ang_dicom_group *group = &groups->group[index];
    const ang_dicom_slice first = ang_dicom_with_defaults(&slices[group->order[0]]);
    ang_vec3 normal = ang_dicom_normal(&first);
    *split = false;
    if (!first.image || first.refusal[0] || !first.has_position || ang_vec3_length(normal) == 0) return true;
    int *part = ang_alloc(group->count, sizeof *part, "volumes of a series", err), parts;
    double *scratch = part ? ang_alloc(group->count, sizeof *scratch, "volumes of a series", err) : NULL;
    bool ok = scratch != NULL;
    ang_dicom_parting why =
        ok ? ang_dicom_part_volumes(slices, group->order, group->count, normal, part, &parts, scratch)
           : ANG_DICOM_ONE_VOLUME;
    if (why != ANG_DICOM_ONE_VOLUME) {
        *(why == ANG_DICOM_ACQUISITIONS ? &group->acquisitions : &group->stacks) = parts;
        size_t *old = group->order, others = groups->count;
        ok = split_group(groups, index, part, parts, err);
        if (groups->group[index].order != old) free(old);
        for (size_t i = others; i < groups->count; i++)
            groups->group[i].part = parts * groups->group[i].part + (int)(i - others) + 1;
        *split = true;
    }
    free(part);
    free(scratch);
    return ok;
}

static bool is_type(const ang_dicom_slice *slice, int index, const char *value) {
    char text[65];
    ang_dicom_value(slice->image_type, index, text, sizeof text);
    return strcmp(text, value) == 0;
}

/* A group's place among others: does its series have a larger one? */
static bool has_larger_sibling(const ang_dicom_slice *slices, const ang_dicom_groups *groups, size_t index) {
    const ang_dicom_group *group = &groups->group[index];
    for (size_t i = 0; i < groups->count; i++) {
        const ang_dicom_group *other = &groups->group[i];
        if (i != index && other->count > group->count && slices[other->order[0]].image &&
            strcmp(slices[other->order[0]].series_uid, slices[group->order[0]].series_uid) == 0)
            return true;
    }
    return false;
}

static void judge(const ang_dicom_slice *slices, ang_dicom_groups *groups, size_t index) {
    ang_dicom_group *group = &groups->group[index];
    const ang_dicom_slice *first = &slices[group->order[0]];
    char kind[65];
    ang_dicom_value(first->image_type, 2, kind, sizeof kind);
    bool capture = strcmp(first->sop_class, "1.2.840.10008.5.1.4.1.1.7") == 0;
    group->derived = capture || (is_type(first, 0, "DERIVED") && is_type(first, 1, "SECONDARY"));
    group->loadable = false;
    if (first->refusal[0]) {
        snprintf(group->remark, sizeof group->remark, "%s", first->refusal);
    } else if (strcmp(kind, "LOCALIZER") == 0) {
        snprintf(group->remark, sizeof group->remark, "localizer");
    } else if (group->derived && (capture || !first->has_position)) {
        snprintf(group->remark, sizeof group->remark, "derived summary%s%s%s", kind[0] ? " (" : "",
                 kind[0] ? ang_dicom_image_kind(kind) : "", kind[0] ? ")" : "");
    } else if (first->bad_position && has_larger_sibling(slices, groups, index)) {
        snprintf(group->remark, sizeof group->remark, "(0020,0032) ImagePositionPatient is invalid");
    } else if (group->count == 1 && group->phases > 1 && has_larger_sibling(slices, groups, index)) {
        snprintf(group->remark, sizeof group->remark, "another slice at the same position as one of its series");
    } else if (group->count == 1 && group->stacks > 1 && has_larger_sibling(slices, groups, index)) {
        snprintf(group->remark, sizeof group->remark, "a single slice far from the others of its series");
    } else if (group->count == 1 && has_larger_sibling(slices, groups, index)) {
        snprintf(group->remark, sizeof group->remark, "localizer: a single slice that differs from its series");
    } else if (group->count == 1 && !first->has_position) {
        snprintf(group->remark, sizeof group->remark, "single picture without a %sposition",
                 first->bad_position ? "valid " : "");
    } else {
        group->loadable = true;
        if (group->set > 0)
            snprintf(group->remark, sizeof group->remark, "%d phases at the same positions", group->phases);
        else if (group->phases > 1)
            snprintf(group->remark, sizeof group->remark, "one of %d volumes at the same positions", group->phases);
        else if (group->acquisitions > 1)
            snprintf(group->remark, sizeof group->remark, "one of %d acquisitions in its series", group->acquisitions);
        else if (group->stacks > 1)
            snprintf(group->remark, sizeof group->remark, "one of %d stacks far apart in its series", group->stacks);
        else if (group->count == 1)
            snprintf(group->remark, sizeof group->remark, "single slice");
        else if (group->derived)
            snprintf(group->remark, sizeof group->remark, "derived");
    }
}

/* Phases of which one parts into stacks in another way than the rest are series of their own. */
static void dissolve_uneven_sets(ang_dicom_groups *groups) {
    for (size_t i = 0; i < groups->count; i++) {
        int set = groups->group[i].set, members = 0, other = 0;
        for (size_t j = 0; set > 0 && j < groups->count; j++) {
            if (groups->group[j].set != set) continue;
            members += groups->group[j].part == 0;
            other += groups->group[j].part == groups->group[i].part;
        }
        if (set == 0 || members == other) continue;
        for (size_t j = 0; j < groups->count; j++)
            if (groups->group[j].set == set) groups->group[j].set = 0;
    }
}

typedef struct listed {
    ang_dicom_group group;
    const ang_dicom_slice *first; /* of the series' first phase */
    size_t count;                 /* of that */
} listed;

/* By series number, then by the first file, so that the numbers do not depend on how the folder was read. */
static int compare_listed(const void *left, const void *right) {
    const listed *a = left, *b = right;
    if (a->first->series_number != b->first->series_number)
        return a->first->series_number < b->first->series_number ? -1 : 1;
    int uid = strcmp(a->first->series_uid, b->first->series_uid);
    if (uid != 0) return uid;
    if (a->count != b->count) return a->count > b->count ? -1 : 1;
    if (a->first->file != b->first->file) return a->first->file < b->first->file ? -1 : 1;
    if (a->first->frame != b->first->frame) return a->first->frame < b->first->frame ? -1 : 1;
    return a->group.phase - b->group.phase;
}

static bool of_one_series(const ang_dicom_group *a, const ang_dicom_group *b) {
    return a->set > 0 && a->set == b->set && a->part == b->part;
}

/* The group of the first phase of the series that group `index` is of. */
static const ang_dicom_group *first_phase(const ang_dicom_groups *groups, size_t index) {
    const ang_dicom_group *first = &groups->group[index];
    for (size_t i = 0; first->set > 0 && i < groups->count; i++)
        if (of_one_series(first, &groups->group[i]) && groups->group[i].phase < first->phase) first = &groups->group[i];
    return first;
}

/* Numbers series and their phases in the list. */
static void number_series(ang_dicom_groups *groups) {
    for (size_t begin = 0, end; begin < groups->count; begin = end) {
        ang_dicom_group *first = &groups->group[begin];
        groups->series_count++;
        for (end = begin + 1; end < groups->count && of_one_series(first, &groups->group[end]);) end++;
        for (size_t i = begin; i < end; i++) {
            ang_dicom_group *group = &groups->group[i];
            group->series = groups->series_count;
            group->phase = (int)(i - begin) + 1;
            if (group->set > 0) group->phases = (int)(end - begin);
        }
    }
}

static bool list_groups(const ang_dicom_slice *slices, ang_dicom_groups *groups, ang_error *err) {
    if (groups->count == 0) return true;
    listed *list = ang_alloc(groups->count, sizeof *list, "list of series", err);
    if (!list) return false;
    for (size_t i = 0; i < groups->count; i++) {
        const ang_dicom_group *first = first_phase(groups, i);
        list[i] = (listed){groups->group[i], &slices[first->order[0]], first->count};
    }
    qsort(list, groups->count, sizeof *list, compare_listed);
    for (size_t i = 0; i < groups->count; i++) groups->group[i] = list[i].group;
    free(list);
    number_series(groups);
    return true;
}

size_t ang_dicom_series_start(const ang_dicom_groups *groups, int number) {
    size_t start = 0;
    while (start < groups->count && groups->group[start].series < number) start++;
    return start;
}

static int compare_uids(const void *left, const void *right, void *context) {
    const ang_dicom_slice *slices = context;
    size_t i = *(const size_t *)left, j = *(const size_t *)right;
    int uid = strcmp(slices[i].series_uid, slices[j].series_uid);
    return uid ? uid : i < j ? -1 : i > j;
}

/* Slices whose series agree, in runs of `order`; `group_of` is scratch. */
static bool split_series(const ang_dicom_slice *slices, const size_t *order, size_t count, ang_dicom_groups *groups,
                         size_t *group_of, ang_error *err) {
    size_t begin = groups->count;
    for (size_t i = 0; i < count; i++) {
        size_t g = begin;
        while (g < groups->count && !alike(&slices[groups->group[g].order[0]], &slices[order[i]])) g++;
        if (g == groups->count) {
            size_t *first = ang_alloc(1, sizeof *first, "list of slices", err);
            if (!first || !add_group(groups, first, 0, err)) return false;
            first[0] = order[i]; /* stands for the group until it is filled */
        }
        group_of[i] = g;
        groups->group[g].count++;
    }
    for (size_t g = begin; g < groups->count; g++) {
        size_t *members = ang_alloc(groups->group[g].count, sizeof *members, "list of slices", err), n = 0;
        if (!members) return false;
        for (size_t i = 0; i < count; i++) {
            if (group_of[i] == g) members[n++] = order[i];
        }
        free(groups->group[g].order);
        groups->group[g].order = members;
    }
    return true;
}

bool ang_dicom_group_slices(const ang_dicom_slice *slices, size_t count, ang_dicom_compare *compare, void *context,
                            ang_dicom_groups *groups, ang_error *err) {
    *groups = (ang_dicom_groups){0};
    if (count == 0) return true;
    size_t *order = ang_alloc(count, 2 * sizeof *order, "list of slices", err);
    if (!order) return false;
    for (size_t i = 0; i < count; i++) order[i] = i;
    qsort_r(order, count, sizeof *order, compare_uids, (void *)(uintptr_t)slices);
    bool ok = true;
    for (size_t begin = 0, end; ok && begin < count; begin = end) {
        for (end = begin + 1; end < count; end++) {
            if (strcmp(slices[order[end]].series_uid, slices[order[begin]].series_uid) != 0) break;
        }
        ok = split_series(slices, order + begin, end - begin, groups, order + count, err);
    }
    free(order);
    size_t before = groups->count;
    for (size_t i = 0; ok && i < before; i++) ok = resolve_positions(slices, groups, i, compare, context, err);
    for (size_t i = 0; ok && i < groups->count;) {
        bool split;
        ok = part_volumes(slices, groups, i, &split, err);
        if (!split) i++;
    }
    if (ok) dissolve_uneven_sets(groups);
    ok = ok && list_groups(slices, groups, err);
    for (size_t i = 0; ok && i < groups->count; i++) judge(slices, groups, i);
    if (!ok) ang_dicom_groups_clear(groups);
    return ok;
}
