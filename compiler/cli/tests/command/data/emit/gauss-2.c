/* gauss-2, 2 stages, basis polynomial(2), nodes gauss(2)
   source: Kuntzmann 1961
   source: Butcher, Implicit Runge–Kutta processes, Math. Comp. 18 (1964)
   source: Hairer, Lubich & Wanner, Geometric Numerical Integration, §II.1.3
   source: built as in Marsden & West 2001, Theorem 2.6.2
   source: the same method as chebyshev-2
   order 4 for every H (proved), 4 for T(p) + U(q) (proved), 4 for T quadratic (proved)
   symplectic (proved), symmetric (proved)
   written by symplectic VERSION
   A step of every H(t, q, p): the stages are solved for by fixed-point iteration, with compensated sums. */
/* Usage, in n dimensions:

       double memory[GAUSS_2_DOUBLES(n)];
       gauss_2_state state;
       gauss_2_system system = {velocity, force, context};
       gauss_2_start(&state, n, memory);
       ... state.q[i] = ..., state.p[i] = ...
       for (long k = 0; k < steps; k++)
           if (gauss_2_step(&state, &system, t0 + (double)k * h, h) != GAUSS_2_OK) ...

   The sums rely on the order of operations: compile without -ffast-math, and with -ffp-contract=off for the same
   bits on every machine. */

#include <float.h>
#include <math.h>
#include <stddef.h>

enum { GAUSS_2_OK, GAUSS_2_NOT_FINITE, GAUSS_2_DOES_NOT_CONVERGE };
enum { GAUSS_2_STAGES = 2, GAUSS_2_MAX_SWEEPS = 100 };

/* Doubles of memory in n dimensions. */
#define GAUSS_2_DOUBLES(n) ((5 + 4 * GAUSS_2_STAGES) * (n))

/* velocity v = dH/dp, and force f = -dH/dq. */
typedef struct {
    void (*velocity)(double t, const double *q, const double *p, double *v, void *context);
    void (*force)(double t, const double *q, const double *p, double *f, void *context);
    void *context;
} gauss_2_system;

/* Positions are q + q_low and momenta p + p_low: the low parts are what rounding left out. */
typedef struct {
    size_t n;
    double *q, *q_low, *p, *p_low;
    double *slope; /* the last velocity or force */
    double *stage_q, *stage_p; /* Q_i and P_i, one after the other */
    double *drift, *kick; /* h b_i velocity_i and h b~_i force_i */
} gauss_2_state;

static const double gauss_2_c[GAUSS_2_STAGES] = {
    0x1.b0cb174df99c7p-3, /* 1/2 - sqrt(3)/6 = 0.21132486540518712 */
    0x1.93cd3a2c8198ep-1, /* 1/2 + sqrt(3)/6 = 0.78867513459481288 */
};
static const double gauss_2_b[GAUSS_2_STAGES] = {
    0x1p-1, /* 1/2 */
    0x1p-1, /* 1/2 */
};
static const double gauss_2_b_tilde[GAUSS_2_STAGES] = {
    0x1p-1, /* 1/2 */
    0x1p-1, /* 1/2 */
};
/* mu_ij = a_ij / b_j and mu_tilde_ij = a_tilde_ij / b_tilde_j, rounded so that mu_ij + mu_tilde_ji is 1 exactly: symplectic as rounded. */
static const double gauss_2_mu[GAUSS_2_STAGES][GAUSS_2_STAGES] = {
    {0x1p-1, -0x1.3cd3a2c8198ep-4},
    {0x1.13cd3a2c8198ep+0, 0x1p-1},
};
static const double gauss_2_mu_tilde[GAUSS_2_STAGES][GAUSS_2_STAGES] = {
    {0x1p-1, -0x1.3cd3a2c8198ep-4},
    {0x1.13cd3a2c8198ep+0, 0x1p-1},
};

static inline void gauss_2_start(gauss_2_state *s, size_t n, double *memory) {
    double *stages = memory + 5 * n;
    size_t m = GAUSS_2_STAGES * n;
    *s = (gauss_2_state){n, memory, memory + n, memory + 2 * n, memory + 3 * n, memory + 4 * n,
                        stages, stages + m, stages + 2 * m, stages + 3 * m};
    for (size_t i = 0; i < 4 * n; i++) memory[i] = 0.0;
}

