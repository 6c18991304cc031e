// SPDX-License-Identifier: Apache-2.0
// What no ground and no rider can do is marked by state, ride and turn, and nothing else is.
#include "run.h"
#include "support/near.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

typedef struct mark {
  const char *wheel, *kind; // wheel NULL: the rider
  double limit;
} mark;

static const json_t *marks_of(const json_t *document) {
  const json_t *marks = json_object_get(document, "outside_physics");
  if (!json_is_array(marks)) fail_msg("no array 'outside_physics'");
  return marks;
}

static void expect_marks(const json_t *document, const mark *expected, size_t count) {
  const json_t *marks = marks_of(document);
  assert_int_equal(json_array_size(marks), count);
  for (size_t i = 0; i < count; i++) {
    const json_t *one = json_array_get(marks, i);
    const char *wheel = json_string_value(json_object_get(one, "wheel"));
    assert_string_equal(wheel ? wheel : "rider", expected[i].wheel ? expected[i].wheel : "rider");
    assert_string_equal(json_string_value(json_object_get(one, "kind")), expected[i].kind);
    assert_near(run_number(one, "limit"), expected[i].limit, 1e-15);
  }
}

static double force_of(const json_t *state, const char *wheel, size_t axis) {
  return json_number_value(json_array_get(json_object_get(state, wheel), axis));
}

//---------------------------------- an instant ----------------------------------------------------

#define FALLING "bicycle state roadster --speed 6 --lean 70deg --steer -8deg --lean-rate 6"

// The forces that are printed decide, in every convention.
static void state_marks_wheels(void **unused) {
  (void)unused;
  static const mark both[] = {{"rear", "pulled", 0}, {"front", "friction", 1}};
  static const mark slippery[] = {{"rear", "pulled", 0}, {"front", "friction", 0.5}};
  json_t *iso = run_json(FALLING " --json");
  json_t *sae = run_json(FALLING " --friction 0.5 --json --convention sae");
  expect_marks(iso, both, 2);
  expect_marks(sae, slippery, 2);
  for (int i = 0; i < 2; i++) {
    const json_t *it = i == 0 ? iso : sae, *marks = marks_of(it);
    double horizontal = hypot(force_of(it, "front_force", 0), force_of(it, "front_force", 1));
    double friction = horizontal / force_of(it, "front_force", 2);
    assert_near(run_number(json_array_get(marks, 0), "value"), -force_of(it, "rear_force", 2), 0);
    assert_near(run_number(json_array_get(marks, 1), "value"), friction, 1e-14);
    assert_near(run_number(it, "front_friction"), friction, 1e-14);
  }
  json_decref(iso);
  json_decref(sae);
  run_result text = run_command(FALLING);
  assert_int_equal(text.status, 0);
  assert_non_null(strstr(text.out, "outside physics: the rear wheel is pulled with 256 N\n"));
  assert_non_null(
      strstr(text.out, "outside physics: the front wheel asks friction 3.225, more than 1\n"));
  run_free(&text);
  json_t *grips = run_json(FALLING " --friction 3.3 --json");
  expect_marks(grips, both, 1);
  json_decref(grips);
}

static void an_ordinary_state_has_no_mark(void **unused) {
  (void)unused;
  json_t *state = run_json("bicycle state roadster --speed 6 --lean 10deg --steer -8deg --json");
  expect_marks(state, NULL, 0);
  json_decref(state);
  run_result text = run_command("bicycle state benchmark --speed 0");
  assert_null(strstr(text.out, "outside"));
  run_free(&text);
}

// A fifth of the height of the rider's centre of mass, which is 1.08 m in the roadster and in the
// recumbent 0.85 m; either side.
static void the_rider_s_reach_is_the_bicycle_s(void **unused) {
  (void)unused;
  static const mark far = {NULL, "rider", 0.216}, low = {NULL, "rider", 0.17},
                    asked = {NULL, "rider", 0.1};
  static const struct {
    const char *options;
    const mark *mark;
  } cases[] = {{"roadster --rider-offset -0.217", &far},
               {"roadster --rider-offset 0.215", NULL},
               {"recumbent --rider-offset 0.171", &low},
               {"recumbent --rider-offset -0.169", NULL},
               {"roadster --rider-offset 0.11 --reach 0.1", &asked},
               {"roadster --rider-offset 0.3 --reach 0.31", NULL},
               {"benchmark", NULL}};
  for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
    char command[160];
    snprintf(command, sizeof command, "bicycle state %s --speed 6 --json", cases[i].options);
    json_t *state = run_json(command);
    expect_marks(state, cases[i].mark, cases[i].mark != NULL);
    json_decref(state);
  }
}

//---------------------------------- rides ---------------------------------------------------------

#define TOPPLING "bicycle ride roadster --speed 0 --lean 0.05 --time 3 --sample 0.5 "

static void a_ride_tells_what_it_asked(void **unused) {
  (void)unused;
  json_t *calm =
      run_json("bicycle ride roadster --speed 6 --lean-rate 0.2 --time 10 --sample 0.01 --json");
  const json_t *asked = json_object_get(calm, "friction_asked");
  const json_t *rear = json_object_get(asked, "rear");
  const json_t *column = json_object_get(json_object_get(calm, "samples"), "rear_friction");
  double largest = 0;
  for (size_t i = 0; i < json_array_size(column); i++)
    largest = fmax(largest, json_number_value(json_array_get(column, i)));
  expect_marks(calm, NULL, 0);
  assert_near(run_number(asked, "limit"), 1, 0);
  // the ends of steps are looked at too, and lie no farther from the top than rows
  assert_true(run_number(rear, "largest") >= largest);
  assert_below(run_number(rear, "largest") - largest, 1e-4);
  assert_true(run_number(rear, "time") > 0.1 && run_number(rear, "time") < 0.5);
  json_decref(calm);
}

