// SPDX-License-Identifier: Apache-2.0
// What right command lines print: the keys and columns that scripts rely on, and known numbers.
#include "run.h"
#include "support/near.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void expect_keys(const json_t *object, const char *const *keys, size_t count) {
  for (size_t i = 0; i < count; i++)
    if (!json_object_get(object, keys[i])) fail_msg("no key '%s'", keys[i]);
}

#define KEY_COUNT(keys) (sizeof(keys) / sizeof(keys)[0])

static double entry(const json_t *object, const char *key, size_t row, size_t column) {
  const json_t *value = json_array_get(json_array_get(json_object_get(object, key), row), column);
  assert_true(json_is_number(value));
  return json_number_value(value);
}

static void state_has_every_key(void **unused) {
  (void)unused;
  static const char *const keys[] = {
      "lean",     "steer",      "lean_rate",   "steer_rate", "speed",       "pitch",   "beta_r",
      "beta_f",   "psi",        "phi_tilde",   "T_r",        "T_f",         "Z_0",     "yaw_rate",
      "lean_acc", "steer_acc",  "energy",      "speed_rate", "front_speed", "kinetic", "potential",
      "bicycle",  "rear_force", "front_force", "convention", "force_axes"};
  json_t *state = run_json("bicycle state roadster --speed 6 --lean 10deg --steer -8deg --json");
  expect_keys(state, keys, KEY_COUNT(keys));
  assert_near(run_number(state, "lean"), 10 * M_PI / 180, 1e-15);
  assert_near(run_number(state, "energy"),
              run_number(state, "kinetic") + run_number(state, "potential"), 1e-12);
  assert_int_equal(json_array_size(json_object_get(state, "rear_force")), 3);
  json_decref(state);
}

// Static loads of the benchmark of Meijaard et al. (2007): 94 kg on a wheelbase of 1.02 m, from the
// moments of its parts about the contact points, in exact arithmetic.
// Any steer has a meaning, but of one beyond a turn another may have been meant.
static void degrees_without_suffix_are_suspected(void **unused) {
  (void)unused;
  static const char suspicion[] = "--steer: 10 is more than a whole turn; degrees have the suffix";
  run_result result = run_command("bicycle state roadster --speed 6 --steer 10");
  assert_int_equal(result.status, 0);
  assert_non_null(strstr(result.err, suspicion));
  run_free(&result);
  result = run_command("bicycle state roadster --speed 6 --steer 6.28");
  assert_int_equal(result.status, 0);
  assert_string_equal(result.err, "");
  run_free(&result);
}

static void loads_of_the_benchmark(void **unused) {
  (void)unused;
  json_t *state = run_json("bicycle state benchmark --speed 0 --json");
  const json_t *rear = json_object_get(state, "rear_force");
  const json_t *front = json_object_get(state, "front_force");
  assert_near(json_number_value(json_array_get(rear, 2)), 612.836470588, 1e-9);
  assert_near(json_number_value(json_array_get(front, 2)), 309.303529412, 1e-9);
  json_decref(state);
}

static void sae_turns_what_is_left_positive(void **unused) {
  (void)unused;
  static const struct {
    const char *key;
    double factor;
  } turned[] = {{"lean", 1},       {"lean_acc", 1}, {"pitch", 1},      {"steer", -1},
                {"steer_acc", -1}, {"psi", 1},      {"phi_tilde", -1}, {"yaw_rate", -1},
                {"speed_rate", 1}, {"energy", 1}};
  static const char command[] =
      "bicycle state roadster --speed 6 --lean 10deg --steer -8deg --steer-rate 0.3 --json";
  char in_sae[256];
  snprintf(in_sae, sizeof in_sae, "%s --convention sae", command);
  json_t *iso = run_json(command), *sae = run_json(in_sae);
  assert_string_equal(json_string_value(json_object_get(iso, "convention")), "iso");
  assert_string_equal(json_string_value(json_object_get(sae, "convention")), "sae");
  for (size_t i = 0; i < KEY_COUNT(turned); i++) {
    double value = run_number(iso, turned[i].key);
    assert_true(fabs(value) > 1e-9); // or the sign would tell nothing
    assert_near(run_number(sae, turned[i].key), turned[i].factor * value, 0);
  }
  json_decref(iso);
  json_decref(sae);
}

