// SPDX-License-Identifier: Apache-2.0
// Calls into MuJoCo that may go wrong, without its default manners: an error there prints, waits
// for Enter and exits; a warning writes MUJOCO_LOG.TXT into the current folder.
#ifndef RUNNER_GUARD_H
#define RUNNER_GUARD_H

#include "bicycle_mjcf.h"

#include <mujoco/mujoco.h>
#include <stdbool.h>

enum { GUARD_TEXT_SIZE = 256 };

// What MuJoCo said during a guarded call; the first text of each kind, in one line.
typedef struct guard_report {
  bool failed;                   // mju_error was called, or C++ found no memory: no return
  bool no_memory;                // the second, or the first for want of memory
  char error[GUARD_TEXT_SIZE];   //
  int warnings;                  // how often mju_warning was called
  char warning[GUARD_TEXT_SIZE]; //
} guard_report;

// Calls function(argument) and reports. An error leaves the function by longjmp: what it had
// allocated is lost, and so is the mjData it worked on, except for being deleted. May be nested;
// threads are independent. After C++ has found no memory (mj_loadXML, a GL driver) nothing is
// called any more, as locks may be held for ever: every call then fails. The handlers
// mju_user_error and mju_user_warning are set at the first call and pass on what is not said within
// a guarded call.
void guard_call(guard_report *report, void (*function)(void *), void *argument);

// The error of a call that failed; returns false.
bool guard_fail(mjcf_error *error, const guard_report *report);

// Whether a message of MuJoCo says that memory was short.
bool guard_tells_of_memory(const char *text);

// mj_makeData, mj_copyModel and mj_makeEmptyFileVFS; NULL or false when out of memory.
mjData *guard_make_data(const mjModel *model);
mjModel *guard_copy_model(const mjModel *model);
bool guard_make_file(mjVFS *vfs, const char *name, int size);

#endif
