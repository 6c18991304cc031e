// SPDX-License-Identifier: Apache-2.0
// The command lines of `bicycle mujoco`: right ones answer with the columns and keys that scripts
// rely on; wrong ones end with 2 and one line that names what is wrong, and leave no trace, neither
// a part of their output nor MuJoCo's log.
#include "cli/run.h"
#include "support/near.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// Rides from which every option but the wrong one is right.
#define TIMES "--time 0.1 --sample 0.01 "
#define RIDE "bicycle mujoco ride roadster --speed 6 -o out.csv " TIMES
#define MODEL_RIDE(file) "bicycle mujoco ride " file " -o out.csv " TIMES

static const run_wrong commands[] = {
    // The program.
    {"bicycle mujoco", "command is missing"},
    {"bicycle mujoco nosuch", "'nosuch' is not a command"},
    {"bicycle mujoco --nosuch", "--nosuch"},
    // mjcf.
    {"bicycle mujoco mjcf", "FILE is missing"},
    {"bicycle mujoco mjcf nosuch -o out.xml", "nosuch"},
    {"bicycle mujoco mjcf nosuch.yml -o out.xml", "nosuch.yml"},
    {"bicycle mujoco mjcf empty.yml -o out.xml", "empty.yml"},
    {"bicycle mujoco mjcf folder.xml -o out.xml", "folder.xml"},
    {"bicycle mujoco mjcf right.xml -o out.xml", "right.xml:"},
    {"bicycle mujoco mjcf roadster benchmark -o out.xml", "'benchmark'"},
    {"bicycle mujoco mjcf roadster -o out.txt", "--output: 'out.txt'"},
    {"bicycle mujoco mjcf roadster -o .xml", "--output: '.xml'"},
    {"bicycle mujoco mjcf benchmark -o folder.xml", "folder.xml: Is a directory"},
    {"bicycle mujoco mjcf benchmark -o folder.mjb", "folder.mjb: Is a directory"},
    {"bicycle mujoco mjcf benchmark -o nosuch/out.xml", "nosuch/out.xml"},
    {"bicycle mujoco mjcf benchmark -o nosuch/out.mjb", "nosuch/out.mjb"},
    {"bicycle mujoco mjcf benchmark -o full.xml", "full.xml: No space left"},
    {"bicycle mujoco mjcf benchmark -o full.mjb", "full.mjb: No space left"},
    {"bicycle mujoco mjcf benchmark > /dev/full", "standard output: No space left"},
    {"bicycle mujoco mjcf roadster -o out.xml --root ball", "--root: 'ball'"},
    {"bicycle mujoco mjcf roadster -o out.xml --timestep 0", "--timestep: 0"},
    {"bicycle mujoco mjcf roadster -o out.xml --speed nan", "--speed: 'nan'"},
    {"bicycle mujoco mjcf roadster -o out.xml --lean 0.1", "--speed is missing"},
    {"bicycle mujoco mjcf roadster -o out.xml --speed 6 --lean 1.5", "roadster: the lean"},
    {"bicycle mujoco mjcf roadster -o out.mjb --rider-offset 1e300", "not finite"},
    {"bicycle mujoco mjcf roadster_riderless -o out.mjb --rider-offset 0.1",
     "no part of the bicycle is the rider"},
    // Models that are broken, or no bicycles.
    {MODEL_RIDE("nosuch.xml"), "nosuch.xml: No such file"},
    {MODEL_RIDE("nosuch.mjb"), "nosuch.mjb: No such file"},
    {MODEL_RIDE("folder.xml"), "folder.xml"},
    {MODEL_RIDE("folder.mjb"), "folder.mjb"},
    {MODEL_RIDE("empty.xml"), "empty.xml"},
    {MODEL_RIDE("empty.mjb"), "empty.mjb"},
    {MODEL_RIDE("zeros.mjb"), "zeros.mjb"},
    {MODEL_RIDE("cut.xml"), "cut.xml: XML parse error"},
    {MODEL_RIDE("cut_header.mjb"), "cut_header.mjb: Model file has an incomplete header"},
    {MODEL_RIDE("cut.mjb"), "cut.mjb: Model file does not contain"},
    {MODEL_RIDE("cut_end.mjb"), "cut_end.mjb: Model file does not contain"},
    {MODEL_RIDE("long.mjb"), "long.mjb: Model file is too large"},
    {MODEL_RIDE("text.mjb"), "text.mjb"},
    {MODEL_RIDE("binary.xml"), "binary.xml"},
    {MODEL_RIDE("no_marker.xml"), "no_marker.xml: not a bicycle: there is no tuple"},
    {MODEL_RIDE("no_steer.xml --speed 5"), "only for a bicycle (not a bicycle: there is no joint"},
    {MODEL_RIDE("unmarked.xml"), "unmarked.xml: not a bicycle: there is no body 'rear_frame'"},
    {MODEL_RIDE("no_key.xml"), "no_key.xml: the model has no keyframe 'test'"},
    {MODEL_RIDE("nan_key.xml"), "nan_key.xml: keyframe 'test'"},
    {MODEL_RIDE("off_key.xml"), "off_key.xml: keyframe 'test'"},
    {MODEL_RIDE("turned_key.xml"), "turned_key.xml: the start has an angle of 2513.27 rad: beyond"},
    {MODEL_RIDE("integrator.xml"), "integrator.xml: XML Error: invalid keyword: 'RK5'"},
    {MODEL_RIDE("timestep.xml"), "timestep.xml: the model's timestep must be positive"},
    {MODEL_RIDE("inertia.xml"), "inertia.xml: XML Error: problem reading attribute 'data'"},
    // Rides.
    {"bicycle mujoco ride", "FILE is missing"},
    {"bicycle mujoco ride roadster --speed 6 --sample 0.01", "--time is missing"},
    {"bicycle mujoco ride roadster --speed 6 --time 0.1", "--sample is missing"},
    {"bicycle mujoco ride roadster -o out.csv " TIMES, "--speed is missing"},
    {MODEL_RIDE("right.xml") "--lean 0.1", "--speed is missing"},
    {MODEL_RIDE("right.xml") "--root free", "--root: right.xml"},
    {MODEL_RIDE("right.xml") "--rolling contact", "--rolling: right.xml"},
    {MODEL_RIDE("right.xml") "--rider-offset 0.01", "--rider-offset"},
    {MODEL_RIDE("right.xml") "--timestep 0.003", "right.xml: the sample interval"},
    {RIDE "--root ball", "--root: 'ball'"},
    {RIDE "--rolling slip", "--rolling: 'slip'"},
    {RIDE "--integrator RK5", "--integrator: 'RK5'"},
    {RIDE "--method rk4", "--method"},
    {RIDE "--timestep 0", "--timestep: 0"},
    {RIDE "--timestep -1", "--timestep: -1"},
    {RIDE "--timestep nan", "--timestep: 'nan'"},
    {RIDE "--timestep 1e-300", "timestep"},
    {RIDE "--sample 0.0105", "roadster: the sample interval must be a multiple"},
    {RIDE "--time 0.1005", "roadster: the duration must be a multiple"},
    {RIDE "--time 1e300", "duration"},
    {RIDE "--sample 1", "--sample 1 is longer"},
    {RIDE "--lean nan", "--lean: 'nan'"},
    {RIDE "--lean 90deg", "roadster: the lean"},
    {"bicycle mujoco ride roadster --speed 6 --lean 90deg " TIMES, "roadster: the lean"},
    {RIDE "--lean-limit 90deg", "lean limit must be above 0 and below 90 deg"},
    {RIDE "--json -o -", "--json and -o -"},
    {RIDE "--stop-at wall", "--stop-at: 'wall'"},
    {RIDE "--steer-torque 1 --roll-torque 1", "exclude each other"},
    {RIDE "--input nosuch.csv", "nosuch.csv"},
    {RIDE "--input broken.csv", "broken.csv:3: steer_torque"},
    {RIDE "--input short.csv", "short.csv:3: time: ends at"},
    {MODEL_RIDE("right.xml") "--input rider.csv", "rider.csv: rider_offset"},
    {MODEL_RIDE("left.xml") "--input rider.csv", "rider.csv: rider_offset"},
    {RIDE "--rolling contact --input rider.csv", "needs exact rolling"},
    {"bicycle mujoco mjcf roadster -o out.xml --moving-rider --rolling contact", "exact rolling"},
    {"bicycle mujoco mjcf roadster_riderless -o out.xml --moving-rider", "rider"},
    {"bicycle mujoco ride roadster_riderless --speed 6 --input rider.csv " TIMES, "rider"},
    {"bicycle mujoco ride roadster_riderless --speed 6 --rider-offset 0.01 " TIMES,
     "no part of the bicycle is the rider"},
    // Outputs.
    {"bicycle mujoco ride roadster --speed 6 -o folder.xml " TIMES, "folder.xml: Is a directory"},
    {"bicycle mujoco ride roadster --speed 6 -o nosuch/out.csv " TIMES, "nosuch/out.csv"},
    {"bicycle mujoco ride roadster --speed 6 -o /dev/full " TIMES, "/dev/full: No space left"},
    {"bicycle mujoco ride roadster --speed 6 > /dev/full " TIMES, "standard output: No space left"},
};

