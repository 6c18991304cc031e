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
  bool apart; // the model without its scene: classes and sensors of its own, no ground, no light
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

// Anybody's text within an attribute.
void mjcf_put_escaped(FILE *out, const char *text);

// Ends a memory stream that was opened on *text: the text, or NULL where it is not whole.
char *mjcf_end_text(FILE *out, char **text, mjcf_error *error);

// What is only looked at: colours with and without those of the scene; lights, sky and cameras; the
// geoms of one body.
void mjcf_put_assets(FILE *out);
void mjcf_put_materials(FILE *out);
void mjcf_put_scene_assets(FILE *out);
void mjcf_put_scenery(FILE *out);
void mjcf_put_cameras(FILE *out);
void mjcf_put_shape(FILE *out, const mjcf_plan *plan, int body);

// Asks MuJoCo's compiler for the model `path`: a file, or where `vfs` is not NULL a name in that.
// Threads wait for each other. NULL with a text in one line.
mjModel *mjcf_call_compiler(const char *path, mjVFS *vfs, mjcf_error *error);

// The plane z = 0.
void mjcf_put_ground(FILE *out, bool visible);

// Attributes of a geom that touches the ground.
void mjcf_put_contact(FILE *out, const mjcf_options *options);

// What a model apart from its scene has more (bicycle_mjcf_apart.c).
void mjcf_put_classes(FILE *out, const mjcf_plan *plan);
void mjcf_put_hub_site(FILE *out, const mjcf_plan *plan);
void mjcf_put_tendon(FILE *out, const mjcf_plan *plan);
void mjcf_put_sensors(FILE *out, const mjcf_plan *plan);

#endif