// Meijaard et al. (2007), equations (5.3) ff.: the canonical matrices of the benchmark, steer right
// positive; printed to 14 digits.
static void linear_matrices_of_the_benchmark(void **unused) {
  (void)unused;
  static const char *const keys[] = {"coordinates", "M",      "C1", "K0", "K2",
                                     "states",      "inputs", "A",  "B",  "speed"};
  json_t *linear = run_json("bicycle linear benchmark --speed 5 --convention sae --json");
  expect_keys(linear, keys, KEY_COUNT(keys));
  assert_relative(entry(linear, "M", 0, 0), 80.81722, 1e-12);
  assert_relative(entry(linear, "M", 0, 1), 2.31941332208709, 1e-12);
  assert_relative(entry(linear, "M", 1, 1), 0.29784188199686, 1e-12);
  assert_relative(entry(linear, "C1", 0, 1), 33.86641391492494, 1e-12);
  assert_relative(entry(linear, "C1", 1, 0), -0.85035641456978, 1e-12);
  assert_relative(entry(linear, "K0", 0, 1), -2.59951685249872, 1e-12);
  assert_relative(entry(linear, "K2", 0, 1), 76.59734589573222, 1e-12);
  assert_near(entry(linear, "A", 0, 2), 1, 0);
  // A against M: lean_acc of lean = -(M^-1 g K0), independent of the sign of the steer.
  json_t *iso = run_json("bicycle linear benchmark --speed 5 --json");
  assert_near(entry(iso, "A", 3, 1), entry(linear, "A", 3, 1), 0);
  assert_near(entry(iso, "A", 3, 0), -entry(linear, "A", 3, 0), 0);
  assert_near(entry(iso, "B", 2, 0), entry(linear, "B", 2, 0), 0);
  assert_near(entry(iso, "B", 3, 0), -entry(linear, "B", 3, 0), 0);
  assert_near(entry(iso, "B", 2, 1), -entry(linear, "B", 2, 1), 0);
  json_decref(iso);
  json_decref(linear);
}

static void stability_of_the_benchmark(void **unused) {
  (void)unused;
  json_t *stability = run_json("bicycle stability benchmark --speeds 0:10:11 --search 0:20 --json");
  assert_near(run_number(stability, "weave_speed"), 4.292382536341, 4.3e-12);
  assert_near(run_number(stability, "capsize_speed"), 6.024262015388, 6.1e-12);
  assert_int_equal(json_array_size(json_object_get(stability, "weave_speeds")), 1);
  assert_near(entry(stability, "stable_ranges", 0, 0), 4.292382536341, 4.3e-12);
  assert_near(entry(stability, "stable_ranges", 0, 1), 6.024262015388, 6.1e-12);
  const json_t *all = json_object_get(stability, "eigenvalues");
  assert_int_equal(json_array_size(all), 11);
  for (size_t i = 0; i < 11; i++) {
    const json_t *one = json_array_get(all, i);
    assert_near(run_number(one, "speed"), (double)i, 1e-15);
    assert_int_equal(json_array_size(json_object_get(one, "values")), 4);
    for (size_t k = 1; k < 4; k++)
      assert_true(entry(one, "values", k, 0) <= entry(one, "values", k - 1, 0));
  }
  // at 5 m/s, as in figure 3 of Meijaard et al. (2007)
  static const char *const names[] = {"capsize", "weave", "weave", "castering"};
  const json_t *modes = json_object_get(json_array_get(all, 5), "modes");
  for (size_t k = 0; k < 4; k++)
    assert_string_equal(json_string_value(json_array_get(modes, k)), names[k]);
  json_decref(stability);
}

// A list without an oscillation takes its names from the speeds beyond.
static void slow_modes_have_names(void **unused) {
  (void)unused;
  run_result table = run_command("bicycle stability benchmark --speeds 0:0.5:3");
  assert_int_equal(run_occurrences(table.out, " weave"), 6);
  assert_int_equal(run_occurrences(table.out, " capsize"), 3);
  assert_int_equal(run_occurrences(table.out, " castering"), 3);
  run_free(&table);
}

static void no_critical_speed_is_null(void **unused) {
  (void)unused;
  json_t *stability = run_json("bicycle stability benchmark --search 0:1 --json");
  assert_true(json_is_null(json_object_get(stability, "weave_speed")));
  assert_true(json_is_null(json_object_get(stability, "capsize_speed")));
  assert_int_equal(json_array_size(json_object_get(stability, "stable_ranges")), 0);
  json_decref(stability);
}

#define ODD "\"" BICYCLE_SOURCE_DIR "/tests/odd_bicycles/"

