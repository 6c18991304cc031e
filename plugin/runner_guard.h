// SPDX-License-Identifier: Apache-2.0
// Calls into MuJoCo that may go wrong, without its default manners: an error there prints, waits
// for Enter and exits; a warning writes MUJOCO_LOG.TXT into the current folder.
#ifndef RUNNER_GUARD_H
#define RUNNER_GUARD_H

#include <stdbool.h>

enum { GUARD_TEXT_SIZE = 256 };

// What MuJoCo said during a guarded call; the first text of each kind, in one line.
typedef struct guard_report {
  bool failed;                   // mju_error was called; the call did not return
  char error[GUARD_TEXT_SIZE];   //
  int warnings;                  // how often mju_warning was called
  char warning[GUARD_TEXT_SIZE]; //
} guard_report;

// Calls function(argument) and reports. An error leaves the function by longjmp: what it had
// allocated is lost, and so is the mjData it worked on, except for being deleted. May be nested;
// threads are independent. The handlers mju_user_error and mju_user_warning are set at the first
// call and pass on what is not said within a guarded call.
void guard_call(guard_report *report, void (*function)(void *), void *argument);

#endif
