/* stormer-verlet, 2 stages, basis polynomial(2), nodes lobatto(2)
   source: Verlet 1967
   source: Marsden & West 2001, §2.6.2
   source: Hairer, Lubich & Wanner, Geometric Numerical Integration, §I.1.4
   source: Leok & Zhang, Example 3 and the remark after it (from the basis 1, cos(πτ), the same tableau)
   source: the same method as lobatto-2 and newton-cotes-2 and leok-zhang-3
   order 2 for every H (proved), 2 for T(p) + U(q) (proved), 2 for T quadratic (proved)
   symplectic (proved), symmetric (proved)
   written by symplectic VERSION
   A step of H = T(t, p) + U(t, q): drifts and kicks, with compensated sums. */
/* Usage, in n dimensions:

       double memory[STORMER_VERLET_DOUBLES(n)];
       stormer_verlet_state state;
       stormer_verlet_system system = {velocity, force, context};
       stormer_verlet_start(&state, n, memory);
       ... state.q[i] = ..., state.p[i] = ...
       for (long k = 0; k < steps; k++)
           if (stormer_verlet_step(&state, &system, t0 + (double)k * h, h) != STORMER_VERLET_OK) ...

   The sums rely on the order of operations: compile without -ffast-math, and with -ffp-contract=off for the same
   bits on every machine. */

#include <math.h>
#include <stddef.h>

enum { STORMER_VERLET_OK, STORMER_VERLET_NOT_FINITE };

/* Doubles of memory in n dimensions. */
#define STORMER_VERLET_DOUBLES(n) (9 * (n))

/* H = T(t, p) + U(t, q): velocity v = dT/dp, and force f = -dU/dq. */
typedef struct {
    void (*velocity)(double t, const double *p, double *v, void *context);
    void (*force)(double t, const double *q, double *f, void *context);
    void *context;
} stormer_verlet_system;

/* Positions are q + q_low and momenta p + p_low: the low parts are what rounding left out. They lie one after another. */
typedef struct {
    size_t n;
    double *q, *q_low, *p, *p_low;
    double *slope; /* the last velocity or force */
    double *start; /* the state before the step */
    int force_is_known; /* set it to 0 after a change of q, of the force, or of the time other than by a step */
} stormer_verlet_state;

static inline void stormer_verlet_start(stormer_verlet_state *s, size_t n, double *memory) {
    *s = (stormer_verlet_state){n, memory, memory + n, memory + 2 * n, memory + 3 * n, memory + 4 * n, memory + 5 * n, 0};
    for (size_t i = 0; i < 4 * n; i++) memory[i] = 0.0;
}

/* high + low + term as the nearest double and the rest (Knuth, Dekker). */
static inline void stormer_verlet_add(double *high, double *low, double term) {
    double sum = *high + term;
    double part = sum - *high;
    double rest = *low + ((*high - (sum - part)) + (term - part));
    *high = sum + rest;
    *low = rest - (*high - sum);
}

static inline void stormer_verlet_kick(stormer_verlet_state *s, double factor) {
    for (size_t i = 0; i < s->n; i++) stormer_verlet_add(&s->p[i], &s->p_low[i], factor * s->slope[i]);
}

static inline void stormer_verlet_drift(stormer_verlet_state *s, double factor) {
    for (size_t i = 0; i < s->n; i++) stormer_verlet_add(&s->q[i], &s->q_low[i], factor * s->slope[i]);
}

/* A step of size h from the time t. Where it is not finite, the state stays as it was. */
static inline int stormer_verlet_step(stormer_verlet_state *s, const stormer_verlet_system *system, double t, double h) {
    for (size_t i = 0; i < 4 * s->n; i++) s->start[i] = s->q[i];
    if (!s->force_is_known) system->force(t, s->q, s->slope, system->context);
    stormer_verlet_kick(s, h * 0x1p-1); /* 1/2 */
    system->velocity(t + h * 0x1p-1, s->p, s->slope, system->context);
    stormer_verlet_drift(s, h * 0x1p+0); /* 1 */
    system->force(t + h, s->q, s->slope, system->context);
    stormer_verlet_kick(s, h * 0x1p-1); /* 1/2 */
    for (size_t i = 0; i < 4 * s->n; i++) {
        if (isfinite(s->q[i])) continue;
        for (size_t j = 0; j < 4 * s->n; j++) s->q[j] = s->start[j];
        s->force_is_known = 0;
        return STORMER_VERLET_NOT_FINITE;
    }
    s->force_is_known = 1;
    return STORMER_VERLET_OK;
}
