// SPDX-License-Identifier: Apache-2.0
#include "work.h"

#include "native.h"
#include "rolling.h"

static volatile double sink; // keeps results alive

// The state moves a little, so that nothing can be kept from one call to the next.
void bench_right_hand_sides(void *context, long repeats) {
  const bench_subject *s = context;
  bike_state state = s->state;
  bike_rates r;
  double sum = 0;
  for (long i = 0; i < repeats; i++) {
    state.lean = s->state.lean + 1e-9 * (double)i;
    if (!bike_rates_of(&r, &s->model, &state, NULL)) sum += r.acceleration.lean;
  }
  sink = sum;
}

void bench_native_accelerations(void *context, long repeats) {
  const bench_subject *s = context;
  bike_state state = s->state;
  bike_acceleration a;
  double sum = 0;
  for (long i = 0; i < repeats; i++) {
    state.lean = s->state.lean + 1e-9 * (double)i;
    if (!native_accelerate(&a, &s->model, &state)) sum += a.lean;
  }
  sink = sum;
}

void bench_mujoco_forward(void *context, long repeats) {
  const bench_twin *twin = context;
  mjModel *m = runner_model(twin->runner);
  mjData *d = runner_data(twin->runner);
  mj_copyData(d, m, twin->start);
  int flags = bench_twin_bare(twin);
  roll_uninstall();
  for (long i = 0; i < repeats; i++) {
    d->qpos[0] = 1e-9 * (double)i;
    mj_forward(m, d);
  }
  roll_install();
  bench_twin_restore(twin, flags);
}
