/* The system Warped: H = (1/2) (x² lambda + 1) (px² + py²) + (1/2) x² k[0, 0] + (1/4) y⁴ k[1, 1] + x⁵ y k[0, 1]/(y² + 1)^(3/2)
   Positions q = (x, y), momenta p = (px, py).

   Usage:

       warped_parameters parameters = {.lambda = 0.25, .k = ...};
       gauss_2_system system = {warped_velocity, warped_force, &parameters}; */
typedef struct {
    double lambda;
    double k[2][2];
} warped_parameters;

/* v = dH/dp */
static inline void warped_velocity(double t, const double *q, const double *p, double *v, void *context) {
    const warped_parameters *s = context;
    (void)t;
    const double x1 = s->lambda * (q[0] * q[0]) + 1.0;
    v[0] = p[0] * x1;
    v[1] = p[1] * x1;
}

/* f = -dH/dq */
static inline void warped_force(double t, const double *q, const double *p, double *f, void *context) {
    const warped_parameters *s = context;
    (void)t;
    const double x1 = q[0] * q[0];
    const double x2 = x1 * x1;
    const double x3 = q[1] * q[1];
    const double x4 = x3 + 1.0;
    const double x5 = sqrt(x4);
    const double x6 = 1.0 / (x4 * x5);
    f[0] = -(5.0 * s->k[0][1] * x2 * q[1] * x6 + s->k[0][0] * q[0] + s->lambda * q[0] * (p[0] * p[0] + p[1] * p[1]));
    const double x7 = s->k[0][1] * (q[0] * x2);
    f[1] = -(x7 * x6 - 3.0 * q[1] * (x7 * q[1] / (x4 * x4 * x5)) + s->k[1][1] * (q[1] * x3));
}

/* H */
static inline double warped_energy(double t, const double *q, const double *p, const void *context) {
    const warped_parameters *s = context;
    (void)t;
    const double x1 = q[0] * q[0];
    const double x2 = q[1] * q[1];
    const double x3 = x2 + 1.0;
    return 0.5 * (s->lambda * x1 + 1.0) * (p[0] * p[0] + p[1] * p[1]) + 0.5 * s->k[0][0] * x1 + 0.25 * s->k[1][1] * (x2 * x2) + s->k[0][1] * (q[0] * (x1 * x1)) * q[1] / (x3 * sqrt(x3));
}
