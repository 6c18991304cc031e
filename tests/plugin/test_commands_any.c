// SPDX-License-Identifier: Apache-2.0
// `bicycle mujoco ride` of models that are no bicycles, and its pictures, discs and sensors.
#include "cli/run.h"
#include "support/near.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define EXAMPLES BICYCLE_SOURCE_DIR "/plugin/examples/"
#define TIMES " --time 0.1 --sample 0.01 "
#define DISC "bicycle mujoco ride disc.xml -o out.csv" TIMES
#define ROADSTER "bicycle mujoco ride roadster --speed 6 -o out.csv" TIMES

static const run_wrong commands[] = {
    // What is said of bicycles alone.
    {DISC "--speed 2", "disc.xml: --speed and the like: only for a bicycle"},
    {DISC "--steer-torque 1", "disc.xml: --steer-torque: only for a bicycle"},
    {DISC "--lean-limit 1", "disc.xml: --lean-limit: only for a bicycle"},
    {DISC "--reach 1", "disc.xml: --reach: only for a bicycle"},
    {DISC "--convention sae", "disc.xml: --convention: only for a bicycle"},
    {DISC "--root free", "--root: disc.xml has its own"},
    {DISC "--timestep 0.003", "disc.xml: the sample interval"},
    {DISC "--picture out.csv", "does not end in .png"},
    {ROADSTER "--project", "--project: roadster is a bicycle"},
    {"bicycle mujoco ride bike.xml --project" TIMES, "--project: bike.xml is a bicycle"},
    // Starts and markers.
    {"bicycle mujoco ride slips.xml -o out.csv" TIMES, "slips.xml: keyframe 'test'"},
    {"bicycle mujoco ride slips.xml -o out.csv" TIMES, "--project puts it right"},
    {"bicycle mujoco ride unknown.xml -o out.csv" TIMES, "unrecognized object 'nosuch'"},
    {"bicycle mujoco ride zero.xml -o out.csv" TIMES, "zero.xml: rolling discs: a radius"},
    {"bicycle mujoco ride sizes.xml -o out.csv" TIMES, "sizes.xml: keyframe 'test'"},
    {"bicycle mujoco ride sizes.xml --project -o out.csv" TIMES, "sizes.xml: "},
    {"bicycle mujoco ride raft.xml -o out.csv" TIMES, "raft.xml: rolling discs: the ground's"},
    {"bicycle mujoco ride raft.xml -o out.csv" TIMES, "that can move (geom 'raft')"},
    {"bicycle mujoco ride disks.xml -o out.csv" TIMES, "disks.xml: a custom element's name"},
    {"bicycle mujoco ride disks.xml -o out.csv" TIMES, "rolling_driven (tuple 'rolling_disks')"},
    {"bicycle mujoco import disks.xml -o out.yml", "disks.xml: a custom element's name"},
    {"bicycle mujoco ride sways.xml -o out.csv" TIMES,
     "sways.xml: a numeric 'driven:JOINT' names no joint of the tuple rolling_driven (numeric "
     "'driven:ridr')"},
    // Pictures.
    {ROADSTER "--picture x.jpg", "--picture: 'x.jpg'"},
    {ROADSTER "--picture .png", "--picture: '.png'"},
    {ROADSTER "--picture -", "--picture: '-'"},
    {ROADSTER "--picture folder.png", "folder.png: Is a directory"},
    {ROADSTER "--picture nosuch/x.png", "nosuch/x.png: No such file"},
    {ROADSTER "--picture-at 0.05", "--picture is missing"},
    {ROADSTER "--size 100x100", "--picture is missing"},
    {ROADSTER "--camera side", "--picture is missing"},
    {ROADSTER "--picture x.png --picture-at 0.2", "--picture-at 0.2 is after the ride"},
    {ROADSTER "--picture x.png --picture-at -1", "--picture-at: -1"},
    {ROADSTER "--picture x.png --picture-at nan", "--picture-at: 'nan'"},
    {ROADSTER "--picture x.png --size 0x0", "--size: '0x0'"},
    {ROADSTER "--picture x.png --size 100", "--size: '100'"},
    {ROADSTER "--picture x.png --size 100x", "--size: '100x'"},
    {ROADSTER "--picture x.png --size x100", "--size: 'x100'"},
    {ROADSTER "--picture x.png --size -5x100", "--size: '-5x100'"},
    {ROADSTER "--picture x.png --size 100x5000", "--size: '100x5000'"},
    {ROADSTER "--picture x.png --size 99999999999999999999x9", "--size: '9"},
    {ROADSTER "--picture x.png --size 100x100x100", "--size: '100x100x100'"},
    {ROADSTER "--picture x.png --camera nosuch", "no camera 'nosuch'"},
    {"bicycle mujoco ride roadster --speed 6 -o x.png --picture x.png" TIMES, "both mean 'x.png'"},
};