static void every_wrong_command_is_refused(void **state) {
  (void)state;
  run_all_wrong(commands, sizeof commands / sizeof commands[0]);
}

// A right model, and what becomes of it by one edit each. full.*: links to a full disk.
static int enter(void **state) {
  (void)state;
  return run_enter_filled(
      "set -e; bicycle mujoco mjcf benchmark --speed 5 --lean-rate 0.2 -o right.xml; "
      "bicycle mujoco mjcf benchmark --speed 5 --lean-rate 0.2 -o right.mjb; "
      "mkdir folder.xml folder.mjb; : > empty.yml; : > empty.xml; : > empty.mjb; "
      "head -c 100000 /dev/zero > zeros.mjb; head -c 3000 right.xml > cut.xml; "
      "head -c 8 right.mjb > cut_header.mjb; head -c 100000 right.mjb > cut.mjb; "
      "head -c -1 right.mjb > cut_end.mjb; { cat right.mjb; echo; } > long.mjb; "
      "cp right.xml text.mjb; cp right.mjb binary.xml; "
      "edit() { sed \"$1\" right.xml > $2; ! cmp -s right.xml $2; }; "
      "edit 's/rolling_discs/other/' no_marker.xml; edit 's/name=\"steer\"/name=\"st\"/' "
      "no_steer.xml; "
      "echo '<mujoco><worldbody><geom size=\"1\"/></worldbody></mujoco>' > unmarked.xml; "
      "edit '/<keyframe>/,/<.keyframe>/d' no_key.xml; "
      "edit 's/qpos=\"0/qpos=\"nan/' nan_key.xml; edit 's/qpos=\"0 0 0/qpos=\"0 0 0.1/' "
      "off_key.xml; "
      "edit 's/qpos=\"0 0 0 0 0 0 0 0/qpos=\"0 0 0 0 0 0 0 2513.2741228718346/' turned_key.xml; "
      "edit 's/integrator=\"RK4\"/integrator=\"RK5\"/' integrator.xml; "
      "edit 's/timestep=\"[^\"]*\"/timestep=\"0\"/' timestep.xml; "
      "edit 's/<custom>/<custom><numeric name=\"inertia:rear_frame\" data=\"x\"\\/>/' inertia.xml; "
      "bicycle mujoco mjcf roadster --moving-rider --speed 6 2>/dev/null | "
      "sed 's/axis=\"0 -1 0\"/axis=\"0 1 0\"/' > left.xml; "
      "ln -s /dev/full full.xml; ln -s /dev/full full.mjb; "
      "printf 'time,steer_torque\\n0,0\\n1,x\\n' > broken.csv; "
      "printf 'time,steer_torque\\n0,0\\n0.05,1\\n' > short.csv; "
      "printf 'time,rider_offset\\n0,0\\n1,0.01\\n' > rider.csv");
}

