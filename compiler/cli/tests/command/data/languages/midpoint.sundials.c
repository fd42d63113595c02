/* midpoint, 1 stage, basis polynomial(1), nodes 1/2
   source: Leok & Zhang, Discrete Hamiltonian Variational Integrators, Example 2 with c = 1/2
   source: the same method as gauss-1 and chebyshev-1
   order 2 for every H (proved), 2 for T(p) + U(q) (proved), 2 for T quadratic (proved)
   symplectic (proved), symmetric (proved)
   written by symplectic VERSION */
#include <arkode/arkode_butcher.h>

/* For ARKStepSetTables. */
static ARKodeButcherTable midpoint(void) {
  static sunrealtype c[1] = {
    0x1p-1, /* 1/2 */
  };
  static sunrealtype b[1] = {
    0x1p+0, /* 1 */
  };
  static sunrealtype A[1] = {
    0x1p-1, /* 1/2 */
  };
  return ARKodeButcherTable_Create(1, 2, 0, c, A, b, NULL);
}
