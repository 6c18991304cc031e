// SPDX-License-Identifier: Apache-2.0
#include "terminal/command.h"

#include "terminal/number.h"

#include <bicycle/state.h>
#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { KEY_JSON = TERM_KEY_SHARED, KEY_CONVENTION, KEY_VERSION };

typedef struct wrapper {
  const char *example;
  void *input;
} wrapper;

const char *term_version(void) {
  return BICYCLE_VERSION;
}

static error_t parse_wrapper(int key, char *text, struct argp_state *state) {
  (void)text;
  const wrapper *wrapped = state->input;
  switch (key) {
  case ARGP_KEY_INIT:
    state->child_inputs[0] = wrapped->input;
    // Without this stream argp adds no second line to getopt's message and leaves the exit to us.
    state->err_stream = NULL;
    return 0;
  case 'h':
    fputs(wrapped->example, stdout);
    putchar('\n');
    setenv("ARGP_HELP_FMT", "no-dup-args-note", 0); // a footnote that says nothing here
    argp_state_help(state, stdout, ARGP_HELP_STD_HELP);
    return 0;
  case KEY_VERSION:
    printf("%s %s\n", term_program(), term_version());
    exit(TERM_DONE);
  default:
    return ARGP_ERR_UNKNOWN;
  }
}

void term_parse(const struct argp *argp, const char *example, int argc, char **argv, void *input) {
  static const struct argp_option options[] = {
      {"help", 'h', NULL, 0, "Show this help", -1},
      {"version", KEY_VERSION, NULL, 0, "Show the version", -1},
      {0},
  };
  const struct argp_child children[] = {{argp, 0, NULL, 0}, {0}};
  const struct argp root = {.options = options, .parser = parse_wrapper, .children = children};
  wrapper wrapped = {example, input};
  argp_err_exit_status = TERM_USAGE;
  int failed = argp_parse(&root, argc, argv, ARGP_NO_HELP, NULL, &wrapped);
  if (failed == ENOMEM) exit(term_fail(TERM_INVALID, "out of memory"));
  if (failed) exit(TERM_USAGE);
}

void term_usage(const char *format, ...) {
  char *text = NULL;
  va_list arguments;
  va_start(arguments, format);
  if (vasprintf(&text, format, arguments) < 0) text = NULL;
  va_end(arguments);
  term_message("%s (see %s --help)", text ? text : "wrong command line", term_program());
  free(text);
  exit(TERM_USAGE);
}

double term_number_of(const char *option, const char *text) {
  double value;
  if (!term_parse_number(&value, text)) term_usage("%s: '%s' is not a number", option, text);
  return value;
}

double term_positive_of(const char *option, const char *text) {
  double value = term_number_of(option, text);
  if (!(value > 0)) term_usage("%s: %s is not positive", option, text);
  return value;
}

double term_angle_of(const char *option, const char *text) {
  double value;
  if (!term_parse_angle(&value, text))
    term_usage("%s: '%s' is not an angle: radians, or degrees as in 5deg", option, text);
  if (fabs(value) > BIKE_LARGEST_ANGLE) term_usage("%s: %s is beyond 100 turns", option, text);
  return value;
}

double term_rate_of(const char *option, const char *text) {
  double value;
  if (!term_parse_angle(&value, text))
    term_usage("%s: '%s' is not a rate: rad/s, or degrees per second as in 5deg", option, text);
  return value;
}

void term_search_of(double out[2], const char *text) {
  if (!term_parse_interval(out, text) || out[0] < 0)
    term_usage("--search: '%s' is not LO:HI with 0 <= LO < HI", text);
}

void term_take_argument(const char **out, const char *text, const char *what) {
  if (*out) term_usage("one %s is enough: '%s' is one too many", what, text);
  *out = text;
}

bool term_ends_with(const char *text, const char *end) {
  size_t length = strlen(text), tail = strlen(end);
  return length > tail && strcmp(text + length - tail, end) == 0;
}

static error_t parse_file(int key, char *text, struct argp_state *state) {
  const char **file = state->input;
  switch (key) {
  case ARGP_KEY_ARG:
    term_take_argument(file, text, "FILE");
    return 0;
  case ARGP_KEY_END:
    if (!*file) term_usage("the bicycle's FILE is missing");
    return 0;
  default:
    return ARGP_ERR_UNKNOWN;
  }
}

const struct argp term_file_argp = {.parser = parse_file};

static error_t parse_show(int key, char *text, struct argp_state *state) {
  term_show *show = state->input;
  switch (key) {
  case KEY_JSON:
    show->json = true;
    return 0;
  case KEY_CONVENTION:
    if (!term_parse_convention(&show->convention, text))
      term_usage("--convention: '%s' is neither iso nor sae", text);
    return 0;
  default:
    return ARGP_ERR_UNKNOWN;
  }
}

static const struct argp_option show_options[] = {
    {"json", KEY_JSON, NULL, 0, "Print one JSON document", 8},
    {"convention", KEY_CONVENTION, "iso|sae", 0,
     "Signs of the output: steer, yaw, y left (iso, the default) or right positive (sae); inputs "
     "are always iso",
     8},
    {0},
};

const struct argp term_show_argp = {.options = show_options, .parser = parse_show};

static error_t parse_question(int key, char *text, struct argp_state *state) {
  (void)text;
  term_question *question = state->input;
  if (key != ARGP_KEY_INIT) return ARGP_ERR_UNKNOWN;
  state->child_inputs[0] = &question->file;
  state->child_inputs[1] = &question->show;
  return 0;
}

static const struct argp_child question_children[] = {
    {&term_file_argp, 0, NULL, 0}, {&term_show_argp, 0, NULL, 0}, {0}};

const struct argp term_question_argp = {.parser = parse_question, .children = question_children};
