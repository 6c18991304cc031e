// SPDX-License-Identifier: Apache-2.0
// Texts from outside: names and paths that are no UTF-8, names that are too long, files that can be
// read once. JSON is UTF-8 whatever they hold.
#include "run.h"
#include "support/near.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define MODEL "\"" BICYCLE_SOURCE_DIR "/model/"

static void expect_name(const char *command, const char *name) {
  json_t *document = run_json(command);
  assert_string_equal(json_string_value(json_object_get(document, "bicycle")), name);
  json_decref(document);
}

// The name of a file that does not tell its own.
static void a_file_name_is_made_utf8(void **state) {
  (void)state;
  run_well("grep -v '^name' " MODEL
           "roadster/roadster.yml\" > \"$(printf 'a\\377\\303\\251b.yml')\"");
  expect_name("bicycle state \"$(printf 'a\\377\\303\\251b.yml')\" --speed 5 --json", "a?\u00e9b");
}

// Cut between characters: 62 bytes and one of two are 64 with the terminator.
static void a_long_name_is_cut_between_characters(void **state) {
  (void)state;
  char expected[64];
  run_well(
      "name=$(printf '%062d\u00e9\u00e9' 0); sed \"s/^parameters:.*/parameters: 'x$name'/\" " MODEL
      "benchmark/benchmark.yml\" > long.yml");
  snprintf(expected, sizeof expected, "x%062d", 0);
  expect_name("bicycle state ./long.yml --speed 5 --json", expected);
  run_well(
      "name=$(printf '%062d\u00e9\u00e9' 0); sed \"s/^parameters:.*/parameters: '$name'/\" " MODEL
      "benchmark/benchmark.yml\" > long.yml");
  snprintf(expected, sizeof expected, "%062d", 0);
  expect_name("bicycle state ./long.yml --speed 5 --json", expected);
}

static void a_path_is_shown_in_json(void **state) {
  (void)state;
  json_t *list = run_json("bicycle figures benchmark -o \"$(printf 'f\\377')\" --inertia 0:0.2:3 "
                          "--trail 0:0.1:3 --json");
  assert_string_equal(json_string_value(json_object_get(list, "folder")), "f\ufffd");
  assert_string_equal(json_string_value(json_object_get(list, "page")), "f\ufffd/index.html");
  json_decref(list);
  run_well("printf 'bicycle: roadster\\nsweep: {speed: 5}\\noutputs: [eps_max]\\n' > s.yml");
  json_t *sweep = run_json("bicycle sweep s.yml -o \"$(printf 's\\377')\" --json");
  assert_string_equal(json_string_value(json_object_get(sweep, "csv")), "s\ufffd.csv");
  json_decref(sweep);
}

// Overlong forms, surrogates, and what is beyond the last character.
static void what_json_refuses_is_no_text(void **state) {
  (void)state;
  static const char *const bytes[] = {"\\340\\200\\257", "\\355\\240\\200", "\\364\\220\\200\\200",
                                      "\\360\\200\\200\\257", "\\300\\257"};
  for (size_t i = 0; i < sizeof bytes / sizeof bytes[0]; i++) {
    char command[512];
    snprintf(command, sizeof command,
             "(printf '# %s\\n'; cat " MODEL "roadster/roadster.yml\") > bad.yml", bytes[i]);
    run_well(command);
    run_all_wrong(&(run_wrong){"bicycle state ./bad.yml --speed 5", "bad.yml:1: this is not UTF-8"},
                  1);
  }
  run_well("(printf '# \\355\\237\\277 \\364\\217\\277\\277 \\340\\240\\200\\n'; cat " MODEL
           "roadster/roadster.yml\") > good.yml && bicycle state ./good.yml --speed 5");
}

static void every_command_reads_a_file_once(void **state) {
  (void)state;
  static const char *const commands[] = {"state %s --speed 5",
                                         "ride %s --speed 5 --time 1 --sample 0.5",
                                         "linear %s --speed 5",
                                         "stability %s",
                                         "effects %s",
                                         "cycle %s --leans 1deg:2deg:2",
                                         "draw %s",
                                         "turn %s --speed 5 --rider-offset 0",
                                         "sweep names %s"};
  for (size_t i = 0; i < sizeof commands / sizeof commands[0]; i++) {
    char command[512];
    int used = snprintf(command, sizeof command, "cat " MODEL "roadster/roadster.yml\" | bicycle ");
    snprintf(command + used, sizeof command - (size_t)used, commands[i], "/dev/stdin");
    run_well(command);
  }
}

// What the shell has opened is read: process substitution, and a named pipe as standard input, even
// if its writer has gone by then.
static void pipes_of_the_shell_are_read(void **state) {
  (void)state;
  run_well("cat > read.sh <<'end'\n"
           "timeout 10 bicycle state <(cat " MODEL "roadster/roadster.yml\") --speed 5\nend\n"
           "bash read.sh");
  run_well("mkfifo p && { cat " MODEL "roadster/roadster.yml\" > p & } && "
           "{ sleep 0.2; timeout 10 bicycle state /dev/stdin --speed 5; } < p");
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_file_name_is_made_utf8),
      cmocka_unit_test(a_long_name_is_cut_between_characters),
      cmocka_unit_test(a_path_is_shown_in_json),
      cmocka_unit_test(what_json_refuses_is_no_text),
      cmocka_unit_test(every_command_reads_a_file_once),
      cmocka_unit_test(pipes_of_the_shell_are_read),
  };
  return cmocka_run_group_tests(tests, run_enter_group, run_leave_group);
}