static void every_wrong_command_is_refused(void **state) {
  (void)state;
  run_all_wrong(commands, sizeof commands / sizeof commands[0]);
}

// The disc and what becomes of it by one edit each.
static int enter(void **state) {
  (void)state;
  return run_enter_filled(
      "set -e; cp " EXAMPLES "disc.xml .; mkdir folder.png; "
      "edit() { sed \"$1\" disc.xml > $2; ! cmp -s disc.xml $2; }; "
      "edit 's/qvel=\"1.5/qvel=\"1.6/' slips.xml; "
      "edit 's/rolling_discs/rolling_disks/' disks.xml; "
      "sed 's/driven:rider/driven:ridr/; s|<custom>|<size nuserdata=\"3\"/>&|' " EXAMPLES
      "sway.xml > sways.xml; "
      "edit 's/objname=\"rim\" /objname=\"nosuch\"/' unknown.xml; "
      "edit 's/type=\"cylinder\" size=\"0.3 0.005\"/type=\"box\" size=\"0.3 0.3 0.01\"/' zero.xml; "
      "edit 's/objname=\"rim\" .>/&<element objtype=\"body\" objname=\"disc\" prm=\"0.2\"\\/>/' "
      "sizes.xml; "
      "edit 's/objname=\"rim\" .>/&<element objtype=\"body\" objname=\"disc\" prm=\"0.3\"\\/>/' "
      "twice.xml; "
      "edit 's/<worldbody>/&<body mocap=\"true\"><geom name=\"raft\" type=\"plane\" "
      "size=\"1 1 1\"\\/><\\/body>/; "
      "s/<tuple name=\"rolling_discs\">/&<element objtype=\"geom\" objname=\"raft\"\\/>/' "
      "raft.xml; "
      "edit 's/diaginertia=\"[^\"]*\"/diaginertia=\"1e-15 1e-15 1e-15\"/' light.xml; "
      "cp " EXAMPLES "bicycle.xml control.xml; "
      "sed 's/<key name=\"test\"/& ctrl=\"nan\"/' " EXAMPLES
      "bicycle_parts.xml > bicycle_parts.xml; "
      "bicycle mujoco mjcf benchmark --speed 5 --lean-rate 0.2 -o bike.xml");
}

static json_t *ride(const char *model, const char *options) {
  char command[512];
  snprintf(command, sizeof command, "bicycle mujoco ride %s %s --json", model, options);
  return run_json(command);
}

static double number_at(const json_t *document, const char *series, size_t row) {
  json_t *samples = json_object_get(json_object_get(document, "samples"), series);
  if (json_array_size(samples) <= row) fail_msg("no '%s' at %zu", series, row);
  return json_number_value(json_array_get(samples, row));
}

//---------------------------------- rows ----------------------------------------------------------

