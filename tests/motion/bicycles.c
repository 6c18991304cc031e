// SPDX-License-Identifier: Apache-2.0
#include "motion/bicycles.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double PI = 3.14159265358979323846;

static bike_part part(const char *name, bike_assembly assembly, double mass, double forward,
                      double up) {
  bike_part p = {.assembly = assembly, .mass = mass, .position = {forward, 0, up}};
  strcpy(p.name, name);
  return p;
}

static void add(bike_bicycle *b, bike_part p) {
  b->parts[b->part_count++] = p;
}

static bike_part spinning(bike_part p, double axial, double diametral) {
  p.inertia[0] = p.inertia[2] = diametral;
  p.inertia[1] = axial;
  return p;
}

// Theta e_S e_S^T, e_S = (-sin tilt, 0, cos tilt)
static bike_part steering(bike_part p, double theta, double tilt) {
  double s = sin(tilt), c = cos(tilt);
  p.inertia[0] = theta * s * s;
  p.inertia[2] = theta * c * c;
  p.inertia[4] = -theta * s * c;
  return p;
}

static bike_model model_of(const bike_bicycle *b) {
  bike_model model;
  if (bike_model_init(&model, b)) abort();
  return model;
}

bike_model damped_roadster(double damping) {
  double tilt = 22 * PI / 180;
  bike_bicycle b = bike_default_bicycle();
  b.geometry = bike_geometry_from_wheelbase(1.11, 0.07, tilt, 0.34, 0.34);
  b.steer_damping = damping;
  add(&b, spinning(part("rear wheel", BIKE_REAR_WHEEL, 2, 0, 0.34), 0.20, 0));
  add(&b, part("frame", BIKE_REAR_FRAME, 12, 0.45, 0.55));
  bike_part rider = part("rider", BIKE_REAR_FRAME, 70, 0.36, 1.08);
  rider.rider = true;
  add(&b, rider);
  add(&b, steering(part("bar and fork", BIKE_FRONT_FRAME, 3, 0.86, 0.85), 0.10, tilt));
  add(&b, spinning(part("front wheel", BIKE_FRONT_WHEEL, 2, 1.11, 0.34), 0.20, 0));
  return model_of(&b);
}

bike_model roadster(void) {
  return damped_roadster(0);
}

bike_model penny_farthing(void) {
  double tilt = 8 * PI / 180;
  bike_bicycle b = bike_default_bicycle();
  b.geometry = bike_geometry_from_wheelbase(0.95, 0.05, tilt, 0.22, 0.66);
  add(&b, spinning(part("rear wheel", BIKE_REAR_WHEEL, 1.5, 0, 0.22), 0.05, 0));
  add(&b, part("frame", BIKE_REAR_FRAME, 9, 0.65, 0.85));
  add(&b, part("rider", BIKE_REAR_FRAME, 70, 0.72, 1.45));
  add(&b, steering(part("bar and fork", BIKE_FRONT_FRAME, 2.5, 0.83, 1.35), 0.05, tilt));
  add(&b, spinning(part("front wheel", BIKE_FRONT_WHEEL, 6, 0.95, 0.66), 2.0, 0));
  return model_of(&b);
}

bike_model benchmark(void) {
  bike_bicycle b = bike_default_bicycle();
  b.geometry = bike_geometry_from_wheelbase(1.02, 0.08, PI / 10, 0.3, 0.35);
  add(&b, spinning(part("R", BIKE_REAR_WHEEL, 2, 0, 0.3), 0.12, 0.0603));
  bike_part body = part("B", BIKE_REAR_FRAME, 85, 0.3, 0.9);
  memcpy(body.inertia, (double[6]){9.2, 11, 2.8, 0, -2.4, 0}, sizeof body.inertia);
  add(&b, body);
  bike_part bar = part("H", BIKE_FRONT_FRAME, 4, 0.9, 0.7);
  memcpy(bar.inertia, (double[6]){0.05892, 0.06, 0.00708, 0, 0.00756, 0}, sizeof bar.inertia);
  add(&b, bar);
  add(&b, spinning(part("F", BIKE_FRONT_WHEEL, 3, 1.02, 0.35), 0.28, 0.1405));
  return model_of(&b);
}
