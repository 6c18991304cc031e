// SPDX-License-Identifier: Apache-2.0
// `bicycle mujoco mjcf FILE -o X/`: a folder of model, scene, README, bicycle file and picture,
// whole or not at all, which rides as the single file does.
#include "cli/run.h"
#include "support/near.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const run_wrong commands[] = {
    {"bicycle mujoco mjcf roadster -o nosuch/set/", "nosuch: No such file"},
    {"bicycle mujoco mjcf roadster -o file/", "file: Not a directory"},
    {"bicycle mujoco mjcf roadster -o file/set/", "file/set: Not a directory"},
    {"bicycle mujoco mjcf roadster -o full/", "also holds 'mine.txt'"},
    {"bicycle mujoco mjcf roadster -o nested/", "also holds 'scene.xml'"},
    {"bicycle mujoco mjcf roadster -o other/", "also holds 'benchmark."},
    {"bicycle mujoco mjcf roadster -o //", "also holds"},
    {"bicycle mujoco mjcf roadster -o /proc/set/", "/proc"},
    // Files of at most 10 kB: a disk that is full half-way.
    {"trap '' XFSZ; ulimit -f 20; bicycle mujoco mjcf roadster --no-picture -o set/",
     "set: File too large"},
    {"trap '' XFSZ; ulimit -f 20; bicycle mujoco mjcf benchmark --no-picture -o other/",
     "other: File too large"},
    {"bicycle mujoco mjcf nosuch -o set/", "nosuch"},
    {"bicycle mujoco mjcf roadster -o set", "nor is it a folder (X/)"},
    {"bicycle mujoco mjcf roadster -o set.xml --no-picture", "--no-picture"},
    {"bicycle mujoco mjcf roadster --no-picture", "--no-picture"},
    {"bicycle mujoco mjcf roadster -o set/ --speed 6 --lean 1.5", "roadster: the lean"},
    {"bicycle mujoco mjcf roadster_riderless -o set/ --moving-rider", "rider"},
};

static int enter(void **state) {
  (void)state;
  return run_enter_filled(
      "set -e; echo > file; mkdir full nested nested/scene.xml; echo > full/mine.txt; "
      "bicycle mujoco mjcf benchmark --no-picture -o other/");
}

static void every_wrong_command_is_refused(void **state) {
  (void)state;
  run_all_wrong(commands, sizeof commands / sizeof commands[0]);
}

// Runs a command that must succeed; its standard output, to be freed.
static char *output_of(const char *command) {
  run_result result = run_command(command);
  if (result.status != 0) fail_msg("%s: %s", command, result.err);
  free(result.err);
  return result.out;
}

static void expect(const char *command, const char *expected) {
  char *out = output_of(command);
  assert_string_equal(out, expected);
  free(out);
}

// What was there before a set that could not be written is there still.
static void an_earlier_set_survives(void **state) {
  (void)state;
  expect("cd other; sha256sum * > ../sums; cd ..; "
         "(trap '' XFSZ; ulimit -f 20; bicycle mujoco mjcf benchmark --root free --no-picture "
         "-o other/ 2>/dev/null); cd other; sha256sum --quiet -c ../sums; rm ../sums",
         "");
}

static const char *const whole = "README.md\nroadster.png\nroadster.xml\nroadster.yml\nscene.xml\n";

static void the_set_is_whole(void **state) {
  (void)state;
  run_result made = run_command("bicycle mujoco mjcf roadster -o set/");
  assert_int_equal(made.status, 0);
  assert_non_null(strstr(made.err, "MJCF refuses the inertia of 4 bodies"));
  run_free(&made);
  expect("ls -A set", whole);
  // The bicycle file is the very one, the picture a PNG of the size that is promised.
  expect(
      "cmp set/roadster.yml \"$(dirname $(command -v bicycle))\"/../share/bicycle/model/roadster/"
      "roadster.yml",
      "");
  expect("head -c 24 set/roadster.png | od -An -tu1 | tr -s ' \\n' ' '",
         " 137 80 78 71 13 10 26 10 0 0 0 13 73 72 68 82 0 0 5 0 0 0 3 32 "); // 1280x800
  // README.md names every file, where the numbers come from, the licence and what is a placeholder.
  char *readme = output_of("cat set/README.md");
  static const char *const words[] = {"roadster.xml",
                                      "scene.xml",
                                      "roadster.yml",
                                      "(roadster.png)",
                                      "Apache-2.0",
                                      "`rear_frame`",
                                      "1.11 m",
                                      "68 deg",
                                      "bicycle mujoco mjcf roadster -o set/",
                                      "Placeholders",
                                      "| rider | rear frame | 70 | 0.36, 0, 1.08 |"};
  for (size_t i = 0; i < sizeof words / sizeof words[0]; i++)
    if (!strstr(readme, words[i])) fail_msg("README.md does not say %s", words[i]);
  free(readme);
  expect("rm -r set; ls", "file\nfull\nnested\nother\n");
}

