// SPDX-License-Identifier: Apache-2.0
// A:B:N of angles, with the limits of each command that takes them.
#include "run.h"
#include "support/near.h"

#define BASIN "bicycle basin roadster --speed 5.8 --time 2 "
#define FIGURES "bicycle figures roadster -o out --speeds 5:6:3 --inertia 0:0.2:3 --trail 0:0.1:3 "
#define CYCLE "bicycle cycle roadster "

static const char basin[] = "2 to 1001) from A > -180deg to B < 180deg, B > A";
static const char figures[] = "3 to 2001) from A >= 0deg to B < 90deg, B > A";
static const char cycle[] = "1 to 1000000) from A > 0deg to B < 90deg, B > A (one: A:A:1)";

static void limits_are_told(void **state) {
  (void)state;
  static const run_wrong commands[] = {
      {BASIN "--leans 0:1deg:1", basin},          {BASIN "--leans 1deg:1deg:1", basin},
      {BASIN "--leans 0:1deg:1002", basin},       {BASIN "--leans -180deg:1deg:5", basin},
      {BASIN "--steers 0:180deg:5", basin},       {BASIN "--steers 9deg:1deg:5", basin},
      {FIGURES "--leans 0:1deg:2", figures},      {FIGURES "--leans 0:1deg:2002", figures},
      {FIGURES "--leans -1deg:10deg:5", figures}, {FIGURES "--leans 0:90deg:5", figures},
      {CYCLE "--leans 0:10deg:5", cycle},         {CYCLE "--leans 10deg:90deg:5", cycle},
      {CYCLE "--leans 1deg:2deg:1", cycle},       {CYCLE "--leans 1deg:1deg:2", cycle},
      {CYCLE "--leans 1deg:2deg", cycle},         {CYCLE "--leans 1deg:2deg:3:4", cycle},
      {CYCLE "--leans 1deg:2grad:3", cycle},      {CYCLE "--leans 1deg:2deg:3.5", cycle},
  };
  run_all_wrong(commands, sizeof commands / sizeof commands[0]);
}

static void what_is_within_is_taken(void **state) {
  (void)state;
  run_well(BASIN "--leans 0:1deg:2 --steers -0.01:0.01:2");
  run_well(FIGURES "--leans 0:1deg:3");
  run_well(CYCLE "--leans 1deg:1deg:1");
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(limits_are_told),
      cmocka_unit_test(what_is_within_is_taken),
  };
  return cmocka_run_group_tests(tests, run_enter_group, run_leave_group);
}
