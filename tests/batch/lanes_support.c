// SPDX-License-Identifier: Apache-2.0
#include "batch/lanes_support.h"

#include "support/near.h"
#include <bicycle/batch.h>
#include <bicycle/error.h>
#include <string.h>

int print_instructions(void **state) {
  (void)state;
  const char *asked = getenv("BICYCLE_INSTRUCTIONS"), *used = bike_instructions();
  bool given = asked && !strcmp(asked, used);
  print_message("instructions: asked %s, using %s in %d lanes%s\n", asked ? asked : "none", used,
                bike_batch_width(), !asked || given ? "" : " (this machine has none such)");
  return 0;
}

static bike_model model_of(const bike_bicycle *bicycle) {
  bike_model model;
  assert_int_equal(bike_model_init(&model, bicycle), BIKE_OK);
  return model;
}

bike_model named_model(const char *name) {
  bike_bicycle bicycle = read_shipped(name);
  return model_of(&bicycle);
}

bike_model shipped_model(int which) {
  return named_model(shipped_bicycles[which].name);
}

bike_model random_model(random_source *source) {
  bike_bicycle bicycle = random_bicycle(source, false);
  return model_of(&bicycle);
}

void assert_same_bits(double a, double b, const char *what) {
  if (memcmp(&a, &b, sizeof a)) fail_msg("%s: %.17g is not %.17g", what, a, b);
}

void assert_same_result(const bike_member_result *a, const bike_member_result *b,
                        const char *what) {
  bool same = a->outcome == b->outcome && a->error == b->error && a->lifted == b->lifted &&
              a->steps == b->steps && a->evaluations == b->evaluations;
  if (!same)
    fail_msg("%s: %s, error %d, %ld steps is not %s, error %d, %ld steps", what,
             bike_outcome_string(a->outcome), a->error, a->steps, bike_outcome_string(b->outcome),
             b->error, b->steps);
  assert_same_bits(a->time, b->time, what);
  assert_same_bits(a->end.lean, b->end.lean, what);
  assert_same_bits(a->end.steer, b->end.steer, what);
  assert_same_bits(a->end.lean_rate, b->end.lean_rate, what);
  assert_same_bits(a->end.steer_rate, b->end.steer_rate, what);
  assert_same_bits(a->end.speed, b->end.speed, what);
}

void ride_members(bike_member_result *out, const bike_member *members, size_t count,
                  const bike_ensemble_def *def) {
  assert_int_equal(bike_ensemble_ride(out, members, count, def), BIKE_OK);
}
