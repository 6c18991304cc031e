// SPDX-License-Identifier: Apache-2.0
// Names of the modes of upright riding at every speed, forwards and backwards.
//
// Eigenvalues collide at isolated speeds alone, the real roots of the discriminant of the
// characteristic polynomial, of degree 12 in v. Between them real eigenvalues keep their order and
// pairs stay pairs, so that names are carried from one interval to the next by what collides.
#ifndef BICYCLE_MOTION_MODE_MAP_H
#define BICYCLE_MOTION_MODE_MAP_H

#include <bicycle/modes.h>

enum { MODE_COLLISIONS = 12 };

// What the modes between two collisions are called.
typedef struct mode_interval {
  int real_count;    // 4, 2 or 0
  bike_mode real[4]; // in falling order
  bike_mode pair[2]; // of two pairs: the one that was real beyond `entry`, and the other
  double entry;      // m/s: the collision through which names came to two pairs
  int segment;       // intervals of one number have capsize and castering from each other
} mode_interval;

typedef struct mode_map {
  int count; // collisions
  double at[MODE_COLLISIONS];
  mode_interval between[MODE_COLLISIONS + 1]; // [i] lies below at[i]
  int end_count;
  bike_name_end ends[BIKE_MAX_NAME_ENDS];
} mode_map;

// Errors of bike_upright_modes.
int mode_map_init(mode_map *out, const bike_model *model);

// Names the eigenvalues at a speed.
int mode_map_name(bike_modes *at, const mode_map *map, const bike_model *model, double speed);

#endif
