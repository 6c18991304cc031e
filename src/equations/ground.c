// SPDX-License-Identifier: Apache-2.0
#include <bicycle/ground.h>
#include <math.h>

double bike_friction(const double force[3]) {
  double horizontal = hypot(force[0], force[1]);
  return horizontal == 0 ? 0 : horizontal / force[2];
}

double bike_grip(const double force[3], double limit) {
  return limit * force[2] - hypot(force[0], force[1]);
}

void bike_spells_set(bike_spells *spells, bool on, double time) {
  if (spells->on == on) return;
  spells->on = on;
  if (!on) {
    spells->duration += time - spells->since;
    return;
  }
  if (spells->count++ == 0) spells->first = time;
  spells->since = time;
}

void bike_ground_look(bike_wheel_ground *wheel, double time, const double force[3]) {
  bool first = wheel->looks++ == 0;
  if (first || force[2] < wheel->normal) {
    wheel->normal = force[2];
    wheel->normal_time = time;
  }
  double friction = bike_friction(force);
  if (force[2] > 0 && (friction > wheel->friction || first)) {
    wheel->friction = friction;
    wheel->friction_time = time;
  }
}

void bike_ground_end(bike_wheel_ground *wheel, double time) {
  bike_spells_set(&wheel->lifted, false, time);
  bike_spells_set(&wheel->no_grip, false, time);
  if (wheel->lifted.count == 0) return;
  wheel->friction = INFINITY;
  wheel->friction_time = wheel->lifted.first;
}
