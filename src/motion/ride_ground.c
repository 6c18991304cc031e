// SPDX-License-Identifier: Apache-2.0
#include "motion/ride_ground.h"

#include <bicycle/error.h>

// One wheel's two questions, each with the indicator that is not positive while it holds.
typedef struct watch {
  bike_spells *spells;
  int indicator;
} watch;

enum { WATCHES = 4 };

static void list_watches(watch out[WATCHES], bike_wheel_ground ground[2]) {
  out[0] = (watch){&ground[0].lifted, BIKE_EVENT_REAR_LIFT};
  out[1] = (watch){&ground[0].no_grip, RIDE_REAR_GRIP};
  out[2] = (watch){&ground[1].lifted, BIKE_EVENT_FRONT_LIFT};
  out[3] = (watch){&ground[1].no_grip, RIDE_FRONT_GRIP};
}

static bool holds(const ride_indicators *at, int indicator) {
  return !(at->g[indicator] > 0);
}

void ride_ground_look(bike_wheel_ground ground[2], double time, const bike_snapshot *view) {
  bike_ground_look(&ground[0], time, view->rear_force);
  bike_ground_look(&ground[1], time, view->front_force);
}

void ride_ground_jump(bike_wheel_ground ground[2], double time, const ride_indicators *now) {
  watch all[WATCHES];
  list_watches(all, ground);
  for (int i = 0; i < WATCHES; i++)
    bike_spells_set(all[i].spells, holds(now, all[i].indicator), time);
}

int ride_ground_pass(bike_wheel_ground ground[2], double a, const ride_indicators *at_a, double b,
                     const ride_indicators *at_b, ride_indicators_at *look, void *user) {
  watch all[WATCHES];
  list_watches(all, ground);
  for (int i = 0; i < WATCHES; i++) {
    int k = all[i].indicator;
    if (holds(at_a, k) == holds(at_b, k)) continue;
    double time;
    int code = ride_event_time(&time, k, a, at_a, b, at_b, look, user);
    if (code) return code;
    bike_spells_set(all[i].spells, holds(at_b, k), time);
  }
  return BIKE_OK;
}
