// SPDX-License-Identifier: Apache-2.0
// The interface to stationary motions: what may be asked, and the order of the answers.
#include <bicycle/error.h>
#include <bicycle/turn.h>
#include <math.h>
#include <stdlib.h>

#include "motion/turn_search.h"
#include "motion/turn_solution.h"

static const double DEGREE = 3.14159265358979323846 / 180;

bike_turn_def bike_default_turn_def(void) {
  return (bike_turn_def){
      .lean_limit = 80 * DEGREE,   // as of a ride: lying flat, where 1/cos(lean) ends all
      .steer_limit = 130 * DEGREE, // the geometry of bicycles ends between 30 and 115 deg
      .offset_limit = 1,           // no rider reaches farther
      .speed_limit = 50,           // no bicycle rides circles faster
  };
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
         def->steer_limit < 2 * right && def->offset_limit > 0 && isfinite(def->offset_limit) &&
         def->speed_limit > 0 && isfinite(def->speed_limit);
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

int bike_turns_find(bike_turns *out, const bike_model *model, const bike_turn_def *def) {
  if (!out || !model || !def) return BIKE_ERROR_ARGUMENT;
  *out = (bike_turns){0};
  turn_bicycle bicycle;
  int code = check(model, def);
  if (!code) code = turn_bicycle_init(&bicycle, model, def->steer_torque);
  if (code) return code;
  bool place = def->given[BIKE_TURN_LEAN] && def->given[BIKE_TURN_STEER];
  code = place ? turn_search_place(out, &bicycle, def) : turn_search(out, &bicycle, def);
  if (code) return code;
  qsort(out->turns, (size_t)out->count, sizeof out->turns[0], main_then_rising);
  qsort(out->marks, (size_t)out->mark_count, sizeof out->marks[0], main_then_rising);
  return BIKE_OK;
}

int bike_turn_near(bike_turn *out, const bike_model *model, const bike_turn_def *def,
                   const bike_turn *from) {
  if (!out || !model || !def || !from || given_count(def) != 2) return BIKE_ERROR_ARGUMENT;
  turn_bicycle bicycle;
  int code = check(model, def);
  if (!code) code = turn_bicycle_init(&bicycle, model, def->steer_torque);
  if (code) return code;
  const bool *given = def->given;
  const double *value = def->value, reach = 0.5; // rad, m: farther off is no neighbour
  double speed = given[BIKE_TURN_SPEED] ? value[BIKE_TURN_SPEED] : from->speed;
  turn_place at = {.lean = given[BIKE_TURN_LEAN] ? value[BIKE_TURN_LEAN] : from->lean,
                   .steer = given[BIKE_TURN_STEER] ? value[BIKE_TURN_STEER] : from->steer,
                   .square = speed * speed / model->gravity,
                   .offset =
                       given[BIKE_TURN_OFFSET] ? value[BIKE_TURN_OFFSET] : from->rider_offset};
  newton *solver = newton_create(2);
  if (!solver) return BIKE_ERROR_MEMORY;
  turn_place_polish(&at, &out->residual, &bicycle, solver, given, reach);
  newton_free(solver);
  if (!(at.square >= 0)) return BIKE_ERROR_NO_CONVERGENCE;
  bike_turn turn = {0};
  code = turn_describe(&turn, &bicycle, &at);
  if (code == BIKE_ERROR_NO_CONVERGENCE) out->residual = turn.residual;
  if (code) return code;
  turn.main_family = from->main_family;
  *out = turn;
  return BIKE_OK;
}
