// SPDX-License-Identifier: Apache-2.0
// The scalar kernel as one straight line, from a state to its accelerations, for count.sh: what
// judges failures is left out, and so is every term that accelerations do not need.
#include "equations/number_double.h"

void bench_counted_kernel(double out[3], const bike_model *m, double phi, double kappa,
                          const form *u);

void bench_counted_kernel(double out[3], const bike_model *m, double phi, double kappa,
                          const form *u) {
  instant now;
  solve_instant(&now, m, guessed(m, phi, kappa), phi, kappa, *u, NULL);
  out[0] = now.acceleration.phi;
  out[1] = now.acceleration.kap;
  out[2] = now.acceleration.v;
}
