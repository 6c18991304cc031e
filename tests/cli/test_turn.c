// SPDX-License-Identifier: Apache-2.0
// `bicycle turn`, and `bicycle linear` about a turn, as scripts use them.
#include "run.h"
#include "support/near.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

static const char *const keys[] = {
    "lean",         "steer",         "speed",       "rider_offset", "yaw_rate",      "radius",
    "eps_max",      "steer_torque",  "eigenvalues", "modes",        "lifted",        "rear_normal",
    "front_normal", "rear_friction", "residual",    "main_family",  "front_friction"};

static const json_t *solution(const json_t *document, size_t i) {
  const json_t *one = json_array_get(json_object_get(document, "solutions"), i);
  assert_non_null(one);
  return one;
}

static void three_fixed_points(void **unused) {
  (void)unused;
  static const double leans[] = {-28.6, 9.7, 21.3};
  json_t *turns = run_json("bicycle turn roadster --speed 5.5 --rider-offset 0.01 --json");
  assert_int_equal(json_array_size(json_object_get(turns, "solutions")), 3);
  for (size_t i = 0; i < 3; i++) {
    const json_t *one = solution(turns, i);
    for (size_t k = 0; k < sizeof keys / sizeof keys[0]; k++)
      if (!json_object_get(one, keys[k])) fail_msg("no key '%s'", keys[k]);
    assert_near(run_number(one, "lean") * 180 / M_PI, leans[i], 0.05);
    assert_near(run_number(one, "speed"), 5.5, 0);
    assert_near(fabs(run_number(one, "yaw_rate")) * run_number(one, "radius"), 5.5, 1e-12);
    assert_below(run_number(one, "residual"), 1e-11);
    assert_int_equal(json_array_size(json_object_get(one, "eigenvalues")), 4);
  }
  json_decref(turns);
}

// The recumbent's curves of 5.4 to 10.6 m/s pass turns so tight that rounding is large there.
static void fast_turns_of_the_recumbent(void **unused) {
  (void)unused;
  for (int i = 0; i < 12; i++) {
    char command[100];
    snprintf(command, sizeof command, "bicycle turn recumbent --speed %g --lean 0.1 --json",
             5 + 0.5 * i);
    json_t *turns = run_json(command);
    const json_t *one = solution(turns, 0);
    assert_near(run_number(one, "lean"), 0.1, 1e-12);
    assert_below(run_number(one, "residual"), 1e-11);
    json_decref(turns);
  }
}

// Nothing there is a turn of 1e-15 deg, and no sign of an eigenvalue of 1e-16 is told as stability.
static void a_capsize_speed_is_neutral(void **unused) {
  (void)unused;
  json_t *stability = run_json("bicycle stability roadster --json");
  char command[128];
  snprintf(command, sizeof command, "bicycle turn roadster --speed %.17g --rider-offset 0",
           run_number(stability, "capsize_speed"));
  run_result text = run_command(command);
  assert_int_equal(text.status, 0);
  assert_non_null(strstr(text.out, "a capsize speed: hands-free turns branch off"));
  assert_int_equal(run_occurrences(text.out, "inf            0  neutral"), 2); // turn and mark
  assert_null(strstr(text.out, "e-"));
  run_free(&text);
  strcat(command, " --json");
  json_t *turns = run_json(command);
  assert_int_equal(json_array_size(json_object_get(turns, "solutions")), 1);
  const json_t *one = solution(turns, 0);
  assert_near(run_number(one, "lean"), 0, 0);
  assert_near(run_number(one, "steer"), 0, 0);
  assert_true(json_is_true(json_object_get(one, "neutral")));
  assert_string_equal(json_string_value(json_object_get(one, "mark")), "meets straight riding");
  assert_true(json_is_string(json_object_get(turns, "reason")));
  json_decref(turns);
  json_decref(stability);
  // below its weave speed it is unstable whatever vanishes
  turns = run_json("bicycle turn roadster_riderless --speed 4.574494793923497 --rider-offset 0 "
                   "--json");
  one = solution(turns, 0);
  assert_string_equal(json_string_value(json_object_get(one, "mark")), "meets straight riding");
  assert_true(json_is_false(json_object_get(one, "neutral")));
  json_decref(turns);
  // elsewhere riding straight is stable or not
  turns = run_json("bicycle turn roadster --speed 6 --rider-offset 0 --json");
  assert_true(json_is_false(json_object_get(solution(turns, 1), "neutral")));
  assert_null(json_object_get(solution(turns, 1), "mark"));
  json_decref(turns);
}

