/* gauss-2, 2 stages, basis polynomial(2), nodes gauss(2)
   source: Kuntzmann 1961
   source: Butcher, Implicit Runge–Kutta processes, Math. Comp. 18 (1964)
   source: Hairer, Lubich & Wanner, Geometric Numerical Integration, §II.1.3
   source: built as in Marsden & West 2001, Theorem 2.6.2
   source: the same method as chebyshev-2
   order 4 for every H (proved), 4 for T(p) + U(q) (proved), 4 for T quadratic (proved)
   symplectic (proved), symmetric (proved)
   written by symplectic VERSION */

static const double gauss_2_c[2] = {
    0x1.b0cb174df99c7p-3, /* 1/2 - sqrt(3)/6 = 0.21132486540518712 */
    0x1.93cd3a2c8198ep-1, /* 1/2 + sqrt(3)/6 = 0.78867513459481288 */
};

static const double gauss_2_b[2] = {
    0x1p-1, /* 1/2 */
    0x1p-1, /* 1/2 */
};

static const double gauss_2_a[2][2] = {
    {
        0x1p-2, /* 1/4 */
        -0x1.3cd3a2c8198e2p-5, /* 1/4 - sqrt(3)/6 = -0.038675134594812882 */
    },
    {
        0x1.13cd3a2c8198ep-1, /* 1/4 + sqrt(3)/6 = 0.53867513459481288 */
        0x1p-2, /* 1/4 */
    },
};
