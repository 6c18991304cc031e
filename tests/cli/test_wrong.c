// SPDX-License-Identifier: Apache-2.0
// Wrong command lines: exit code 2, one line on stderr that says what is wrong, nothing on stdout,
// and no file left behind.
#include "run.h"
#include "support/near.h"

// A start from which every option of `ride` but the wrong one is right.
#define RIDE "bicycle ride roadster --speed 6 --time 1 --sample 0.1 -o out.csv "

static const run_wrong commands[] = {
    // The program.
    {"bicycle", "command is missing"},
    {"bicycle nosuch", "'nosuch' is not a command"},
    {"bicycle ''", "not a command"},
    {"bicycle ../bin/bicycle", "not a command"},
    {"bicycle state/", "not a command"},
    {"bicycle --nosuch", "--nosuch"},
    // The bicycle.
    {"bicycle state --speed 5", "FILE is missing"},
    {"bicycle state nosuch --speed 5", "nosuch"},
    {"bicycle state nosuch.yml --speed 5", "nosuch.yml"},
    {"bicycle state folder --speed 5", "folder"},
    {"bicycle state ./folder --speed 5", "folder"},
    {"bicycle state '' --speed 5", "bicycle state"},
    {"bicycle state benchmark roadster --speed 5", "'roadster'"},
    {"bicycle state empty.yml --speed 5", "empty.yml"},
    {"timeout 10 bicycle state pipe.yml --speed 5", "pipe.yml: is a named pipe"},
    {"timeout 10 bicycle state /dev/..$(pwd)/pipe.yml --speed 5", "pipe.yml: is a named pipe"},
    {"bicycle state \"$(printf 'a\\nb').yml\" --speed 5", "a?b.yml"},
    {"bicycle linear nosuch.yml --speed 5", "nosuch.yml"},
    {"bicycle stability nosuch.yml", "nosuch.yml"},
    {"bicycle draw nosuch.yml", "nosuch.yml"},
    // Numbers.
    {"bicycle state roadster --speed 1.5abc", "--speed: '1.5abc'"},
    {"bicycle state roadster --speed nan", "--speed: 'nan'"},
    {"bicycle state roadster --speed inf", "'inf'"},
    {"bicycle state roadster --speed 1e999", "'1e999'"},
    {"bicycle state roadster --speed ''", "''"},
    {"bicycle state roadster --speed 5deg", "'5deg'"},
    {"bicycle state roadster --speed 5 --lean 5grad", "--lean: '5grad'"},
    {"bicycle state roadster --speed 5 --steer-rate ' 1'", "--steer-rate"},
    {"bicycle state roadster --speed 5 --steer 1e12", "--steer: 1e12 is beyond 100 turns"},
    {"bicycle state roadster --speed 5 --steer -36001deg", "--steer: -36001deg is beyond"},
    {"bicycle state roadster --speed 5 --lean 1e300", "--lean: 1e300 is beyond 100 turns"},
    {RIDE "--steer 1e12", "--steer: 1e12 is beyond 100 turns"},
    {RIDE "--lean-limit 1e12", "--lean-limit: 1e12 is beyond 100 turns"},
    {"bicycle linear roadster --speed 5 --lean 1e12", "--lean: 1e12 is beyond 100 turns"},
    {"bicycle turn roadster --speed 5 --steer 1e12", "--steer: 1e12 is beyond 100 turns"},
    {"bicycle basin roadster --speed 5 --steers 1e12:2e12:3", "--steers"},
    {"bicycle state roadster --speed 1e200", "too large to compute with"},
    {"bicycle state roadster --speed 5 --steer-rate 1e200", "too large to compute with"},
    {"bicycle state roadster --speed 5 --steer-torque 1e200", "too large to compute with"},
    {RIDE "--lean-rate 1e154", "too large to compute with"},
    {"bicycle state roadster --speed 5 --rider-offset 1cm", "--rider-offset"},
    {"bicycle stability roadster --speeds 0:10", "--speeds"},
    {"bicycle stability roadster --speeds 0:10:0", "--speeds"},
    {"bicycle stability roadster --speeds 0:10:1000000000000", "--speeds"},
    {"bicycle stability roadster --speeds 10:0:5", "--speeds"},
    {"bicycle stability roadster --search 10:0", "--search"},
    {"bicycle stability roadster --search -5:5", "--search"},
    // Options.
    {"bicycle state roadster", "--speed is missing"},
    {"bicycle linear roadster", "--speed is missing"},
    {"bicycle ride roadster --time 1 --sample 0.1 -o out.csv", "--speed is missing"},
    {RIDE "--json -o -", "--json and -o - both mean the standard output"},
    {"bicycle ride roadster --speed 6 --sample 0.1 -o out.csv", "--time is missing"},
    {"bicycle ride roadster --speed 6 --time 1 -o out.csv", "--sample is missing"},
    {"bicycle state roadster --speed", "--speed"},
    {"bicycle state roadster --speed 5 --nosuch", "--nosuch"},
    {"bicycle state roadster --speed 5 --s 1", "--s"},
    {"bicycle state roadster --speed 5 -q", "q"},
    {"bicycle state roadster --speed 5 --json=yes", "json"},
    {"bicycle state roadster --speed 5 --convention din", "--convention: 'din'"},
    // States.
    {"bicycle state roadster --speed 5 --lean 90deg", "no geometry"},
    {"bicycle state roadster_riderless --speed 5 --rider-offset 0.01", "rider"},
    // Rides.
    {"bicycle ride roadster --speed 6 --time -1 --sample 0.1 -o out.csv", "--time: -1"},
    {"bicycle ride roadster --speed 6 --time 0 --sample 0.1 -o out.csv", "--time: 0"},
    {"bicycle ride roadster --speed 6 --time 1 --sample 2 -o out.csv", "--sample 2 is longer"},
    {RIDE "--lean 90deg", "no geometry"},
    {RIDE "--lean 5.5", "--lean: 5.5 is beyond 90deg; degrees have the suffix deg"},
    {RIDE "--lean -91deg", "--lean: -91deg is beyond 90deg"},
    {"bicycle ride roadster --speed 6 --time 1 --sample 0.1 --lean 90deg", "no geometry"},
    {RIDE "--method euler", "--method: 'euler'"},
    {RIDE "--rtol -1", "--rtol"},
    {RIDE "--rtol 1e-30", "ride: rtol must be at least 8.9e-16\n"},
    {RIDE "--atol 0", "--atol"},
    {RIDE "--step 0.01", "--step is for --method rk4"},
    {RIDE "--method rk4 --rtol 1e-9", "--rtol"},
    {RIDE "--method rk4 --step 0.03", "ride: step must divide sample, the time between rows\n"},
    {RIDE "--sample 1e-12", "ride: sample must be at least a billionth of the duration\n"},
    {RIDE "--lean-limit 91deg", "--lean-limit"},
    {RIDE "--stop-at wall", "--stop-at: 'wall'"},
    {RIDE "--steer-torque 1 --rider-offset 0.01", "exclude each other"},
    {RIDE "--roll-torque 1 --input input.csv", "exclude each other"},
    {RIDE "--input nosuch.csv", "nosuch.csv"},
    {RIDE "--input folder", "folder"},
    {RIDE "--input empty.csv", "empty.csv"},
    {"timeout 10 " RIDE "--input pipe.yml", "pipe.yml: is a named pipe"},
    {RIDE "--input broken.csv", "broken.csv:3"},
    {"bicycle ride roadster_riderless --speed 6 --time 1 --sample 0.1 -o out.csv "
     "--rider-offset 0.01",
     "rider"},
    {"bicycle ride roadster_riderless --speed 6 --time 1 --sample 0.1 -o out.csv --input input.csv",
     "rider"},
    // Outputs.
    {"bicycle ride roadster --speed 6 --time 1 --sample 0.1 -o folder", "folder"},
    {"bicycle ride roadster --speed 6 --time 1 --sample 0.1 -o nosuch/out.csv", "nosuch/out.csv"},
    {"bicycle ride roadster --speed 6 --time 1 --sample 0.1 -o /dev/full",
     "/dev/full: No space left"},
    {"bicycle draw roadster -o folder", "folder"},
    {"bicycle draw roadster -o nosuch/x.svg", "nosuch/x.svg"},
    {"bicycle draw roadster -o /dev/full", "/dev/full: No space left"},
    {"bicycle draw roadster > /dev/full", "standard output: No space left"},
    {"bicycle state roadster --speed 5 > /dev/full", "No space left"},
    {"bicycle state roadster --speed 5 --json > /dev/full", "No space left"},
    {"bicycle stability roadster > /dev/full", "No space left"},
    {"ulimit -f 1; bicycle ride roadster --speed 6 --time 1 --sample 0.01 -o out.csv",
     "File too large"},
    {"ulimit -f 1; bicycle draw roadster -o out.svg", "out.svg: File too large"},
    {"bicycle --help > /dev/full", "No space left"},
    {"bicycle state --help > /dev/full", "No space left"},
};

static void every_wrong_command_is_refused(void **state) {
  (void)state;
  run_all_wrong(commands, sizeof commands / sizeof commands[0]);
}

// A wrong command leaves what stood under the name of its output.
static void an_old_output_survives(void **state) {
  (void)state;
  run_result result =
      run_command("echo old > out.csv; " RIDE "--lean 90deg; cat out.csv; rm out.csv");
  assert_string_equal(result.out, "old\n");
  run_free(&result);
}

static int enter(void **state) {
  (void)state;
  return run_enter_filled("mkdir folder && mkfifo pipe.yml && : > empty.yml && : > empty.csv &&"
                          "printf 'time,rider_offset\\n0,0\\n1,0.01\\n' > input.csv &&"
                          "printf 'time,steer_torque\\n0,0\\n1,x\\n' > broken.csv");
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(every_wrong_command_is_refused),
                                     cmocka_unit_test(an_old_output_survives)};
  return cmocka_run_group_tests(tests, enter, run_leave_group);
}
