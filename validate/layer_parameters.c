// SPDX-License-Identifier: Apache-2.0
// Lp: the parameters that an engine's own model holds, read back, against the bicycle's.
//
// The bicycle's parts are lumped here into one rigid body for each assembly, independently of what
// the engines do.
#include "layer.h"

#include <bicycle/error.h>
#include <math.h>
#include <stdio.h>

static const char *const assembly_names[4] = {"rear_frame", "rear_wheel", "front_frame",
                                              "front_wheel"};
static const char *const body_quantities[10] = {"mass", "x",   "y",   "z",   "Ixx",
                                                "Iyy",  "Izz", "Ixy", "Ixz", "Iyz"};
static const char *const other_names[8] = {
    "wheelbase",    "trail",   "head_angle",    "rear_radius",
    "front_radius", "gravity", "steer_damping", NULL};

// A rigid body: mass, centre (forward, left, up) from the rear contact, tensor about the centre.
typedef struct rigid {
  double mass, centre[3], inertia[6];
} rigid;

static rigid lump(const bike_bicycle *b, int assembly) {
  rigid r = {0};
  for (int i = 0; i < b->part_count; i++) {
    const bike_part *part = &b->parts[i];
    if ((int)part->assembly != assembly) continue;
    r.mass += part->mass;
    for (int k = 0; k < 3; k++) r.centre[k] += part->mass * part->position[k];
  }
  for (int k = 0; k < 3 && r.mass > 0; k++) r.centre[k] /= r.mass;
  for (int i = 0; i < b->part_count; i++) {
    const bike_part *part = &b->parts[i];
    if ((int)part->assembly != assembly) continue;
    double d[3];
    for (int k = 0; k < 3; k++) d[k] = part->position[k] - r.centre[k];
    // Steiner: I + m (d.d 1 - d d^T)
    const double shift[6] = {d[1] * d[1] + d[2] * d[2],
                             d[0] * d[0] + d[2] * d[2],
                             d[0] * d[0] + d[1] * d[1],
                             -d[0] * d[1],
                             -d[0] * d[2],
                             -d[1] * d[2]};
    for (int k = 0; k < 6; k++) r.inertia[k] += part->inertia[k] + part->mass * shift[k];
  }
  return r;
}

// A quantity of the file (`is`) and what the engine has instead, with the size to which an error
// is compared and the unit of all three.
static void compare(comparison *c, const comparison_side *side, const char *signal, double is,
                    double has, double scale, const char *unit) {
  measurement m = measurement_of(layer_parameters.name, signal, "relative", "");
  snprintf(m.source, sizeof m.source, "%s", side->label);
  m.value = is == has ? 0 : fabs(has - is) / scale;
  measurement_detail(&m, "%.12g against %.12g%s%s", has, is, *unit ? " " : "", unit);
  measurement_add(&c->measurements, &m);
}

static void compare_bodies(comparison *c, const comparison_side *side, const bike_bicycle *has,
                           double wheelbase) {
  for (int a = 0; a < 4; a++) {
    rigid want = lump(&c->scenario->bicycle, a), got = lump(has, a);
    double want_values[10] = {want.mass}, got_values[10] = {got.mass};
    for (int k = 0; k < 3; k++) want_values[1 + k] = want.centre[k];
    for (int k = 0; k < 3; k++) got_values[1 + k] = got.centre[k];
    for (int k = 0; k < 6; k++) want_values[4 + k] = want.inertia[k];
    for (int k = 0; k < 6; k++) got_values[4 + k] = got.inertia[k];
    // A tensor's entries err by its largest; below that of a point of that mass 1 cm away no
    // difference shows in a ride.
    double sum = want.inertia[0] + want.inertia[1] + want.inertia[2];
    double tensor = fmax(sum, 1e-4 * want.mass);
    for (int q = 0; q < 10; q++) {
      char signal[MEASUREMENT_NAME];
      double scale = q == 0 ? c->scenario->model.total_mass : q < 4 ? wheelbase : tensor;
      // The place of a body without mass means nothing.
      if (want.mass == 0 && q > 0) break;
      snprintf(signal, sizeof signal, "%s_%s", assembly_names[a], body_quantities[q]);
      compare(c, side, signal, want_values[q], got_values[q], scale,
              q == 0  ? "kg"
              : q < 4 ? "m"
                      : "kg m^2");
    }
  }
}

static void compare_geometry(comparison *c, const comparison_side *side, const bike_bicycle *has,
                             const bike_upright *want, const bike_upright *got) {
  const bike_bicycle *b = &c->scenario->bicycle;
  double wheelbase = want->wheelbase;
  const double right = 1.57079632679489661923;
  compare(c, side, "wheelbase", want->wheelbase, got->wheelbase, wheelbase, "m");
  compare(c, side, "trail", want->trail, got->trail, wheelbase, "m");
  compare(c, side, "head_angle", right - want->tilt, right - got->tilt, 1, "rad");
  compare(c, side, "rear_radius", b->geometry.R_r, has->geometry.R_r, b->geometry.R_r, "m");
  compare(c, side, "front_radius", b->geometry.R_f, has->geometry.R_f, b->geometry.R_f, "m");
  compare(c, side, "gravity", b->gravity, has->gravity, b->gravity, "m/s^2");
  compare(c, side, "steer_damping", b->steer_damping, has->steer_damping, fmax(b->steer_damping, 1),
          "N m s/rad");
}

static term_exit measure_side(comparison *c, const comparison_side *side, problem *p) {
  bike_bicycle has;
  bike_upright want, got = {0};
  if (!side->engine->parameters) return TERM_DONE; // it uses the bicycle's numbers as they are
  term_exit code = side->engine->parameters(&has, side->instance, p);
  if (code != TERM_DONE) return problem_prefix(p, code, side->label);
  int error = bike_upright_position(&want, &c->scenario->bicycle.geometry);
  if (error == BIKE_OK) error = bike_upright_position(&got, &has.geometry);
  if (error != BIKE_OK)
    return problem_set(p, TERM_INVALID, "%s: the model read back: %s", side->label,
                       bike_error_string(error));
  compare_geometry(c, side, &has, &want, &got);
  compare_bodies(c, side, &has, want.wheelbase);
  return TERM_DONE;
}

static term_exit measure(comparison *c, problem *p) {
  term_exit code = TERM_DONE;
  for (int i = 0; i < 2 && code == TERM_DONE; i++) code = measure_side(c, &c->side[i], p);
  return code;
}

static bool names_body_quantity(const char *signal) {
  for (int a = 0; a < 4; a++)
    for (int q = 0; q < 10; q++) {
      char name[MEASUREMENT_NAME];
      snprintf(name, sizeof name, "%s_%s", assembly_names[a], body_quantities[q]);
      if (layer_names((const char *const[]){name, NULL}, signal)) return true;
    }
  return false;
}

static bool knows(const char *signal, const char *metric) {
  static const char *const metrics[] = {"relative", NULL};
  if (!layer_names(metrics, metric)) return false;
  return !signal || layer_names(other_names, signal) || names_body_quantity(signal);
}

const layer layer_parameters = {
    .name = "Lp",
    .title = "parameters",
    .agreed = "the parameters agree",
    .failure = "an engine's model does not hold the bicycle's parameters",
    .knows = knows,
    .measure = measure,
};
