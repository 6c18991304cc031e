// SPDX-License-Identifier: Apache-2.0
// Anybody's MuJoCo model of a bicycle, and the bike_bicycle it is.
//
// Looked for are two wheels (bodies with one hinge and nothing that moves on them), a steering
// hinge between what carries the one and what carries the other, and a root with six freedoms
// (a free joint, or slides and hinges, in one body or in several without mass). Names, axes, signs
// and frames of bodies do not matter, nor which half carries the other: the front wheel is the one
// nearer to the steering axis. At qpos 0 the bicycle is unsteered; it need not stand on the ground.
//
// Bodies that are rigid to each other are lumped. The masses may lie beside the plane of the
// wheels; the hubs and the steering axis may not.
#ifndef BICYCLE_IMPORT_H
#define BICYCLE_IMPORT_H

#include "bicycle_mjcf.h"

enum { IMPORT_REAR, IMPORT_FRONT, IMPORT_WHEELS };

// Where in an mjModel the bicycle is.
typedef struct import_map {
  int steer;               // joint id
  int spin[IMPORT_WHEELS]; // joint ids
  // 1, or -1 for a joint whose angle grows against this project's: steering right, rolling
  // backward.
  int steer_sign, spin_sign[IMPORT_WHEELS];
  int top;                           // body id of the lowest body that carries all
  int half[IMPORT_WHEELS];           // body ids of what carries each wheel; one of them is `top`
  int wheel[IMPORT_WHEELS];          // body ids
  double hub[IMPORT_WHEELS][3];      // m  in the axes of the wheel's body
  double radius[IMPORT_WHEELS];      // m
  double forward[3], left[3], up[3]; // of the bicycle, in the axes of half[IMPORT_REAR]
} import_map;

// Finds the bicycle in a model; false with a text that says what was looked for and what was found.
// `map` may be NULL.
bool import_bicycle(bike_bicycle *out, import_map *map, const mjModel *model, mjcf_error *error);

// Loads a model (.xml, .mjb) and makes sure that its wheels are marked to roll (plugin/rolling.h):
// where it has no such marker, one is added in memory, and its contacts are switched off. An .mjb
// must bring its own.
mjModel *import_load_rolling(const char *path, mjcf_error *error);

#endif
