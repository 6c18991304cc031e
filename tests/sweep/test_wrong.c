// SPDX-License-Identifier: Apache-2.0
// Broken specs and command lines: exit code 2, one line that names file, line, column and key,
// nothing on stdout, and no file left behind.
#include "sweeps.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// A good spec: each broken one is an edit of it.
static const char good[] = "bicycle: roadster\n"                                   // 1
                           "seed: 1\n"                                             // 2
                           "draws: 2\n"                                            // 3
                           "sweep:\n"                                              // 4
                           "  speed: [4, 5]\n"                                     // 5
                           "  geometry.trail: {from: 0.02, to: 0.1, count: 3}\n"   // 6
                           "  parts.rider.mass: {uniform: [60, 80]}\n"             // 7
                           "  g: {normal: [9.81, 0.01]}\n"                         // 8
                           "outputs: [weave_speed, eps_max]\n"                     // 9
                           "search: [0, 20]\n"                                     // 10
                           "ride: {time: 30, settled: 0.01, start_speed: given}\n" // 11
                           "front: on_axis\n";                                     // 12

typedef struct edit {
  const char *from, *to;
  const char *says; // after "wrong.yml:"
} edit;

static const edit edits[] = {
    // Keys.
    {"seed: 1", "sead: 1", "2:1: sead: unknown key"},
    {"seed: 1", "seed: 1\nseed: 1", "3:1: seed: given twice"},
    {"bicycle: roadster\n", "", " key 'bicycle' is missing"},
    {"sweep:", "swept:", "4:1: swept: unknown key"},
    {"outputs: [weave_speed, eps_max]\n", "", " key 'outputs' is missing"},
    {"seed: 1\n", "", " key 'seed' is missing: an axis is drawn"},
    {"draws: 2\n", "", " key 'draws' is missing: an axis is drawn"},
    {"time: 30", "tome: 30", "11:8: tome: unknown key"},
    // The bicycle.
    {"roadster", "nosuch", "1:1: bicycle: nosuch: No such file"},
    {"roadster", "nosuch.yml", "1:1: bicycle: nosuch.yml: No such file"},
    {"roadster", "broken.yml", "1:1: bicycle: broken.yml:2: g: "},
    {"roadster", "[a]", "1:1: bicycle: must be a text"},
    // Numbers of their own.
    {"seed: 1", "seed: -1", "2:1: seed: must be a whole number"},
    {"seed: 1", "seed: 1.5", "2:1: seed: must be a whole number"},
    {"seed: 1", "seed: 1e300", "2:1: seed: must be a whole number"},
    {"draws: 2", "draws: 0", "3:1: draws: must be a whole number from 1"},
    {"draws: 2", "draws: many", "3:1: draws: 'many' is not a number"},
    {"search: [0, 20]", "search: [20, 0]", "10:1: search: must be [LOW, HIGH]"},
    {"search: [0, 20]", "search: [-1, 20]", "10:1: search: must be [LOW, HIGH]"},
    {"search: [0, 20]", "search: 20", "10:1: search: must be a list of 2 numbers"},
    {"search: [0, 20]", "search: [0, .inf]", "10:13: search: '.inf' is not finite"},
    {"time: 30", "time: 0.1", "11:8: time: is too short"},
    {"settled: 0.01", "settled: 0", "11:18: settled: must be positive"},
    {"start_speed: given", "start_speed: best", "11:33: start_speed: must be given or same_energy"},
    {"front: on_axis", "front: loose", "12:1: front: must be in_space or on_axis"},
    {"ride: {", "ride: 3 #{", "11:1: ride: must hold"},
    // Angles are in radians.
    {"speed: [4, 5]", "lean: [0.1, 10]",
     "5:3: lean: 10 must be in radians, between -pi/2 and pi/2; 10 deg are 0.174533"},
    {"speed: [4, 5]", "lean: {from: -10, to: 0.1, count: 3}",
     "5:3: lean: -10 must be in radians, between -pi/2 and pi/2; -10 deg are -0.174533"},
    {"speed: [4, 5]", "steer: {uniform: [0, 45]}",
     "5:3: steer: 45 must be in radians, between -pi and pi; 45 deg are 0.785398"},
    {"speed: [4, 5]", "property.head_angle: 68",
     "5:3: property.head_angle: 68 must be in radians, between 0 and pi"},
    {"speed: [4, 5]", "steer: {normal: [1e12, 1]}",
     "5:3: steer: 1e+12 must be in radians, within 100 turns"},
    {"speed: [4, 5]", "lean: {normal: [0, 1e12]}", "5:3: lean: 1e+12 must be in radians"},
    {"speed: [4, 5]", "lean: 5deg",
     "5:3: lean: '5deg' is not a number: angles are in radians, 5 deg are 0.0872665"},
    // Axes.
    {"  speed: [4, 5]", "  speed: [4, nan]", "5:14: speed: 'nan' is not finite"},
    {"  speed: [4, 5]", "  speed: nan", "5:3: speed: 'nan' is not finite"},
    {"  speed: [4, 5]", "  speed: []", "5:3: speed: the list is empty"},
    {"  speed: [4, 5]", "  speed: [4, '5']", "5:14: speed: must be a number, not a quoted text"},
    {"  speed: [4, 5]", "  speed: [4, [5]]", "5:15: speed: must be a number"},
    {"  speed: [4, 5]", "  speed: 4mps", "5:3: speed: '4mps' is not a number"},
    {"  speed: [4, 5]", "  speed:", "5:3: speed: must be a number"},
    {"  speed: [4, 5]", "  lean: 10deg", "5:3: lean: '10deg' is not a number"},
    {"  speed: [4, 5]", "  speed: 4\n  speed: 5", "6:3: speed: given twice"},
    {"  speed: [4, 5]", "  spede: 4", "5:3: spede: is neither a number of this bicycle's file"},
    {"  speed: [4, 5]", "  property.colour: 4", "5:3: property.colour: is neither"},
    {"parts.rider.mass", "parts.nobody.mass", "7:3: parts.nobody.mass: is neither"},
    {"parts.rider.mass", "mB", "7:3: mB: is neither a number of this"},
    {"from: 0.02, to: 0.1", "from: 0.1, to: 0.02", "6:3: geometry.trail: from 0.1 is above to"},
    {"from: 0.02, to: 0.1", "from: 0.1, to: 0.1", "6:3: geometry.trail: count 1 goes with"},
    {"count: 3", "count: 0", "6:41: count: must be a whole number from 1"},
    {"count: 3", "count: 1", "6:3: geometry.trail: count 1 goes with from = to"},
    {"count: 3", "count: -3", "6:41: count: must be a whole number"},
    {"count: 3", "count: 2.5", "6:41: count: must be a whole number"},
    {"count: 3", "count: 1e12", "6:41: count: must be a whole number from 1 to 1000000000"},
    {"count: 3", "count: 900000000", "4:1: sweep: 3600000000 points are more than 1000000000"},
    {", count: 3", "", "6:3: geometry.trail: key 'count' is missing"},
    {"count: 3", "count: 3, step: 1", "6:51: step: unknown key"},
    {"{uniform: [60, 80]}", "{uniform: [80, 60]}", "7:22: uniform: must be [LOW, HIGH]"},
    {"{uniform: [60, 80]}", "{uniform: [60]}", "7:22: uniform: must be a list of 2 numbers"},
    {"{uniform: [60, 80]}", "{uniform: [60, 80], normal: [1, 1]}", "7:3: parts.rider.mass: must h"},
    {"{uniform: [60, 80]}", "{}", "7:3: parts.rider.mass: must hold from, to and count"},
    {"{normal: [9.81, 0.01]}", "{normal: [9.81, 0]}", "8:7: normal: must be [MEAN, DEVIATION]"},
    {"{normal: [9.81, 0.01]}", "{normal: file}", "8:7: normal: the bicycle's file gives no unc"},
    {"sweep:\n", "sweep: {}\nold:\n", "4:1: sweep: holds no axis"},
    {"sweep:\n", "sweep: speed\nold:\n", "4:1: sweep: must hold"},
    {"roadster", "roadster_riderless", "7:3: parts.rider.mass: is neither"},
    {"roadster\n", "benchmark\n", "6:3: geometry.trail: is neither"},
    // Outputs.
    {"eps_max]", "top_speed]", "9:24: outputs: must be weave_speed, capsize_speed"},
    {"eps_max]", "weave_speed]", "9:24: outputs: 'weave_speed' is given twice"},
    {"[weave_speed, eps_max]", "[]", "9:1: outputs: the list is empty"},
    {"[weave_speed, eps_max]", "weave_speed", "9:1: outputs: must be a list"},
    {"  speed: [4, 5]\n", "", "8:1: outputs: 'eps_max' needs a speed"},
    {"  speed: [4, 5]\n", "  speed: 4\n  rider_offset: 0.01\n#", "#"}, // right: see below
    {"start_speed: given}\n", "start_speed: same_energy}\n#", "#"},    // right
    // YAML.
    {"seed: 1", "seed: &a 1", "2:1: seed: anchors are not accepted"},
    {"seed: 1", "seed: [1", "4:6: missing comma"},
    {"seed: 1", "\tseed: 1", "1:10: "},
    {"seed: 1", "seed: 1\n---\n", " more than one YAML document"},
};

