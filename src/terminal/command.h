// SPDX-License-Identifier: Apache-2.0
// Command lines with glibc's argp: help that starts with an example, one-line errors, exit code 2.
#ifndef BICYCLE_TERMINAL_COMMAND_H
#define BICYCLE_TERMINAL_COMMAND_H

#include "terminal/convention.h"
#include "terminal/message.h"

#include <argp.h>
#include <stdbool.h>

// Keys of options without a short form start here, beyond the characters.
enum { TERM_KEY_FIRST = 0x1000, TERM_KEY_SHARED = 0x2000 };

// A command of a program: `bicycle state` is run(argc, argv) with argv[0] = "bicycle state".
typedef struct term_command {
  const char *name;
  int (*run)(int argc, char **argv);
  const char *summary; // one line for the program's help
} term_command;

// Parses a command line; `example` (whole lines) heads the help. Adds --help and --version.
// Returns only if the command line is right; ends the program with TERM_USAGE and one line on
// stderr otherwise. `input` reaches the parser as state->input.
void term_parse(const struct argp *argp, const char *example, int argc, char **argv, void *input);

// The version of the project, as in "0.1.0".
const char *term_version(void);

// Reports a wrong command line in one line and ends the program with TERM_USAGE.
void term_usage(const char *format, ...) __attribute__((format(printf, 1, 2), noreturn));

// Values of options, for parsers; `option` is its name, as in "--time". A wrong value ends the
// program through term_usage.
double term_number_of(const char *option, const char *text);
double term_positive_of(const char *option, const char *text);
double term_angle_of(const char *option, const char *text); // within 100 turns
double term_rate_of(const char *option, const char *text);  // of an angle

// The value of --search: "LO:HI", m/s, with 0 <= LO < HI.
void term_search_of(double out[2], const char *text);

// Keeps the one positional argument of a command, called `what` in messages, as in "FILE".
void term_take_argument(const char **out, const char *text, const char *what);

// Whether a text ends in another and has something before it: a file's name and its kind.
bool term_ends_with(const char *text, const char *end);

// The bicycle's FILE, required: a child parser whose input is a `const char *` that is NULL.
extern const struct argp term_file_argp;

// How results are shown: --json and --convention, a child parser for commands that take both.
// Its input is a term_show.
typedef struct term_show {
  bool json;
  bike_convention convention;
} term_show;

extern const struct argp term_show_argp;

// A question about a bicycle: FILE, --json and --convention. A child parser for commands that take
// them; its input is a term_question.
typedef struct term_question {
  const char *file;
  term_show show;
} term_question;

extern const struct argp term_question_argp;

#endif
