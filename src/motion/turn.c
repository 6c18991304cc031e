// SPDX-License-Identifier: Apache-2.0
// The interface to stationary motions: what may be asked, and the order of the answers.
#include <bicycle/error.h>
#include <bicycle/turn.h>
#include <math.h>
#include <stdlib.h>

#include "motion/turn_search.h"
#include "motion/turn_solution.h"
#include "motion/turn_units.h"

static const double DEGREE = 3.14159265358979323846 / 180;

bike_turn_def bike_default_turn_def(void) {
  return (bike_turn_def){
      .lean_limit = 80 * DEGREE,   // as of a ride: lying flat, where 1/cos(lean) ends all
      .steer_limit = 130 * DEGREE, // the geometry of bicycles ends between 30 and 115 deg
      .offset_limit = 0,           // by the bicycle's size
      .speed_limit = 0,
  };
}

bike_turn_def bike_turn_limits(const bike_turn_def *def, const bike_model *model) {
  turn_units units = turn_units_of(model);
  bike_turn_def similar = turn_units_def(def, units), out = *def;
  if (out.offset_limit == 0) out.offset_limit = similar.offset_limit * units.length;
  if (out.speed_limit == 0) out.speed_limit = similar.speed_limit * units.length / units.time;
  return out;
}

const char *bike_turn_variable_string(bike_turn_variable variable) {
  static const char *const names[BIKE_TURN_VARIABLES] = {"speed", "lean", "steer", "rider_offset"};
  return variable < BIKE_TURN_VARIABLES ? names[variable] : "unknown";
}

static int given_count(const bike_turn_def *def) {
  int count = 0;
  for (int v = 0; v < BIKE_TURN_VARIABLES; v++) count += def->given[v];
  return count;
}

static bool limits_ok(const bike_turn_def *def) {
  const double right = 90 * DEGREE;
  return def->lean_limit > 0 && def->lean_limit < right && def->steer_limit > 0 &&
         def->steer_limit < 2 * right && def->offset_limit >= 0 && isfinite(def->offset_limit) &&
         def->speed_limit >= 0 && isfinite(def->speed_limit);
}

static int check(const bike_model *model, const bike_turn_def *def) {
  const bool *given = def->given;
  for (int v = 0; v < BIKE_TURN_VARIABLES; v++)
    if (given[v] && !isfinite(def->value[v])) return BIKE_ERROR_NOT_FINITE;
  if (!isfinite(def->steer_torque)) return BIKE_ERROR_NOT_FINITE;
  int count = given_count(def);
  bool place = given[BIKE_TURN_LEAN] || given[BIKE_TURN_STEER];
  if (!limits_ok(def) || count < 1 || count > 2 || (count == 1 && place))
    return BIKE_ERROR_ARGUMENT;
  if (given[BIKE_TURN_SPEED] && def->value[BIKE_TURN_SPEED] < 0) return BIKE_ERROR_ARGUMENT;
  // without a rider the offset is zero, and has to be given as such
  bool zero = given[BIKE_TURN_OFFSET] && def->value[BIKE_TURN_OFFSET] == 0;
  return model->rider_mass > 0 || zero ? BIKE_OK : BIKE_ERROR_NO_RIDER;
}

static int main_then_rising(const void *a, const void *b) {
  const bike_turn *x = a, *y = b;
  if (x->main_family != y->main_family) return x->main_family ? -1 : 1;
  if (x->lean != y->lean) return x->lean < y->lean ? -1 : 1;
  return (x->steer > y->steer) - (x->steer < y->steer);
}

// A question about a bicycle, both as the units of its size tell them.
typedef struct similar {
  turn_units units;
  bike_model model;
  bike_turn_def def;
  turn_bicycle bicycle;
} similar;

static int ask(similar *out, const bike_model *model, const bike_turn_def *def) {
  int code = check(model, def);
  if (code) return code;
  out->units = turn_units_of(model);
  out->model = turn_units_model(model, out->units);
  out->def = turn_units_def(def, out->units);
  return turn_bicycle_init(&out->bicycle, &out->model, out->def.steer_torque);
}

static double in_seconds(double residual, turn_units units) {
  return residual / (units.time * units.time);
}

static void answer(bike_turn *turns, int count, turn_units units) {
  for (int i = 0; i < count; i++) turns[i] = turn_units_out(&turns[i], units);
  qsort(turns, (size_t)count, sizeof turns[0], main_then_rising);
}

int bike_turns_find(bike_turns *out, const bike_model *model, const bike_turn_def *def) {
  if (!out || !model || !def) return BIKE_ERROR_ARGUMENT;
  *out = (bike_turns){0};
  similar s;
  int code = ask(&s, model, def);
  if (code) return code;
  bool place = def->given[BIKE_TURN_LEAN] && def->given[BIKE_TURN_STEER];
  code = place ? turn_search_place(out, &s.bicycle, &s.def) : turn_search(out, &s.bicycle, &s.def);
  out->residual = in_seconds(out->residual, s.units);
  if (code) return code;
  answer(out->turns, out->count, s.units);
  answer(out->marks, out->mark_count, s.units);
  return BIKE_OK;
}

// What is given, and the neighbour's values of the rest.
static turn_place guess_from(const bike_turn *from, const similar *s) {
  const bool *given = s->def.given;
  const double *value = s->def.value;
  double speed = given[BIKE_TURN_SPEED] ? value[BIKE_TURN_SPEED] : from->speed;
  return (turn_place){.lean = given[BIKE_TURN_LEAN] ? value[BIKE_TURN_LEAN] : from->lean,
                      .steer = given[BIKE_TURN_STEER] ? value[BIKE_TURN_STEER] : from->steer,
                      .square = speed * speed / s->model.gravity,
                      .offset =
                          given[BIKE_TURN_OFFSET] ? value[BIKE_TURN_OFFSET] : from->rider_offset};
}

static int polish_near(bike_turn *out, similar *s, const bike_turn *from) {
  const double reach = 0.5; // rad, units of length: farther off is no neighbour
  turn_place at = guess_from(from, s);
  newton *solver = newton_create(2);
  if (!solver) return BIKE_ERROR_MEMORY;
  turn_place_polish(&at, &out->residual, &s->bicycle, solver, s->def.given, reach);
  newton_free(solver);
  if (!(at.square >= 0)) return BIKE_ERROR_NO_CONVERGENCE;
  return turn_describe(out, &s->bicycle, &at);
}

int bike_turn_near(bike_turn *out, const bike_model *model, const bike_turn_def *def,
                   const bike_turn *from) {
  if (!out || !model || !def || !from || given_count(def) != 2) return BIKE_ERROR_ARGUMENT;
  similar s;
  int code = ask(&s, model, def);
  if (code) return code;
  bike_turn start = turn_units_in(from, s.units), turn = {0};
  code = polish_near(&turn, &s, &start);
  if (code == BIKE_ERROR_NO_CONVERGENCE) out->residual = in_seconds(turn.residual, s.units);
  if (code) return code;
  *out = turn_units_out(&turn, s.units);
  out->main_family = from->main_family;
  return BIKE_OK;
}