static int count_lines(const char *text) {
  int lines = 0;
  for (; *text; text++) lines += *text == '\n';
  return lines;
}

static bool is_refused(const edit *e) {
  const char *at = strstr(good, e->from);
  if (!at) fail_msg("'%s' is not in the good spec", e->from);
  char text[2048], says[256];
  snprintf(text, sizeof text, "%.*s%s%s", (int)(at - good), good, e->to, at + strlen(e->from));
  snprintf(says, sizeof says, "bicycle sweep: wrong.yml:%s", e->says);
  sweep_write("wrong.yml", text);
  char *before = run_list();
  run_result result = run_command("bicycle sweep wrong.yml -o out");
  char *after = run_list();
  const bool right = result.status == 2 && count_lines(result.err) == 1 && !*result.out &&
                     strncmp(result.err, says, strlen(says)) == 0 && strcmp(before, after) == 0;
  if (!right)
    print_error("%s\n  exit %d; must say: %s\n  err: %s", e->to, result.status, says, result.err);
  free(before);
  free(after);
  run_free(&result);
  return right;
}

static void broken_specs(void **state) {
  (void)state;
  int failures = 0;
  for (size_t i = 0; i < sizeof edits / sizeof *edits; i++)
    if (edits[i].says[0] != '#') failures += !is_refused(&edits[i]);
  assert_int_equal(failures, 0);
}

