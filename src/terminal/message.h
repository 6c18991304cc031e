// SPDX-License-Identifier: Apache-2.0
// One-line diagnostics on stderr, and how they end a program.
#ifndef BICYCLE_TERMINAL_MESSAGE_H
#define BICYCLE_TERMINAL_MESSAGE_H

#include "terminal/exit_code.h"

#include <stdbool.h>

// Names the program in messages and makes sure that results which could not be written to stdout
// (a full disk, a closed pipe) end the program with TERM_USAGE, and that a limit on the size of
// files is an error like a full disk. Call it first in main; `program` must stay valid.
void term_begin(const char *program);

// Notes that memory was short for a part of the output. Whatever the program makes of
// it, it then ends with TERM_INVALID, and says why.
void term_lose(void);
bool term_has_lost(void);

// The name in force, as in "bicycle state".
const char *term_program(void);

// "PROGRAM: text" and a line feed on stderr. Line feeds within the text become spaces, so that a
// message is one line whatever a file name holds.
void term_message(const char *format, ...) __attribute__((format(printf, 1, 2)));

// The same, and returns `code`: `return term_fail(TERM_USAGE, "...")`.
term_exit term_fail(term_exit code, const char *format, ...) __attribute__((format(printf, 2, 3)));

// How a program ends on an error of the library: TERM_USAGE where the input is to blame,
// TERM_INVALID where the computation failed, TERM_DONE for BIKE_OK.
term_exit term_exit_of(int code);

// Reports an error of the library about `subject` (a file or an option): "subject: text".
term_exit term_fail_bike(int code, const char *subject);

// Reports a failed system call, `number` being its errno: TERM_INVALID where memory is short,
// TERM_USAGE otherwise.
term_exit term_fail_system(int number, const char *subject);

#endif