/* high + low + term as the nearest double and the rest (Knuth, Dekker). */
static inline void gauss_2_add(double *high, double *low, double term) {
    double sum = *high + term;
    double part = sum - *high;
    double rest = *low + ((*high - (sum - part)) + (term - part));
    *high = sum + rest;
    *low = rest - (*high - sum);
}

/* Stages as sums of increments: x + (low + sum_j factors[j] increments[j]). Returns how far they moved, relative to the
   largest; NaN where one is not finite. */
static inline double gauss_2_stages(size_t n, const double *x, const double *low,
                                   const double factors[GAUSS_2_STAGES][GAUSS_2_STAGES], const double *increments,
                                   double *stages) {
    double moved = 0.0, largest = 0.0;
    for (size_t k = 0; k < GAUSS_2_STAGES; k++) {
        for (size_t i = 0; i < n; i++) {
            double sum = low[i];
            for (size_t j = 0; j < GAUSS_2_STAGES; j++) sum += factors[k][j] * increments[j * n + i];
            double stage = x[i] + sum;
            if (!isfinite(stage)) return NAN;
            moved = fmax(moved, fabs(stage - stages[k * n + i]));
            largest = fmax(largest, fabs(stage));
            stages[k * n + i] = stage;
        }
    }
    return moved == 0.0 ? 0.0 : moved / largest;
}

static inline void gauss_2_kicks(gauss_2_state *s, const gauss_2_system *system, double t, double h) {
    for (size_t k = 0; k < GAUSS_2_STAGES; k++) {
        size_t at = k * s->n;
        system->force(t + h * gauss_2_c[k], s->stage_q + at, s->stage_p + at, s->slope, system->context);
        for (size_t i = 0; i < s->n; i++) s->kick[at + i] = h * gauss_2_b_tilde[k] * s->slope[i];
    }
}

static inline void gauss_2_drifts(gauss_2_state *s, const gauss_2_system *system, double t, double h) {
    for (size_t k = 0; k < GAUSS_2_STAGES; k++) {
        size_t at = k * s->n;
        system->velocity(t + h * gauss_2_c[k], s->stage_q + at, s->stage_p + at, s->slope, system->context);
        for (size_t i = 0; i < s->n; i++) s->drift[at + i] = h * gauss_2_b[k] * s->slope[i];
    }
}

/* A step of size h from the time t. Stages are iterated until they no longer change, or change by rounding errors only and
   twice no less than before. Where they do not, or are not finite, the state stays as it was. */
static inline int gauss_2_step(gauss_2_state *s, const gauss_2_system *system, double t, double h) {
    for (size_t k = 0; k < GAUSS_2_STAGES; k++) {
        for (size_t i = 0; i < s->n; i++) {
            s->stage_q[k * s->n + i] = s->q[i];
            s->stage_p[k * s->n + i] = s->p[i];
        }
    }
    gauss_2_drifts(s, system, t, h);
    double moved = gauss_2_stages(s->n, s->q, s->q_low, gauss_2_mu, s->drift, s->stage_q);
    if (!isfinite(moved)) return GAUSS_2_NOT_FINITE;
    double least = INFINITY;
    int sweeps = 0, stalled = 0;
    for (;;) {
        gauss_2_kicks(s, system, t, h);
        double moved_p = gauss_2_stages(s->n, s->p, s->p_low, gauss_2_mu_tilde, s->kick, s->stage_p);
        if (!isfinite(moved_p)) return GAUSS_2_NOT_FINITE;
        gauss_2_drifts(s, system, t, h);
        double moved_q = gauss_2_stages(s->n, s->q, s->q_low, gauss_2_mu, s->drift, s->stage_q);
        if (!isfinite(moved_q)) return GAUSS_2_NOT_FINITE;
        moved = fmax(moved_q, moved_p);
        if (moved >= least) stalled++;
        if (moved == 0.0 || (stalled >= 2 && fmin(moved_q, moved_p) <= 64.0 * DBL_EPSILON)) break;
        least = fmin(least, moved);
        if (++sweeps == GAUSS_2_MAX_SWEEPS) return GAUSS_2_DOES_NOT_CONVERGE;
    }
    for (size_t k = 0; k < GAUSS_2_STAGES; k++) {
        for (size_t i = 0; i < s->n; i++) {
            gauss_2_add(&s->q[i], &s->q_low[i], s->drift[k * s->n + i]);
            gauss_2_add(&s->p[i], &s->p_low[i], s->kick[k * s->n + i]);
        }
    }
    return GAUSS_2_OK;
}