// Rows 0.5 s apart see nothing of a lift of 0.13 s: what is told does not depend on them.
static void a_lift_between_rows_is_marked(void **unused) {
  (void)unused;
  static const mark expected[] = {
      {"rear", "pulled", 0}, {"rear", "friction", 1}, {"front", "friction", 1}};
  json_t *ride = run_json(TOPPLING "--json");
  const json_t *marks = marks_of(ride);
  expect_marks(ride, expected, 3);
  double end = run_number(ride, "end_time");
  double lift = run_number(json_array_get(json_object_get(ride, "events"), 0), "time");
  assert_near(run_number(json_array_get(marks, 0), "first"), lift, 1e-11);
  assert_near(run_number(json_array_get(marks, 0), "duration"), end - lift, 1e-11);
  // a wheel that lifts asks more than any limit just before
  assert_true(json_is_null(json_object_get(json_array_get(marks, 1), "value")));
  assert_true(run_number(json_array_get(marks, 1), "first") < lift);
  const json_t *asked = json_object_get(ride, "friction_asked");
  assert_true(json_is_null(json_object_get(json_object_get(asked, "rear"), "largest")));
  json_decref(ride);
  run_result text = run_command(TOPPLING "-o rows.csv");
  assert_int_equal(text.status, 0);
  assert_non_null(strstr(text.err, "largest friction asked: rear without bound at 1.12117 s, "));
  assert_non_null(strstr(text.err, "outside physics: the rear wheel is pulled with up to "));
  assert_non_null(strstr(text.err, "first at 1.12117 s, for 0.1323 s in all\n"));
  run_free(&text);
}

static void a_ride_marks_its_rider(void **unused) {
  (void)unused;
  static const mark far = {NULL, "rider", 0.216};
  json_t *still = run_json(
      "bicycle ride roadster --speed 9 --rider-offset 0.25 --time 0.1 --sample 0.1 --json");
  expect_marks(still, &far, 1);
  json_decref(still);
  run_well("printf 'time,rider_offset\\n0,0\\n0.3,0\\n0.6,-0.22\\n1,-0.22\\n' > sway.csv");
  json_t *early = run_json("bicycle ride roadster --speed 9 --input sway.csv --time 0.01 "
                           "--sample 0.01 --json");
  expect_marks(early, NULL, 0);
  json_decref(early);
  json_t *whole = run_json("bicycle ride roadster --speed 9 --input sway.csv --time 1 "
                           "--sample 1 --json");
  expect_marks(whole, &far, 1);
  assert_near(run_number(json_array_get(marks_of(whole), 0), "value"), 0.22, 1e-12);
  json_decref(whole);
}

//---------------------------------- turns ---------------------------------------------------------

static void turns_are_marked(void **unused) {
  (void)unused;
  json_t *turns = run_json("bicycle turn roadster --speed 5.5 --lean 20deg --json");
  const json_t *found = json_array_get(json_object_get(turns, "solutions"), 0);
  const json_t *other = json_array_get(json_object_get(turns, "elsewhere"), 0);
  static const mark expected[] = {{"front", "friction", 1}, {NULL, "rider", 0.216}};
  expect_marks(found, NULL, 0);
  expect_marks(other, expected, 2);
  assert_near(run_number(json_array_get(marks_of(other), 0), "value"),
              run_number(other, "front_friction"), 0);
  json_decref(turns);
  run_result text = run_command("bicycle turn roadster --speed 4 --rider-offset 0");
  assert_non_null(strstr(text.out, "rear pulled 32.1 N, front friction 1.07, rider 59.2 cm\n"));
  run_free(&text);
  json_t *icy = run_json("bicycle turn roadster --speed 5.5 --lean 20deg --friction 0.3 --json");
  assert_true(json_array_size(marks_of(json_array_get(json_object_get(icy, "solutions"), 0))) > 0);
  json_decref(icy);
}

static void limits_are_positive(void **unused) {
  (void)unused;
  static const run_wrong wrong[] = {
      {"bicycle state roadster --speed 6 --friction 0", "--friction"},
      {"bicycle state roadster --speed 6 --reach -1", "--reach"},
      {"bicycle ride roadster --speed 6 --time 1 --sample 1 --friction nan", "--friction"},
      {"bicycle turn roadster --speed 6 --lean 0 --friction x", "--friction"},
  };
  run_all_wrong(wrong, sizeof wrong / sizeof wrong[0]);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(state_marks_wheels),
      cmocka_unit_test(an_ordinary_state_has_no_mark),
      cmocka_unit_test(the_rider_s_reach_is_the_bicycle_s),
      cmocka_unit_test(a_ride_tells_what_it_asked),
      cmocka_unit_test(a_lift_between_rows_is_marked),
      cmocka_unit_test(a_ride_marks_its_rider),
      cmocka_unit_test(turns_are_marked),
      cmocka_unit_test(limits_are_positive),
  };
  return cmocka_run_group_tests(tests, run_enter_group, run_leave_group);
}
