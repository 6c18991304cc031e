// SPDX-License-Identifier: Apache-2.0
// Engines beside the analytic one and MuJoCo's own integrators: linear, file, CVODE in MuJoCo.
#include "support/near.h"
#include "validate_support.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>

#ifndef __has_feature // clang's way to ask what GCC says by __SANITIZE_ADDRESS__
#define __has_feature(feature) 0
#endif

//---------------------------------- linear --------------------------------------------------------

// The linear engine is the limit of small motions: the next terms are cubic.
static void test_linear_is_the_limit(void **state) {
  (void)state;
  static const char *const signals[4] = {"lean", "steer", "yaw", "y"};
  double worst[2][4];
  for (int i = 0; i < 2; i++) {
    char text[600];
    snprintf(text, sizeof text,
             "title: small\nbicycle: recumbent_damped\nstart: {speed: 13, lean_rate: %g}\n"
             "duration: 3\nsample: 0.01\nreference: {engine: analytic}\n"
             "candidate: {engine: linear}\n"
             "gates:\n  - {layer: L2, metric: max, signals: [lean], limit: 1, reason: test}\n",
             i ? 1e-3 : 1e-2);
    support_run *f = support_open(NULL, text);
    support_play(f);
    for (int k = 0; k < 4; k++)
      worst[i][k] = support_find(&f->comparison, "L2", signals[k], "max")->value;
    support_close(f);
  }
  for (int k = 0; k < 4; k++) assert_near(log10(worst[0][k] / worst[1][k]), 3, 0.1);
}

static void test_linear_falls(void **state) {
  (void)state;
  support_run *f = support_open(
      NULL, "title: fall\nbicycle: benchmark\nstart: {speed: 1, lean: 0.1}\nduration: 3\n"
            "sample: 0.01\nreference: {engine: linear}\ncandidate: {engine: linear}\n"
            "gates:\n  - {layer: L2, metric: max, signals: [lean], limit: 0, reason: test}\n");
  comparison *c = support_play(f);
  assert_false(c->side[0].trace.complete);
  assert_int_equal(c->side[0].trace.end_event.kind, BIKE_EVENT_LEAN_LIMIT);
  assert_int_equal(c->verdict, VERDICT_AGREE);
  support_close(f);
}

//---------------------------------- file ----------------------------------------------------------

static const char file_scenario[] =
    "title: file\nbicycle: benchmark\nstart: {speed: 5, lean_rate: 0.1}\nduration: 0.3\n"
    "sample: 0.1\nreference: {engine: analytic}\ncandidate: {engine: file, file: ride.csv}\n"
    "gates:\n  - {layer: L2, metric: max, signals: [lean], limit: 1e-12, reason: test}\n";

// A scenario whose candidate is a file beside it.
static support_run *open_scenario(const char *text, const char *csv, problem *p, term_exit *code) {
  support_run *run = calloc(1, sizeof *run);
  assert_non_null(run);
  run->folder = support_folder();
  free(support_write(run->folder, "ride.csv", csv));
  support_read_scenario(&run->scenario, run->folder, text);
  *code = comparison_open(&run->comparison, &run->scenario, p);
  if (*code == TERM_DONE) *code = comparison_run(&run->comparison, p);
  return run;
}

static support_run *open_recording(const char *csv, const char *columns, problem *p,
                                   term_exit *code) {
  char file[900];
  snprintf(file, sizeof file, "file: ride.csv%s", columns);
  char *text = support_replace(file_scenario, "file: ride.csv", file);
  support_run *run = open_scenario(text, csv, p, code);
  free(text);
  return run;
}

