// SPDX-License-Identifier: Apache-2.0
// What the preloaded library and the driver share: a mapped file, inherited by number, so that
// nothing is lost whatever the process ends like.
#ifndef BICYCLE_TESTS_FAULTS_FAULT_LEDGER_H
#define BICYCLE_TESTS_FAULTS_FAULT_LEDGER_H

#include <stdatomic.h>

enum {
  LEDGER_DESCRIPTOR = 198,
  LEDGER_TEXT = 16384, // of a backtrace: a line "object(function+offset)" for each frame
  LEDGER_SITES = 65536
};

typedef struct fault_ledger {
  // Set by the driver.
  long first, last; // allocations that fail, counted from 1; 0: none
  int visits;       // list the first so many allocations of every call stack; 0: do not
  int frozen_clock; // the same time is told always, so that outputs compare
  // Written by the process.
  atomic_long count;         // allocations so far
  atomic_long failed;        // of which were made to fail
  int signal;                // that ended it, 0: none
  char failure[LEDGER_TEXT]; // who asked for the first allocation that failed
  char crash[LEDGER_TEXT];   // where the signal came
  atomic_long site_count;    // may exceed LEDGER_SITES
  long site[LEDGER_SITES];   // with `visits`: numbers of allocations
} fault_ledger;

#endif
