#include "core/cpu/classifier.h"

#include "core/base/memory.h"

#include <math.h>
#include <stdlib.h>

static void drop_prefix(ang_classifier *classifier) {
    ang_prefix_free(classifier->prefix);
    free(classifier->steps);
    classifier->prefix = NULL;
    classifier->steps = NULL;
}

bool ang_classifier_update(ang_classifier *classifier, const ang_transfer *transfer, const ang_volume *volume,
                           bool *made, ang_error *err) {
    if (!ang_table_cache_update(&classifier->table, transfer, volume, 0, made, err)) return false;
    if (!*made) return true;
    drop_prefix(classifier);
    classifier->measured = false;
    return true;
}

static bool make_steps(ang_classifier *classifier, const ang_transfer *transfer, const ang_volume *volume,
                       ang_error *err) {
    const ang_transfer_tables *tables = classifier->table.tables;
    const float *extinctions = classifier->table.extinctions;
    int count = tables->intervals;
    classifier->prefix = ang_prefix_create(tables, transfer, volume->slope, volume->intercept, err);
    if (!classifier->prefix) return false;
    classifier->steps = ang_alloc(4 * ((size_t)count + 3), sizeof *classifier->steps, "table of whole steps", err);
    if (!classifier->steps) {
        drop_prefix(classifier);
        return false;
    }
    for (int i = -1; i <= count + 1; i++) {
        float *record = &classifier->steps[4 * ((size_t)i + 1)];
        int begin = i < 0 ? 0 : i < count ? i : count;
        record[0] = i < 0 ? extinctions[0] : i < count ? extinctions[2 * i] : extinctions[2 * count - 1];
        record[1] = i < 0 ? extinctions[0] : i < count ? extinctions[2 * i + 1] : extinctions[2 * count - 1];
        record[2] = classifier->prefix->sums[8 * (size_t)begin + 3];
        record[3] = classifier->prefix->sums[8 * (size_t)begin + 7];
    }
    classifier->steps[2] = -extinctions[0]; /* one interval before the table's left end */
    return true;
}

bool ang_classifier_choose(ang_classifier *classifier, const ang_transfer *transfer, const ang_volume *volume,
                           ang_classify wanted, double step, bool wants_warning, ang_error *err) {
    bool asks_data = wanted == ANG_CLASSIFY_AUTO || (wanted == ANG_CLASSIFY_MIDPOINT && wants_warning);
    if (!classifier->measured && asks_data) {
        classifier->stiffness = ang_stiffness_of(transfer);
        bool asks_volume = classifier->stiffness.count > 0 && !classifier->neighbours.stored;
        if (asks_volume && !ang_neighbours_take(&classifier->neighbours, volume, err)) return false;
        ang_stiffness_measure_in(&classifier->stiffness, &classifier->neighbours, volume);
        classifier->measured = true;
    }
    static const ang_stiffness unknown = {.count = 0};
    const ang_stiffness *stiffness = classifier->measured ? &classifier->stiffness : &unknown;
    classifier->classification = ang_classification_choose(wanted, stiffness, step);
    return !classifier->classification.prefix || classifier->steps || make_steps(classifier, transfer, volume, err);
}

double ang_classifier_greatest(const ang_classifier *classifier) {
    double middle = classifier->table.greatest;
    return classifier->classification.prefix ? fmax(middle, classifier->prefix->greatest) : middle;
}

void ang_classifier_clear(ang_classifier *classifier) {
    drop_prefix(classifier);
    ang_table_cache_clear(&classifier->table);
    ang_neighbours_clear(&classifier->neighbours);
    *classifier = (ang_classifier){0};
}