// What the analytic engine says, as another program would have written it: degrees, steer to the
// right, other names, rows between.
static char *record(void) {
  char *csv = NULL;
  size_t size = 0;
  support_run *f = support_open(
      NULL, "title: record\nbicycle: benchmark\nstart: {speed: 5, lean_rate: 0.1}\nduration: 0.3\n"
            "sample: 0.05\nreference: {engine: analytic}\ncandidate: {engine: analytic}\n"
            "gates:\n  - {layer: L2, metric: max, signals: [lean], limit: 0, reason: test}\n");
  comparison *c = support_play(f);
  FILE *stream = open_memstream(&csv, &size);
  assert_non_null(stream);
  fputs("t [s],phi [deg],delta,unused\n", stream);
  for (size_t k = 0; k < c->side[0].trace.count; k++) {
    const bike_sample *s = &c->side[0].trace.rows[k].sample;
    fprintf(stream, "%.17g,%.17g,%.17g,1\n", s->time, s->lean * 180 / 3.14159265358979323846,
            -s->steer);
  }
  assert_int_equal(fclose(stream), 0);
  support_close(f);
  return csv;
}

static const char column_map[] =
    ", columns: {time: 't [s]', lean: {column: 'phi [deg]', scale: 0.017453292519943295},"
    " steer: {column: delta, scale: -1}}";

static void test_recorded_ride_agrees(void **state) {
  (void)state;
  problem p = {""};
  term_exit code;
  char *csv = record();
  support_run *f = open_recording(csv, column_map, &p, &code);
  assert_string_equal(p.text, "");
  assert_int_equal(code, TERM_DONE);
  assert_string_equal(f->comparison.cause, "");
  assert_below(support_find(&f->comparison, "L2", "steer", "max")->value, 1e-12);
  for (size_t i = 0; i < f->comparison.measurements.count; i++)
    assert_string_not_equal(f->comparison.measurements.items[i].signal, "yaw");
  free(csv);
  support_close(f);
}

static void test_wrong_recordings(void **state) {
  (void)state;
  static const struct {
    const char *csv, *columns, *says;
  } cases[] = {
      {"time,lean\n0,0\n0.1,0\n0.2,0\n0.3,0\n", ", columns: {lean: roll}",
       "ride.csv: there is no column 'roll' for 'lean'; there are: time, lean"},
      {"t,lean\n0,0\n0.1,0\n", "", "there is no column 'time'"},
      {"time,roll\n0,0\n0.1,0\n", "", "there is no column 'lean'"},
      {"time,lean\n0,0\n0.1,0\n0.1,0\n0.2,0\n0.3,0\n", "",
       "ride.csv:4: time: the time does not rise: 0.1 s after 0.1 s"},
      {"time,lean\n0,0\n0.2,0\n0.1,0\n0.3,0\n", "", "ride.csv:4: time: the time does not rise"},
      {"time,lean\n0,0\n0.1,0\n0.3,0\n", "", "ride.csv:4: there is no row at 0.2 s"},
      {"time,lean\n0,0\n0.11,0\n0.21,0\n0.3,0\n", "", "ride.csv:3: there is no row at 0.1 s"},
      {"time,lean\n0.1,0\n0.2,0\n0.3,0\n", "", "there is no row at 0 s"},
      {"time,lean,speed\n0,0,nan\n0.1,1e999,5\n0.2,0,5\n0.3,0,5\n", "",
       "ride.csv:3: lean: '1e999'"},
      {"time,lean\n0,0\n0.1\n0.2,0\n0.3,0\n", "", "ride.csv:3: lean: the number is missing"},
      {"time,lean\n0,0\n", "", "two rows at least, there is 1"},
      {"time,lean\n", "", "two rows at least, there are 0"},
      {"", "", "empty"},
  };
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    problem p = {""};
    term_exit code;
    support_run *f = open_recording(cases[i].csv, cases[i].columns, &p, &code);
    assert_int_equal(code, TERM_USAGE);
    if (!strstr(p.text, cases[i].says)) fail_msg("'%s' does not say '%s'", p.text, cases[i].says);
    support_close(f);
  }
}

