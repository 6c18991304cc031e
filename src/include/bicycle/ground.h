// SPDX-License-Identifier: Apache-2.0
// The ground of the model pulls on a wheel where it would lift, and holds it against any horizontal
// force. A real one does neither: these functions say by how much and for how long a motion asks it
// to. Forces are (along e_R, left, up) on a wheel, N, as in bike_snapshot; any horizontal axes do.
#ifndef BICYCLE_GROUND_H
#define BICYCLE_GROUND_H

#include <bicycle/export.h>
#include <stdbool.h>

// The friction asked: horizontal over normal force. It has the sign of the normal force, negative
// where the ground pulls; 0 without any horizontal force.
BIKE_API double bike_friction(const double force[3]);

// N  What is left of the friction that a coefficient allows, `limit` times the normal force, beyond
// the horizontal force. Not positive where the wheel slides, or is pulled.
BIKE_API double bike_grip(const double force[3], double limit);

// When something held: intervals of time.
typedef struct bike_spells {
  int count;       //   of intervals
  double first;    // s start of the first; of no meaning where there is none
  double duration; // s all of them together
  double since;    // s start of the one that lasts
  bool on;         //   one lasts
} bike_spells;

// Holds from `time` on, or no longer. Times do not fall; no change has no effect.
BIKE_API void bike_spells_set(bike_spells *spells, bool on, double time);

// What a ride asked of the ground under one wheel. Largest values are those of the instants that
// were looked at: a wheel that lifts asks friction without bound just before.
typedef struct bike_wheel_ground {
  int looks;            //   instants looked at
  double friction;      //   largest while the ground pressed; INFINITY where the wheel lifted
  double friction_time; // s when; where the wheel lifted: when it first did
  double normal;        // N least normal force
  double normal_time;   // s when
  bike_spells lifted;   //   the normal force is not positive
  bike_spells no_grip;  //   bike_grip is not positive: it slides or has lifted
} bike_wheel_ground;

// Looks at an instant. Zero the wheel's before the first; times do not fall.
BIKE_API void bike_ground_look(bike_wheel_ground *wheel, double time, const double force[3]);

// Closes what still lasts at the end of a ride.
BIKE_API void bike_ground_end(bike_wheel_ground *wheel, double time);

#endif
