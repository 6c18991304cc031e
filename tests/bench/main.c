// SPDX-License-Identifier: Apache-2.0
// bicycle-bench: what things cost, as ratios within one run.
#include "cases.h"
#include "terminal/command.h"
#include "terminal/data.h"
#include "terminal/json.h"
#include "terminal/progress.h"
#include "terminal/table.h"

#include <math.h>

typedef struct options {
  const char *bicycle;
  bool json;
} options;

enum { KEY_JSON = TERM_KEY_FIRST };

static const struct argp_option OPTION_LIST[] = {
    {"json", KEY_JSON, NULL, 0, "Print one JSON document", 0}, {0}};

static error_t parse(int key, char *text, struct argp_state *state) {
  options *o = state->input;
  switch (key) {
  case KEY_JSON:
    o->json = true;
    return 0;
  case ARGP_KEY_ARG:
    term_take_argument(&o->bicycle, text, "FILE");
    return 0;
  default:
    return ARGP_ERR_UNKNOWN;
  }
}

static json_t *as_json(const bench_contest *c, const bench_result *r) {
  return json_pack("{s:s, s:s, s:s, s:o, s:o, s:o, s:o, s:o, s:o}", "question", c->question, "ours",
                   c->ours.name, "theirs", c->theirs.name, "ratio", term_json_number(r->ratio),
                   "at_most", term_json_number(c->at_most), "quartile_low",
                   term_json_number(r->low), "quartile_high", term_json_number(r->high), "ours_s",
                   term_json_number(r->ours), "theirs_s", term_json_number(r->theirs));
}

static void add_row(term_table *table, const bench_contest *c, const bench_result *r) {
  char ours[32], theirs[32], ratio[32], spread[48], limit[32];
  snprintf(ours, sizeof ours, "%.3g us", 1e6 * r->ours);
  snprintf(theirs, sizeof theirs, "%.3g us", 1e6 * r->theirs);
  snprintf(ratio, sizeof ratio, "%.3f", r->ratio);
  snprintf(spread, sizeof spread, "%.3f .. %.3f", r->low, r->high);
  if (isfinite(c->at_most))
    snprintf(limit, sizeof limit, "%.3g", c->at_most);
  else
    snprintf(limit, sizeof limit, "-");
  const char *cells[] = {c->question, ours, theirs, ratio, spread, limit};
  term_table_add(table, r->ratio <= c->at_most ? TERM_PLAIN : TERM_BAD, cells);
}

static bool report(const bench_contest contests[BENCH_CONTESTS], bool json) {
  static const term_column COLUMNS[] = {{"ratio of medians", TERM_LEFT}, {"ours", TERM_RIGHT},
                                        {"theirs", TERM_RIGHT},          {"ratio", TERM_RIGHT},
                                        {"quartiles", TERM_RIGHT},       {"asked", TERM_RIGHT}};
  term_table *table = term_table_create(COLUMNS, 6);
  json_t *list = json_array();
  for (int i = 0; i < BENCH_CONTESTS; i++) {
    bench_result r = bench_run(&contests[i]);
    add_row(table, &contests[i], &r);
    json_array_append_new(list, as_json(&contests[i], &r));
  }
  bool written = json ? term_json_write(json_pack("{s:o}", "contests", json_incref(list)), stdout)
                      : term_table_print(table, stdout);
  json_decref(list);
  term_table_free(table);
  return written;
}

int main(int argc, char **argv) {
  static const char EXAMPLE[] = "bicycle-bench --json";
  static const struct argp ARGP = {OPTION_LIST,
                                   parse,
                                   "[FILE]",
                                   "What a bicycle costs, in units of MuJoCo's work on the same "
                                   "bicycle, which needs a rider (default: the roadster).",
                                   NULL,
                                   NULL,
                                   NULL};
  options o = {.bicycle = "roadster"};
  term_begin("bicycle-bench");
  term_parse(&ARGP, EXAMPLE, argc, argv, &o);
  bike_bicycle bicycle;
  term_exit code = term_load_bicycle(&bicycle, NULL, o.bicycle);
  if (code) return code;
  const bike_state state = {.lean = 0.1, .steer = 0.05, .lean_rate = 0.1, .speed = 5};
  bench_cases *cases = bench_cases_create(&bicycle, &state);
  if (!cases) return TERM_INVALID;
  bench_contest contests[BENCH_CONTESTS];
  bench_contests(contests, cases);
  code = report(contests, o.json) ? TERM_DONE : TERM_INVALID;
  bench_cases_free(cases);
  return code;
}
