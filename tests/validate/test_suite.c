// SPDX-License-Identifier: Apache-2.0
// Suites on several threads, under the thread sanitizer where it is to be had: no race, and the
// report of one thread to the last byte but for times.
#include "support/near.h"
#include "validate_support.h"

#include <report.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <suite.h>
#include <time.h>

enum { MOST_SCENARIOS = 8 };

typedef struct variant {
  const char *name, *from, *to; // a change of the support's scenario; NULL: none
} variant;

static void write_variant(char *paths[], size_t index, variant v) {
  char name[64];
  char *text = support_replace(support_scenario_text, v.from, v.to);
  snprintf(name, sizeof name, "%s.yml", v.name);
  paths[index] = support_write(support_home, name, text);
  free(text);
}

static void load(suite *out, const variant *variants, size_t count) {
  char *paths[MOST_SCENARIOS];
  problem p = {""};
  assert_true(count <= MOST_SCENARIOS);
  for (size_t i = 0; i < count; i++) write_variant(paths, i, variants[i]);
  term_exit code = suite_load(out, paths, (int)count, &p);
  assert_string_equal(p.text, "");
  assert_int_equal(code, TERM_DONE);
  for (size_t i = 0; i < count; i++) free(paths[i]);
}

// The report without what may differ between two runs.
static char *document_of(const suite *s) {
  report r = {.comparisons = s->comparisons, .count = s->count};
  assert_true(provenance_begin(&r.provenance, NULL, 0));
  json_t *document = report_document(&r);
  json_t *origin = json_object_get(document, "provenance");
  assert_int_equal(json_object_del(origin, "created"), 0);
  assert_int_equal(json_object_del(origin, "timings"), 0);
  char *text = json_dumps(document, JSON_REAL_PRECISION(17));
  assert_non_null(text);
  json_decref(document);
  provenance_clear(&r.provenance);
  return text;
}

static const variant mixed[] = {
    {"exact", NULL, NULL},
    {"free", "engine: mujoco", "engine: mujoco, root: free"},
    {"wild", "speed: 4.6, lean_rate: 0.5", "speed: 1e11"}, // MuJoCo warns and begins anew
    {"contact", "engine: mujoco", "engine: mujoco, rolling: contact"},
    {"timed", "gates:", "cost: {repeats: 2}\ngates:"},
    {"study",
     "gates:", "convergence: {timesteps: [1e-2, 5e-3, 2.5e-3, 2e-3], tolerance: 1e-9}\ngates:"},
    {"cvode", "engine: mujoco", "engine: mujoco, integrator: cvode"},
    {"other", "speed: 4.6", "speed: 5"},
};
enum { MIXED = sizeof mixed / sizeof *mixed };

static char *play_mixed(int jobs) {
  suite s;
  problem p = {""};
  load(&s, mixed, MIXED);
  assert_int_equal(suite_play(&s, jobs, &p), TERM_DONE);
  for (size_t i = 0; i < MIXED; i++)
    assert_string_equal(s.comparisons[i].scenario->name, mixed[i].name);
  assert_int_equal(s.comparisons[0].verdict, VERDICT_AGREE);
  assert_int_equal(s.comparisons[2].verdict, VERDICT_INVALID);
  char *text = document_of(&s);
  suite_clear(&s);
  return text;
}

// Several threads come first, when nothing of the process is set up yet.
static void test_report_is_that_of_one_thread(void **state) {
  (void)state;
  char *five = play_mixed(5), *two = play_mixed(2), *one = play_mixed(1);
  assert_string_equal(one, two);
  assert_string_equal(one, five);
  free(five);
  free(two);
  free(one);
}

// A problem ends the suite; which one is told does not depend on who is faster.
static void test_first_problem_is_told(void **state) {
  (void)state;
  static const variant wrong[] = {
      {"good", NULL, NULL},
      {"slow", "engine: mujoco}", "engine: mujoco}\nhorizon: {share: 0.1}"},
      {"misfit", "sample: 0.01", "sample: 0.0125"}, // no multiple of MuJoCo's timestep
      {"misfit_too", "sample: 0.01", "sample: 0.0025"},
      {"more", NULL, NULL},
  };
  for (int jobs = 1; jobs <= 4; jobs++) {
    suite s;
    problem p = {""};
    load(&s, wrong, sizeof wrong / sizeof *wrong);
    assert_int_equal(suite_play(&s, jobs, &p), TERM_USAGE);
    assert_ptr_equal(strstr(p.text, "misfit: "), p.text);
    suite_clear(&s);
  }
}

