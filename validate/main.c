// SPDX-License-Identifier: Apache-2.0
// bicycle-validate: plays scenarios in two simulators and says whether they agree.
#include "baseline.h"
#include "cmd.h"
#include "folder.h"
#include "report.h"
#include "suite.h"
#include "terminal/command.h"
#include "terminal/json.h"
#include "terminal/number.h"
#include "terminal/table.h"
#include "terminal/threads.h"

#include <string.h>

static const char example[] = "Example: bicycle validate\n"
                              "         bicycle validate benchmark_m1 my.yml -o report --all\n"
                              "         bicycle validate --baseline before.json\n"
                              "         bicycle validate list | compare | bless\n";

static const char documentation[] =
    "Plays scenarios in two simulators, compares what comes out with the limits of the scenario, "
    "prints the verdict and writes a report. SCENARIO is a file or the name of a shipped one; all "
    "shipped ones without. `list` shows these, `compare` compares two saved reports, `bless` makes "
    "a report the baseline of later runs.\v"
    "Exit status: 0 the simulators agree or differ as expected; 1 they do not, or a metric is "
    "worse than the baseline's; "
    "2 wrong usage or input; 3 a run is invalid; 4 the baseline is missing or is of other rides.";

typedef struct arguments {
  const char *output, *baseline;
  bool json, all;
  int jobs;
  char **scenarios; // of argv
  int count;
} arguments;

enum { KEY_JSON = TERM_KEY_FIRST, KEY_ALL, KEY_BASELINE };

static error_t parse(int key, char *text, struct argp_state *state) {
  arguments *args = state->input;
  switch (key) {
  case 'o':
    args->output = text;
    return 0;
  case 'j':
    args->jobs = term_threads_of("--jobs", text);
    return 0;
  case KEY_JSON:
    args->json = true;
    return 0;
  case KEY_ALL:
    args->all = true;
    return 0;
  case KEY_BASELINE:
    args->baseline = text;
    return 0;
  case ARGP_KEY_ARGS:
    args->scenarios = state->argv + state->next;
    args->count = state->argc - state->next;
    return 0;
  default:
    return ARGP_ERR_UNKNOWN;
  }
}

static const struct argp_option options[] = {
    {"output", 'o', "DIR", 0, "Folder of the report (./bicycle-report)", 1},
    {"jobs", 'j', "N", 0, "Play N scenarios at a time (default: the processors there are)", 1},
    {"json", KEY_JSON, NULL, 0, "Print report.json instead of the tables", 1},
    {"all", KEY_ALL, NULL, 0, "Show every gate, not only the closest ones", 1},
    {"baseline", KEY_BASELINE, "FILE", 0, "Compare with an earlier report.json", 1},
    {0},
};

static void print(const json_t *document, const arguments *args) {
  if (args->json) {
    if (!term_json_write(json_deep_copy(document), stdout)) term_message("out of memory");
    return;
  }
  report_print(document, args->all, stdout);
  baseline_print(document, stdout);
  printf("Report: %s\n", args->output);
}

// The report's own verdict, unless it says that the run agrees.
static term_exit judge(const report *r, const json_t *document) {
  term_exit code = verdict_exit(report_verdict(r));
  return code == TERM_DONE && baseline_is_worse(document) ? TERM_FAILED : code;
}

// A baseline, or why there is none to compare with.
typedef struct yardstick {
  json_t *document; // NULL: none was asked for, or it is missing
  problem misfit;   // empty: it can be compared, or none was asked for
} yardstick;

// Adds the comparison, or why there is none: with exit status 4 every view tells that. False when
// out of memory.
static bool compare(json_t *document, yardstick *y, const char *path) {
  if (y->document && baseline_match(document, y->document, &y->misfit) != TERM_DONE) {
    problem_prefix(&y->misfit, TERM_BASELINE, path);
    term_message("%s", y->misfit.text);
  }
  if (*y->misfit.text)
    return json_object_set_new(document, "baseline_problem", term_json_text(y->misfit.text)) == 0;
  return !y->document || baseline_compare(document, y->document);
}

// Compares, writes and prints. A baseline that does not fit costs no more than the comparison.
static term_exit publish(const report *r, yardstick *y, const arguments *args) {
  problem p = {""};
  json_t *document = report_document(r);
  bool ready = document && compare(document, y, args->baseline);
  term_exit code = ready ? report_write(r, document, args->output, &p) : problem_memory(&p);
  // A verdict without a report is not published: with exit status 2 nothing was.
  if (code == TERM_DONE) print(document, args);
  if (code != TERM_DONE)
    term_message("%s", p.text);
  else if (report_verdict(r) != VERDICT_INVALID && *y->misfit.text)
    code = TERM_BASELINE;
  else
    code = judge(r, document);
  json_decref(document);
  return code;
}