static void sae_is_the_literature(void **unused) {
  (void)unused;
  json_t *turns =
      run_json("bicycle turn benchmark --rider-offset 0 --steer -5deg --convention sae --json");
  const json_t *one = solution(turns, 0);
  assert_near(run_number(one, "steer"), 5 * M_PI / 180, 1e-15);
  assert_near(run_number(one, "lean"), 0.275829694554, 1e-12);
  assert_near(run_number(one, "speed"), 5.773782597692, 1e-11);
  assert_true(run_number(one, "yaw_rate") > 0); // to the right
  json_decref(turns);
}

// What has no solution is an answer with a reason.
static void no_solution_is_an_answer(void **unused) {
  (void)unused;
  static const char *const commands[] = {"bicycle turn roadster --lean 20deg --steer 40deg --json",
                                         "bicycle turn roadster --lean 0 --steer 0 --json",
                                         "bicycle turn roadster --speed 6.5 --json"};
  for (size_t i = 0; i < 3; i++) {
    json_t *turns = run_json(commands[i]);
    assert_int_equal(json_array_size(json_object_get(turns, "solutions")), 0);
    assert_true(json_is_string(json_object_get(turns, "reason")));
    json_decref(turns);
  }
}

static void wrong_questions(void **unused) {
  (void)unused;
  static const char *const wrong[][2] = {
      {"roadster", "give two of"},
      {"roadster --lean 3deg", "give two of"},
      {"roadster --speed 5 --lean 3deg --steer 1deg", "give two of"},
      {"roadster --speed -1 --lean 3deg", "--speed: -1 is negative"},
      {"roadster --speed 5 --lean 85deg", "--lean: 85 deg is beyond"},
      {"roadster --speed 1e300 --lean 3deg", "--speed: 1e+300 m/s is beyond"},
      {"roadster --steer 179deg --speed 5", "--steer: 179 deg is beyond"},
      {"roadster --rider-offset 5 --speed 5", "--rider-offset: 5 m is beyond"},
      {"roadster --speed 5 --lean 3deg --steer-torque nan", "--steer-torque: 'nan'"},
      {"roadster --speed nan --lean 3deg", "--speed: 'nan' is not a number"},
      {"benchmark --speed 5 --lean 3deg", "--rider-offset 0"},
      {"nowhere --speed 5 --lean 3deg", "nowhere"}};
  for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
    char command[128];
    snprintf(command, sizeof command, "bicycle turn %s", wrong[i][0]);
    run_result result = run_command(command);
    assert_int_equal(result.status, 2);
    assert_string_equal(result.out, "");
    assert_non_null(strstr(result.err, wrong[i][1]));
    assert_true(strchr(result.err, '\n') == result.err + strlen(result.err) - 1); // one line
    run_free(&result);
  }
}

static void linear_about_a_turn(void **unused) {
  (void)unused;
  json_t *turns = run_json("bicycle turn roadster --speed 5.5 --rider-offset 0.01 --json");
  json_t *linear = run_json("bicycle linear roadster --speed 5.5 --rider-offset 0.01 --json");
  const json_t *turn = solution(turns, 1), *about = json_object_get(linear, "turn");
  assert_near(run_number(about, "lean"), run_number(turn, "lean"), 1e-12);
  // the trace of A is the sum of the eigenvalues
  double sum = 0;
  for (size_t i = 0; i < 4; i++) {
    const json_t *value = json_array_get(json_object_get(turn, "eigenvalues"), i);
    sum += json_number_value(json_array_get(value, 0));
    const json_t *row = json_array_get(json_object_get(linear, "A"), i);
    sum -= json_number_value(json_array_get(row, i));
  }
  assert_near(sum, 0, 1e-10);
  json_decref(turns);
  json_decref(linear);
  run_result both = run_command("bicycle linear roadster --speed 5 --lean 0.1 --rider-offset 0");
  assert_int_equal(both.status, 2);
  run_free(&both);
}

