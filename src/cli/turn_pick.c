// SPDX-License-Identifier: Apache-2.0
#include "turn_pick.h"

#include <bicycle/error.h>
#include <math.h>
#include <stdlib.h>

int turn_pick(bike_turn *out, const bike_model *model, const bike_turn_def *def) {
  bike_turns *found = calloc(1, sizeof *found); // large for a stack
  if (!found) return BIKE_ERROR_MEMORY;
  int error = bike_turns_find(found, model, def);
  if (error == BIKE_OK && found->count == 0) error = BIKE_ERROR_NOT_STATIONARY;
  if (error == BIKE_OK) *out = found->turns[0];
  for (int i = 1; error == BIKE_OK && i < found->count; i++) {
    const bike_turn *turn = &found->turns[i];
    if (turn->main_family == out->main_family && fabs(turn->lean) < fabs(out->lean)) *out = *turn;
  }
  free(found);
  return error;
}
