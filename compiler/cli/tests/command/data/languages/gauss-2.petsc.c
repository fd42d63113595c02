/* gauss-2, 2 stages, basis polynomial(2), nodes gauss(2)
   source: Kuntzmann 1961
   source: Butcher, Implicit Runge–Kutta processes, Math. Comp. 18 (1964)
   source: Hairer, Lubich & Wanner, Geometric Numerical Integration, §II.1.3
   source: built as in Marsden & West 2001, Theorem 2.6.2
   source: the same method as chebyshev-2
   order 4 for every H (proved), 4 for T(p) + U(q) (proved), 4 for T quadratic (proved)
   symplectic (proved), symmetric (proved)
   written by symplectic VERSION */
#include <petscts.h>

/* Order 4. A is stored row by row, and A_inv column by column, as TSIRK reads it.
   After TSIRKRegister("gauss_2", gauss_2_create): TSSetType(ts, TSIRK), TSIRKSetNumStages(ts, 2), TSIRKSetType(ts, "gauss_2"). */
static PetscErrorCode gauss_2_create(TS ts)
{
  PetscReal A[] = {
    0x1p-2, /* 1/4 */
    -0x1.3cd3a2c8198e2p-5, /* 1/4 - sqrt(3)/6 = -0.038675134594812882 */
    0x1.13cd3a2c8198ep-1, /* 1/4 + sqrt(3)/6 = 0.53867513459481288 */
    0x1p-2, /* 1/4 */
  };
  PetscReal b[] = {
    0x1p-1, /* 1/2 */
    0x1p-1, /* 1/2 */
  };
  PetscReal c[] = {
    0x1.b0cb174df99c7p-3, /* 1/2 - sqrt(3)/6 = 0.21132486540518712 */
    0x1.93cd3a2c8198ep-1, /* 1/2 + sqrt(3)/6 = 0.78867513459481288 */
  };
  const PetscScalar A_inv[] = {
    0x1.8p+1,
    -0x1.9db3d742c2655p+2,
    0x1.db3d742c26554p-2,
    0x1.8p+1,
  };
  const PetscScalar A_inv_rowsum[] = {
    0x1.bb67ae8584caap+1,
    -0x1.bb67ae8584caap+1,
  };
  const PetscScalar I_s[] = {
    0x1p+0,
    0x0p+0,
    0x0p+0,
    0x1p+0,
  };
  PetscFunctionBegin;
  PetscCall(TSIRKTableauCreate(ts, 2, A, b, c, NULL, A_inv, A_inv_rowsum, I_s));
  PetscFunctionReturn(PETSC_SUCCESS);
}
