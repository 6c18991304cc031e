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

// Where a radius is from: the marker of rolling discs, the wheel's tyre (its largest round geom),
// or the height of its hub above the ground.
typedef enum import_source { IMPORT_MARKER, IMPORT_GEOM, IMPORT_HEIGHT } import_source;

// Where in an mjModel the bicycle is.
typedef struct import_map {
  int steer;               // joint id
  int spin[IMPORT_WHEELS]; // joint ids
  // 1, or -1 for a joint whose angle grows against this project's: steering right, rolling
  // backward.
  int steer_sign, spin_sign[IMPORT_WHEELS];
  int top;                             // body id of the lowest body that carries all
  int half[IMPORT_WHEELS];             // body ids of what carries each wheel; one of them is `top`
  int wheel[IMPORT_WHEELS];            // body ids
  double hub[IMPORT_WHEELS][3];        // m  in the axes of the wheel's body
  double radius[IMPORT_WHEELS];        // m
  import_source source[IMPORT_WHEELS]; // of the radius
  int geom[IMPORT_WHEELS];             // its id, where it is from a geom
  double clearance[IMPORT_WHEELS];     // m  of each wheel above the ground at qpos 0
  double travel[3];                    // the direction of travel in the world at qpos 0
  double forward[3], left[3], up[3];   // of the bicycle, in the axes of half[IMPORT_REAR]
} import_map;

// Whether nothing acts on the bicycle but what the equations have: gravity along -z, a damper on
// the steer, inputs (bicycle_import_physics.c says what else there may be). `steer` and `spin`:
// joint ids of steer and wheels.
bool import_check_physics(const mjModel *model, int steer, const int spin[IMPORT_WHEELS],
                          mjcf_error *error);

// The limited joints and tendons, "joint 'steer' at -0.6 and 0.6 rad, ..."; false where there are
// none. They are outside the equations too, but most rides do not reach them.
bool import_stops(char *out, size_t size, const mjModel *model);

// Finds the bicycle in a model; false with a text that says what was looked for and what was found.
// `map` may be NULL.
bool import_bicycle(bike_bicycle *out, import_map *map, const mjModel *model, mjcf_error *error);

// The name of a joint, a body or anything else, quoted, or "number 3".
const char *import_name(char out[64], const char *name, int number);
const char *import_joint_name(char out[64], const mjModel *m, int joint);
const char *import_body_name(char out[64], const mjModel *m, int body);

// Loads a model (.xml, .mjb) and makes sure that its wheels are marked to roll (plugin/rolling.h):
// where it has no such marker, one is added in memory, and its contacts are switched off. An .mjb
// must bring its own.
mjModel *import_load_rolling(const char *path, mjcf_error *error);

#endif
