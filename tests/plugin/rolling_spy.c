// SPDX-License-Identifier: Apache-2.0
// Loaded beside libmujoco_rolling.so into a program of others: after ROLL_SPY_STEPS steps of one
// mjData it says on stderr what the discs do, and ends the program with 0 if they roll, else
// with 1.
#include "rolling.h"

#include <dlfcn.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

enum { MOST = 8 };

static void report(const mjModel *m, mjData *d) {
  roll_disc disc[MOST];
  mjtNum height = 0, slip = 0;
  mj_forward(m, d);
  int count = roll_disc_count(m);
  int rolls = count > 0 && count <= MOST && roll_discs(disc, count, m, d) == ROLL_OK;
  for (int i = 0; rolls && i < count; i++) {
    height = fmax(height, fabs(disc[i].height));
    slip = fmax(slip, mju_norm3(disc[i].slip));
  }
  mjtNum speed = mju_norm(d->qvel, m->nv);
  fprintf(stderr, "spy: %d discs at %.3f s: height %.1e m, slip %.1e m/s, |qvel| %.3f\n", count,
          d->time, height, slip, speed);
  // the state of the keyframe, not of rest, and on the ground
  _exit(rolls && height < 1e-10 && slip < 1e-8 && speed > 1 ? 0 : 1);
}

__attribute__((visibility("default"))) void mj_step(const mjModel *m, mjData *d) {
  static _Thread_local const mjData *watched;
  static _Thread_local int steps;
  static void (*step)(const mjModel *, mjData *);
  if (!step) *(void **)&step = dlsym(RTLD_NEXT, "mj_step");
  step(m, d);
  steps = d == watched ? steps + 1 : 1;
  watched = d;
  const char *limit = getenv("ROLL_SPY_STEPS");
  if (limit && steps == atoi(limit)) report(m, d);
}
