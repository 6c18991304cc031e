// SPDX-License-Identifier: Apache-2.0
// What the files of bicycle_import share; not for users.
#ifndef BICYCLE_IMPORT_INTERNAL_H
#define BICYCLE_IMPORT_INTERNAL_H

#include "bicycle_import.h"

// A model being looked at. An assembly is a body with joints and all that is rigid to it, named by
// that body's id; 0 is the world.
typedef struct import_view {
  const mjModel *m;
  mjData *d;     // kinematics at qpos0
  int *assembly; // of each body
  import_map map;
  bike_geometry geometry;
  bike_upright upright;
} import_view;

// What the numbers of a model may be off from a plane or a direction and still be meant so: m and
// pure numbers. People type six digits.
#define IMPORT_TOLERANCE 1e-6

// Steps, in this order. False with a text.
bool import_find_joints(import_view *v, mjcf_error *error); // topology
bool import_find_wheels(import_view *v, mjcf_error *error); // hubs and radii
bool import_find_geometry(import_view *v,
                          mjcf_error *error); // plane, axes, the five lengths, signs
bool import_lump(bike_bicycle *out, const import_view *v, mjcf_error *error);

// World axes at qpos0 of a joint, and a point of it.
const double *import_axis(const import_view *v, int joint);
const double *import_anchor(const import_view *v, int joint);

// Mass, centre (world, m) and inertia tensor about it (world axes, row-major) of an assembly.
double import_mass(double centre[3], double tensor[9], const import_view *v, int assembly);

// Whether a radius that no marker gives can be that of the wheel's tyre, from the wheel's shape and
// inertia; and, of both wheels, from the height of their hubs.
bool import_check_tyre(const import_view *v, int wheel, mjcf_error *error);
bool import_check_heights(const import_view *v, mjcf_error *error);

// Hub of a wheel in the world at qpos0.
void import_hub(double out[3], const import_view *v, int wheel);

#endif