// Without a rider the lean decides the speed, and the command says so.
static void linear_without_a_rider(void **unused) {
  (void)unused;
  run_result refused = run_command("bicycle linear benchmark --speed 5 --lean 5deg");
  assert_int_equal(refused.status, 2);
  assert_non_null(strstr(refused.err, "--rider-offset 0"));
  run_free(&refused);
  json_t *linear =
      run_json("bicycle linear benchmark --lean 0.275829694554 --rider-offset 0 --json");
  assert_near(run_number(linear, "speed"), 5.773782597692, 1e-10); // the published turn
  assert_near(run_number(json_object_get(linear, "turn"), "steer"), -5 * M_PI / 180, 1e-10);
  json_decref(linear);
  static const char *const wrong[] = {"bicycle linear benchmark --lean 5deg",
                                      "bicycle linear benchmark --rider-offset 0",
                                      "bicycle linear benchmark --speed 5 --rider-offset 0.01",
                                      "bicycle linear roadster --speed 5 --lean 1e9",
                                      "bicycle linear benchmark --lean 60deg --rider-offset 0.1"};
  for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
    run_result result = run_command(wrong[i]);
    if (result.status != 2) fail_msg("%s: %d", wrong[i], result.status);
    assert_true(strchr(result.err, '\n') == result.err + strlen(result.err) - 1); // one line
    run_free(&result);
  }
}

// What lies beyond the usual range can be asked for.
static void limits_are_options(void **unused) {
  (void)unused;
  run_result usual = run_command("bicycle turn roadster --speed 60 --lean 0.1");
  assert_int_equal(usual.status, 2);
  assert_non_null(strstr(usual.err, "see --speed-limit"));
  run_free(&usual);
  json_t *turns = run_json("bicycle turn roadster --speed 60 --lean 0.1 --speed-limit 70 "
                           "--offset-limit 2 --json");
  assert_near(run_number(solution(turns, 0), "speed"), 60, 0);
  json_decref(turns);
  static const char *const wrong[] = {"bicycle turn roadster --speed 5 --speed-limit 0",
                                      "bicycle turn roadster --speed 5 --offset-limit -1",
                                      "bicycle turn roadster --speed 5 --speed-limit 4"};
  for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
    run_result result = run_command(wrong[i]);
    if (result.status != 2) fail_msg("%s: %d", wrong[i], result.status);
    run_free(&result);
  }
}

static void help_starts_with_an_example(void **unused) {
  (void)unused;
  static const char start[] = "Example: bicycle turn ";
  run_result result = run_command("bicycle turn --help");
  assert_int_equal(result.status, 0);
  assert_true(strncmp(result.out, start, strlen(start)) == 0);
  run_free(&result);
}

static int enter(void **state) {
  (void)state;
  run_enter();
  return 0;
}

static int leave(void **state) {
  (void)state;
  run_leave();
  return 0;
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(three_fixed_points),
      cmocka_unit_test(fast_turns_of_the_recumbent),
      cmocka_unit_test(sae_is_the_literature),
      cmocka_unit_test(no_solution_is_an_answer),
      cmocka_unit_test(wrong_questions),
      cmocka_unit_test(linear_about_a_turn),
      cmocka_unit_test(a_capsize_speed_is_neutral),
      cmocka_unit_test(linear_without_a_rider),
      cmocka_unit_test(help_starts_with_an_example),
      cmocka_unit_test(limits_are_options),
  };
  return cmocka_run_group_tests(tests, enter, leave);
}