static void an_old_output_survives(void **state) {
  (void)state;
  run_result result = run_command(
      "echo old > out.csv; " RIDE "--lean 90deg; cat out.csv; rm out.csv; "
      "echo old > out.xml; bicycle mujoco mjcf roadster -o out.xml --speed 6 --lean 1.5;"
      "cat out.xml; rm out.xml");
  assert_string_equal(result.out, "old\nold\n");
  run_free(&result);
}

// The same ride by a bicycle's name, its MJCF and its compiled model: the same rows.
static void models_ride_as_the_bicycle_does(void **state) {
  (void)state;
  static const char *const rides[] = {"benchmark --speed 5 --lean-rate 0.2", "right.xml",
                                      "right.mjb", "right.xml --speed 5 --lean-rate 0.2"};
  static const char header[] = "time,x,y,yaw,lean,pitch,steer,lean_rate,steer_rate,speed,";
  char *first = NULL;
  for (size_t i = 0; i < sizeof rides / sizeof rides[0]; i++) {
    char command[128];
    snprintf(command, sizeof command, "bicycle mujoco ride %s " TIMES, rides[i]);
    run_result result = run_command(command);
    assert_int_equal(result.status, 0);
    assert_memory_equal(result.out, header, strlen(header));
    if (!first) first = strdup(result.out);
    assert_string_equal(result.out, first);
    run_free(&result);
  }
  free(first);
}

