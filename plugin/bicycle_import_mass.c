// SPDX-License-Identifier: Apache-2.0
// Masses, centres and tensors: bodies rigid to each other become one part, in (forward, left, up)
// from the rear contact.
#include "bicycle_import_internal.h"

#include <bicycle/error.h>
#include <math.h>
#include <stdio.h>

static const char *const part_names[4] = {"rear_frame", "rear_wheel", "front_frame", "front_wheel"};

typedef struct axes {
  double rows[9]; // forward, left, up in the world
  double hub[3];  // rear hub in the world
  double height;  // of that hub above the ground
} axes;

// World tensor of a body about its own centre.
static void body_tensor(double out[9], const import_view *v, int body) {
  double R[9], scaled[9];
  mju_copy(R, v->d->ximat + 9 * body, 9);
  for (int i = 0; i < 3; i++)
    for (int k = 0; k < 3; k++) scaled[3 * i + k] = R[3 * i + k] * v->m->body_inertia[3 * body + k];
  mju_mulMatMatT(out, scaled, R, 3, 3, 3);
}

// T += m (r.r 1 - r r^T)
static void add_steiner(double tensor[9], double mass, const double r[3]) {
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      tensor[3 * i + j] += mass * ((i == j ? mju_dot3(r, r) : 0) - r[i] * r[j]);
}

double import_mass(double centre[3], double tensor[9], const import_view *v, int assembly) {
  double mass = 0, one[9], arm[3];
  mju_zero3(centre);
  mju_zero(tensor, 9);
  for (int b = 1; b < v->m->nbody; b++) {
    if (v->assembly[b] != assembly) continue;
    mass += v->m->body_mass[b];
    mju_addToScl3(centre, v->d->xipos + 3 * b, v->m->body_mass[b]);
  }
  if (mass > 0) mju_scl3(centre, centre, 1 / mass);
  for (int b = 1; b < v->m->nbody; b++) {
    if (v->assembly[b] != assembly) continue;
    body_tensor(one, v, b);
    mju_addTo(tensor, one, 9);
    mju_sub3(arm, v->d->xipos + 3 * b, centre);
    add_steiner(tensor, v->m->body_mass[b], arm);
  }
  return mass;
}

static void express(bike_part *part, const axes *a, const double centre[3],
                    const double tensor[9]) {
  double arm[3], half[9], T[9];
  mju_sub3(arm, centre, a->hub);
  mju_rotVecMat(part->position, arm, a->rows);
  part->position[2] += a->height;
  mju_mulMatMat(half, a->rows, tensor, 3, 3, 3);
  mju_mulMatMatT(T, half, a->rows, 3, 3, 3);
  const double packed[6] = {T[0], T[4], T[8], T[1], T[2], T[5]};
  mju_copy(part->inertia, packed, 6);
}

// A wheel's tensor is the same however it is turned; its place is the hub.
static bool make_wheel(bike_part *part, const import_view *v, int wheel, mjcf_error *error) {
  double *T = part->inertia, size = T[0] + T[1] + T[2];
  char name[64];
  double uneven = fmax(fabs(T[0] - T[2]), fmax(fabs(T[3]), fmax(fabs(T[4]), fabs(T[5]))));
  if (!(uneven <= IMPORT_TOLERANCE * size))
    return mjcf_fail(
        error,
        "not a bicycle: the inertia of wheel %s is not round about its axle (uneven by "
        "%.3g kg m^2)",
        import_body_name(name, v->m, v->map.wheel[wheel]), uneven);
  T[0] = T[2] = (T[0] + T[2]) / 2;
  T[3] = T[4] = T[5] = 0;
  const double *hub = wheel == IMPORT_REAR ? v->upright.rear_hub : v->upright.front_hub;
  if (!(fabs(part->position[1]) <= IMPORT_TOLERANCE))
    return mjcf_fail(error, "not a bicycle: the mass of wheel %s is %.3g m beside its plane",
                     import_body_name(name, v->m, v->map.wheel[wheel]), part->position[1]);
  mju_copy3(part->position, hub);
  return true;
}

// Below a share of 1e-13 a mass is only there because MuJoCo wants one.
static const double no_mass = 1e-13;

static bool add_part(bike_bicycle *out, const import_view *v, const axes *a, bike_assembly assembly,
                     mjcf_error *error) {
  bool front = assembly == BIKE_FRONT_FRAME || assembly == BIKE_FRONT_WHEEL;
  bool is_wheel = assembly == BIKE_REAR_WHEEL || assembly == BIKE_FRONT_WHEEL;
  int wheel = front ? IMPORT_FRONT : IMPORT_REAR;
  double centre[3], tensor[9];
  double mass = import_mass(centre, tensor, v, is_wheel ? v->map.wheel[wheel] : v->map.half[wheel]);
  if (!(mass > no_mass * v->m->body_subtreemass[0]) && !is_wheel) return true;
  bike_part *part = &out->parts[out->part_count++];
  *part = (bike_part){.assembly = assembly, .mass = mass};
  snprintf(part->name, sizeof part->name, "%s", part_names[assembly]);
  express(part, a, centre, tensor);
  if (!(part->position[2] >= 0))
    return mjcf_fail(error, "not a bicycle: the mass centre of %s is %.3g m below the ground",
                     part->name, -part->position[2]);
  return !is_wheel || make_wheel(part, v, wheel, error);
}

bool import_lump(bike_bicycle *out, const import_view *v, mjcf_error *error) {
  axes a;
  const double *frame = v->d->xmat + 9 * v->map.half[IMPORT_REAR];
  mju_rotVecMat(a.rows, v->map.forward, frame);
  mju_rotVecMat(a.rows + 3, v->map.left, frame);
  mju_rotVecMat(a.rows + 6, v->map.up, frame);
  import_hub(a.hub, v, IMPORT_REAR);
  a.height = v->geometry.R_r;
  *out = bike_default_bicycle();
  snprintf(out->name, sizeof out->name, "%.60s", *v->m->names ? v->m->names : "imported");
  out->geometry = v->geometry;
  out->gravity = -v->m->opt.gravity[2];
  out->steer_damping = v->m->dof_damping[v->m->jnt_dofadr[v->map.steer]];
  for (int i = 0; i < 4; i++)
    if (!add_part(out, v, &a, (bike_assembly)i, error)) return false;
  int part = -1;
  const char *what = NULL;
  int code = bike_check(out, &part, &what);
  if (code == BIKE_OK) return true;
  return mjcf_fail(error, "not a bicycle: %s%s%s", part >= 0 ? out->parts[part].name : "",
                   part >= 0 ? ": " : "", what ? what : bike_error_string(code));
}
