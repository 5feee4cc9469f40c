#include "core/cpu/integrate.h"

#include <math.h>
#include <stdbool.h>

enum { nodes = ANG_GAUSS_NODES, max_depth = 60 };

ang_gauss ang_gauss_make(void) {
    ang_gauss gauss = {0};
    for (int i = 0; i < nodes; i++) {
        double x = cos(M_PI * (i + 0.75) / (nodes + 0.5)), slope = 0;
        for (int iteration = 0; iteration < 100; iteration++) {
            double previous = 1, value = x;
            for (int k = 2; k <= nodes; k++) {
                double next = ((2 * k - 1) * x * value - (k - 1) * previous) / k;
                previous = value;
                value = next;
            }
            slope = nodes * (x * value - previous) / (x * x - 1);
            double step = value / slope;
            x -= step;
            if (fabs(step) < 1e-16) break;
        }
        int at = nodes - 1 - i;
        gauss.node[at] = 0.5 + 0.5 * x;
        gauss.weight[at] = 1 / ((1 - x * x) * slope * slope);
    }
    for (int i = 0; i < nodes; i++)
        for (int j = 0; j < nodes; j++) {
            double sum = 0;
            for (int k = 0; k < nodes; k++) {
                double x = gauss.node[i] * gauss.node[k], lagrange = 1;
                for (int m = 0; m < nodes; m++)
                    if (m != j) lagrange *= (x - gauss.node[m]) / (gauss.node[j] - gauss.node[m]);
                sum += gauss.weight[k] * lagrange;
            }
            gauss.upto[i][j] = gauss.node[i] * sum;
        }
    return gauss;
}

/* What a stretch adds when transmittance 1 enters it. */
typedef struct stretch {
    double colour[3];
    double depth; /* optical */
} stretch;

typedef struct task {
    const ang_gauss *gauss;
    ang_medium *medium;
    const void *context;
    double length, tolerance;
    uint64_t *samples;
} task;

static stretch measure(const task *task, double low, double high) {
    const ang_gauss *gauss = task->gauss;
    double extinction[nodes], colour[nodes][3], mm = (high - low) * task->length;
    for (int i = 0; i < nodes; i++)
        task->medium(task->context, low + gauss->node[i] * (high - low), &extinction[i], colour[i]);
    *task->samples += nodes;
    stretch sum = {0};
    for (int i = 0; i < nodes; i++) {
        double depth = 0;
        for (int j = 0; j < nodes; j++) depth += gauss->upto[i][j] * extinction[j];
        double emitted = gauss->weight[i] * mm * extinction[i] * exp(-fmax(depth * mm, 0));
        for (int c = 0; c < 3; c++) sum.colour[c] += emitted * colour[i][c];
        sum.depth += gauss->weight[i] * mm * extinction[i];
    }
    return sum;
}

static void add(ang_light *light, const stretch *part) {
    for (int c = 0; c < 3; c++) light->colour[c] += light->transmittance * part->colour[c];
    light->transmittance *= exp(-part->depth);
}

static void refine(const task *task, double low, double high, const stretch *whole, int depth, ang_light *light) {
    if (light->transmittance < 1e-14) return;
    double middle = 0.5 * (low + high);
    stretch left = measure(task, low, middle), right = measure(task, middle, high);
    double through = exp(-left.depth), error = 0;
    for (int c = 0; c < 3; c++)
        error = fmax(error, fabs(whole->colour[c] - left.colour[c] - through * right.colour[c]));
    error = fmax(error, fabs(exp(-whole->depth) - through * exp(-right.depth)));
    /* A stretch of great optical depth may agree with its halves by having lost its front. */
    bool shallow = whole->depth < 4;
    if ((shallow && error * light->transmittance <= task->tolerance) || depth == max_depth || middle <= low ||
        middle >= high) {
        add(light, &left);
        add(light, &right);
        return;
    }
    refine(task, low, middle, &left, depth + 1, light);
    refine(task, middle, high, &right, depth + 1, light);
}

void ang_integrate(const ang_gauss *gauss, ang_medium *medium, const void *context, double low, double high,
                   double length, double tolerance, ang_light *light, uint64_t *samples) {
    task task = {gauss, medium, context, length, tolerance, samples};
    stretch whole = measure(&task, low, high);
    refine(&task, low, high, &whole, 0, light);
}
