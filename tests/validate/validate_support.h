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

// The number in a column, by its header, and a row, from 0, of a CSV file.
double support_csv_value(const char *path, const char *column, int row);

// A copy of `text` with its first `from` replaced, which must be there; allocated. Without `from` a
// plain copy.
char *support_replace(const char *text, const char *from, const char *to);

// A folder for each test of a group: a fixture, and where it is meanwhile.
extern char *support_home;
int support_enter(void **state);
int support_leave(void **state);

// Runs bicycle-validate there; stdout and stderr go to the files "out" and "err". Returns its exit
// status; the test fails if a signal ended it.
int support_validate(const char *arguments);

// The file of that name there; NULL if there is none. Allocated.
char *support_output(const char *name);

// That it holds a text.
void support_expect_text(const char *name, const char *part);

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

// How many gates of a comparison fail.
size_t support_failed_gates(const gate_list *gates);

// The comparison failed, that layer first, and the cause holds that text.
void support_expect_failure(const comparison *c, const char *layer_name, const char *named);

// The same of a scenario text with another candidate, from opening to closing.
void support_expect_fault(const engine *candidate, const char *text, const char *layer_name,
                          const char *named);

// A ride of engine_mujoco whose mjcb_control is taken away half way, and put back at the end.
term_exit support_robbed_ride(trace *out, void *instance, const engine_ride *asked, problem *p);

#endif