// NaN and infinities make a ride invalid where something needs them, and the cause says where they
// stand; elsewhere they do not matter.
static void test_not_finite_recordings(void **state) {
  (void)state;
  static const struct {
    const char *csv, *columns, *says; // NULL: the ride is judged
  } cases[] = {
      {"time,lean\n0,0\n0.1,nan\n0.2,0\n0.3,0\n", "",
       "ride.csv:3: lean: not a finite number at 0.1 s"},
      {"time,roll [deg]\n0,0\n0.1,0\n0.2,-Infinity\n0.3,0\n",
       ", columns: {time: time, lean: 'roll [deg]'}",
       "ride.csv:4: roll [deg]: not a finite number at 0.2 s"},
      {"time,lean\n0,0\n0.1,1e300\n0.2,0\n0.3,0\n",
       ", columns: {time: time, lean: {column: lean, scale: 1e300}}",
       "ride.csv:3: lean: not a finite"},
      {"time,lean,yaw\n0,0,0\n0.1,0,-nan(ind)\n0.2,1.#QNAN,0\n0.3,0,0\n", "",
       "ride.csv:3: yaw: not a finite number at 0.1 s"}, // compared; the first of two
      {"time,lean\n0,0\n.nan,0\n0.2,0\n0.3,0\n", "", "ride.csv:3: time: the time is not finite"},
      {"time,lean,torque\n0,0,nan\n0.1,0,inf\n0.2,0,nan\n0.3,0,nan\n", "", NULL}, // no signal
      {"time,lean,rear_normal,energy\n0,0,nan,nan\n0.1,0,inf,0\n0.2,0,nan,0\n0.3,0,nan,0\n", "",
       NULL},
      {"time,lean\n0,0\n0.05,nan\n0.1,0\n0.2,0\n0.3,0\n0.4,nan\nnan,0\n", "", NULL}, // other rows
      {"time,lean,yaw\n0,0,0\n0.1,0,nan\n0.2,0,0\n0.3,0,0\n", ", columns: {time: time, lean: lean}",
       NULL},
  };
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    problem p = {""};
    term_exit code;
    support_run *f = open_recording(cases[i].csv, cases[i].columns, &p, &code);
    const scenario *s = &f->scenario;
    const engine_ride ride = {.duration = s->duration, .sample = s->sample};
    assert_int_equal(code, TERM_DONE);
    p = (problem){""};
    assert_int_equal(engine_file.check(&s->candidate, &ride, &p), TERM_DONE);
    assert_string_equal(p.text, "");
    assert_int_equal(f->comparison.verdict == VERDICT_INVALID, cases[i].says != NULL);
    if (cases[i].says && !strstr(f->comparison.cause, cases[i].says))
      fail_msg("'%s' does not say '%s'", f->comparison.cause, cases[i].says);
    support_close(f);
  }
}

// A signal that only a gate of L3 needs.
static void test_not_finite_energy(void **state) {
  (void)state;
  static const char csv[] = "time,lean,energy,work\n0,0,9,0\n0.1,0,9,0\n0.2,0,9,nan\n0.3,0,9,0\n";
  static const char *const gates[] = {
      "gates:\n  - {layer: L3, metric: balance_max, limit: 1, reason: test}\n",
      "gates:\n  - {layer: L3, metric: balance_max, info: true, reason: test}\n"};
  for (int i = 0; i < 2; i++) {
    problem p = {""};
    term_exit code;
    char *text = support_replace(file_scenario, "gates:\n", gates[i]);
    support_run *f = open_scenario(text, csv, &p, &code);
    assert_int_equal(code, TERM_DONE);
    assert_int_equal(f->comparison.verdict == VERDICT_INVALID, i == 0);
    if (i == 0)
      assert_non_null(
          strstr(f->comparison.cause, "ride.csv:4: work: not a finite number at 0.2 s"));
    support_close(f);
    free(text);
  }
}

static void test_short_recording_ends_early(void **state) {
  (void)state;
  problem p = {""};
  term_exit code;
  support_run *f = open_recording("time,lean\n0,0\n0.1,0\n", "", &p, &code);
  assert_int_equal(code, TERM_DONE);
  const measurement *end = support_find(&f->comparison, "L2", "end_time", "difference");
  assert_near(end->value, 0.2, 1e-12);
  assert_non_null(strstr(end->detail, "file to 0.1 s"));
  assert_int_equal(f->comparison.verdict, VERDICT_FAIL);
  support_close(f);
}

// What the process holds at most, in kB.
static long peak_memory(void) {
  struct rusage usage;
  assert_int_equal(getrusage(RUSAGE_SELF, &usage), 0);
  return usage.ru_maxrss;
}