// Stops of users' models are outside the equations: rides may reach them, instants do not.
static void tell_stops(const suite *s) {
  for (size_t i = 0; i < s->count; i++)
    if (*s->scenarios[i].stops)
      term_message("%s: the model has stops (%s): L0 compares no states beyond them",
                   s->scenarios[i].name, s->scenarios[i].stops);
}

// What can be wrong is found before the work, not after it. A baseline that is missing or damaged
// is told at once; the report, from which one can be blessed, is made all the same.
static term_exit prepare(suite *s, yardstick *y, const arguments *args, problem *p) {
  term_exit code = folder_check(args->output, p);
  if (code == TERM_DONE && args->baseline) code = baseline_read(&y->document, args->baseline, p);
  if (code == TERM_BASELINE) y->misfit = *p;
  if (code == TERM_DONE || code == TERM_BASELINE)
    code = suite_load(s, args->scenarios, args->count, p);
  if (code == TERM_DONE) tell_stops(s);
  if (code == TERM_DONE && *y->misfit.text) term_message("%s", y->misfit.text);
  return code;
}

static term_exit validate(const arguments *args) {
  problem p = {""};
  suite s = {0};
  report r = {0};
  yardstick y = {0};
  double begun = engine_clock();
  if (!provenance_begin(&r.provenance, args->scenarios, args->count))
    return term_fail(TERM_INVALID, "out of memory");
  term_exit code = prepare(&s, &y, args, &p);
  if (code == TERM_DONE) code = suite_play(&s, args->jobs, &p);
  r.provenance.elapsed = engine_clock() - begun;
  if (code == TERM_DONE) {
    r.comparisons = s.comparisons;
    r.count = s.count;
    code = publish(&r, &y, args);
  } else {
    code = term_fail(code, "%s", p.text);
  }
  json_decref(y.document);
  suite_clear(&s);
  provenance_clear(&r.provenance);
  return code;
}

static void print_list(const suite *s) {
  static const term_column columns[] = {
      {"scenario", TERM_LEFT}, {"bicycle", TERM_LEFT}, {"title", TERM_LEFT}};
  term_table *table = term_table_create(columns, 3);
  for (size_t i = 0; i < s->count; i++)
    term_table_add(table, TERM_PLAIN,
                   (const char *const[]){s->scenarios[i].name, s->scenarios[i].bicycle_name,
                                         s->scenarios[i].title});
  term_table_print(table, stdout);
  term_table_free(table);
}

static bool print_list_json(const suite *s) {
  json_t *array = json_array();
  for (size_t i = 0; i < s->count; i++)
    json_array_append_new(array,
                          json_pack("{s:s, s:s, s:s}", "name", s->scenarios[i].name, "bicycle",
                                    s->scenarios[i].bicycle_name, "title", s->scenarios[i].title));
  return term_json_write(array, stdout);
}

static term_exit list(const arguments *args) {
  problem p = {""};
  suite s = {0};
  term_exit code = suite_load(&s, NULL, 0, &p);
  if (code != TERM_DONE) return term_fail(code, "%s", p.text);
  if (!args->json)
    print_list(&s);
  else if (!print_list_json(&s))
    code = term_fail(TERM_INVALID, "out of memory");
  suite_clear(&s);
  return code;
}

// A command on saved reports, if the first argument names one; it returns the exit code.
static bool run_command(int *code, int argc, char **argv) {
  static char compare[] = "bicycle validate compare", bless[] = "bicycle validate bless";
  const struct {
    const char *word;
    char *name;
    int (*run)(int argc, char **argv);
  } commands[] = {{"compare", compare, cmd_compare}, {"bless", bless, cmd_bless}};
  for (size_t i = 0; argc > 1 && i < sizeof commands / sizeof *commands; i++) {
    if (strcmp(argv[1], commands[i].word) != 0) continue;
    argv[1] = commands[i].name;
    term_begin(commands[i].name);
    *code = commands[i].run(argc - 1, argv + 1);
    return true;
  }
  return false;
}

int main(int argc, char **argv) {
  int code;
  if (run_command(&code, argc, argv)) return code;
  static char name[] = "bicycle validate";
  const struct argp argp = {
      options,       parse, "[SCENARIO...]\nlist\ncompare A.json B.json\nbless [REPORT]",
      documentation, NULL,  NULL,
      NULL};
  arguments args = {.output = "bicycle-report", .jobs = term_processors()};
  term_begin(name);
  argv[0] = name;
  term_parse(&argp, example, argc, argv, &args);
  if (args.count > 0 && strcmp(args.scenarios[0], "list") == 0) {
    if (args.count > 1) term_usage("list: '%s' is one argument too many", args.scenarios[1]);
    return list(&args);
  }
  return validate(&args);
}