// Stable from the weave speed on: the end of the search is none of the bicycle's speeds.
static void the_end_of_the_search_is_told(void **unused) {
  (void)unused;
  run_result text = run_command("bicycle stability " ODD "two_masses.yml\"");
  assert_non_null(strstr(text.out, "2.841008323366 m/s to the end of the search at 40 m/s\n"));
  run_free(&text);
  json_t *open = run_json("bicycle stability " ODD "two_masses.yml\" --json");
  assert_true(json_is_true(json_object_get(open, "stable_to_search_end")));
  assert_near(entry(open, "stable_ranges", 0, 1), 40, 0);
  json_decref(open);
  json_t *closed = run_json("bicycle stability benchmark --json");
  assert_true(json_is_false(json_object_get(closed, "stable_to_search_end")));
  assert_int_equal(json_array_size(json_object_get(closed, "names_end")), 0);
  json_decref(closed);
}

// Every command looks as far as the bicycle's size asks.
static void a_giant_is_searched_far_enough(void **unused) {
  (void)unused;
  json_t *stability = run_json("bicycle stability " ODD "giant.yml\" --json");
  json_t *effects = run_json("bicycle effects " ODD "giant.yml\" --json");
  assert_near(run_number(stability, "weave_speed"), 42.9238, 1e-4);
  assert_near(run_number(stability, "capsize_speed"), 60.2426, 1e-4);
  assert_near(run_number(effects, "weave_speed"), run_number(stability, "weave_speed"), 0);
  assert_near(run_number(effects, "capsize_speed"), run_number(stability, "capsize_speed"), 0);
  assert_near(entry(stability, "stable_ranges", 0, 1), run_number(stability, "capsize_speed"), 0);
  json_decref(stability);
  json_decref(effects);
  run_result sweep = run_command(
      "printf 'bicycle: %s\\nsweep: {speed: [5]}\\noutputs: [weave_speed]\\n' " ODD "giant.yml\" "
      "> giant.yml && bicycle sweep giant.yml -o giant > sweep.txt 2>&1; cat giant.csv");
  assert_non_null(strstr(sweep.out, "42.92382536"));
  run_free(&sweep);
}

static const char header[] =
    "time,x,y,yaw,lean,pitch,steer,lean_rate,steer_rate,speed,rear_angle,front_angle,energy,"
    "rear_normal,front_normal,rear_friction,front_friction\n";

// The numbers of a CSV row; returns how many.
static int read_row(const char *line, double *out, int room) {
  int count = 0;
  while (count < room) {
    char *end;
    out[count++] = strtod(line, &end);
    assert_true(end != line);
    if (*end != ',') break;
    line = end + 1;
  }
  return count;
}

static void ride_writes_rows_at_multiples(void **unused) {
  (void)unused;
  run_result result =
      run_command("bicycle ride roadster --speed 6 --lean-rate 0.2 --time 1 --sample 0.3");
  assert_int_equal(result.status, 0);
  assert_true(strncmp(result.out, header, strlen(header)) == 0);
  const char *line = result.out + strlen(header);
  int rows = 0;
  for (; *line; line = strchr(line, '\n') + 1) {
    double row[17];
    assert_int_equal(read_row(line, row, 17), 17);
    assert_near(row[0], 0.3 * rows, 0); // k DT, to the last bit
    rows++;
  }
  assert_int_equal(rows, 4); // 0, 0.3, 0.6, 0.9
  run_free(&result);
}

static void ride_includes_its_end(void **unused) {
  (void)unused;
  run_result result = run_command(
      "bicycle ride roadster --speed 6 --lean-rate 0.2 --time 1 --sample 0.1 -o end.csv &&"
      "tail -n 1 end.csv | cut -d , -f 1; wc -l < end.csv; rm end.csv");
  assert_string_equal(result.out, "1\n12\n");
  run_free(&result);
}

static void ride_json_is_complete(void **unused) {
  (void)unused;
  static const char *const keys[] = {"bicycle", "convention", "end_time",    "complete", "rows",
                                     "events",  "end",        "evaluations", "steps",    "energy"};
  json_t *ride =
      run_json("bicycle ride roadster --speed 6 --lean-rate 0.2 --time 1 --sample 0.25 --json");
  expect_keys(ride, keys, KEY_COUNT(keys));
  assert_near(run_number(ride, "end_time"), 1, 0);
  assert_near(run_number(ride, "rows"), 5, 0);
  const json_t *samples = json_object_get(ride, "samples");
  assert_int_equal(json_object_size(samples), 17);
  const json_t *lean = json_object_get(samples, "lean");
  assert_int_equal(json_array_size(lean), 5);
  assert_near(json_number_value(json_array_get(lean, 4)),
              run_number(json_object_get(ride, "end"), "lean"), 0);
  assert_below(run_number(json_object_get(ride, "energy"), "balance"), 1e-12);
  json_decref(ride);
}