// A bicycle of a thousandth of the size: its drawing has 32 pieces of tyre like any other, and what
// MuJoCo thinks of its inertia is said by us, once.
static void a_tiny_bicycle_has_its_model(void **state) {
  (void)state;
  run_result result = run_command(
      "printf '%s\\n' 'parameterization: \"Meijaard2007\"' values: ' w: 1.02e-3' ' c: 0.08e-3' "
      "' lam: 0.314' ' g: 9.81' ' rR: 0.3e-3' ' mR: 2e-9' ' IRxx: 0.06e-15' ' IRyy: 0.12e-15' "
      "' xB: 0.3e-3' ' zB: -0.9e-3' ' mB: 85e-9' ' IBxx: 9.2e-15' ' IByy: 11e-15' "
      "' IBzz: 2.8e-15' ' IBxz: 2.4e-15' ' xH: 0.9e-3' ' zH: -0.7e-3' ' mH: 4e-9' "
      "' IHxx: 0.06e-15' ' IHyy: 0.06e-15' ' IHzz: 0.008e-15' ' IHxz: -0.0075e-15' "
      "' rF: 0.35e-3' ' mF: 3e-9' ' IFxx: 0.14e-15' ' IFyy: 0.28e-15' > tiny.yml; "
      "bicycle mujoco mjcf tiny.yml --speed 0.1 -o tiny.mjb; status=$?; "
      "bicycle mujoco ride tiny.yml --speed 0.1 " TIMES ">/dev/null; "
      "rm -f tiny.yml tiny.mjb; exit $status");
  if (result.status != 0) fail_msg("%s", result.err);
  if (strstr(result.err, "MuJoCo warning")) fail_msg("raw text of MuJoCo: %s", result.err);
  run_free(&result);
}

// What import took for what is said beside the file, which is a bicycle file.
static void import_tells_how_it_was_understood(void **state) {
  (void)state;
  static const char told[] =
      "bicycle mujoco import: travels along -y\n"
      "bicycle mujoco import: steer: joint 'hb', positive to the right\n"
      "bicycle mujoco import: rear wheel 'rearw': radius 0.34 m, from geom 'rtyre'\n"
      "bicycle mujoco import: front wheel 'frontw': radius 0.34 m, from geom 'ftyre'; at qpos 0 it "
      "is 0.01755 m above the ground\n"
      "bicycle mujoco import: wheelbase 1.06815 m, trail 0.069851 m, head angle 70.9414 deg\n";
  run_result result =
      run_command("bicycle mujoco import \"" BICYCLE_SOURCE_DIR
                  "/tests/plugin/import_models/company_bike.xml\" > company.yml; "
                  "bicycle stability company.yml --speeds 5:6:2 > /dev/null || echo unreadable; "
                  "rm company.yml");
  assert_string_equal(result.err, told);
  assert_string_equal(result.out, "");
  run_free(&result);
}

static void help_says_when_a_speed_is_required(void **state) {
  (void)state;
  run_result result = run_command("bicycle mujoco ride --help | tr -s ' \n' ' '; "
                                  "bicycle mujoco mjcf --help | tr -s ' \n' ' '");
  if (strstr(result.out, "m/s (required)")) fail_msg("%s", result.out);
  assert_non_null(strstr(result.out, "m/s (required with any other number of the state)"));
  assert_non_null(strstr(result.out, "the end of the model's validity"));
  run_free(&result);
  result = run_command("bicycle ride --help | tr -s ' \n' ' '");
  assert_non_null(strstr(result.out, "m/s (required)"));
  run_free(&result);
}

