// SPDX-License-Identifier: Apache-2.0
// bicycle stability: eigenvalues over speeds, critical speeds, stable ranges.
#include "commands.h"
#include "terminal/command.h"
#include "terminal/data.h"
#include "terminal/json.h"
#include "terminal/number.h"
#include "terminal/table.h"

#include <bicycle/error.h>
#include <bicycle/modes.h>
#include <bicycle/stability.h>
#include <math.h>
#include <stdlib.h>

static const char example[] = "Example: bicycle stability benchmark\n"
                              "         bicycle stability roadster --speeds 0:10:101 --json\n";

static const char documentation[] =
    "Stability of riding straight and upright, rigid rider, hands off: the eigenvalues in 1/s at "
    "each speed, falling, with the names of their modes (weave, capsize, castering; followed from "
    "the fastest oscillation), the weave and capsize speeds, and the ranges of speed in which "
    "every "
    "disturbance dies out.";

typedef struct arguments {
  term_question question;
  term_range speeds;
  double search[2]; // m/s
} arguments;

enum { KEY_SPEEDS = TERM_KEY_FIRST, KEY_SEARCH };

static error_t parse(int key, char *text, struct argp_state *state) {
  arguments *args = state->input;
  switch (key) {
  case ARGP_KEY_INIT:
    state->child_inputs[0] = &args->question;
    return 0;
  case KEY_SPEEDS:
    if (!term_parse_range(&args->speeds, text))
      term_usage("--speeds: '%s' is not A:B:N, N points from A to B > A", text);
    return 0;
  case KEY_SEARCH:
    term_search_of(args->search, text);
    return 0;
  default:
    return ARGP_ERR_UNKNOWN;
  }
}

static const struct argp_option options[] = {
    {"speeds", KEY_SPEEDS, "A:B:N", 0, "N speeds from A to B, both included, m/s (0:10:11)", 1},
    {"search", KEY_SEARCH, "LO:HI", 0, "Where to look for critical speeds, m/s (0:20)", 1},
    {0},
};

// The default search ends well above the speeds at which people ride a bicycle.
static const arguments defaults = {.speeds = {0, 10, 11}, .search = {0, 20}};

static double first_or_nan(const double *speeds, int count) {
  return count > 0 ? speeds[0] : NAN;
}

// The names in the order of the eigenvalues.
static json_t *names_json(const bike_modes *at) {
  const char *names[4];
  for (int k = 0; k < 4; k++) names[k] = bike_mode_string(at->mode[k]);
  return term_json_texts(names, 4);
}

static json_t *eigenvalues_json(const term_range *speeds, const bike_modes *modes) {
  json_t *array = json_array();
  for (long i = 0; i < speeds->count; i++) {
    const bike_eigenvalues *values = &modes[i].values;
    double pairs[4][2];
    for (int k = 0; k < 4; k++) {
      pairs[k][0] = values->re[k];
      pairs[k][1] = values->im[k];
    }
    json_array_append_new(array, json_pack("{s:o, s:o, s:o}", "speed",
                                           term_json_number(term_range_point(speeds, i)), "values",
                                           term_json_matrix(pairs[0], 4, 2), "modes",
                                           names_json(&modes[i])));
  }
  return array;
}

static bool print_json(const bike_bicycle *bicycle, const arguments *args, const bike_modes *modes,
                       const bike_critical_speeds *critical) {
  json_t *document = json_pack(
      "{s:s, s:s, s:o, s:o, s:o, s:o, s:o, s:o, s:o}", "bicycle", bicycle->name, "convention",
      term_convention_name(args->question.show.convention), "eigenvalues",
      eigenvalues_json(&args->speeds, modes), "weave_speed",
      term_json_number(first_or_nan(critical->weave, critical->weave_count)), "capsize_speed",
      term_json_number(first_or_nan(critical->capsize, critical->capsize_count)), "weave_speeds",
      term_json_numbers(critical->weave, (size_t)critical->weave_count), "capsize_speeds",
      term_json_numbers(critical->capsize, (size_t)critical->capsize_count), "stable_ranges",
      term_json_matrix(critical->ranges[0], (size_t)critical->range_count, 2), "search",
      term_json_numbers(args->search, 2));
  return term_json_write(document, stdout);
}

typedef char cell[64];

static bool is_pair(const bike_eigenvalues *e, int k) {
  return k + 1 < 4 && e->im[k] > 0 && e->im[k + 1] == -e->im[k] && e->re[k + 1] == e->re[k];
}

