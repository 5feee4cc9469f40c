/* Emission and absorption along one smooth piece of a ray, to a tolerance. */
#ifndef ANG_CPU_INTEGRATE_H
#define ANG_CPU_INTEGRATE_H

#include <stdint.h>

enum { ANG_GAUSS_NODES = 6 };

/* Gauss-Legendre nodes and weights on [0, 1], and the integrals of the Lagrange polynomials from 0 to each node. */
typedef struct ang_gauss {
    double node[ANG_GAUSS_NODES], weight[ANG_GAUSS_NODES];
    double upto[ANG_GAUSS_NODES][ANG_GAUSS_NODES];
} ang_gauss;

/* Computed, not typed in. */
ang_gauss ang_gauss_make(void);

/* Extinction per mm (may be infinite at single places) and emitted colour at place s of [0, 1]. */
typedef void ang_medium(const void *context, double s, double *extinction, double colour[3]);

/* Light gathered so far: premultiplied colour and what still comes through. */
typedef struct ang_light {
    double colour[3];
    double transmittance;
} ang_light;

/* Adds the piece [low, high] of the medium, in which one unit of s is `length` mm, to `light`:
 *   colour += transmittance * int c kappa exp(-tau) dt,  transmittance *= exp(-tau(end)).
 * Adaptive bisection from the front until both colour and opacity agree with their halves to `tolerance`; stops where
 * less than 1e-14 comes through. Counts evaluations into *samples. */
void ang_integrate(const ang_gauss *gauss, ang_medium *medium, const void *context, double low, double high,
                   double length, double tolerance, ang_light *light, uint64_t *samples);

#endif