static void mjcf_prints_what_it_writes(void **state) {
  (void)state;
  run_result result = run_command(
      "bicycle mujoco mjcf benchmark --speed 5 --lean-rate 0.2 | cmp - right.xml && ls MUJOCO*");
  assert_string_equal(result.out, "");
  assert_non_null(strstr(result.err, "MUJOCO*"));
  run_free(&result);
}

static void ride_json_has_its_keys(void **state) {
  (void)state;
  static const char *const keys[] = {
      "bicycle",  "convention", "end_time",         "complete", "rows",
      "events",   "end",        "energy",           "slip",     "height_error",
      "timestep", "steps",      "real_time_factor", "samples",  "discs"};
  json_t *ride = run_json("bicycle mujoco ride right.mjb --json --convention sae " TIMES);
  for (size_t i = 0; i < sizeof keys / sizeof keys[0]; i++)
    if (!json_object_get(ride, keys[i])) fail_msg("no key '%s'", keys[i]);
  assert_string_equal(json_string_value(json_object_get(ride, "bicycle")), "benchmark");
  assert_string_equal(json_string_value(json_object_get(ride, "convention")), "sae");
  assert_int_equal(json_integer_value(json_object_get(ride, "rows")), 11);
  assert_int_equal(json_integer_value(json_object_get(ride, "steps")), 100);
  assert_near(run_number(ride, "timestep"), 0.001, 0);
  json_decref(ride);
}

// A ride that MuJoCo itself calls unstable: 3, with the rows before, and no log.
// Both engines say the same of a fall in which a wheel lifts; MuJoCo's times and values are those
// of steps of 1 ms, in which a force of this fall changes by some 0.5 %.
static void both_engines_find_the_same_outside(void **state) {
  (void)state;
  static const char options[] = "roadster --speed 0 --lean 0.05 --time 3 --sample 0.5 --json";
  char command[2][160];
  snprintf(command[0], sizeof command[0], "bicycle ride %s", options);
  snprintf(command[1], sizeof command[1], "bicycle mujoco ride %s", options);
  json_t *a = run_json(command[0]), *b = run_json(command[1]);
  json_t *marks = json_object_get(a, "outside_physics");
  json_t *others = json_object_get(b, "outside_physics");
  assert_int_equal(json_array_size(marks), 3);
  assert_int_equal(json_array_size(others), 3);
  for (size_t i = 0; i < 3; i++) {
    json_t *one = json_array_get(marks, i), *other = json_array_get(others, i);
    assert_true(json_equal(json_object_get(one, "wheel"), json_object_get(other, "wheel")));
    assert_true(json_equal(json_object_get(one, "kind"), json_object_get(other, "kind")));
    assert_near(run_number(other, "first"), run_number(one, "first"), 1e-4);
    assert_near(run_number(other, "duration"), run_number(one, "duration"), 2e-4);
    if (json_is_null(json_object_get(one, "value")))
      assert_true(json_is_null(json_object_get(other, "value")));
    else
      assert_near(run_number(other, "value"), run_number(one, "value"),
                  0.005 * run_number(one, "value"));
  }
  json_decref(a);
  json_decref(b);
}

static void an_invalid_run_keeps_its_rows(void **state) {
  (void)state;
  char *before = run_list();
  run_result result = run_command(
      "bicycle mujoco ride roadster --speed 6 --lean-rate 0.3 --root free --timestep 0.1 --time 10 "
      "--sample 0.1 --roll-torque 1e6");
  char *after = run_list();
  assert_int_equal(result.status, 3);
  assert_non_null(strstr(result.err, "roadster: MuJoCo raised a warning"));
  assert_memory_equal(result.out, "time,", 5);
  assert_string_equal(before, after);
  free(before);
  free(after);
  run_free(&result);
}

//---------------------------------- inputs with kinks ---------------------------------------------

