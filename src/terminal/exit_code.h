// SPDX-License-Identifier: Apache-2.0
// What the programs of this project return to the shell.
#ifndef BICYCLE_TERMINAL_EXIT_CODE_H
#define BICYCLE_TERMINAL_EXIT_CODE_H

typedef enum term_exit {
  TERM_DONE = 0,    // done, or the two simulators agree
  TERM_FAILED = 1,  // the comparison was made and failed
  TERM_USAGE = 2,   // a wrong command line or input; an output that cannot be written
  TERM_INVALID = 3, // the run means nothing: NaN, solver failure, a warning of the engine
  TERM_BASELINE = 4 // the baseline is missing or does not fit
} term_exit;

#endif
