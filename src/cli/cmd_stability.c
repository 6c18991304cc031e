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
    "each speed, falling, with the names of their modes (weave, capsize, castering; followed "
    "through all speeds from the oscillation that becomes weave, and ended where different modes "
    "collide), the weave and capsize speeds, and the ranges of speed in which every disturbance "
    "dies out. In JSON a range of stable_ranges that goes on beyond the search ends with it; "
    "stable_to_search_end says so.";

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
    {"speeds", KEY_SPEEDS, "A:B:N", 0,
     "N speeds from A to B, both included, m/s (11 to a quarter of the search: 0:10:11)", 1},
    {"search", KEY_SEARCH, "LO:HI", 0,
     "Where to look for critical speeds, m/s (0:40, of very small or large bicycles by their size)",
     1},
    {0},
};

// What was not given follows from the bicycle's size.
static void complete(arguments *args, const bike_model *model) {
  const double end = bike_search_end(model);
  if (args->speeds.count == 0) args->speeds = (term_range){0, 0.25 * end, 11};
  if (isnan(args->search[1])) {
    args->search[0] = 0;
    args->search[1] = end;
  }
}

// What `stability` has to tell.
typedef struct answer {
  bike_modes *modes; // one per speed
  int end_count;
  bike_name_end ends[BIKE_MAX_NAME_ENDS];
  bike_critical_speeds critical;
} answer;

static bool stable_to_the_end(const answer *a, const arguments *args) {
  const int count = a->critical.range_count;
  return count > 0 && a->critical.ranges[count - 1][1] == args->search[1];
}

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

// Speeds at which names end, with the modes that collide there.
static json_t *ends_json(const answer *a) {
  json_t *array = json_array();
  for (int i = 0; i < a->end_count; i++) {
    const char *names[2];
    for (int k = 0; k < 2; k++) names[k] = bike_mode_string(a->ends[i].modes[k]);
    json_array_append_new(array,
                          json_pack("{s:o, s:o}", "speed", term_json_number(a->ends[i].speed),
                                    "modes", term_json_texts(names, 2)));
  }
  return array;
}

static bool print_json(const bike_bicycle *bicycle, const arguments *args, const answer *a) {
  const bike_critical_speeds *critical = &a->critical;
  json_t *document = json_pack(
      "{s:s, s:s, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:b, s:o}", "bicycle", bicycle->name,
      "convention", term_convention_name(args->question.show.convention), "eigenvalues",
      eigenvalues_json(&args->speeds, a->modes), "names_end", ends_json(a), "weave_speed",
      term_json_number(first_or_nan(critical->weave, critical->weave_count)), "capsize_speed",
      term_json_number(first_or_nan(critical->capsize, critical->capsize_count)), "weave_speeds",
      term_json_numbers(critical->weave, (size_t)critical->weave_count), "capsize_speeds",
      term_json_numbers(critical->capsize, (size_t)critical->capsize_count), "stable_ranges",
      term_json_matrix(critical->ranges[0], (size_t)critical->range_count, 2),
      "stable_to_search_end", stable_to_the_end(a, args), "search",
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

// A range ends at a critical speed, or goes on where the search ends.
static void print_ranges(const answer *a, const arguments *args) {
  const int count = a->critical.range_count;
  printf("%-13s ", "stable");
  if (count == 0) printf("nowhere");
  for (int i = 0; i < count; i++) {
    const double *range = a->critical.ranges[i];
    printf("%s%.12f", i ? ", " : "", range[0]);
    if (i + 1 == count && stable_to_the_end(a, args))
      printf(" m/s to the end of the search at %g", args->search[1]);
    else
      printf(" to %.12f", range[1]);
  }
  puts(count ? " m/s" : "");
}

static bool within(const arguments *args, double speed) {
  return speed >= fmin(args->speeds.first, args->search[0]) &&
         speed <= fmax(args->speeds.last, args->search[1]);
}

// Why modes have no name.
static void print_ends(const answer *a, const arguments *args) {
  for (int i = 0; i < a->end_count; i++) {
    const bike_name_end *end = &a->ends[i];
    if (!within(args, end->speed)) continue;
    const char *first = bike_mode_string(end->modes[0]), *second = bike_mode_string(end->modes[1]);
    if (end->modes[0] == end->modes[1])
      printf("%-13s %g m/s: %s parts or passes zero\n", "names end at", end->speed, first);
    else
      printf("%-13s %g m/s: %s meets %s\n", "names end at", end->speed, first, second);
  }
}

static bool print_tables(const bike_bicycle *bicycle, const arguments *args, const answer *a) {
  printf("%s, riding straight and upright, convention %s\n\n", bicycle->name,
         term_convention_name(args->question.show.convention));
  bool printed = print_eigenvalues(&args->speeds, a->modes);
  printf("\nbetween %g and %g m/s:\n", args->search[0], args->search[1]);
  print_speeds("weave speed", a->critical.weave, a->critical.weave_count);
  print_speeds("capsize speed", a->critical.capsize, a->critical.capsize_count);
  print_ranges(a, args);
  print_ends(a, args);
  return printed;
}

static int find(answer *out, const bike_model *model, const arguments *args) {
  const size_t count = (size_t)args->speeds.count;
  double *speeds = calloc(count, sizeof *speeds);
  out->modes = calloc(count, sizeof *out->modes);
  int code = speeds && out->modes ? BIKE_OK : BIKE_ERROR_MEMORY;
  for (size_t i = 0; i < count && !code; i++) speeds[i] = term_range_point(&args->speeds, (long)i);
  if (!code) code = bike_upright_modes(out->modes, model, speeds, (int)count);
  free(speeds);
  if (!code) code = bike_upright_name_ends(out->ends, &out->end_count, model);
  if (code) return code;
  return bike_upright_critical_speeds(&out->critical, model, args->search[0], args->search[1]);
}

int cmd_stability(int argc, char **argv) {
  const struct argp_child children[] = {{&term_question_argp, 0, NULL, 0}, {0}};
  const struct argp argp = {options, parse, "FILE", documentation, children, NULL, NULL};
  arguments args = {.search = {NAN, NAN}};
  term_parse(&argp, example, argc, argv, &args);

  bike_bicycle bicycle;
  bike_model model;
  term_exit code = term_load_bicycle(&bicycle, &model, args.question.file);
  if (code != TERM_DONE) return code;
  complete(&args, &model);
  answer a = {0};
  int error = find(&a, &model, &args);
  if (error == BIKE_OK) {
    bool printed = args.question.show.json ? print_json(&bicycle, &args, &a)
                                           : print_tables(&bicycle, &args, &a);
    error = printed ? BIKE_OK : BIKE_ERROR_MEMORY;
  }
  free(a.modes);
  return error == BIKE_OK ? TERM_DONE : term_fail_bike(error, args.question.file);
}
