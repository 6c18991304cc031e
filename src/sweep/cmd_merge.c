// SPDX-License-Identifier: Apache-2.0
// bicycle sweep merge: the table of a sweep from the logs of its shards.
#include "cmd.h"

#include "merge.h"
#include "terminal/command.h"
#include "terminal/json.h"

#include <bicycle/error.h>
#include <string.h>

static const char example[] = "Example: bicycle sweep merge map.*of8.log -o map.csv\n";

static const char documentation[] =
    "Writes the table of a sweep, one row a point in the order of the points, from its logs: those "
    "of all shards, or of one run. The same table comes out whatever the shards, ranks, threads "
    "and restarts. Says which points are missing or contradictory; the table is then not written.\v"
    "Exit status: 0 written; 1 points are missing or contradictory; 2 wrong usage or input.";

typedef struct arguments {
  char **paths; // of argv
  int count;
  const char *output;
  bool partial, json;
} arguments;

enum { KEY_PARTIAL = TERM_KEY_FIRST, KEY_JSON };

static error_t parse(int key, char *text, struct argp_state *state) {
  arguments *args = state->input;
  switch (key) {
  case 'o':
    args->output = text;
    return 0;
  case KEY_PARTIAL:
    args->partial = true;
    return 0;
  case KEY_JSON:
    args->json = true;
    return 0;
  case ARGP_KEY_ARGS:
    args->paths = state->argv + state->next;
    args->count = state->argc - state->next;
    return 0;
  case ARGP_KEY_END:
    if (args->count == 0) term_usage("no LOG is named");
    if (args->json && args->output && strcmp(args->output, "-") == 0)
      term_usage("--json and -o - both write to the standard output");
    return 0;
  default:
    return ARGP_ERR_UNKNOWN;
  }
}

static const struct argp_option options[] = {
    {"output", 'o', "OUT.csv", 0, "The table; - is the standard output (without: only report)", 1},
    {"partial", KEY_PARTIAL, NULL, 0, "Write what there is, even where points are missing", 1},
    {"json", KEY_JSON, NULL, 0, "Print one JSON document", 8},
    {0},
};

static bool print_json(const sweep_merged *m, bool written) {
  return term_json_write(
      json_pack("{s:I, s:I, s:I, s:s, s:I, s:I, s:I, s:I, s:b}", "points", (json_int_t)m->points,
                "present", (json_int_t)m->present, "missing", (json_int_t)(m->points - m->present),
                "missing_points", m->gaps, "contradictory", (json_int_t)m->contradictory,
                "repeated", (json_int_t)m->repeated, "damaged_lines", (json_int_t)m->damaged,
                "failed", (json_int_t)m->failed, "written", written),
      stdout);
}

static void say(const sweep_merged *m, const arguments *args) {
  if (sweep_is_whole(m) && !args->output && !args->json)
    term_message("all %ld points are there: -o OUT.csv writes the table", m->points);
  if (m->present < m->points)
    term_message("%ld of %ld points are missing: %s", m->points - m->present, m->points, m->gaps);
  if (m->contradictory)
    term_message("%ld records are contradictory; the first: %s", m->contradictory, m->conflict);
  if (m->repeated) term_message("%ld points were done twice, with the same result", m->repeated);
  if (m->damaged) term_message("%ld damaged lines were passed over", m->damaged);
  if (m->failed)
    term_message("%ld of %ld points lack outputs: column 'error' says why", m->failed, m->points);
}

int cmd_merge(int argc, char **argv) {
  const struct argp argp = {options, parse, "LOG...", documentation, NULL, NULL, NULL};
  arguments args = {0};
  term_parse(&argp, example, argc, argv, &args);
  sweep_merged merged;
  bike_file_error error;
  const int code = sweep_merge(&merged, (const char *const *)args.paths, args.count, args.output,
                               args.partial, &error);
  if (code) return term_fail(term_exit_of(code), "%s", error.text);
  const bool whole = sweep_is_whole(&merged);
  say(&merged, &args);
  if (args.json &&
      !print_json(&merged, args.output && merged.contradictory == 0 && (whole || args.partial)))
    return term_fail_bike(BIKE_ERROR_MEMORY, "--json");
  return whole ? TERM_DONE : TERM_FAILED;
}
