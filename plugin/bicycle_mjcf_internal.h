// SPDX-License-Identifier: Apache-2.0
// What the files of bicycle_mjcf, and the loader of bicycle_import, share; not for users.
#ifndef BICYCLE_MJCF_INTERNAL_H
#define BICYCLE_MJCF_INTERNAL_H

#include "bicycle_mjcf.h"

#include "runner_guard.h"

#include <stdio.h>

// Numbered as bike_assembly; the rider is a body of his own only where he moves.
enum { MJCF_RIDER = 4, MJCF_BODIES };

// One rigid body of the model: the parts of an assembly lumped. Axes (forward, left, up).
typedef struct mjcf_body {
  const char *name;    //
  double origin[3];    // m       of the body frame, upright, from the rear contact
  double mass;         // kg
  double centre[3];    // m       of mass, from the origin
  double inertia[6];   // kg m^2  Ixx, Iyy, Izz, Ixy, Ixz, Iyz about the centre of mass
  double principal[3]; // kg m^2  moments as MJCF takes them
  double quat[4];      //         the principal axes
  bool placeholder;    //         `principal` is not the tensor: MJCF refuses that
} mjcf_body;

// All that is written, computed once.
typedef struct mjcf_plan {
  const bike_bicycle *bicycle;
  const mjcf_options *options;
  bike_upright upright;
  double axis[3];   // unit, upwards along the steering axis (e_S)
  double across[3]; // unit, forwards and square to it in the plane of symmetry (e_p)
  mjcf_body body[MJCF_BODIES];
  int bodies; // without the rider, or all
} mjcf_plan;

// Checks the bicycle and the options and fills the plan, which keeps both pointers.
bool mjcf_plan_init(mjcf_plan *plan, const bike_bicycle *bicycle, const mjcf_options *options,
                    mjcf_error *error);

// Principal moments and axes of a symmetric tensor, to rounding (MuJoCo's own stop at 1e-12).
void mjcf_principal(double moments[3], double quat[4], const double inertia[6]);

// Raises the moments to the nearest that MJCF takes; false if they already were.
bool mjcf_make_legal(double moments[3]);

// ` name="a b c"` with 17 digits.
void mjcf_put(FILE *out, const char *name, const double *values, int count);

// The blanks before a line of a body, or of what stands `deeper` in it.
void mjcf_indent(FILE *out, int body, int deeper);

// What is only looked at: colours; lights and cameras; the geoms of one body.
void mjcf_put_assets(FILE *out);
void mjcf_put_scenery(FILE *out);
void mjcf_put_cameras(FILE *out);
void mjcf_put_shape(FILE *out, const mjcf_plan *plan, int body);

// Asks MuJoCo's compiler for the model `path`: a file, or where `vfs` is not NULL a name in that.
// Threads wait for each other. NULL with a text in one line.
mjModel *mjcf_call_compiler(const char *path, mjVFS *vfs, mjcf_error *error);

#endif
