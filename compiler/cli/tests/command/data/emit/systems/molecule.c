/* The system Molecule: H = (1/2) Σ(0 ≤ i < N) (p[i][0]² + p[i][1]² + p[i][2]²)/m[i] + (1/2) Σ((j′, j″) in springs) stiffness[j] (√((q[j′][0] − q[j″][0])² + (q[j′][1] − q[j″][1])² + (q[j′][2] − q[j″][2])²) − length[j])² − Σ(0 ≤ i < N) Σ(i+1 ≤ k < N) G m[i] m[k]/√((q[i][0] − q[k][0])² + (q[i][1] − q[k][1])² + (q[i][2] − q[k][2])²)
   The formula's q[i][k] is the entry 3 i + k of q, counted from 0; p likewise.

   Usage:

       molecule_parameters parameters = {.N = ..., .springs_count = ..., .m = ..., .springs = ..., .stiffness = ..., .length = ..., .G = 0.125};
       forest_ruth_1990_system system = {molecule_velocity, molecule_force, &parameters}; */
typedef struct {
    size_t N;
    size_t springs_count;
    const double *m; /* N numbers */
    const size_t (*springs)[2]; /* springs_count pairs of indices from 0 */
    const double *stiffness; /* springs_count numbers */
    const double *length; /* springs_count numbers */
    double G;
} molecule_parameters;

/* v = dH/dp */
static inline void molecule_velocity(double t, const double *p, double *v, void *context) {
    const molecule_parameters *s = context;
    (void)t;
    for (size_t i = 0; i < s->N; i++) {
        const double x1 = 1.0 / s->m[i];
        v[3 * i] = x1 * p[3 * i];
        v[3 * i + 1] = x1 * p[3 * i + 1];
        v[3 * i + 2] = x1 * p[3 * i + 2];
    }
}

/* f = -dH/dq */
static inline void molecule_force(double t, const double *q, double *f, void *context) {
    const molecule_parameters *s = context;
    (void)t;
    for (size_t i = 0; i < 3 * s->N; i++) f[i] = 0.0;
    for (size_t i = 0; i < s->N; i++) {
        double x1 = 0.0;
        double x2 = 0.0;
        double x3 = 0.0;
        const double x4 = s->G * s->m[i];
        for (size_t k = i + 1; k < s->N; k++) {
            const double x5 = q[3 * i + 2] - q[3 * k + 2];
            const double x6 = q[3 * i] - q[3 * k];
            const double x7 = q[3 * i + 1] - q[3 * k + 1];
            const double x8 = x6 * x6 + x7 * x7 + x5 * x5;
            const double x9 = x4 * s->m[k] / (x8 * sqrt(x8));
            const double x10 = x5 * x9;
            x1 += x10;
            const double x11 = x7 * x9;
            x2 += x11;
            const double x12 = x6 * x9;
            x3 += x12;
            f[3 * k] += x12;
            f[3 * k + 1] += x11;
            f[3 * k + 2] += x10;
        }
        f[3 * i] += -x3;
        f[3 * i + 1] += -x2;
        f[3 * i + 2] += -x1;
    }
    for (size_t j = 0; j < s->springs_count; j++) {
        const size_t j_0 = s->springs[j][0], j_1 = s->springs[j][1];
        if (j_0 >= s->N || j_1 >= s->N) { for (size_t i = 0; i < 3 * s->N; i++) f[i] = NAN; return; }
        const double x13 = q[3 * j_0] - q[3 * j_1];
        const double x14 = q[3 * j_0 + 1] - q[3 * j_1 + 1];
        const double x15 = q[3 * j_0 + 2] - q[3 * j_1 + 2];
        const double x16 = sqrt(x13 * x13 + x14 * x14 + x15 * x15);
        const double x17 = s->stiffness[j] * (x16 - s->length[j]) / x16;
        const double x18 = x13 * x17;
        f[3 * j_0] += -x18;
        const double x19 = x14 * x17;
        f[3 * j_0 + 1] += -x19;
        const double x20 = x15 * x17;
        f[3 * j_0 + 2] += -x20;
        f[3 * j_1] += x18;
        f[3 * j_1 + 1] += x19;
        f[3 * j_1 + 2] += x20;
    }
}

/* H */
static inline double molecule_energy(double t, const double *q, const double *p, const void *context) {
    const molecule_parameters *s = context;
    (void)t;
    double x1 = 0.0;
    double x2 = 0.0;
    double x3 = 0.0;
    for (size_t i = 0; i < s->N; i++) {
        double x4 = 0.0;
        const double x5 = s->G * s->m[i];
        for (size_t k = i + 1; k < s->N; k++) {
            const double x6 = q[3 * i] - q[3 * k];
            const double x7 = q[3 * i + 1] - q[3 * k + 1];
            const double x8 = q[3 * i + 2] - q[3 * k + 2];
            x4 += x5 * s->m[k] / sqrt(x6 * x6 + x7 * x7 + x8 * x8);
        }
        x1 += 1.0 / s->m[i] * (p[3 * i] * p[3 * i] + p[3 * i + 1] * p[3 * i + 1] + p[3 * i + 2] * p[3 * i + 2]);
        x3 += x4;
    }
    for (size_t j = 0; j < s->springs_count; j++) {
        const size_t j_0 = s->springs[j][0], j_1 = s->springs[j][1];
        if (j_0 >= s->N || j_1 >= s->N) return NAN;
        const double x9 = q[3 * j_0] - q[3 * j_1];
        const double x10 = q[3 * j_0 + 1] - q[3 * j_1 + 1];
        const double x11 = q[3 * j_0 + 2] - q[3 * j_1 + 2];
        const double x12 = sqrt(x9 * x9 + x10 * x10 + x11 * x11) - s->length[j];
        x2 += s->stiffness[j] * (x12 * x12);
    }
    return 0.5 * x1 + 0.5 * x2 - x3;
}
