/* What ARKODE holds of every table, what SPRKStep steps with, and where it comes. */
#include <stdlib.h>

#include <arkode/arkode.h>
#include <arkode/arkode_arkstep.h>
#include <arkode/arkode_sprkstep.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_version.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include "sundials.h"
#include "kepler.h"

#define CHECK(call) do { if ((call) != 0) { fprintf(stderr, "%s failed\n", #call); exit(1); } } while (0)

static SUNContext context;

/* The k-th evaluation returns the k-th unit vector, so that one step of size 1 from zero shows every weight as it is. */
static int evaluations, *kinds;

static int unit(N_Vector y, N_Vector ydot, int kind) {
  (void)y;
  kinds[evaluations] = kind;
  N_VGetArrayPointer(ydot)[evaluations++] = 1;
  return 0;
}
static int unit_force(sunrealtype t, N_Vector y, N_Vector ydot, void *data) { (void)t; (void)data; return unit(y, ydot, 'k'); }
static int unit_velocity(sunrealtype t, N_Vector y, N_Vector ydot, void *data) { (void)t; (void)data; return unit(y, ydot, 'd'); }

/* y = (q, p) */
static int kepler_force(sunrealtype t, N_Vector y, N_Vector ydot, void *data) {
  (void)t; (void)data;
  force(N_VGetArrayPointer(y), N_VGetArrayPointer(ydot) + 2);
  return 0;
}
static int kepler_velocity(sunrealtype t, N_Vector y, N_Vector ydot, void *data) {
  (void)t; (void)data;
  memcpy(N_VGetArrayPointer(ydot), N_VGetArrayPointer(y) + 2, 2 * sizeof(double));
  return 0;
}
static int kepler(sunrealtype t, N_Vector y, N_Vector ydot, void *data) {
  return kepler_force(t, y, ydot, data) || kepler_velocity(t, y, ydot, data);
}

static void steps(void *memory, N_Vector y, int number, double size) {
  sunrealtype t;
  CHECK(ARKodeSetFixedStep(memory, size));
  for (int i = 0; i < number; i++) CHECK(ARKodeEvolve(memory, 100, y, &t, ARK_ONE_STEP));
}

static void show_state(const char *name, N_Vector y) { show(name, "state", N_VGetArrayPointer(y), 4); }

static void splitting(const char *name, ARKodeSPRKTable table) {
  CHECK(table == NULL);
  printf("%s order %d\n", name, table->q);
  printf("%s flows", name);
  for (int i = 0; i < table->stages; i++) { flow('k', table->ahat[i]); flow('d', table->a[i]); }
  printf("\n");

  int size = 2 * table->stages;
  kinds = calloc(size, sizeof(int));
  evaluations = 0;
  N_Vector y = N_VNew_Serial(size, context);
  N_VConst(0, y);
  void *memory = SPRKStepCreate(unit_force, unit_velocity, 0, y, context);
  CHECK(SPRKStepSetMethod(memory, table));
  steps(memory, y, 1, 1);
  printf("%s flows", name);
  for (int i = 0; i < evaluations; i++) flow(kinds[i], N_VGetArrayPointer(y)[i]);
  printf("\n");
  ARKodeFree(&memory);
  N_VDestroy(y);
  free(kinds);

  double start[] = START;
  y = N_VMake_Serial(4, start, context);
  memory = SPRKStepCreate(kepler_force, kepler_velocity, 0, y, context);
  CHECK(SPRKStepSetMethod(memory, table));
  steps(memory, y, STEPS, STEP);
  show_state(name, y);
  ARKodeFree(&memory);
  N_VDestroy(y);
  ARKodeSPRKTable_Free(table);
}

static void butcher(const char *name, ARKodeButcherTable table) {
  CHECK(table == NULL);
  int stages = table->stages, p;
  printf("%s order %d\n", name, table->q);
  show(name, "c", table->c, stages);
  show(name, "b", table->b, stages);
  double *a = malloc(stages * stages * sizeof(double));
  for (int i = 0; i < stages; i++) memcpy(a + i * stages, table->A[i], stages * sizeof(double));
  show(name, "a", a, stages * stages);
  free(a);
  /* The library's own check of the order conditions, up to 6. */
  int q;
  if (ARKodeButcherTable_CheckOrder(table, &q, &p, NULL) < 0) q = 0;
  printf("%s least %d\n", name, q);

  double start[] = START;
  N_Vector y = N_VMake_Serial(4, start, context);
  void *memory = ARKStepCreate(NULL, kepler, 0, y, context);
  SUNNonlinearSolver solver = SUNNonlinSol_FixedPoint(y, 0, context);
  CHECK(ARKStepSetTables(memory, table->q, 0, table, NULL));
  CHECK(ARKodeSStolerances(memory, 1e-14, 1e-14));
  CHECK(ARKodeSetNonlinearSolver(memory, solver));
  CHECK(ARKodeSetMaxNonlinIters(memory, 200));
  CHECK(ARKodeSetNonlinConvCoef(memory, 1e-2));
  steps(memory, y, STEPS, STEP);
  show_state(name, y);
  ARKodeFree(&memory);
  SUNNonlinSolFree(solver);
  N_VDestroy(y);
  ARKodeButcherTable_Free(table);
}

int main(void) {
  CHECK(SUNContext_Create(SUN_COMM_NULL, &context));
  char version[64];
  CHECK(SUNDIALSGetVersion(version, sizeof(version)));
  printf("version SUNDIALS %s\n", version);
#define SPLITTING(name) splitting(#name, name());
  ALL_ARKodeSPRKTable(SPLITTING)
#define BUTCHER(name) butcher(#name, name());
  ALL_ARKodeButcherTable(BUTCHER)
  SUNContext_Free(&context);
  return 0;
}