static void format_mode(cell out, const bike_modes *at, int k) {
  const bike_eigenvalues *e = &at->values;
  bool named = at->mode[k] != BIKE_MODE_UNNAMED;
  const char *name = named ? bike_mode_string(at->mode[k]) : "", *blank = named ? " " : "";
  if (is_pair(e, k))
    snprintf(out, sizeof(cell), "%.6g\u00b1%.6gi%s%s", e->re[k], e->im[k], blank, name);
  else if (e->im[k] != 0)
    snprintf(out, sizeof(cell), "%.6g%+.6gi%s%s", e->re[k], e->im[k], blank, name);
  else
    snprintf(out, sizeof(cell), "%.6g%s%s", e->re[k], blank, name);
}

// A pair takes one cell.
static bool print_eigenvalues(const term_range *speeds, const bike_modes *modes) {
  static const term_column columns[] = {{"speed", TERM_RIGHT}, {"eigenvalues", TERM_RIGHT},
                                        {"", TERM_RIGHT},      {"", TERM_RIGHT},
                                        {"", TERM_RIGHT},      {"stable", TERM_LEFT}};
  term_table *table = term_table_create(columns, 6);
  for (long i = 0; i < speeds->count; i++) {
    cell speed, text[4] = {""};
    snprintf(speed, sizeof speed, "%g", term_range_point(speeds, i));
    for (int k = 0, column = 0; k < 4; k += is_pair(&modes[i].values, k) ? 2 : 1)
      format_mode(text[column++], &modes[i], k);
    bool stable = bike_all_decay(&modes[i].values);
    term_table_add(
        table, stable ? TERM_GOOD : TERM_PLAIN,
        (const char *const[]){speed, text[0], text[1], text[2], text[3], stable ? "yes" : "no"});
  }
  bool printed = term_table_print(table, stdout);
  term_table_free(table);
  return printed;
}

static void print_speeds(const char *name, const double *speeds, int count) {
  printf("%-13s ", name);
  for (int i = 0; i < count; i++) printf("%s%.12f", i ? ", " : "", speeds[i]);
  puts(count ? " m/s" : "none");
}

static bool print_tables(const bike_bicycle *bicycle, const arguments *args,
                         const bike_modes *modes, const bike_critical_speeds *critical) {
  printf("%s, riding straight and upright, convention %s\n\n", bicycle->name,
         term_convention_name(args->question.show.convention));
  bool printed = print_eigenvalues(&args->speeds, modes);
  printf("\nbetween %g and %g m/s:\n", args->search[0], args->search[1]);
  print_speeds("weave speed", critical->weave, critical->weave_count);
  print_speeds("capsize speed", critical->capsize, critical->capsize_count);
  printf("%-13s ", "stable");
  for (int i = 0; i < critical->range_count; i++)
    printf("%s%.12f to %.12f", i ? ", " : "", critical->ranges[i][0], critical->ranges[i][1]);
  puts(critical->range_count ? " m/s" : "nowhere");
  return printed;
}

// Modes are named from their fastest oscillation on: it is looked for beyond the list too, up to
// the end of the search, so that a list of slow speeds gets the same names. `out` has room for
// that.
enum { BEYOND = 40 };

static int find_modes(bike_modes *out, const bike_model *model, const arguments *args) {
  const term_range *speeds = &args->speeds;
  const long listed = speeds->count;
  const double gap = args->search[1] - speeds->last;
  const long count = gap > 0 ? listed + BEYOND : listed;
  double *at = calloc((size_t)count, sizeof *at);
  if (!at) return BIKE_ERROR_MEMORY;
  for (long i = 0; i < listed; i++) at[i] = term_range_point(speeds, i);
  for (long i = listed; i < count; i++)
    at[i] = speeds->last + gap * (double)(i - listed + 1) / BEYOND;
  int error = bike_upright_modes(out, model, at, (int)count);
  free(at);
  return error;
}

int cmd_stability(int argc, char **argv) {
  const struct argp_child children[] = {{&term_question_argp, 0, NULL, 0}, {0}};
  const struct argp argp = {options, parse, "FILE", documentation, children, NULL, NULL};
  arguments args = defaults;
  term_parse(&argp, example, argc, argv, &args);

  bike_bicycle bicycle;
  bike_model model;
  term_exit code = term_load_bicycle(&bicycle, &model, args.question.file);
  if (code != TERM_DONE) return code;

  bike_critical_speeds critical = {0};
  bike_modes *modes = calloc((size_t)args.speeds.count + BEYOND, sizeof *modes);
  int error = modes ? find_modes(modes, &model, &args) : BIKE_ERROR_MEMORY;
  if (error == BIKE_OK)
    error = bike_upright_critical_speeds(&critical, &model, args.search[0], args.search[1]);
  if (error == BIKE_OK) {
    bool printed = args.question.show.json ? print_json(&bicycle, &args, modes, &critical)
                                           : print_tables(&bicycle, &args, modes, &critical);
    error = printed ? BIKE_OK : BIKE_ERROR_MEMORY;
  }
  free(modes);
  return error == BIKE_OK ? TERM_DONE : term_fail_bike(error, args.question.file);
}