// What the edits start from is right, and so are two of the edits.
static void the_good_spec(void **state) {
  (void)state;
  sweep_write("good.yml", good);
  sweep_run(0, "bicycle sweep good.yml -o good && rm good.*");
  char text[2048];
  for (size_t i = 0; i < sizeof edits / sizeof *edits; i++) {
    const edit *e = &edits[i];
    const char *at = strstr(good, e->from);
    if (e->says[0] != '#') continue;
    snprintf(text, sizeof text, "%.*s%s%s", (int)(at - good), good, e->to, at + strlen(e->from));
    sweep_write("good.yml", text);
    sweep_run(0, "bicycle sweep good.yml -o good && rm good.*");
  }
}

static void other_wrong_specs(void **state) {
  (void)state;
  static const struct {
    const char *text, *says;
  } specs[] = {
      {"bicycle: roadster\nsweep: {speed: 5, rider_offset: 0.01}\noutputs: [outcome]\n"
       "ride: {start_speed: same_energy}\n",
       "4:1: ride: start_speed same_energy and an axis rider_offset exclude each other"},
      {"bicycle: roadster\nseed: 1\nsweep: {speed: 5}\noutputs: [eps_max]\n",
       "2:1: seed: no axis is drawn at random"},
      {"bicycle: roadster_riderless\nsweep: {speed: 5, rider_offset: 0.1}\noutputs: [eps_max]\n",
       "2:19: rider_offset: no part of the bicycle is the rider"},
      {"bicycle: roadster_riderless\nsweep: {property.rider_forward: 0.1}\noutputs: [weave_speed]",
       "2:9: property.rider_forward: this bicycle has no such property"},
      {"", " the file is empty"},
      {"just words\n", "1: must hold"},
  };
  for (size_t i = 0; i < sizeof specs / sizeof *specs; i++) {
    char says[256];
    sweep_write("wrong.yml", specs[i].text);
    snprintf(says, sizeof says, "wrong.yml:%s", specs[i].says);
    run_all_wrong(&(run_wrong){"bicycle sweep wrong.yml -o out", says}, 1);
  }
}

