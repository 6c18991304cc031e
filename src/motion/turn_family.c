// SPDX-License-Identifier: Apache-2.0
#include "motion/turn_family.h"

#include <bicycle/error.h>
#include <math.h>

static bool changes(double a, double b) {
  return (a < 0) != (b < 0);
}

// A branch of constant speed goes through zero steer only where it rides straight on; one of
// constant offset also where its speed is infinite, but only straight riding turns both signs.
static bool meets_straight(const turn_branch *branch, bool at_speed) {
  for (size_t i = 1; i < branch->count; i++) {
    const double *a = branch->at[i - 1].y, *b = branch->at[i].y;
    if (changes(a[Y_STEER], b[Y_STEER]) && (at_speed || changes(a[Y_LAST], b[Y_LAST]))) return true;
  }
  return false;
}

static bool has_rider(const turn_curve *curve) {
  return curve->bicycle->model->rider_mass > 0;
}

turn_family turn_family_of(const turn_branch *branch, const turn_curve *curve, bool nearest) {
  bool only_choice = nearest && !has_rider(curve);
  return only_choice || meets_straight(branch, curve->at_speed) ? FAMILY_MAIN : FAMILY_MIXED;
}

// Whether the branch of a curve through y meets straight riding.
static int leads_to_straight(bool *out, const turn_curve *curve, newton *solver,
                             const double y[Y_SIZE]) {
  turn_point start;
  double residual;
  *out = false;
  if (turn_branch_land(&start, &residual, curve, solver, y)) return BIKE_OK;
  turn_branch branch;
  int code = turn_branch_trace(&branch, curve, solver, &start);
  *out = !code && meets_straight(&branch, curve->at_speed);
  turn_branch_free(&branch);
  return code;
}

int turn_in_main_family(bool *out, const turn_curve *curve, newton *solver, turn_family family,
                        const bike_turn *turn) {
  *out = family == FAMILY_MAIN;
  if (*out || !has_rider(curve)) return BIKE_OK;
  turn_curve own = *curve;
  own.square = turn->speed * turn->speed;
  own.offset = turn->rider_offset;
  if (!curve->at_speed) {
    own.at_speed = true;
    const double y[Y_SIZE] = {turn->lean, turn->steer, turn->rider_offset};
    int code = leads_to_straight(out, &own, solver, y);
    if (code || *out) return code;
  }
  if (!(curve->at_speed && turn->rider_offset == 0)) return BIKE_OK;
  own.at_speed = false;
  double z = own.square * sin(turn->steer) / curve->bicycle->model->gravity;
  const double y[Y_SIZE] = {turn->lean, turn->steer, z};
  return leads_to_straight(out, &own, solver, y);
}
