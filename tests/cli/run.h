// SPDX-License-Identifier: Apache-2.0
// Runs commands as a user types them, in a folder of the test's own.
#ifndef BICYCLE_TESTS_CLI_RUN_H
#define BICYCLE_TESTS_CLI_RUN_H

#include <jansson.h>

// What a command answered. Free it with run_free.
typedef struct run_result {
  int status; // the exit code; 128 + its number for a signal
  char *out, *err;
} run_result;

// A new empty folder, removed by run_leave with all that is in it. Fails the test where it cannot
// be made.
void run_enter(void);
void run_leave(void);
const char *run_folder(void);

// Runs a shell command there; BUILD/bin heads PATH.
run_result run_command(const char *command);
void run_free(run_result *result);

// Names in the folder, sorted, each followed by a line feed; free it.
char *run_list(void);

// Runs a command that must succeed and print one JSON document; free it with json_decref.
json_t *run_json(const char *command);

// A number in it; fails the test where there is none.
double run_number(const json_t *object, const char *key);

#endif
