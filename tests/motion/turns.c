// SPDX-License-Identifier: Apache-2.0
#include "motion/turns.h"
#include "support/near.h"
#include <bicycle/error.h>

bike_turn_def turn_def(bike_turn_variable a, double a_value, bike_turn_variable b, double b_value) {
  bike_turn_def def = bike_default_turn_def();
  def.given[a] = def.given[b] = true;
  def.value[a] = a_value;
  def.value[b] = b_value;
  return def;
}

const bike_turns *turns_of(const bike_model *model, const bike_turn_def *def) {
  static bike_turns answers[TURN_ANSWERS];
  static int next = 0;
  bike_turns *out = &answers[next++ % TURN_ANSWERS];
  int code = bike_turns_find(out, model, def);
  if (code) fail_msg("%s (%g left)", bike_error_string(code), out->residual);
  return out;
}

int main_family_count(const bike_turns *found) {
  int count = 0;
  for (int i = 0; i < found->count; i++) {
    if (found->turns[i].main_family) assert_int_equal(i, count); // they come first
    count += found->turns[i].main_family;
  }
  return count;
}

bike_turn main_mark(const bike_turns *found, bike_turn_mark mark, bike_turn_variable fold) {
  bool is_fold = mark == BIKE_TURN_LARGEST || mark == BIKE_TURN_SMALLEST;
  for (int i = 0; i < found->mark_count; i++) {
    const bike_turn *m = &found->marks[i];
    bool right = m->main_family && m->mark == mark && (!is_fold || m->fold == fold);
    if (right && m->lean >= -1e-9) return *m;
  }
  fail_msg("no mark %d of %s", (int)mark, bike_turn_variable_string(fold));
  return (bike_turn){0};
}
