/* The Kepler problem as compare.py has it, and how doubles are printed for it. */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#define START { 0.4, 0.0, 0.0, 2.0 }
#define STEPS 3
#define STEP 0.0625

static void force(const double *q, double *f) {
  double r = hypot(q[0], q[1]), cube = r * r * r;
  f[0] = -q[0] / cube;
  f[1] = -q[1] / cube;
}

static void print_bits(double x) {
  uint64_t bits;
  memcpy(&bits, &x, sizeof(bits));
  printf("%016llx", (unsigned long long)bits);
}

static void show(const char *name, const char *part, const double *values, int length) {
  printf("%s %s", name, part);
  for (int i = 0; i < length; i++) { printf(" "); print_bits(values[i]); }
  printf("\n");
}

static void flow(int kind, double weight) {
  printf(" %c=", kind);
  print_bits(weight);
}
