// SPDX-License-Identifier: Apache-2.0
// From the list of parts to four rigid bodies, in MuJoCo's axes.
#include "bicycle_mjcf_internal.h"

#include <bicycle/error.h>
#include <math.h>
#include <stdarg.h>

mjcf_options mjcf_default_options(void) {
  return (mjcf_options){.root = MJCF_ROOT_HINGE,
                        .rolling = MJCF_ROLLING_EXACT,
                        .integrator = MJCF_RK4,
                        .timestep = 1e-3,
                        .visible = true};
}

bool mjcf_fail(mjcf_error *error, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(error->text, sizeof error->text, format, arguments);
  va_end(arguments);
  error->no_memory = false;
  return false;
}

bool mjcf_fail_memory(mjcf_error *error) {
  mjcf_fail(error, "%s", bike_error_string(BIKE_ERROR_MEMORY));
  error->no_memory = true;
  return false;
}

static bool check_bicycle(const bike_bicycle *bicycle, mjcf_error *error) {
  int part = -1;
  const char *what = NULL;
  int code = bike_check(bicycle, &part, &what);
  if (code == BIKE_OK) return true;
  const char *text = what ? what : bike_error_string(code);
  if (part < 0) return mjcf_fail(error, "%s", text);
  return mjcf_fail(error, "part '%s': %s", bicycle->parts[part].name, text);
}

static bool check_options(const bike_bicycle *bicycle, const mjcf_options *options,
                          mjcf_error *error) {
  if (!(options->timestep > 0 && options->timestep <= 1))
    return mjcf_fail(error, "the timestep must be positive and at most 1 s");
  if (!(options->contact_time >= 0 && options->contact_time <= 1))
    return mjcf_fail(error, "the time constant of contacts must not be negative, and at most 1 s");
  if (!isfinite(options->rider_offset))
    return mjcf_fail(error, "the rider offset is not a finite number");
  // MuJoCo solves its contacts after the drive: the rider's work would not be exact.
  if (options->moving_rider && options->rolling != MJCF_ROLLING_EXACT)
    return mjcf_fail(error, "a moving rider needs exact rolling");
  if (options->rider_offset == 0 && !options->moving_rider) return true;
  for (int i = 0; i < bicycle->part_count; i++)
    if (bicycle->parts[i].rider) return true;
  return mjcf_fail(error, "%s", bike_error_string(BIKE_ERROR_NO_RIDER));
}

// Body frames: hubs, and for the front frame the foot of the perpendicular on the steering axis,
// which lies L_r e_p - L_s e_S from the rear hub.
static void place_bodies(mjcf_plan *plan) {
  static const char *const names[MJCF_BODIES] = {"rear_frame", "rear_wheel", "front_frame",
                                                 "front_wheel", "rider"};
  const bike_geometry *g = &plan->bicycle->geometry;
  const double *e_p = plan->across, *e_S = plan->axis;
  for (int i = 0; i < MJCF_BODIES; i++) plan->body[i].name = names[i];
  for (int k = 0; k < 3; k++) {
    double hub = k == 2 ? g->R_r : 0;
    double foot = hub + g->L_r * e_p[k] - g->L_s * e_S[k];
    plan->body[BIKE_REAR_FRAME].origin[k] = plan->body[BIKE_REAR_WHEEL].origin[k] = hub;
    plan->body[MJCF_RIDER].origin[k] = hub;
    plan->body[BIKE_FRONT_FRAME].origin[k] = foot;
    plan->body[BIKE_FRONT_WHEEL].origin[k] = foot + g->L_f * e_p[k];
  }
}

// Centre of mass of a part from its body's origin, the rider displaced to the right.
static void part_centre(double out[3], const mjcf_plan *plan, const bike_part *part) {
  // A wheel's place is its hub, which the body's origin is: no rounding may tilt the wheel.
  bool wheel = part->assembly == BIKE_REAR_WHEEL || part->assembly == BIKE_FRONT_WHEEL;
  for (int k = 0; k < 3; k++)
    out[k] = wheel ? 0 : part->position[k] - plan->body[part->assembly].origin[k];
  if (part->rider) out[1] -= plan->options->rider_offset;
}

