// SPDX-License-Identifier: Apache-2.0
// The benchmark of Meijaard et al. (2007), table 1, through the installed headers.
#include <bicycle/error.h>
#include <bicycle/file.h>
#include <bicycle/stability.h>
#include <stdio.h>

int main(void) {
  // w, c, lam, g, rR, mR, IRxx, IRyy, xB, zB, mB, IBxx, IByy, IBzz, IBxz, xH, zH, mH, ... rF ...
  const double table1[BIKE_MEIJAARD_COUNT] = {1.02,     0.08, 0.3141592653589793,
                                              9.81,     0.3,  2,
                                              0.0603,   0.12, 0.3,
                                              -0.9,     85,   9.2,
                                              11,       2.8,  2.4,
                                              0.9,      -0.7, 4,
                                              0.05892,  0.06, 0.00708,
                                              -0.00756, 0.35, 3,
                                              0.1405,   0.28};
  bike_bicycle bicycle;
  bike_model model;
  bike_critical_speeds found;
  int code = bike_from_meijaard(&bicycle, table1);
  if (!code) code = bike_model_init(&model, &bicycle);
  if (!code) code = bike_upright_critical_speeds(&found, &model, 0, 20);
  if (code) {
    fprintf(stderr, "%s\n", bike_error_string(code));
    return 1;
  }
  printf("%.17g\n", found.weave[0]);
  return 0;
}