static void rows_are_named_after_joints(void **state) {
  (void)state;
  run_result result = run_command("bicycle mujoco ride disc.xml --time 1 --sample 0.5");
  assert_int_equal(result.status, 0);
  static const char header[] =
      "time,qpos:x,qpos:y,qpos:z,qpos:yaw,qpos:roll,qpos:spin,qvel:x,qvel:y,qvel:z,qvel:yaw,"
      "qvel:roll,qvel:spin,energy,disc:rim:slip,disc:rim:height,disc:rim:normal,"
      "sensor:rolling:rim:force:0,sensor:rolling:rim:force:1,sensor:rolling:rim:force:2,"
      "sensor:rolling:rim:lift\n";
  assert_memory_equal(result.out, header, strlen(header));
  assert_non_null(strstr(result.err, "disc.xml: not a bicycle: there is no body 'rear_frame'"));
  assert_non_null(strstr(result.err, "rim: never lifts; asks friction "));
  assert_non_null(strstr(result.err, "3 rows to 1 s, "));
  assert_non_null(strstr(result.err, " times real time"));
  run_free(&result);
  // 1.5 m/s for 1 s, straight on; a disc of 0.3 m; 2 kg
  json_t *it = ride("disc.xml", "--time 1 --sample 0.5");
  assert_near(number_at(it, "qpos:x", 2), 1.5, 1e-12);
  assert_near(number_at(it, "qpos:spin", 2), 5, 1e-11);
  assert_near(number_at(it, "disc:rim:normal", 2), 19.62, 1e-12);
  assert_near(number_at(it, "energy", 2), 2 * 9.81 * 0.3 + 1.5 * 2 * 1.5 * 1.5 / 2, 1e-12);
  assert_string_equal(json_string_value(json_object_get(it, "model")), "disc");
  assert_near(run_number(json_object_get(it, "end"), "time"), 1, 0);
  assert_true(run_number(it, "real_time_factor") > 0);
  json_decref(it);
}

// Free joints have seven and six numbers, driven joints what they give.
static void other_joints_have_their_columns(void **state) {
  (void)state;
  json_t *tricycle = ride(EXAMPLES "tricycle.xml", TIMES);
  assert_near(number_at(tricycle, "qpos:joint0:qw", 10), 1, 1e-12);
  assert_near(number_at(tricycle, "qvel:joint0:vx", 10), 3, 1e-12);
  assert_near(number_at(tricycle, "qvel:joint0:wz", 10), 0, 1e-12);
  assert_int_equal(json_array_size(json_object_get(tricycle, "discs")), 3);
  json_decref(tricycle);
  json_t *pogo = ride(BICYCLE_SOURCE_DIR "/tests/plugin/rolling_models/pogo.xml", TIMES);
  assert_near(number_at(pogo, "drive:jump:error", 10), 0, 1e-10);
  // 3 kg (g + w'')
  assert_near(number_at(pogo, "drive:jump:force", 10), 3 * (9.81 - 20 * sin(2)), 1e-8);
  const json_t *wheel = json_array_get(json_object_get(pogo, "discs"), 0);
  assert_string_equal(json_string_value(json_object_get(wheel, "name")), "wheel");
  const json_t *lifts = json_object_get(wheel, "lifts");
  assert_int_equal(json_array_size(lifts), 1);
  assert_near(json_number_value(json_array_get(lifts, 0)), asin(49.05 / 60) / 20, 1e-4);
  // the ground would have to pull with what is missing of g: at the rows, the strongest
  const json_t *pulled = json_array_get(json_object_get(pogo, "outside_physics"), 0);
  assert_string_equal(json_string_value(json_object_get(pulled, "disc")), "wheel");
  assert_string_equal(json_string_value(json_object_get(pulled, "kind")), "pulled");
  assert_near(run_number(pulled, "first"), asin(49.05 / 60) / 20, 1e-4);
  assert_true(run_number(pulled, "value") > 0);
  json_decref(pogo);
}

static void repeated_constraints_are_told_of(void **state) {
  (void)state;
  run_result result = run_command("bicycle mujoco ride twice.xml -o out.csv" TIMES "; rm out.csv");
  assert_non_null(strstr(result.err, "twice.xml: rolling discs: constraints repeat each other"));
  run_free(&result);
}

static void a_start_is_put_right(void **state) {
  (void)state;
  run_result result =
      run_command("bicycle mujoco ride slips.xml --project -o out.csv" TIMES "&& rm out.csv");
  assert_int_equal(result.status, 0);
  assert_non_null(strstr(result.err, "slips.xml: the start was put right"));
  run_free(&result);
}

//---------------------------------- invalid runs --------------------------------------------------

static void check_invalid(const char *command, const char *says) {
  char *before = run_list();
  run_result result = run_command(command);
  char *after = run_list();
  if (result.status != 3 || !strstr(result.err, says))
    fail_msg("%s: exit %d: %s", command, result.status, result.err);
  assert_string_equal(before, after);
  free(before);
  free(after);
  run_free(&result);
}