// Two million rows are passed over, in memory that does not know of them: as text they take 40 MB,
// as numbers 32 MB.
static void test_two_million_rows(void **state) {
  (void)state;
  enum { ROWS = 2000000 };
  problem p = {""};
  term_exit code;
  char *path = support_write(support_home, "long.csv", "time,speed\n");
  FILE *stream = fopen(path, "ae");
  assert_non_null(stream);
  for (int k = 0; k <= ROWS; k++) fprintf(stream, "%.8f,5.0000000\n", k * 0.5e-6);
  assert_int_equal(fclose(stream), 0);
  long before = peak_memory();
  char map[512];
  snprintf(map, sizeof map, "file: %s", path);
  char *text = support_replace(file_scenario, "file: ride.csv", map);
  scenario s;
  comparison c;
  support_read_scenario(&s, support_home, text);
  assert_int_equal(comparison_open(&c, &s, &p), TERM_DONE);
  code = comparison_run(&c, &p);
  assert_string_equal(p.text, "");
  assert_int_equal(code, TERM_DONE);
  assert_int_equal(c.side[CANDIDATE].trace.count, 4);
#if !defined __SANITIZE_ADDRESS__ && !__has_feature(address_sanitizer) // which keeps what was freed
  assert_true(peak_memory() - before < 8192);
#else
  (void)before;
#endif
  comparison_close(&c);
  scenario_clear(&s);
  free(text);
  free(path);
}

// A model of somebody else on its own contacts is another model than rolling; that its contacts are
// its own is said.
static void test_foreign_contacts(void **state) {
  (void)state;
  static const char text[] =
      "title: contacts\nbicycle: " BICYCLE_SOURCE_DIR
      "/validate/scenarios/models/somebodys_bicycle.xml\nstart: {speed: 5, lean_rate: 0.02}\n"
      "duration: 0.5\nsample: 0.01\nreference: {engine: analytic}\n"
      "candidate: {engine: mujoco, rolling: contact}\ngates:\n"
      "  - {layer: Lp, metric: relative, limit: 1e-12, reason: test}\n"
      "  - {layer: L2, metric: max, signals: [lean], limit: 0.1, reason: test}\n";
  problem p = {""};
  support_run *f = support_open(NULL, text);
  comparison *c = support_play(f);
  assert_string_equal(c->cause, "");
  assert_true(support_find(c, "L2", "lean", "max")->value > 1e-6);
  assert_true(support_find(c, "L3", "mujoco.rear_slip", "max")->value > 1e-9);
  support_close(f);
  char *wrong = support_replace(text, "rolling: contact", "rolling: contact, solref: 0.01");
  scenario s;
  comparison refused;
  support_read_scenario(&s, support_home, wrong);
  assert_int_equal(comparison_open(&refused, &s, &p), TERM_USAGE);
  assert_non_null(strstr(p.text, "has contacts of its own"));
  comparison_close(&refused);
  scenario_clear(&s);
  free(wrong);
}

// A model of somebody else with one piece of its text replaced, "changed.xml" in the test's folder.
static void write_changed_model(const char *from, const char *to) {
  char *text = support_read(BICYCLE_SOURCE_DIR "/validate/scenarios/models/somebodys_bicycle.xml");
  char *changed = support_replace(text, from, to);
  free(support_write(support_home, "changed.xml", changed));
  free(changed);
  free(text);
}

static const char changed_text[] =
    "title: stops\nbicycle: ./changed.xml\nstart: {speed: 5, lean_rate: 0.02}\nduration: 0.1\n"
    "sample: 0.01\ninstants: {count: 20, seed: 3}\nreference: {engine: analytic}\n"
    "candidate: {engine: mujoco}\ngates:\n"
    "  - {layer: L0, metric: relative, limit: 1e-9, reason: test}\n";

