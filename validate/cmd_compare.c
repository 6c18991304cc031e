// SPDX-License-Identifier: Apache-2.0
// bicycle validate compare: two saved reports, metric by metric; nothing is played.
#include "cmd.h"

#include "baseline.h"
#include "terminal/command.h"
#include "terminal/json.h"

static const char example[] =
    "Example: bicycle validate compare before.json bicycle-report/report.json\n";

static const char documentation[] =
    "Compares the report B with the earlier report A, files or folders: which metrics are better, "
    "the same or worse, "
    "beyond a noise floor from the convergence study or from rounding. Timings are not compared.\v"
    "Exit status: 0 nothing is worse; 1 something is, or a gate or a scenario of A is missing in "
    "B; "
    "2 wrong usage; 4 a report is missing, is not "
    "one, or is of other rides.";

typedef struct arguments {
  const char *file[2];
  int count;
  bool json;
} arguments;

enum { KEY_JSON = TERM_KEY_FIRST };

static const struct argp_option options[] = {
    {"json", KEY_JSON, NULL, 0, "Print B as JSON, with the comparison in each gate", 1}, {0}};

static error_t parse(int key, char *text, struct argp_state *state) {
  arguments *args = state->input;
  switch (key) {
  case KEY_JSON:
    args->json = true;
    return 0;
  case ARGP_KEY_ARG:
    if (args->count == 2) term_usage("'%s' is one argument too many", text);
    args->file[args->count++] = text;
    return 0;
  case ARGP_KEY_END:
    if (args->count < 2) term_usage("two reports are needed, as in: compare A.json B.json");
    return 0;
  default:
    return ARGP_ERR_UNKNOWN;
  }
}

static term_exit compare(json_t *document[2], const arguments *args) {
  problem p = {""};
  term_exit code = baseline_match(document[1], document[0], &p);
  if (code != TERM_DONE) return term_fail(code, "%s: %s", args->file[0], p.text);
  if (!baseline_compare(document[1], document[0])) return term_fail(TERM_INVALID, "out of memory");
  if (!args->json)
    baseline_print(document[1], stdout);
  else if (!term_json_write(json_incref(document[1]), stdout))
    return term_fail(TERM_INVALID, "out of memory");
  return baseline_is_worse(document[1]) ? TERM_FAILED : TERM_DONE;
}

int cmd_compare(int argc, char **argv) {
  const struct argp argp = {options, parse, "A.json B.json", documentation, NULL, NULL, NULL};
  arguments args = {0};
  json_t *document[2] = {NULL, NULL};
  problem p = {""};
  term_exit code = TERM_DONE;
  term_parse(&argp, example, argc, argv, &args);
  for (int i = 0; i < 2 && code == TERM_DONE; i++)
    code = baseline_read(&document[i], args.file[i], &p);
  code = code == TERM_DONE ? compare(document, &args) : term_fail(code, "%s", p.text);
  for (int i = 0; i < 2; i++) json_decref(document[i]);
  return code;
}
