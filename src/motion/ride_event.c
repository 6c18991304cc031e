// SPDX-License-Identifier: Apache-2.0
#include "motion/ride_event.h"

#include <bicycle/error.h>
#include <float.h>
#include <math.h>

const char *bike_event_string(bike_event_kind kind) {
  switch (kind) {
  case BIKE_EVENT_REAR_LIFT:
    return "rear wheel lifts";
  case BIKE_EVENT_FRONT_LIFT:
    return "front wheel lifts";
  case BIKE_EVENT_LEAN_LIMIT:
    return "lean limit reached";
  case BIKE_EVENT_VALIDITY:
    return "end of the model's validity";
  case BIKE_EVENT_STANDSTILL:
    return "standstill";
  }
  return "unknown event";
}

// A ride that starts at rest has no standstill: its wheels roll to and fro while it falls.
static double standstill(double start, double speed) {
  return start == 0 ? 1 : copysign(1, start) * speed;
}

static double yaw_denominator(const bike_snapshot *now) {
  return now->T_r * cos(now->phi_tilde) - now->T_f;
}

static double pitch_denominator(const bike_snapshot *now) {
  return now->T_r - now->T_f * cos(now->phi_tilde);
}

ride_side ride_side_of(const bike_snapshot *start) {
  return (ride_side){copysign(1, yaw_denominator(start)), copysign(1, pitch_denominator(start))};
}

// Where a denominator has fallen to BIKE_EDGE of |T_r| + |T_f| the model is taken to end. Rates
// err by some eps / share^2: nearer, an integrator at 1e-13 steps on that noise (in falls of the
// roadster 1e3 steps to a share of 1e-3, 1e5 to 1e-4) and wheels lift by it. What is left of the
// way was then 3e-4 s or less.
static double validity(const ride_side *side, const bike_snapshot *now) {
  double scale = fabs(now->T_r) + fabs(now->T_f);
  double least = fmin(side->yaw * yaw_denominator(now), side->pitch * pitch_denominator(now));
  return least - BIKE_EDGE * scale;
}

ride_indicators ride_indicate(const bike_ride_def *def, const ride_side *side, const ride_point *at,
                              const bike_snapshot *now) {
  ride_indicators i = ride_nothing_happened();
  i.g[BIKE_EVENT_REAR_LIFT] = now->rear_force[2];
  i.g[BIKE_EVENT_FRONT_LIFT] = now->front_force[2];
  i.g[BIKE_EVENT_LEAN_LIMIT] = def->lean_limit - fabs(at->y[RIDE_LEAN]);
  i.g[BIKE_EVENT_VALIDITY] = validity(side, now);
  i.g[BIKE_EVENT_STANDSTILL] = standstill(def->start.speed, at->y[RIDE_SPEED]);
  i.g[RIDE_REAR_GRIP] = bike_grip(now->rear_force, def->friction_limit);
  i.g[RIDE_FRONT_GRIP] = bike_grip(now->front_force, def->friction_limit);
  return i;
}

ride_indicators ride_nothing_happened(void) {
  ride_indicators i;
  for (int k = 0; k < RIDE_INDICATORS; k++) i.g[k] = 1;
  return i;
}

bool ride_event_ends(const bike_ride_def *def, bike_event_kind kind) {
  bool lift = kind == BIKE_EVENT_REAR_LIFT || kind == BIKE_EVENT_FRONT_LIFT;
  return !lift || def->stop_at_lift;
}

// Where the chord between (a, ga) and (b, gb) meets zero, at least half a width from both ends;
// the middle where that is nowhere.
static double chord(double a, double ga, double b, double gb, double width) {
  double t = a + (b - a) * (ga / (ga - gb));
  if (!(t >= a && t <= b)) return a + (b - a) / 2;
  return fmin(fmax(t, a + width / 2), b - width / 2);
}

// 1e-12 s is a hundred times finer than anyone compares events; later in a ride the rounding of the
// time itself is the limit. Chords in the Illinois manner (the end that stays counts half), every
// third cut in the middle, so that the bracket shrinks whatever the function.
int ride_event_time(double *time, int kind, double a, const ride_indicators *at_a, double b,
                    const ride_indicators *at_b, ride_indicators_at *look, void *user) {
  bool falls = at_a->g[kind] > 0;
  double ga = fabs(at_a->g[kind]), gb = -fabs(at_b->g[kind]);
  double width = fmax(1e-12, 8 * DBL_EPSILON * fabs(b));
  for (int cut = 1; b - a > width; cut++) {
    double t = cut % 3 == 0 ? a + (b - a) / 2 : chord(a, ga, b, gb, width);
    ride_indicators here;
    int code = look(&here, t, user);
    if (code) return code;
    double g = fabs(here.g[kind]);
    if ((here.g[kind] > 0) == falls) {
      a = t;
      ga = g;
      gb /= 2;
    } else {
      b = t;
      gb = -g;
      ga /= 2;
    }
  }
  *time = b;
  return BIKE_OK;
}

void ride_record(bike_ride_result *out, bike_event_kind kind, double time) {
  if (out->event_count < BIKE_MAX_EVENTS) out->events[out->event_count] = (bike_event){kind, time};
  out->event_count++;
}
