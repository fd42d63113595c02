/* forest-ruth-1990, 4 stages, kick -1/(2*(cbrt(2) - 2)), (cbrt(2) - 1)/(2*(cbrt(2) - 2)), drift -1/(cbrt(2) - 2), cbrt(2)/(cbrt(2) - 2), symmetric true
   source: Forest & Ruth, Fourth-order symplectic integration, Physica D 43 (1990)
   source: Candy & Rozmus, J. Comput. Phys. 92 (1991)
   source: Yoshida 1990
   order 1 for every H (proved), 4 for T(p) + U(q) (proved), 4 for T quadratic (proved)
   symplectic(separable) (proved), symmetric(separable) (proved)
   written by symplectic VERSION */
#include <arkode/arkode_sprk.h>

/* For SPRKStepSetMethod: f1 is the force at q, f2 the velocity at p. */
static ARKodeSPRKTable forest_ruth_1990(void) {
  static sunrealtype a[4] = {
    0x1.59e8b6eb96338p+0, /* 2/3 + cbrt(2)/3 + cbrt(2)^2/6 = 1.3512071919596576 */
    -0x1.b3d16dd72c671p+0, /* -1/3 - 2*cbrt(2)/3 - cbrt(2)^2/3 = -1.7024143839193153 */
    0x1.59e8b6eb96338p+0, /* 2/3 + cbrt(2)/3 + cbrt(2)^2/6 = 1.3512071919596576 */
    0x0p+0, /* 0 */
  };
  static sunrealtype ahat[4] = {
    0x1.59e8b6eb96338p-1, /* 1/3 + cbrt(2)/6 + cbrt(2)^2/12 = 0.67560359597982882 */
    -0x1.67a2dbae58ce2p-3, /* 1/6 - cbrt(2)/6 - cbrt(2)^2/12 = -0.17560359597982882 */
    -0x1.67a2dbae58ce2p-3, /* 1/6 - cbrt(2)/6 - cbrt(2)^2/12 = -0.17560359597982882 */
    0x1.59e8b6eb96338p-1, /* 1/3 + cbrt(2)/6 + cbrt(2)^2/12 = 0.67560359597982882 */
  };
  return ARKodeSPRKTable_Create(4, 4, a, ahat);
}
