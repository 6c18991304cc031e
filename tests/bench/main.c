// SPDX-License-Identifier: Apache-2.0
// bicycle-bench: what things cost, as ratios within one run.
#include "list.h"
#include "report.h"
#include "terminal/command.h"
#include "terminal/data.h"
#include "terminal/progress.h"

#include <stdlib.h>
#include <string.h>

typedef struct options {
  const char *bicycle, *only;
  bool json, quick, list;
} options;

enum { KEY_JSON = TERM_KEY_FIRST, KEY_QUICK, KEY_ONLY, KEY_LIST };

static const struct argp_option OPTION_LIST[] = {
    {"json", KEY_JSON, NULL, 0, "Print one JSON document", 0},
    {"only", KEY_ONLY, "NAME", 0, "Contests whose name is NAME or starts so, as in rhs-", 0},
    {"list", KEY_LIST, NULL, 0, "Print the contests' names", 0},
    {"quick", KEY_QUICK, NULL, 0, "Seconds instead of a minute: figures mean nothing", 0},
    {0}};

static error_t parse(int key, char *text, struct argp_state *state) {
  options *o = state->input;
  switch (key) {
  case KEY_JSON:
    o->json = true;
    return 0;
  case KEY_QUICK:
    o->quick = true;
    return 0;
  case KEY_ONLY:
    o->only = text;
    return 0;
  case KEY_LIST:
    o->list = true;
    return 0;
  case ARGP_KEY_ARG:
    term_take_argument(&o->bicycle, text, "FILE");
    return 0;
  default:
    return ARGP_ERR_UNKNOWN;
  }
}

static bool chosen(const bench_contest *contest, const options *o) {
  return !o->only || !strncmp(contest->name, o->only, strlen(o->only));
}

static void print_names(const bench_list *list) {
  for (int i = 0; i < list->count; i++) puts(list->contests[i].name);
}

// Runs what is chosen; the number of lines.
static size_t compete(bench_line *lines, const bench_list *list, const options *o) {
  bench_effort effort = o->quick ? bench_quick_effort() : bench_usual_effort();
  term_progress progress = {0};
  size_t count = 0;
  for (int i = 0; i < list->count; i++) {
    const bench_contest *c = &list->contests[i];
    if (!chosen(c, o)) continue;
    term_progress_show(&progress, c->name, (double)i / list->count);
    lines[count].contest = c;
    bench_run(&lines[count++].result, c, &effort);
  }
  term_progress_clear(&progress);
  return count;
}

static term_exit report(const bench_list *list, const options *o) {
  static bench_line lines[BENCH_MAX_CONTESTS];
  size_t count = compete(lines, list, o);
  if (count == 0) return term_fail(TERM_USAGE, "--only %s: no such contest (see --list)", o->only);
  bool written =
      o->json ? bench_print_json(lines, count, list->subject) : bench_print_table(lines, count);
  if (!written) return term_fail(TERM_INVALID, "out of memory");
  for (size_t i = 0; i < count; i++)
    if (lines[i].result.status == BENCH_REFUSED) return TERM_FAILED;
  return TERM_DONE;
}

int main(int argc, char **argv) {
  static const char EXAMPLE[] = "Example: bicycle-bench\n"
                                "         bicycle-bench --only rhs- --json\n";
  static const struct argp ARGP = {OPTION_LIST,
                                   parse,
                                   "[FILE]",
                                   "What a bicycle costs, in units of others' work on the same "
                                   "bicycle (default: the roadster). Exit status 1: a peer answers "
                                   "something else and was not timed.",
                                   NULL,
                                   NULL,
                                   NULL};
  options o = {0};
  term_begin("bicycle-bench");
  term_parse(&ARGP, EXAMPLE, argc, argv, &o);
  // a roll at a speed at which the roadster is stable, and a state where nothing vanishes
  static bench_subject subject = {
      .state = {.lean = 0.1, .steer = 0.05, .lean_rate = 0.1, .speed = 5},
      .ride_start = {.lean_rate = 0.2, .speed = 6},
      .ride_time = 10};
  term_exit code =
      term_load_bicycle(&subject.bicycle, &subject.model, o.bicycle ? o.bicycle : "roadster");
  if (code) return code;
  subject.quick = o.quick;
  static bench_list list;
  code = bench_list_open(&list, &subject) ? TERM_DONE : TERM_INVALID;
  if (!code && o.list)
    print_names(&list);
  else if (!code)
    code = report(&list, &o);
  bench_list_close(&list);
  return code;
}