static void ride_with_file_keeps_rows_out_of_json(void **unused) {
  (void)unused;
  json_t *ride = run_json("bicycle ride roadster --speed 6 --time 1 --sample 0.5 -o rows.csv "
                          "--json && test -s rows.csv");
  assert_null(json_object_get(ride, "samples"));
  json_decref(ride);
}

// A fall ends the ride with exit code 0, the rows so far, and an event with time and reason.
static void a_fall_is_an_event(void **unused) {
  (void)unused;
  run_result result = run_command("bicycle ride benchmark --speed 1 --lean-rate 0.5 --time 30 "
                                  "--sample 0.1 --json");
  assert_int_equal(result.status, 0);
  json_t *ride = json_loads(result.out, 0, NULL);
  assert_non_null(ride);
  assert_true(json_is_false(json_object_get(ride, "complete")));
  assert_true(run_number(ride, "end_time") < 30);
  const json_t *events = json_object_get(ride, "events");
  size_t count = json_array_size(events);
  assert_true(count > 0);
  const json_t *last = json_array_get(events, count - 1);
  assert_near(run_number(last, "time"), run_number(ride, "end_time"), 1e-12);
  const char *reason = json_string_value(json_object_get(last, "reason"));
  assert_non_null(reason);
  assert_non_null(strstr(result.err, reason)); // told on stderr too
  json_decref(ride);
  run_free(&result);
}

static void ride_in_sae_mirrors(void **unused) {
  (void)unused;
  static const char *const turned[] = {"y", "yaw", "steer", "steer_rate"};
  static const char command[] =
      "bicycle ride roadster --speed 6 --lean-rate 0.2 --steer-torque 0.1 "
      "--time 1 --sample 1 --json";
  char in_sae[256];
  snprintf(in_sae, sizeof in_sae, "%s --convention sae", command);
  json_t *iso = run_json(command), *sae = run_json(in_sae);
  const json_t *end_iso = json_object_get(iso, "end"), *end_sae = json_object_get(sae, "end");
  for (size_t i = 0; i < KEY_COUNT(turned); i++) {
    assert_true(fabs(run_number(end_iso, turned[i])) > 1e-6);
    assert_near(run_number(end_sae, turned[i]), -run_number(end_iso, turned[i]), 0);
  }
  assert_near(run_number(end_sae, "lean"), run_number(end_iso, "lean"), 0);
  json_decref(iso);
  json_decref(sae);
}

// An interrupted ride leaves no file. The ride would take hours.
static void an_interrupted_ride_leaves_nothing(void **unused) {
  (void)unused;
  char *before = run_list();
  run_result result = run_command(
      "timeout --signal=INT --preserve-status 0.5 bicycle ride roadster --speed 6 --lean-rate 0.2 "
      "--time 1e6 --sample 0.01 -o long.csv");
  assert_int_equal(result.status, 128 + 2);
  char *after = run_list();
  assert_string_equal(before, after);
  free(before);
  free(after);
  run_free(&result);
}

static void draw_names_every_length(void **unused) {
  (void)unused;
  static const char *const bicycles[] = {"benchmark", "roadster",         "roadster_riderless",
                                         "recumbent", "recumbent_damped", "penny_farthing"};
  static const char *const names[] = {"L</tspan><tspan dy=\"4\" font-size=\"11\">r<",
                                      "L</tspan><tspan dy=\"4\" font-size=\"11\">f<",
                                      "L</tspan><tspan dy=\"4\" font-size=\"11\">s<",
                                      "R</tspan><tspan dy=\"4\" font-size=\"11\">r<",
                                      "R</tspan><tspan dy=\"4\" font-size=\"11\">f<",
                                      "Z</tspan><tspan dy=\"4\" font-size=\"11\">0<",
                                      "T</tspan><tspan dy=\"4\" font-size=\"11\">r<",
                                      "T</tspan><tspan dy=\"4\" font-size=\"11\">f<",
                                      "β"};
  for (size_t i = 0; i < KEY_COUNT(bicycles); i++) {
    char command[128];
    snprintf(command, sizeof command, "bicycle draw %s", bicycles[i]);
    run_result result = run_command(command);
    assert_int_equal(result.status, 0);
    for (size_t k = 0; k < KEY_COUNT(names); k++)
      if (!strstr(result.out, names[k])) fail_msg("%s: no %s", bicycles[i], names[k]);
    assert_null(strstr(result.out, "nan"));
    assert_non_null(strstr(result.out, "</svg>\n"));
    run_free(&result);
  }
}

