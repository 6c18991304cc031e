// SPDX-License-Identifier: Apache-2.0
// bicycle validate bless: makes a report the baseline of later ones. Nothing else ever writes one.
#include "cmd.h"

#include "baseline.h"
#include "files/text.h"
#include "report_read.h"
#include "terminal/command.h"

#include <bicycle/output.h>
#include <string.h>

static const char example[] =
    "Example: bicycle validate bless\n"
    "         bicycle validate bless other-report -o baselines/main.json\n";

static const char documentation[] =
    "Makes a report (a folder or its report.json; ./bicycle-report without) the baseline of later "
    "runs, to be given to `bicycle validate --baseline`. A run that is invalid cannot be one.\v"
    "Exit status: 0 done; 2 wrong usage, or the file cannot be written; 3 the run is invalid; 4 "
    "there is no such report.";

typedef struct arguments {
  const char *report, *output;
} arguments;

static const struct argp_option options[] = {
    {"output", 'o', "FILE", 0, "The baseline (./bicycle-baseline.json)", 1}, {0}};

static error_t parse(int key, char *text, struct argp_state *state) {
  arguments *args = state->input;
  switch (key) {
  case 'o':
    args->output = text;
    return 0;
  case ARGP_KEY_ARG:
    term_take_argument(&args->report, text, "REPORT");
    return 0;
  default:
    return ARGP_ERR_UNKNOWN;
  }
}

// Byte for byte what the report holds: a baseline is a report.
static term_exit write_baseline(const json_t *document, const char *path) {
  bike_output output;
  bike_file_error error;
  if (bike_text_is_named_pipe(path)) return term_fail(TERM_USAGE, "%s: is a named pipe", path);
  int code = bike_output_begin(&output, path, &error);
  if (code) return term_fail(term_exit_of(code), "%s", error.text);
  bool written = !term_has_lost() &&
                 json_dumpf(document, output.stream, JSON_INDENT(2) | JSON_REAL_PRECISION(17)) == 0;
  fputc('\n', output.stream);
  if (!written && !ferror(output.stream)) {
    bike_output_abort(&output);
    return term_fail(TERM_INVALID, "out of memory");
  }
  code = bike_output_commit(&output, &error);
  return code ? term_fail(term_exit_of(code), "%s", error.text) : TERM_DONE;
}

static term_exit bless(const char *path, const char *output) {
  problem p = {""};
  json_t *document = NULL;
  term_exit code = baseline_read(&document, path, &p);
  if (code != TERM_DONE) return term_fail(code, "%s", p.text);
  if (strcmp(report_text(document, "verdict"), "invalid") == 0)
    code = term_fail(TERM_INVALID, "%s: the run is invalid", path);
  else
    code = write_baseline(document, output);
  if (code == TERM_DONE && !report_passed(document))
    term_message("%s: the simulators do not agree; blessed all the same", path);
  json_decref(document);
  return code;
}

int cmd_bless(int argc, char **argv) {
  const struct argp argp = {options, parse, "[REPORT]", documentation, NULL, NULL, NULL};
  arguments args = {.output = "bicycle-baseline.json"};
  term_parse(&argp, example, argc, argv, &args);
  term_exit code = bless(args.report ? args.report : "bicycle-report", args.output);
  if (code == TERM_DONE) printf("Baseline: %s\n", args.output);
  return code;
}