// The same rows, to the last digit, as the single file's, by the scene and by the model alone.
static void it_rides_as_the_single_file(void **state) {
  (void)state;
  static const char *const options[] = {"", "--root free", "--rolling contact",
                                        "--moving-rider --integrator implicit"};
  for (size_t i = 0; i < sizeof options / sizeof options[0]; i++) {
    char command[1000];
    // Without ground there is no contact: the model alone is for exact rolling.
    const char *alone = strstr(options[i], "contact") ? "scene" : "roadster";
    snprintf(command, sizeof command,
             "exec 2>/dev/null; set -e; rm -rf set; o='%s'; "
             "bicycle mujoco mjcf roadster $o --speed 6 --lean-rate 0.2 --no-picture -o set/; "
             "bicycle mujoco mjcf roadster $o --speed 6 --lean-rate 0.2 -o one.xml; "
             "for m in one.xml set/scene.xml set/%s.xml; do "
             "bicycle mujoco ride $m --time 0.5 --sample 0.01 | sha256sum; done | sort -u | wc -l; "
             "rm -r set one.xml",
             options[i], alone);
    expect(command, "1\n");
  }
}

// From another folder, and read back by import: the numbers of the file.
static void it_is_found_from_anywhere(void **state) {
  (void)state;
  expect(
      "bicycle mujoco mjcf benchmark --no-picture -o set/ && cd / && "
      "bicycle mujoco import \"$OLDPWD\"/set/scene.xml -o \"$OLDPWD\"/back.yml && cd - >/dev/null "
      "&& grep -c L_r back.yml; rm -r set back.yml",
      "1\n");
}

// An earlier set is replaced, files that are no more part of it too; an empty folder is filled.
static void an_earlier_set_is_replaced(void **state) {
  (void)state;
  expect("exec 2>/dev/null; set -e; mkdir set; bicycle mujoco mjcf roadster -o set/; "
         "bicycle mujoco mjcf roadster --no-picture -o set/; ls -A . set; "
         "grep -c png set/README.md || :; rm -r set",
         ".:\nfile\nfull\nnested\nother\nset\n\n"
         "set:\nREADME.md\nroadster.xml\nroadster.yml\nscene.xml\n0\n");
}

// Names of bicycle files that mean something elsewhere.
static void any_file_name_will_do(void **state) {
  (void)state;
  expect("exec 2>/dev/null; set -e; "
         "f=$(dirname $(command -v bicycle))/../share/bicycle/model/benchmark/benchmark.yml; "
         "for n in scene 'a <b>&|c' README .hidden; do cp $f \"$n.yml\"; "
         "bicycle mujoco mjcf \"./$n.yml\" --no-picture -o set/; ls -A set | tr '\\n' ' '; "
         "bicycle mujoco ride set/scene.xml --time 0.01 --sample 0.01 | wc -l; "
         "rm -r set \"$n.yml\"; done",
         "README.md bicycle.xml bicycle.yml scene.xml 3\n"
         "README.md a__b___c.xml a__b___c.yml scene.xml 3\n"
         "README.md bicycle.xml bicycle.yml scene.xml 3\n"
         "README.md _hidden.xml _hidden.yml scene.xml 3\n");
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_wrong_command_is_refused),
      cmocka_unit_test(an_earlier_set_survives),
      cmocka_unit_test(the_set_is_whole),
      cmocka_unit_test(it_rides_as_the_single_file),
      cmocka_unit_test(it_is_found_from_anywhere),
      cmocka_unit_test(an_earlier_set_is_replaced),
      cmocka_unit_test(any_file_name_will_do),
  };
  return cmocka_run_group_tests(tests, enter, run_leave_group);
}
