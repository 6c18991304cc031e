// SPDX-License-Identifier: Apache-2.0
#include "turn_pick.h"

#include <bicycle/error.h>
#include <math.h>
#include <stdlib.h>

// Nearer to upright riding: by the lean, where that is given by the steer.
static bool is_nearer(const bike_turn *a, const bike_turn *b) {
  if (fabs(a->lean) != fabs(b->lean)) return fabs(a->lean) < fabs(b->lean);
  return fabs(a->steer) < fabs(b->steer);
}

int turn_pick(bike_turn *out, const bike_model *model, const bike_turn_def *def) {
  bike_turns *found = calloc(1, sizeof *found); // large for a stack
  if (!found) return BIKE_ERROR_MEMORY;
  int error = bike_turns_find(found, model, def);
  if (error == BIKE_OK && found->count == 0) error = BIKE_ERROR_NOT_STATIONARY;
  if (error == BIKE_OK) *out = found->turns[0];
  for (int i = 1; error == BIKE_OK && i < found->count; i++) {
    const bike_turn *turn = &found->turns[i];
    if (turn->main_family == out->main_family && is_nearer(turn, out)) *out = *turn;
  }
  free(found);
  return error;
}