static void invalid_runs_end_with_3(void **state) {
  (void)state;
  check_invalid("bicycle mujoco ride control.xml" TIMES,
                "control.xml: MuJoCo raised a warning at 0");
  check_invalid("bicycle mujoco ride light.xml" TIMES, "singular");
  check_invalid("bicycle mujoco ride " EXAMPLES "slope.xml --timestep 0.2 --time 20 --sample 0.2",
                "'disc' is off the ground or slips");
}

//---------------------------------- discs and sensors of bicycles ---------------------------------

static void a_bicycle_tells_of_its_discs(void **state) {
  (void)state;
  json_t *it = ride("roadster", "--speed 6 --lean-rate 0.2" TIMES);
  json_t *discs = json_object_get(it, "discs");
  double slip = fmax(run_number(json_array_get(discs, 0), "slip"),
                     run_number(json_array_get(discs, 1), "slip"));
  assert_near(slip, run_number(it, "slip"), 0);
  assert_true(slip > 0 && slip < 1e-10);
  json_decref(it);
  // Thrown over by a torque of 5 kN m, it lifts.
  it = ride("roadster", "--speed 1 --roll-torque 5000 --time 1 --sample 0.01");
  json_t *events = json_object_get(it, "events");
  size_t lifts = 0, told = 0;
  for (size_t i = 0; i < json_array_size(events); i++)
    lifts += strstr(json_string_value(json_object_get(json_array_get(events, i), "reason")),
                    "lifts") != NULL;
  for (size_t i = 0; i < 2; i++)
    told +=
        json_array_size(json_object_get(json_array_get(json_object_get(it, "discs"), i), "lifts"));
  assert_int_equal(told, lifts);
  assert_true(lifts > 0);
  json_decref(it);
}

// A rider who sways by himself: what he gives is in the balance.
static void a_rider_s_work_is_counted(void **state) {
  (void)state;
  json_t *it = ride(EXAMPLES "sway.xml", "--time 1 --sample 0.1");
  const json_t *energy = json_object_get(it, "energy");
  assert_true(fabs(run_number(energy, "work")) > 0.01);
  assert_below(run_number(energy, "balance"), 1e-11);
  json_decref(it);
}

static void sensors_are_told_of(void **state) {
  (void)state;
  run_result made = run_command("bicycle mujoco mjcf roadster --speed 6 --lean-rate 0.2 "
                                "--no-picture -o set/");
  assert_int_equal(made.status, 0);
  run_free(&made);
  json_t *it = ride("set/scene.xml", "--sensors --time 2 --sample 0.01");
  json_t *sensors = json_object_get(it, "sensors"), *end = json_object_get(it, "end");
  static const char *const names[][2] = {
      {"lean", "lean"}, {"steer", "steer"}, {"speed", "speed"}, {"rolling:model:energy", "energy"}};
  for (int i = 0; i < 4; i++) {
    json_t *sensor = json_object_get(sensors, names[i][0]);
    double last = run_number(end, names[i][1]);
    assert_near(run_number(sensor, "end"), last, 1e-12 * fmax(1, fabs(last)));
    assert_true(run_number(sensor, "least") < run_number(sensor, "most"));
  }
  json_decref(it);
  it = ride("set/scene.xml", TIMES);
  assert_null(json_object_get(it, "sensors"));
  json_decref(it);
  run_result result = run_command("bicycle mujoco ride set/scene.xml --sensors -o out.csv" TIMES
                                  "; rm -r set out.csv");
  assert_non_null(strstr(result.err, "sensor speed: "));
  run_free(&result);
}

//---------------------------------- pictures ------------------------------------------------------

// The size that stands in a PNG.
static void check_size(const char *file, int width, int height) {
  char command[200], expected[40];
  snprintf(command, sizeof command,
           "head -c 24 %s | tail -c 8 | od -An -tu1 | awk '{print $3*256+$4, $7*256+$8}'", file);
  snprintf(expected, sizeof expected, "%d %d\n", width, height);
  run_result result = run_command(command);
  assert_string_equal(result.out, expected);
  run_free(&result);
}

