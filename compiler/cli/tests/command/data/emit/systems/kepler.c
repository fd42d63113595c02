/* The system Kepler: H = (1/2) (p[0]² + p[1]²) − gm/√(q[0]² + q[1]²)

   Usage:

       kepler_parameters parameters = {.gm = 1.0};
       stormer_verlet_system system = {kepler_velocity, kepler_force, &parameters}; */
typedef struct {
    double gm;
} kepler_parameters;

/* v = dH/dp */
static inline void kepler_velocity(double t, const double *p, double *v, void *context) {
    (void)context;
    (void)t;
    v[0] = p[0];
    v[1] = p[1];
}

/* f = -dH/dq */
static inline void kepler_force(double t, const double *q, double *f, void *context) {
    const kepler_parameters *s = context;
    (void)t;
    const double x1 = q[0] * q[0] + q[1] * q[1];
    const double x2 = s->gm / (x1 * sqrt(x1));
    f[0] = -q[0] * x2;
    f[1] = -q[1] * x2;
}

/* H */
static inline double kepler_energy(double t, const double *q, const double *p, const void *context) {
    const kepler_parameters *s = context;
    (void)t;
    return 0.5 * (p[0] * p[0] + p[1] * p[1]) - s->gm / sqrt(q[0] * q[0] + q[1] * q[1]);
}