// I += m (r.r 1 - r r^T)
static void add_point_mass(double inertia[6], double mass, const double r[3]) {
  inertia[0] += mass * (r[1] * r[1] + r[2] * r[2]);
  inertia[1] += mass * (r[0] * r[0] + r[2] * r[2]);
  inertia[2] += mass * (r[0] * r[0] + r[1] * r[1]);
  inertia[3] -= mass * r[0] * r[1];
  inertia[4] -= mass * r[0] * r[2];
  inertia[5] -= mass * r[1] * r[2];
}

static mjcf_body *body_of(mjcf_plan *plan, const bike_part *part) {
  bool apart = part->rider && plan->options->moving_rider;
  return &plan->body[apart ? (int)MJCF_RIDER : (int)part->assembly];
}

static void lump(mjcf_plan *plan) {
  const bike_bicycle *b = plan->bicycle;
  for (int i = 0; i < b->part_count; i++) {
    mjcf_body *body = body_of(plan, &b->parts[i]);
    double centre[3];
    part_centre(centre, plan, &b->parts[i]);
    body->mass += b->parts[i].mass;
    for (int k = 0; k < 3; k++) body->centre[k] += b->parts[i].mass * centre[k];
  }
  for (int i = 0; i < MJCF_BODIES; i++)
    for (int k = 0; k < 3 && plan->body[i].mass > 0; k++)
      plan->body[i].centre[k] /= plan->body[i].mass;
  for (int i = 0; i < b->part_count; i++) {
    mjcf_body *body = body_of(plan, &b->parts[i]);
    double arm[3];
    part_centre(arm, plan, &b->parts[i]);
    for (int k = 0; k < 3; k++) arm[k] -= body->centre[k];
    for (int k = 0; k < 6; k++) body->inertia[k] += b->parts[i].inertia[k];
    add_point_mass(body->inertia, b->parts[i].mass, arm);
  }
}

static bool make_compilable(mjcf_plan *plan, mjcf_error *error) {
  // A frame without parts still is a body: its mass is below the last digit of any bicycle's.
  static const double no_mass = 1e-14;
  for (int i = 0; i < plan->bodies; i++) {
    mjcf_body *body = &plan->body[i];
    bool wheel = i == BIKE_REAR_WHEEL || i == BIKE_FRONT_WHEEL;
    if (wheel && !(body->inertia[1] > 0))
      return mjcf_fail(error, "MuJoCo cannot hold a wheel without inertia about its axle (%s)",
                       body->name);
    if (body->mass == 0) body->mass = no_mass;
    mjcf_principal(body->principal, body->quat, body->inertia);
    body->placeholder = mjcf_make_legal(body->principal);
  }
  return true;
}

bool mjcf_plan_init(mjcf_plan *plan, const bike_bicycle *bicycle, const mjcf_options *options,
                    mjcf_error *error) {
  *plan = (mjcf_plan){.bicycle = bicycle, .options = options};
  plan->bodies = options->moving_rider ? MJCF_BODIES : MJCF_RIDER;
  if (!check_bicycle(bicycle, error) || !check_options(bicycle, options, error)) return false;
  int code = bike_upright_position(&plan->upright, &bicycle->geometry);
  if (code != BIKE_OK) return mjcf_fail(error, "%s", bike_error_string(code));
  double tilt = plan->upright.tilt;
  plan->axis[0] = -sin(tilt), plan->axis[2] = cos(tilt);
  plan->across[0] = cos(tilt), plan->across[2] = sin(tilt);
  place_bodies(plan);
  lump(plan);
  return make_compilable(plan, error);
}

int mjcf_placeholder_count(const bike_bicycle *bicycle, const mjcf_options *options) {
  mjcf_plan plan;
  mjcf_error error;
  if (!mjcf_plan_init(&plan, bicycle, options, &error)) return 0;
  int count = 0;
  for (int i = 0; i < plan.bodies; i++) count += plan.body[i].placeholder;
  return count;
}
