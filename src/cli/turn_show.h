// SPDX-License-Identifier: Apache-2.0
// Stationary turns as `bicycle turn` shows them.
#ifndef BICYCLE_CLI_TURN_SHOW_H
#define BICYCLE_CLI_TURN_SHOW_H

#include "terminal/command.h"
#include "terminal/outside.h"

#include <bicycle/turn.h>

typedef struct turn_answer {
  const bike_bicycle *bicycle;
  const bike_model *model;
  const bike_turn_def *def;
  const bike_turns *found;
  const term_limits *limits;
} turn_answer;

// One JSON document, or tables. False where memory is short.
bool turn_print_json(const turn_answer *answer, bike_convention convention);
bool turn_print_tables(const turn_answer *answer, bike_convention convention);

#endif
