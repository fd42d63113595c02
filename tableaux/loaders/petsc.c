/* What TSBASICSYMPLECTIC and TSIRK step with, and where they come. Their tables are private: the numbers are read from steps. */
#include <petscsnes.h>
#include <petscts.h>

#include "petsc.h"
#include "kepler.h"

/* Not fewer than the evaluations of a step. */
#define MOST 1300

/* The k-th evaluation returns the k-th unit vector, so that one step of size 1 from zero shows every weight as it is. */
static int evaluations, kinds[MOST];

static PetscErrorCode unit(Vec f, int kind)
{
  PetscFunctionBegin;
  kinds[evaluations] = kind;
  PetscCall(VecZeroEntries(f));
  PetscCall(VecSetValue(f, evaluations++, 1, INSERT_VALUES));
  PetscCall(VecAssemblyBegin(f));
  PetscCall(VecAssemblyEnd(f));
  PetscFunctionReturn(PETSC_SUCCESS);
}
static PetscErrorCode unit_velocity(TS ts, PetscReal t, Vec p, Vec f, void *data) { return unit(f, 'd'); }
static PetscErrorCode unit_force(TS ts, PetscReal t, Vec q, Vec f, void *data) { return unit(f, 'k'); }

static PetscErrorCode kepler_velocity(TS ts, PetscReal t, Vec p, Vec f, void *data) { return VecCopy(p, f); }
static PetscErrorCode kepler_force(TS ts, PetscReal t, Vec q, Vec f, void *data)
{
  const PetscScalar *x;
  PetscScalar       *y;

  PetscFunctionBegin;
  PetscCall(VecGetArrayRead(q, &x));
  PetscCall(VecGetArray(f, &y));
  force(x, y);
  PetscCall(VecRestoreArray(f, &y));
  PetscCall(VecRestoreArrayRead(q, &x));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode create(PetscInt steps, PetscReal size, TS *ts)
{
  PetscFunctionBegin;
  PetscCall(TSCreate(PETSC_COMM_SELF, ts));
  PetscCall(TSSetProblemType(*ts, TS_NONLINEAR));
  PetscCall(TSSetTimeStep(*ts, size));
  PetscCall(TSSetMaxSteps(*ts, steps));
  PetscCall(TSSetMaxTime(*ts, 100));
  PetscCall(TSSetExactFinalTime(*ts, TS_EXACTFINALTIME_STEPOVER));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode starting(Vec y)
{
  const double start[] = START;

  PetscFunctionBegin;
  for (PetscInt i = 0; i < 4; i++) PetscCall(VecSetValue(y, i, start[i], INSERT_VALUES));
  PetscCall(VecAssemblyBegin(y));
  PetscCall(VecAssemblyEnd(y));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode show_state(const char *name, Vec y)
{
  const PetscScalar *x;

  PetscFunctionBegin;
  PetscCall(VecGetArrayRead(y, &x));
  show(name, "state", x, 4);
  PetscCall(VecRestoreArrayRead(y, &x));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Steps of TSBASICSYMPLECTIC from y = (q, p), each of the given dimension. */
static PetscErrorCode split(const char *name, PetscInt dimension, TSRHSFunctionFn *velocity, TSRHSFunctionFn *kick, PetscInt steps, PetscReal size, Vec y)
{
  TS ts;
  IS q, p;

  PetscFunctionBegin;
  PetscCall(create(steps, size, &ts));
  PetscCall(ISCreateStride(PETSC_COMM_SELF, dimension, 0, 1, &q));
  PetscCall(ISCreateStride(PETSC_COMM_SELF, dimension, dimension, 1, &p));
  PetscCall(TSRHSSplitSetIS(ts, "position", q));
  PetscCall(TSRHSSplitSetIS(ts, "momentum", p));
  PetscCall(TSRHSSplitSetRHSFunction(ts, "position", NULL, velocity, NULL));
  PetscCall(TSRHSSplitSetRHSFunction(ts, "momentum", NULL, kick, NULL));
  PetscCall(TSSetType(ts, TSBASICSYMPLECTIC));
  PetscCall(TSBasicSymplecticSetType(ts, name));
  PetscCall(TSSolve(ts, y));
  PetscCall(ISDestroy(&q));
  PetscCall(ISDestroy(&p));
  PetscCall(TSDestroy(&ts));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode splitting(const char *name)
{
  Vec                y;
  const PetscScalar *x;

  PetscFunctionBegin;
  PetscCall(VecCreateSeq(PETSC_COMM_SELF, 2 * MOST, &y));
  evaluations = 0;
  PetscCall(split(name, MOST, unit_velocity, unit_force, 1, 1, y));
  PetscCall(VecGetArrayRead(y, &x));
  printf("%s flows", name);
  for (int i = 0; i < evaluations; i++) flow(kinds[i], x[kinds[i] == 'd' ? i : MOST + i]);
  printf("\n");
  PetscCall(VecRestoreArrayRead(y, &x));
  PetscCall(VecDestroy(&y));

  PetscCall(VecCreateSeq(PETSC_COMM_SELF, 4, &y));
  PetscCall(starting(y));
  PetscCall(split(name, 2, kepler_velocity, kepler_force, STEPS, STEP, y));
  PetscCall(show_state(name, y));
  PetscCall(VecDestroy(&y));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The nodes are where the right-hand side is asked for in the first step, from the time 0. */
static PetscReal nodes[MOST];
/* If so, the k-th evaluation returns the k-th unit vector. */
static PetscBool units;

static PetscErrorCode rest(TS ts, PetscReal t, Vec u, Vec udot, Vec f, void *data)
{
  PetscFunctionBegin;
  nodes[evaluations] = t;
  if (units) PetscCall(unit(f, 0));
  else {
    PetscCall(VecCopy(udot, f));
    evaluations++;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}
static PetscErrorCode rest_jacobian(TS ts, PetscReal t, Vec u, Vec udot, PetscReal shift, Mat j, Mat preconditioner, void *data)
{
  PetscFunctionBegin;
  PetscCall(MatZeroEntries(j));
  PetscCall(MatShift(j, shift));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode kepler(TS ts, PetscReal t, Vec u, Vec udot, Vec f, void *data)
{
  const PetscScalar *x, *xdot;
  PetscScalar       *y;

  PetscFunctionBegin;
  PetscCall(VecGetArrayRead(u, &x));
  PetscCall(VecGetArrayRead(udot, &xdot));
  PetscCall(VecGetArray(f, &y));
  force(x, y + 2);
  for (int i = 0; i < 2; i++) {
    y[i]     = xdot[i] - x[i + 2];
    y[i + 2] = xdot[i + 2] - y[i + 2];
  }
  PetscCall(VecRestoreArray(f, &y));
  PetscCall(VecRestoreArrayRead(udot, &xdot));
  PetscCall(VecRestoreArrayRead(u, &x));
  PetscFunctionReturn(PETSC_SUCCESS);
}
static PetscErrorCode kepler_jacobian(TS ts, PetscReal t, Vec u, Vec udot, PetscReal shift, Mat j, Mat preconditioner, void *data)
{
  const PetscScalar *x;

  PetscFunctionBegin;
  PetscCall(VecGetArrayRead(u, &x));
  const double r = hypot(x[0], x[1]), cube = r * r * r;
  PetscCall(MatZeroEntries(j));
  for (int i = 0; i < 2; i++) {
    PetscCall(MatSetValue(j, i, i + 2, -1, INSERT_VALUES));
    for (int k = 0; k < 2; k++) PetscCall(MatSetValue(j, i + 2, k, ((i == k) - 3 * x[i] * x[k] / (r * r)) / cube, INSERT_VALUES));
  }
  PetscCall(VecRestoreArrayRead(u, &x));
  PetscCall(MatAssemblyBegin(j, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(j, MAT_FINAL_ASSEMBLY));
  PetscCall(MatShift(j, shift));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A TSIRK that has taken its steps from y. */
static PetscErrorCode irk(const char *name, PetscInt stages, PetscInt dimension, TSIFunctionFn *f, TSIJacobianFn *df, PetscInt steps, PetscReal size, Vec y, TS *ts)
{
  Mat  j;
  SNES snes;
  KSP  ksp;
  PC   pc;

  PetscFunctionBegin;
  PetscCall(create(steps, size, ts));
  PetscCall(MatCreateSeqAIJ(PETSC_COMM_SELF, dimension, dimension, dimension, NULL, &j));
  for (PetscInt i = 0; i < dimension; i++)
    for (PetscInt k = 0; k < dimension; k++) PetscCall(MatSetValue(j, i, k, 0, INSERT_VALUES));
  PetscCall(MatAssemblyBegin(j, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(j, MAT_FINAL_ASSEMBLY));
  PetscCall(TSSetIFunction(*ts, NULL, f, NULL));
  PetscCall(TSSetIJacobian(*ts, j, j, df, NULL));
  PetscCall(TSSetType(*ts, TSIRK));
  PetscCall(TSIRKSetNumStages(*ts, stages));
  PetscCall(TSIRKSetType(*ts, name));
  PetscCall(TSGetSNES(*ts, &snes));
  PetscCall(SNESSetTolerances(snes, 1e-12, 0, 0, 300, 10000));
  PetscCall(SNESGetKSP(snes, &ksp));
  PetscCall(KSPSetTolerances(ksp, 1e-12, PETSC_CURRENT, PETSC_CURRENT, 1000));
  PetscCall(KSPGMRESSetRestart(ksp, 200));
  PetscCall(KSPGetPC(ksp, &pc));
  PetscCall(PCSetType(pc, PCNONE));
  PetscCall(TSSolve(*ts, y));
  PetscCall(MatDestroy(&j));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A method of TSIRK. */
static PetscErrorCode implicit(const char *name, PetscInt stages)
{
  TS                 ts;
  SNES               snes;
  Vec                y, z, f, w;
  const PetscScalar *x;

  PetscFunctionBegin;
  PetscCall(VecCreateSeq(PETSC_COMM_SELF, stages, &y));
  evaluations = 0;
  units       = PETSC_FALSE;
  PetscCall(irk(name, stages, stages, rest, rest_jacobian, 1, 1, y, &ts));
  show(name, "c", nodes, stages);
  /* The derivatives of stages that are unit vectors are the columns of the inverse. */
  PetscCall(TSGetSNES(ts, &snes));
  PetscCall(SNESGetSolution(snes, &z));
  PetscCall(VecDuplicate(z, &f));
  PetscCall(VecZeroEntries(z));
  for (PetscInt i = 0; i < stages; i++) PetscCall(VecSetValue(z, i * stages + i, 1, INSERT_VALUES));
  PetscCall(VecAssemblyBegin(z));
  PetscCall(VecAssemblyEnd(z));
  evaluations = 0;
  PetscCall(SNESComputeFunction(snes, z, f));
  PetscCall(VecGetArrayRead(f, &x));
  printf("%s inverse", name);
  for (PetscInt i = 0; i < stages; i++)
    for (PetscInt k = 0; k < stages; k++) {
      printf(" ");
      print_bits(x[k * stages + i]);
    }
  printf("\n");
  PetscCall(VecRestoreArrayRead(f, &x));
  /* The sum of weights times unit vectors. */
  units       = PETSC_TRUE;
  evaluations = 0;
  PetscCall(SNESComputeFunction(snes, z, f));
  PetscCall(VecDuplicate(y, &w));
  PetscCall(TSEvaluateStep(ts, stages, w, NULL));
  PetscCall(VecGetArrayRead(w, &x));
  show(name, "b", x, stages);
  PetscCall(VecRestoreArrayRead(w, &x));
  PetscCall(VecDestroy(&w));
  PetscCall(VecDestroy(&f));
  PetscCall(VecDestroy(&y));
  PetscCall(TSDestroy(&ts));

  PetscCall(VecCreateSeq(PETSC_COMM_SELF, 4, &y));
  PetscCall(starting(y));
  PetscCall(irk(name, stages, 4, kepler, kepler_jacobian, STEPS, STEP, y, &ts));
  PetscCall(show_state(name, y));
  PetscCall(VecDestroy(&y));
  PetscCall(TSDestroy(&ts));
  PetscFunctionReturn(PETSC_SUCCESS);
}

int main(int count, char **arguments)
{
  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&count, &arguments, NULL, NULL));
  printf("version PETSc %d.%d.%d\n", PETSC_VERSION_MAJOR, PETSC_VERSION_MINOR, PETSC_VERSION_SUBMINOR);
#define SPLITTING(name) \
  PetscCall(name##_register()); \
  PetscCall(splitting(#name));
  ALL_register(SPLITTING)
#define IMPLICIT(name) \
  PetscCall(TSIRKRegister(#name, name##_create)); \
  PetscCall(implicit(#name, STAGES_##name));
  ALL_create(IMPLICIT)
  PetscCall(PetscFinalize());
  return 0;
}
