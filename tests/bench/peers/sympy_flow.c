// SPDX-License-Identifier: Apache-2.0
// sympy's bicycle as a differential equation y' = f(t, y), y = (lean, steer, lean rate, steer rate,
// speed), in a shared library of its own: scipy's Fortran integrators call it without Python
// between. Such a callback has no room for a context; the process that loads this rides one
// bicycle.
#include "sympy_flow.h"

#include <math.h>
#include <string.h>

static sympy_bicycle bicycle;
static long calls;

int sympy_flow_load(const double *parameters, int count) {
  if (count != (int)(sizeof bicycle / sizeof(double))) return -1;
  memcpy(&bicycle, parameters, sizeof bicycle);
  return 0;
}

long sympy_flow_calls(void) {
  long made = calls;
  calls = 0;
  return made;
}

void sympy_flow(const int *n, const double *t, const double *y, double *dy) {
  (void)n, (void)t;
  const bike_state state = {y[0], y[1], y[2], y[3], y[4]};
  bike_acceleration a = {NAN, NAN, NAN};
  calls++;
  sympy_accelerate_reduced(&a, &bicycle, &state);
  dy[0] = y[2];
  dy[1] = y[3];
  dy[2] = a.lean;
  dy[3] = a.steer;
  dy[4] = a.speed;
}

void sympy_flow_repeat(const double *y, double *dy, long repeats) {
  const int n = 5;
  const double t = 0;
  double moved[5];
  memcpy(moved, y, sizeof moved);
  for (long i = 0; i < repeats; i++) {
    moved[0] = y[0] + 1e-9 * (double)i;
    sympy_flow(&n, &t, moved, dy);
  }
}
