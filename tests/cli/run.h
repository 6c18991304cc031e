// SPDX-License-Identifier: Apache-2.0
// Runs commands as a user types them, in a folder of the test's own.
#ifndef BICYCLE_TESTS_CLI_RUN_H
#define BICYCLE_TESTS_CLI_RUN_H

#include <jansson.h>
#include <stddef.h>

// What a command answered. Free it with run_free.
typedef struct run_result {
  int status; // the exit code; 128 + its number for a signal
  char *out, *err;
} run_result;

// A new empty folder, removed by run_leave with all that is in it. Fails the test where it cannot
// be made.
void run_enter(void);
void run_leave(void);

// The same as fixtures of a group of tests: an empty folder, or one that a shell command fills, and
// its end.
int run_enter_group(void **state);
int run_enter_filled(const char *command);
int run_leave_group(void **state);

const char *run_folder(void);

// Runs a shell command there; BUILD/bin heads PATH.
run_result run_command(const char *command);
void run_free(run_result *result);

// A command line that is wrong, and what its message must hold.
typedef struct run_wrong {
  const char *command;
  const char *says;
} run_wrong;

// Runs every one of them; fails the test unless each ends with 2 and one line on stderr that says
// so, prints nothing else, and leaves the folder as it was.
void run_all_wrong(const run_wrong *commands, size_t count);

// Names in the folder, sorted, each followed by a line feed; free it.
char *run_list(void);

// Runs a command that must succeed.
void run_well(const char *command);

// A file of the folder as text, free it; fails the test where it is missing.
char *run_read(const char *name);

// How often a word occurs in a text.
int run_occurrences(const char *text, const char *word);

// Runs a command that must succeed and print one JSON document; free it with json_decref.
json_t *run_json(const char *command);

// A number in it; fails the test where there is none.
double run_number(const json_t *object, const char *key);

#endif
