// SPDX-License-Identifier: Apache-2.0
// Scenarios, files and engines made up for the tests of the comparator.
#ifndef TESTS_VALIDATE_SUPPORT_H
#define TESTS_VALIDATE_SUPPORT_H

#include <comparison.h>

// A folder of its own for a test, removed with everything in it by support_remove.
char *support_folder(void);
void support_remove(char *folder);

// Writes a text file "folder/name"; the path is allocated.
char *support_write(const char *folder, const char *name, const char *text);

// The whole file, allocated; NULL if there is none.
char *support_read(const char *path);

// A scenario of half a second that agrees in all layers, and its text.
extern const char support_scenario_text[];
void support_read_scenario(scenario *out, const char *folder, const char *text);

// The measurement of that name; the test fails if there is none.
const measurement *support_find(const comparison *c, const char *layer_name, const char *signal,
                                const char *metric);

// A comparison of a scenario text; `candidate`, unless NULL, takes the place of its candidate.
typedef struct support_run {
  char *folder;
  scenario scenario;
  comparison comparison;
} support_run;

support_run *support_open(const engine *candidate, const char *text);
void support_close(support_run *run);

// Measures and judges; the test fails on a problem.
comparison *support_play(support_run *run);

// The comparison failed, that layer first, and the cause holds that text.
void support_expect_failure(const comparison *c, const char *layer_name, const char *named);

#endif