typedef struct text_place {
  double x, y, half_width;
} text_place;

// The centred texts of a picture: their places and half of their widths, less than which no font
// takes. Returns how many.
static int read_texts(const char *svg, text_place *out, int room) {
  int count = 0;
  const char *at = svg;
  while (count < room && (at = strstr(at, "<text x=")) != NULL) {
    const char *end = strstr(at, "</text>");
    assert_non_null(end);
    assert_int_equal(sscanf(at, "<text x=\"%lf\" y=\"%lf\"", &out[count].x, &out[count].y), 2);
    int characters = 0;
    bool tag = false;
    for (; at < end; at++) {
      if (*at == '<') tag = true;
      if (!tag) characters++;
      if (*at == '>') tag = false;
    }
    out[count++].half_width = 0.22 * 15 * characters; // of the font's 15 pixels
  }
  return count;
}

static void draw_keeps_labels_apart(void **unused) {
  (void)unused;
  enum { ROOM = 64 };
  static const char *const bicycles[] = {"benchmark", "roadster",         "roadster_riderless",
                                         "recumbent", "recumbent_damped", "penny_farthing"};
  for (size_t i = 0; i < KEY_COUNT(bicycles); i++) {
    char command[128];
    text_place texts[ROOM];
    snprintf(command, sizeof command, "bicycle draw %s", bicycles[i]);
    run_result result = run_command(command);
    int count = read_texts(result.out, texts, ROOM);
    assert_true(count >= 14); // 10 lengths and angles, a scale, at least three parts
    for (int a = 0; a < count; a++)
      for (int b = 0; b < a; b++)
        if (fabs(texts[a].y - texts[b].y) < 15 &&
            fabs(texts[a].x - texts[b].x) < texts[a].half_width + texts[b].half_width)
          fail_msg("%s: texts overlap at %g, %g", bicycles[i], texts[a].x, texts[a].y);
    run_free(&result);
  }
}

static void help_starts_with_an_example(void **unused) {
  (void)unused;
  static const char *const commands[] = {"", " state", " ride", " linear", " stability", " draw"};
  for (size_t i = 0; i < KEY_COUNT(commands); i++) {
    char command[64], start[64];
    snprintf(command, sizeof command, "bicycle%s --help", commands[i]);
    snprintf(start, sizeof start, "Example: bicycle%s ", commands[i]);
    run_result result = run_command(command);
    assert_int_equal(result.status, 0);
    assert_true(strncmp(result.out, start, strlen(start)) == 0);
    assert_string_equal(result.err, "");
    run_free(&result);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(state_has_every_key),
      cmocka_unit_test(degrees_without_suffix_are_suspected),
      cmocka_unit_test(loads_of_the_benchmark),
      cmocka_unit_test(sae_turns_what_is_left_positive),
      cmocka_unit_test(linear_matrices_of_the_benchmark),
      cmocka_unit_test(stability_of_the_benchmark),
      cmocka_unit_test(slow_modes_have_names),
      cmocka_unit_test(the_end_of_the_search_is_told),
      cmocka_unit_test(a_giant_is_searched_far_enough),
      cmocka_unit_test(no_critical_speed_is_null),
      cmocka_unit_test(ride_writes_rows_at_multiples),
      cmocka_unit_test(ride_includes_its_end),
      cmocka_unit_test(ride_json_is_complete),
      cmocka_unit_test(ride_with_file_keeps_rows_out_of_json),
      cmocka_unit_test(a_fall_is_an_event),
      cmocka_unit_test(ride_in_sae_mirrors),
      cmocka_unit_test(an_interrupted_ride_leaves_nothing),
      cmocka_unit_test(draw_names_every_length),
      cmocka_unit_test(draw_keeps_labels_apart),
      cmocka_unit_test(help_starts_with_an_example),
  };
  return cmocka_run_group_tests(tests, run_enter_group, run_leave_group);
}
