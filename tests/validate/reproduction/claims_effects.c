// SPDX-License-Identifier: Apache-2.0
// Section 4: figures 3 and 4 and the list of other quantities.
#include "shared.h"
#include <math.h>

static const double FAST = 400; // m/s  light wheels are stable at speeds that nobody rides

static void put_limits(figures *out, const bike_bicycle *b) {
  limits l = limits_of(b, FAST);
  put(out, l.weave);
  put(out, l.capsize);
}

static limits with_wheels(const bike_bicycle *b, double factor) {
  double theta = present(b, BIKE_VARY_WHEEL_INERTIA);
  bike_bicycle v = varied(b, BIKE_VARY_WHEEL_INERTIA, factor * theta, BIKE_FRONT_IN_SPACE);
  return limits_of(&v, FAST);
}

static limits with_front_wheel(const bike_bicycle *b, double factor) {
  double theta = present(b, BIKE_VARY_FRONT_WHEEL_INERTIA);
  bike_bicycle v = varied(b, BIKE_VARY_FRONT_WHEEL_INERTIA, factor * theta, BIKE_FRONT_IN_SPACE);
  return limits_of(&v, FAST);
}

// The exponents d ln v/d ln Theta of the limits between an inertia and a quarter of it.
static void wheel_inertia(figures *out) {
  bike_bicycle b = bicycle_of("roadster");
  const double factors[] = {1, 0.1, 0.01};
  for (int i = 0; i < 3; i++) {
    limits at = with_wheels(&b, factors[i]), less = with_wheels(&b, factors[i] / 4);
    put(out, log(at.weave / less.weave) / log(4));
    put(out, log(at.capsize / less.capsize) / log(4));
  }
}

static void region_size(figures *out) {
  bike_bicycle b = bicycle_of("roadster");
  const double factors[] = {1, 0.1, 0.01};
  for (int i = 0; i < 3; i++) {
    limits l = with_wheels(&b, factors[i]);
    put(out, l.weave);
    put(out, l.capsize);
    put(out, l.capsize - l.weave);
  }
}

static void rear_wheel_kept(figures *out) {
  bike_bicycle b = bicycle_of("roadster");
  const double factors[] = {0.1, 0.01, 0.001};
  for (int i = 0; i < 3; i++) {
    limits l = with_front_wheel(&b, factors[i]);
    put(out, l.weave);
    put(out, l.capsize);
  }
}

static void front_gyroscope(figures *out) {
  bike_bicycle b = bicycle_of("roadster");
  limits l = with_front_wheel(&b, 0);
  put(out, l.weave);
  put(out, l.capsize);
  put(out, l.ranges);
  limits none = with_wheels(&b, 0);
  put(out, none.ranges);
}

// Limits at trails of 3 to 12 cm, and the largest distance of the range's width from the straight
// line between its ends, over the width at the longest.
static void trail_held(figures *out, bike_front_hold hold) {
  enum { COUNT = 10 };
  bike_bicycle b = bicycle_of("roadster");
  double width[COUNT], bend = 0;
  for (int i = 0; i < COUNT; i++) {
    bike_bicycle v = varied(&b, BIKE_VARY_TRAIL, 0.03 + 0.01 * i, hold);
    limits l = limits_of(&v, FAST);
    width[i] = l.capsize - l.weave;
    if (i == 0 || i == 4 || i == COUNT - 1) {
      put(out, l.weave);
      put(out, l.capsize);
    }
  }
  for (int i = 0; i < COUNT; i++) {
    double line = width[0] + (width[COUNT - 1] - width[0]) * i / (COUNT - 1);
    bend = fmax(bend, fabs(width[i] - line));
  }
  put(out, 100 * bend / width[COUNT - 1]);
}

static void trail(figures *out) {
  trail_held(out, BIKE_FRONT_IN_SPACE);
  trail_held(out, BIKE_FRONT_ON_AXIS);
}

static void rider_forward(figures *out) {
  bike_bicycle b = bicycle_of("roadster");
  bike_bicycle rider = varied(&b, BIKE_VARY_RIDER_FORWARD, 0.05, BIKE_FRONT_IN_SPACE);
  bike_bicycle longer = varied(&b, BIKE_VARY_TRAIL, 0.08, BIKE_FRONT_IN_SPACE);
  put_limits(out, &b);
  put_limits(out, &rider);
  put_limits(out, &longer);
}

static void head_angle(figures *out) {
  bike_bicycle b = bicycle_of("roadster");
  put_limits(out, &b);
  for (int hold = 0; hold < 2; hold++) {
    bike_bicycle v = varied(&b, BIKE_VARY_HEAD_ANGLE, 64 * DEGREE, (bike_front_hold)hold);
    put_limits(out, &v);
  }
}

static void steering_inertia(figures *out) {
  bike_bicycle b = bicycle_of("roadster");
  for (int i = 0; i < 3; i++) {
    bike_bicycle v = varied(&b, BIKE_VARY_STEERING_INERTIA, 0.10 + 0.05 * i, BIKE_FRONT_IN_SPACE);
    put_limits(out, &v);
  }
}

static double damped(const bike_bicycle *b, double damping) {
  bike_bicycle v = varied(b, BIKE_VARY_STEER_DAMPING, damping, BIKE_FRONT_IN_SPACE);
  return limits_of(&v, FAST).weave;
}

static void damping_of(figures *out, const char *shipped) {
  bike_bicycle b = bicycle_of(shipped);
  double before = limits_of(&b, FAST).weave, after = damped(&b, 1);
  put(out, before);
  put(out, after);
  put(out, 100 * (after / before - 1));
}

static void damping(figures *out) {
  damping_of(out, "roadster");
  damping_of(out, "benchmark");
}

static void damping_recumbent(figures *out) {
  bike_bicycle b = bicycle_of("recumbent");
  double before = limits_of(&b, FAST).weave;
  damping_of(out, "recumbent");
  put(out, 100 * (damped(&b, 0.5) / before - 1));
  put(out, 100 * (damped(&b, 2) / before - 1));
}

const claim claims_effects[] = {{"wheel-inertia", wheel_inertia},
                                {"region-size", region_size},
                                {"rear-wheel-kept", rear_wheel_kept},
                                {"front-gyroscope", front_gyroscope},
                                {"trail", trail},
                                {"rider-forward", rider_forward},
                                {"head-angle", head_angle},
                                {"steering-inertia", steering_inertia},
                                {"damping", damping},
                                {"damping-recumbent", damping_recumbent},
                                {0}};