// How far the steer of MuJoCo's ride is from the analytic one after a triangle of torque whose top
// is at `kink`; says whether MuJoCo's ride warned of rows within a timestep.
static double steer_error(const char *kink, bool *warned) {
  char command[512];
  snprintf(command, sizeof command,
           "printf 'time,steer_torque\\n0,0\\n%s,2\\n0.4,0\\n1,0\\n' > kink.csv && "
           "bicycle ride benchmark --speed 5 --input kink.csv --time 1 --sample 0.1 --json",
           kink);
  json_t *analytic = run_json(command);
  run_result result = run_command(
      "bicycle mujoco ride benchmark --speed 5 --input kink.csv --time 1 --sample 0.1 --json; "
      "status=$?; rm kink.csv; exit $status");
  assert_int_equal(result.status, 0);
  json_t *mujoco = json_loads(result.out, 0, NULL);
  assert_non_null(mujoco);
  *warned = strstr(result.err, "kink.csv: time: RK4 loses its order") != NULL;
  double error = fabs(run_number(json_object_get(mujoco, "end"), "steer") -
                      run_number(json_object_get(analytic, "end"), "steer"));
  json_decref(analytic);
  json_decref(mujoco);
  run_free(&result);
  return error;
}

// MuJoCo's steps do not stop at the rows of an input, the analytic ride's do: rows at multiples of
// the timestep cost nothing, others are told of, and for a reason.
static void rows_within_a_timestep_are_told_of(void **state) {
  (void)state;
  bool warned;
  double error = steer_error("0.2", &warned);
  assert_false(warned);
  assert_near(error, 0, 1e-11); // as a ride without input
  error = steer_error("0.2004", &warned);
  assert_true(warned);
  print_message("steer error with a kink within a timestep: %.1e rad\n", error);
  assert_true(error > 1e-10); // or there would be nothing to tell
}

//---------------------------------- a rider who moves ---------------------------------------------

static const char sway[] =
    "printf 'time,rider_offset\\n0,0\\n0.3,0.02\\n0.7,-0.01\\n1,0\\n' > sway.csv; ";

static json_t *ride_swaying(const char *ride) {
  char command[512];
  snprintf(command, sizeof command,
           "%s %s --input sway.csv --time 1 --sample 0.1 --json; rm -f sway.csv", sway, ride);
  return run_json(command);
}

static void check_swaying(json_t *ride, const json_t *analytic) {
  json_t *is = json_object_get(ride, "end"), *should = json_object_get(analytic, "end");
  assert_near(run_number(is, "lean"), run_number(should, "lean"), 1e-10);
  assert_near(run_number(is, "steer"), run_number(should, "steer"), 1e-10);
  assert_near(run_number(json_object_get(ride, "energy"), "balance"), 0, 1e-11);
  json_decref(ride);
}

// By the bicycle's name, and in a model written for it.
static void a_rider_moves_as_his_input_says(void **state) {
  (void)state;
  json_t *analytic = ride_swaying("bicycle ride roadster --speed 6");
  assert_true(fabs(run_number(json_object_get(analytic, "end"), "lean")) > 0.001);
  check_swaying(ride_swaying("bicycle mujoco ride roadster --speed 6"), analytic);
  check_swaying(ride_swaying("bicycle mujoco mjcf roadster --speed 6 --moving-rider -o sway.xml; "
                             "bicycle mujoco ride sway.xml --speed 6"),
                analytic);
  check_swaying(ride_swaying("bicycle mujoco mjcf roadster --speed 6 --moving-rider -o sway.mjb; "
                             "bicycle mujoco ride sway.mjb"),
                analytic);
  json_decref(analytic);
  run_result result = run_command("rm sway.xml sway.mjb");
  assert_int_equal(result.status, 0);
  run_free(&result);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_wrong_command_is_refused),
      cmocka_unit_test(an_old_output_survives),
      cmocka_unit_test(models_ride_as_the_bicycle_does),
      cmocka_unit_test(a_tiny_bicycle_has_its_model),
      cmocka_unit_test(import_tells_how_it_was_understood),
      cmocka_unit_test(help_says_when_a_speed_is_required),
      cmocka_unit_test(mjcf_prints_what_it_writes),
      cmocka_unit_test(ride_json_has_its_keys),
      cmocka_unit_test(both_engines_find_the_same_outside),
      cmocka_unit_test(an_invalid_run_keeps_its_rows),
      cmocka_unit_test(a_rider_moves_as_his_input_says),
      cmocka_unit_test(rows_within_a_timestep_are_told_of),
  };
  return cmocka_run_group_tests(tests, enter, run_leave_group);
}