// Stops are outside the equations: L0 keeps within them and says so, wherever its states come from.
static void test_stops(void **state) {
  (void)state;
  write_changed_model("axis=\"0 0 -1\" damping=\"0.4\"",
                      "axis=\"0 0 -1\" damping=\"0.4\" limited=\"true\" range=\"-12 15\"");
  free(support_write(support_home, "stops.yml", changed_text));
  assert_int_equal(support_validate("stops.yml -o report"), 0);
  support_expect_text("err", "stops: the model has stops (joint 'column' at -0.20944 and 0.261799 "
                             "rad): L0 compares no states beyond them");
  support_expect_text("report/report.json", " states beyond stops left out (joint 'column'");
  char *beyond = support_replace(changed_text, "lean_rate", "steer: 0.3, lean_rate");
  free(support_write(support_home, "stops.yml", beyond));
  assert_int_equal(support_validate("stops.yml -o report"), 2);
  support_expect_text("err", "start: it is beyond a stop of the model: joint 'column'");
  free(beyond);
}

// What is refused on import is refused in a scenario, with its line.
static void test_servo(void **state) {
  (void)state;
  write_changed_model("</worldbody>", "</worldbody><actuator><position name=\"servo\" "
                                      "joint=\"column\"/></actuator>");
  free(support_write(support_home, "servo.yml", changed_text));
  assert_int_equal(support_validate("servo.yml -o report"), 2);
  support_expect_text("err", "servo.yml:2: bicycle: ");
  support_expect_text("err", "actuator 'servo' acts while its control is zero");
}

static void test_solref_is_for_contacts(void **state) {
  (void)state;
  scenario s;
  comparison refused;
  problem p = {""};
  support_read_scenario(&s, support_home,
                        "title: exact\nbicycle: benchmark\nstart: {speed: 5}\nduration: 0.5\n"
                        "sample: 0.01\nreference: {engine: analytic}\n"
                        "candidate: {engine: mujoco, solref: 0.01}\ngates:\n"
                        "  - {layer: Lp, metric: relative, limit: 1e-12, reason: test}\n");
  assert_int_equal(comparison_open(&refused, &s, &p), TERM_USAGE);
  assert_non_null(strstr(p.text, "solref is for rolling: contact"));
  comparison_close(&refused);
  scenario_clear(&s);
}

//---------------------------------- cvode ---------------------------------------------------------

// The same model by another integrator: no step of MuJoCo's shows, with either root, and the work
// of the damper is counted.
static void test_cvode(void **state) {
  (void)state;
  static const char *const roots[2] = {"hinge", "free"};
  for (int i = 0; i < 2; i++) {
    char text[700];
    snprintf(
        text, sizeof text,
        "title: cvode\nbicycle: recumbent_damped\nstart: {speed: 13, lean_rate: 0.1}\n"
        "duration: 2\nsample: 0.01\ninstants: {count: 0}\nreference: {engine: analytic}\n"
        "candidate: {engine: mujoco, integrator: cvode, root: %s, timestep: 1e-2}\ngates:\n"
        "  - {layer: L2, metric: max, signals: [lean, steer, yaw], limit: 1e-11, reason: test}\n"
        "  - {layer: L3, metric: balance_max, limit: 1e-12, reason: test}\n",
        roots[i]);
    support_run *f = support_open(NULL, text);
    comparison *c = support_play(f);
    assert_string_equal(c->cause, "");
    assert_true(support_find(c, "L3", "mujoco.energy", "spread_percent")->value > 1e-7);
    assert_true(c->side[CANDIDATE].trace.evaluations > c->side[CANDIDATE].trace.steps);
    support_close(f);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_linear_is_the_limit),
      cmocka_unit_test(test_linear_falls),
      cmocka_unit_test(test_recorded_ride_agrees),
      cmocka_unit_test(test_wrong_recordings),
      cmocka_unit_test(test_not_finite_recordings),
      cmocka_unit_test(test_not_finite_energy),
      cmocka_unit_test(test_short_recording_ends_early),
      cmocka_unit_test_setup_teardown(test_two_million_rows, support_enter, support_leave),
      cmocka_unit_test_setup_teardown(test_foreign_contacts, support_enter, support_leave),
      cmocka_unit_test_setup_teardown(test_stops, support_enter, support_leave),
      cmocka_unit_test_setup_teardown(test_servo, support_enter, support_leave),
      cmocka_unit_test_setup_teardown(test_solref_is_for_contacts, support_enter, support_leave),
      cmocka_unit_test(test_cvode),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