static const run_wrong commands[] = {
    {"bicycle sweep", "SPEC.yml is missing"},
    {"bicycle sweep good.yml", "-o RESULT is missing"},
    {"bicycle sweep good.yml other.yml -o out", "'other.yml'"},
    {"bicycle sweep nosuch.yml -o out", "nosuch.yml: No such file"},
    {"bicycle sweep folder -o out", "folder: Is a directory"},
    {"bicycle sweep good.yml -o out --threads 0", "--threads: '0'"},
    {"bicycle sweep good.yml -o out --threads x", "--threads: 'x'"},
    {"bicycle sweep good.yml -o out --nosuch", "--nosuch"},
    {"bicycle sweep good.yml -o ''", "-o: ''"},
    {"bicycle sweep good.yml -o folder/", "-o: 'folder/'"},
    {"bicycle sweep good.yml -o nosuch/out", "nosuch/out.log: No such file"},
    {"bicycle sweep good.yml -o taken", "taken.log: Is a directory"},
    {"bicycle sweep good.yml -o foreign", "foreign.log: is not a log of bicycle sweep"},
    {"bicycle sweep good.yml -o out --shard 0/3", "--shard: '0/3': must be K/N"},
    {"bicycle sweep good.yml -o out --shard 4/3", "--shard: '4/3': must be K/N"},
    {"bicycle sweep good.yml -o out --shard 1", "--shard: '1': must be K/N"},
    {"bicycle sweep good.yml -o out --shard 1/2/3", "--shard: '1/2/3'"},
    {"bicycle sweep good.yml -o out --shard slurm", "SLURM_ARRAY_TASK_ID is not set"},
    {"SLURM_ARRAY_TASK_ID=x SLURM_ARRAY_TASK_MIN=1 SLURM_ARRAY_TASK_MAX=2 SLURM_ARRAY_TASK_COUNT=2 "
     "bicycle sweep good.yml -o out --shard slurm",
     "are not whole numbers"},
    {"SLURM_ARRAY_TASK_ID=3 SLURM_ARRAY_TASK_MIN=3 SLURM_ARRAY_TASK_MAX=7 SLURM_ARRAY_TASK_COUNT=2 "
     "bicycle sweep good.yml -o out --shard slurm",
     "give K/N yourself"},
    {"bicycle sweep merge", "no LOG is named"},
    {"bicycle sweep merge nosuch.log", "nosuch.log: No such file"},
    {"bicycle sweep merge folder", "folder: Is a directory"},
    {"bicycle sweep merge foreign.log", "foreign.log: is not a log of bicycle sweep"},
    {"bicycle sweep merge right.log right.log -o - --json", "standard output"},
    {"bicycle sweep merge right.log -o ./right.log", "./right.log: is one of the logs"},
    {"bicycle sweep merge right.log -o folder", "folder: Is a directory"},
    {"bicycle sweep merge right.log foreign.log", "foreign.log: is not a log"},
    {"bicycle sweep merge right.log other.log", "other.log: is of another sweep"},
    {"bicycle sweep merge right.log -o /dev/full", "/dev/full: No space left"},
    {"bicycle sweep names", "FILE is missing"},
    {"bicycle sweep names nosuch", "nosuch: No such file"},
    {"bicycle sweep good.yml -o right --fresh --json > /dev/full",
     "standard output: No space left"},
};

static void wrong_commands(void **state) {
  (void)state;
  sweep_write("good.yml", good);
  sweep_write("foreign.log", "time,lean\n0,1\n");
  sweep_write("other.yml", "bicycle: roadster\nsweep: {speed: 5}\noutputs: [eps_max]\n");
  sweep_run(0, "mkdir folder taken.log; bicycle sweep good.yml -o right && bicycle sweep other.yml "
               "-o other");
  run_all_wrong(commands, sizeof commands / sizeof *commands);
  sweep_run(0, "bicycle sweep merge right.log -o right.csv"); // right.log is still a log
}

static int enter(void **state) {
  run_enter_group(state);
  sweep_write("broken.yml", "parameterization: components\ng: heavy\n");
  return 0;
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(broken_specs),
      cmocka_unit_test(the_good_spec),
      cmocka_unit_test(other_wrong_specs),
      cmocka_unit_test(wrong_commands),
  };
  return cmocka_run_group_tests(tests, enter, run_leave_group);
}