// What is wrong with a recording is told when the suite is read, before a scenario that stands
// first is played, which would fail; and of the file and line.
static void test_recordings_are_read_first(void **state) {
  (void)state;
  static const struct {
    const char *csv, *says; // NULL: nothing
  } cases[] = {
      {"time,lean\n0,0\n0.01,x\n", "ride.csv:3: lean: 'x' is not a number"},
      {"time,lean\n0,0\n0.02,0\n0.01,0\n", "ride.csv:4: time: the time does not rise"},
      {"time,lean\n0,0\n0.01,0\n0.03,0\n", "ride.csv:4: there is no row at 0.02 s"},
      {"time,lean\n0,0\n0.01,0\n", NULL}, // a ride that ended early
  };
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    char *paths[2];
    problem p = {""};
    suite s;
    write_variant(paths, 0, (variant){"misfit", "sample: 0.01", "sample: 0.0125"});
    write_variant(paths, 1,
                  (variant){"recorded", "{engine: mujoco}", "{engine: file, file: ride.csv}"});
    free(support_write(support_home, "ride.csv", cases[i].csv));
    term_exit code = suite_load(&s, paths, 2, &p);
    assert_int_equal(code, cases[i].says ? TERM_USAGE : TERM_DONE);
    if (cases[i].says) {
      assert_ptr_equal(strstr(p.text, "recorded: "), p.text);
      if (!strstr(p.text, cases[i].says)) fail_msg("%s", p.text);
    }
    suite_clear(&s);
    for (int k = 0; k < 2; k++) free(paths[k]);
  }
}

//---------------------------------- faults of the whole process -----------------------------------

static atomic_int riding, disturbed;

// Rides long enough for all threads to be at it.
static term_exit ride_slowly(trace *out, void *instance, const engine_ride *asked, problem *p) {
  const struct timespec while_others_begin = {0, 100000000};
  atomic_fetch_add(&riding, 1);
  nanosleep(&while_others_begin, NULL);
  term_exit code = engine_mujoco.ride(out, instance, asked, p);
  atomic_fetch_sub(&riding, 1);
  return code;
}

static term_exit rob_alone(trace *out, void *instance, const engine_ride *asked, problem *p) {
  atomic_fetch_add(&disturbed, atomic_load(&riding));
  return support_robbed_ride(out, instance, asked, p);
}

// An engine that robs the process of its callback, and says so, is played when nobody else is.
static void test_alone_disturbs_nobody(void **state) {
  (void)state;
  static const variant all[] = {{"a", NULL, NULL},
                                {"robbed", NULL, NULL},
                                {"b", NULL, NULL},
                                {"c", NULL, NULL},
                                {"d", NULL, NULL}};
  suite s;
  problem p = {""};
  engine robber = engine_mujoco, slow = engine_mujoco;
  robber.ride = rob_alone;
  robber.alone = true;
  slow.ride = ride_slowly;
  load(&s, all, 5);
  for (size_t i = 0; i < 5; i++) s.scenarios[i].candidate.engine = i == 1 ? &robber : &slow;
  assert_int_equal(suite_play(&s, 3, &p), TERM_DONE);
  assert_int_equal(disturbed, 0);
  for (size_t i = 0; i < 5; i++)
    assert_int_equal(s.comparisons[i].verdict, i == 1 ? VERDICT_INVALID : VERDICT_AGREE);
  assert_non_null(strstr(s.comparisons[1].cause, "mjcb_control"));
  suite_clear(&s);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(test_report_is_that_of_one_thread, support_enter,
                                      support_leave),
      cmocka_unit_test_setup_teardown(test_first_problem_is_told, support_enter, support_leave),
      cmocka_unit_test_setup_teardown(test_recordings_are_read_first, support_enter, support_leave),
      cmocka_unit_test_setup_teardown(test_alone_disturbs_nobody, support_enter, support_leave),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