static void pictures_are_rendered(void **state) {
  (void)state;
  run_result result = run_command(
      ROADSTER
      "--picture a.png --picture-at 0 && " ROADSTER "--picture b.png --size 320x200 && "
      "bicycle mujoco ride bike.xml -o out.csv --picture c.png --camera side --size 64x48" TIMES
      " && " DISC "--picture d.png --size 160x100 --json >/dev/null");
  if (result.status != 0) fail_msg("%s", result.err);
  run_free(&result);
  check_size("a.png", 1280, 800);
  check_size("b.png", 320, 200);
  check_size("c.png", 64, 48);
  check_size("d.png", 160, 100);
  result = run_command("rm a.png b.png c.png d.png out.csv");
  assert_int_equal(result.status, 0);
  run_free(&result);
}

// Of another moment another picture; of a ride that ended before, the last row, and a word.
static void pictures_are_of_their_moment(void **state) {
  (void)state;
  run_result result = run_command(
      "r() { bicycle mujoco ride roadster --speed 6 --lean-rate 0.5 --time 1 --sample 0.1 "
      "--size 64x48 -o out.csv --picture $1 --picture-at $2; }; "
      "r a.png 0.3; r b.png 0.25; r c.png 0; r d.png 0.3; "
      "cmp a.png b.png && ! cmp -s a.png c.png && cmp a.png d.png; s=$?; rm *.png out.csv; exit "
      "$s");
  if (result.status != 0) fail_msg("%s", result.err);
  run_free(&result);
  result = run_command("bicycle mujoco ride roadster --speed 0.5 --lean-rate 0.5 --time 10 "
                       "--sample 0.1 --lean-limit 30deg --size 64x48 -o out.csv --picture a.png "
                       "--picture-at 9; rm a.png out.csv");
  assert_int_equal(result.status, 0);
  assert_non_null(strstr(result.err, "a.png: the ride ended before; the picture is of "));
  run_free(&result);
}

// A disk that is full when the picture comes: the rows are kept, of the picture there is no trace.
static void half_a_picture_is_none(void **state) {
  (void)state;
  run_result result = run_command("trap '' XFSZ; ulimit -f 20; " DISC "--picture x.png; s=$?; "
                                  "ls out.csv x.png .*.tmp 2>/dev/null; rm out.csv; exit $s");
  assert_int_equal(result.status, 2);
  assert_string_equal(result.out, "out.csv\n");
  assert_non_null(strstr(result.err, "x.png: File too large"));
  run_free(&result);
}

// Nothing of a ride that is refused or of a picture that cannot be made, not even the rows before.
static void no_osmesa_is_said(void **state) {
  (void)state;
  const char *library = getenv("NO_OSMESA");
  if (!library || !*library) skip(); // a sanitizer must be loaded first
  char command[600];
  snprintf(command, sizeof command, "LD_PRELOAD=%s " ROADSTER "--picture x.png", library);
  check_invalid(command, "--picture: no OSMesa to render with (package libosmesa6)");
  snprintf(command, sizeof command, "LD_PRELOAD=%s bicycle mujoco mjcf roadster -o set/", library);
  check_invalid(command, "roadster: no OSMesa to render with (package libosmesa6)");
  snprintf(command, sizeof command,
           "LD_PRELOAD=%s bicycle mujoco mjcf roadster --no-picture -o set/ && rm -r set", library);
  run_result result = run_command(command);
  assert_int_equal(result.status, 0);
  run_free(&result);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_wrong_command_is_refused),
      cmocka_unit_test(rows_are_named_after_joints),
      cmocka_unit_test(other_joints_have_their_columns),
      cmocka_unit_test(repeated_constraints_are_told_of),
      cmocka_unit_test(a_start_is_put_right),
      cmocka_unit_test(invalid_runs_end_with_3),
      cmocka_unit_test(a_bicycle_tells_of_its_discs),
      cmocka_unit_test(a_rider_s_work_is_counted),
      cmocka_unit_test(sensors_are_told_of),
      cmocka_unit_test(pictures_are_rendered),
      cmocka_unit_test(pictures_are_of_their_moment),
      cmocka_unit_test(half_a_picture_is_none),
      cmocka_unit_test(no_osmesa_is_said),
  };
  return cmocka_run_group_tests(tests, enter, run_leave_group);
}
