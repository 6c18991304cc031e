// SPDX-License-Identifier: Apache-2.0
// bicycle cycle: the oscillation that is left beyond the weave speed.
#include "angle_range.h"
#include "commands.h"
#include "terminal/command.h"
#include "terminal/data.h"
#include "terminal/json.h"
#include "terminal/progress.h"
#include "terminal/table.h"

#include <bicycle/cycle.h>
#include <bicycle/error.h>
#include <bicycle/modes.h>
#include <bicycle/stability.h>
#include <complex.h>
#include <math.h>
#include <stdlib.h>

static const char example[] = "Example: bicycle cycle roadster\n"
                              "         bicycle cycle benchmark --leans 0.5deg:12deg:24 --json\n";

static const char documentation[] =
    "Limit cycles that are born at the first weave speed (Hopf bifurcation), one for each "
    "amplitude of the lean: the speed at which riding straight has the same energy, its distance "
    "from the weave speed, period, and stability by Floquet multipliers; and the weave mode "
    "around that speed.";

typedef struct arguments {
  const char *file;
  double search[2]; // m/s
  term_range leans; // rad
  term_show show;
} arguments;

enum { KEY_SEARCH = TERM_KEY_FIRST, KEY_LEANS };

static error_t parse(int key, char *text, struct argp_state *state) {
  arguments *args = state->input;
  switch (key) {
  case ARGP_KEY_INIT:
    state->child_inputs[0] = &args->file;
    state->child_inputs[1] = &args->show;
    return 0;
  case KEY_SEARCH:
    if (!term_parse_interval(args->search, text) || args->search[0] < 0)
      term_usage("--search: '%s' is not LO:HI with 0 <= LO < HI", text);
    return 0;
  case KEY_LEANS:
    if (!cli_parse_angle_range(&args->leans, text) || !(args->leans.first > 0) ||
        !(args->leans.last < M_PI / 2))
      term_usage("--leans: '%s' is not A:B:N, N amplitudes from A > 0 to B < 90deg", text);
    return 0;
  default:
    return ARGP_ERR_UNKNOWN;
  }
}

static const struct argp_option options[] = {
    {"search", KEY_SEARCH, "LO:HI", 0, "Where to look for the weave speed, m/s (0:40)", 1},
    {"leans", KEY_LEANS, "A:B:N", 0, "Amplitudes of the lean, rad or deg (1deg:10deg:10)", 1},
    {0},
};

// The weave mode is shown at these shares of the weave speed.
static const double shares[] = {0.6, 0.8, 0.9, 1, 1.1, 1.2, 1.4};
enum { MODES = sizeof shares / sizeof shares[0] };

typedef struct answer {
  double weave; // m/s; NaN: none, and nothing else is set
  bike_hopf hopf;
  bike_weave_mode modes[MODES];
  bool has_mode[MODES];
  int count;
  bike_cycle *cycles;
  double ended_at; // rad: the first amplitude without a cycle; NaN: all found
} answer;

// Of the mode named weave at each speed; none where it is no oscillation.
static int find_modes(answer *out, const bike_model *model) {
  double speeds[MODES];
  bike_modes modes[MODES];
  for (int i = 0; i < MODES; i++) speeds[i] = shares[i] * out->weave;
  int code = bike_upright_modes(modes, model, speeds, MODES);
  for (int i = 0; i < MODES && !code; i++) {
    for (int k = 0; k < 4; k++) {
      double im = modes[i].values.im[k];
      if (modes[i].mode[k] != BIKE_MODE_WEAVE || !(im > 0)) continue;
      const double *re_part = modes[i].vectors_re[k], *im_part = modes[i].vectors_im[k];
      double complex steer_per_lean = (re_part[0] + I * im_part[0]) / (re_part[1] + I * im_part[1]);
      double lag = -carg(steer_per_lean);
      out->has_mode[i] = true;
      out->modes[i] = (bike_weave_mode){modes[i].values.re[k], im, cabs(steer_per_lean),
                                        lag < 0 ? lag + 2 * M_PI : lag};
    }
  }
  return code;
}

// Follows the cycles from small to large. An amplitude without a cycle ends it.
static int find_cycles(answer *out, const bike_model *model, const term_range *leans) {
  term_progress progress = {0};
  out->ended_at = NAN;
  out->cycles = calloc((size_t)leans->count, sizeof *out->cycles);
  if (!out->cycles) return BIKE_ERROR_MEMORY;
  for (int i = 0; i < leans->count; i++) {
    double lean = term_range_point(leans, i);
    term_progress_show(&progress, "cycles", (double)i / (double)leans->count);
    if (bike_cycle_find(&out->cycles[i], model, lean, out->weave,
                        i > 0 ? &out->cycles[i - 1] : NULL)) {
      out->ended_at = lean;
      break;
    }
    out->count++;
  }
  term_progress_clear(&progress);
  return BIKE_OK;
}

static int find_answer(answer *out, const bike_model *model, const arguments *args) {
  bike_critical_speeds found;
  int code = bike_upright_critical_speeds(&found, model, args->search[0], args->search[1]);
  out->weave = !code && found.weave_count > 0 ? found.weave[0] : NAN;
  if (code || isnan(out->weave)) return code;
  code = bike_hopf_at(&out->hopf, model, out->weave);
  if (!code) code = find_modes(out, model);
  return code ? code : find_cycles(out, model, &args->leans);
}

// With steer to the right positive the lag is half a turn less or more.
static double lag_in(bike_convention convention, double lag) {
  if (term_left_sign(convention) > 0) return lag;
  return lag < M_PI ? lag + M_PI : lag - M_PI;
}

static json_t *modes_json(const answer *a, bike_convention convention) {
  json_t *array = json_array();
  for (int i = 0; i < MODES; i++) {
    const bike_weave_mode *m = &a->modes[i];
    if (a->has_mode[i])
      json_array_append_new(array, json_pack("{s:o, s:o, s:o, s:o, s:o}", "speed",
                                             term_json_number(shares[i] * a->weave), "growth",
                                             term_json_number(m->growth), "frequency",
                                             term_json_number(m->frequency), "steer_per_lean",
                                             term_json_number(m->ratio), "steer_lag",
                                             term_json_number(lag_in(convention, m->lag))));
  }
  return array;
}

static json_t *cycle_json(const bike_cycle *c, const answer *a, bike_convention convention) {
  double left = term_left_sign(convention);
  return json_pack(
      "{s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:b, s:o, s:{s:o, s:o, s:o, s:o, s:o}}",
      "lean", term_json_number(c->lean), "steer", term_json_number(c->steer), "speed",
      term_json_number(c->speed), "distance", term_json_number(c->speed - a->weave), "mean_speed",
      term_json_number(c->mean_speed), "period", term_json_number(c->period), "steer_per_lean",
      term_json_number(c->ratio), "steer_lag", term_json_number(lag_in(convention, c->lag)),
      "multiplier", term_json_number(c->multiplier), "stable", c->multiplier < 1, "residual",
      term_json_number(c->residual), "start", "lean", term_json_number(c->start.lean), "steer",
      term_json_number(left * c->start.steer), "lean_rate", term_json_number(c->start.lean_rate),
      "steer_rate", term_json_number(left * c->start.steer_rate), "speed",
      term_json_number(c->start.speed));
}

static bool print_json(const bike_bicycle *bicycle, const answer *a, bike_convention convention) {
  bool born = !isnan(a->weave);
  json_t *cycles = json_array();
  for (int i = 0; i < a->count; i++)
    json_array_append_new(cycles, cycle_json(&a->cycles[i], a, convention));
  const bike_weave_mode *m = &a->hopf.mode;
  json_t *hopf =
      born ? json_pack("{s:b, s:o, s:s, s:o, s:o, s:o}", "supercritical", a->hopf.supercritical,
                       "curvature", term_json_number(a->hopf.curvature), "unstable",
                       a->hopf.unstable_side < 0 ? "below" : "above", "frequency",
                       term_json_number(m->frequency), "steer_per_lean", term_json_number(m->ratio),
                       "steer_lag", term_json_number(lag_in(convention, m->lag)))
           : json_null();
  return term_json_write(json_pack("{s:s, s:s, s:o, s:o, s:o, s:o, s:o}", "bicycle", bicycle->name,
                                   "convention", term_convention_name(convention), "weave_speed",
                                   term_json_number(a->weave), "hopf", hopf, "modes",
                                   born ? modes_json(a, convention) : json_array(), "cycles",
                                   cycles, "ended_at", term_json_number(born ? a->ended_at : NAN)),
                         stdout);
}

typedef char cell[32];

static const char *show(cell out, int decimals, double value) {
  snprintf(out, sizeof(cell), "%.*f", decimals, value);
  return out;
}

static const double degrees = 180 / M_PI;

static bool print_modes(const answer *a, bike_convention convention) {
  static const term_column columns[] = {{"speed m/s", TERM_RIGHT},
                                        {"growth 1/s", TERM_RIGHT},
                                        {"frequency rad/s", TERM_RIGHT},
                                        {"steer/lean", TERM_RIGHT},
                                        {"steer behind lean, deg", TERM_RIGHT}};
  term_table *table = term_table_create(columns, 5);
  for (int i = 0; i < MODES; i++) {
    const bike_weave_mode *m = &a->modes[i];
    cell t[5];
    if (!a->has_mode[i]) continue;
    term_table_add(table, m->growth < 0 ? TERM_GOOD : TERM_PLAIN,
                   (const char *const[]){show(t[0], 4, shares[i] * a->weave),
                                         show(t[1], 4, m->growth), show(t[2], 4, m->frequency),
                                         show(t[3], 4, m->ratio),
                                         show(t[4], 2, lag_in(convention, m->lag) * degrees)});
  }
  bool printed = term_table_print(table, stdout);
  term_table_free(table);
  return printed;
}

static bool print_cycles(const answer *a, bike_convention convention) {
  static const term_column columns[] = {
      {"lean deg", TERM_RIGHT},          {"steer deg", TERM_RIGHT},  {"speed m/s", TERM_RIGHT},
      {"distance m/s", TERM_RIGHT},      {"period s", TERM_RIGHT},   {"steer/lean", TERM_RIGHT},
      {"steer behind, deg", TERM_RIGHT}, {"multiplier", TERM_RIGHT}, {"stable", TERM_LEFT}};
  term_table *table = term_table_create(columns, 9);
  for (int i = 0; i < a->count; i++) {
    const bike_cycle *c = &a->cycles[i];
    cell t[8];
    bool stable = c->multiplier < 1;
    term_table_add(table, stable ? TERM_GOOD : TERM_PLAIN,
                   (const char *const[]){show(t[0], 3, c->lean * degrees),
                                         show(t[1], 3, c->steer * degrees), show(t[2], 6, c->speed),
                                         show(t[3], 6, c->speed - a->weave),
                                         show(t[4], 5, c->period), show(t[5], 4, c->ratio),
                                         show(t[6], 2, lag_in(convention, c->lag) * degrees),
                                         show(t[7], 5, c->multiplier), stable ? "yes" : "no"});
  }
  bool printed = term_table_print(table, stdout);
  term_table_free(table);
  return printed;
}

static bool print_tables(const bike_bicycle *bicycle, const arguments *args, const answer *a) {
  bike_convention convention = args->show.convention;
  printf("%s, convention %s\n\n", bicycle->name, term_convention_name(convention));
  if (isnan(a->weave)) {
    printf("no weave speed between %g and %g m/s: no cycle is born\n", args->search[0],
           args->search[1]);
    return true;
  }
  printf("weave speed %.9f m/s, unstable %s: %s Hopf bifurcation\n", a->weave,
         a->hopf.unstable_side < 0 ? "below" : "above",
         a->hopf.supercritical ? "supercritical" : "subcritical");
  printf("small cycles: speed - weave speed = %.4f m/s/rad^2 times lean squared\n\n",
         a->hopf.curvature);
  if (!print_modes(a, convention)) return false;
  puts("\ncycles; speed: of riding straight with the same energy\n");
  return print_cycles(a, convention);
}

int cmd_cycle(int argc, char **argv) {
  const struct argp_child children[] = {
      {&term_file_argp, 0, NULL, 0}, {&term_show_argp, 0, NULL, 0}, {0}};
  const struct argp argp = {options, parse, "FILE", documentation, children, NULL, NULL};
  arguments args = {.search = {0, 40}, .leans = {M_PI / 180, M_PI / 18, 10}};
  term_parse(&argp, example, argc, argv, &args);

  bike_bicycle bicycle;
  bike_model model;
  term_exit code = term_load_bicycle(&bicycle, &model, args.file);
  if (code != TERM_DONE) return code;
  answer a = {0};
  int error = find_answer(&a, &model, &args);
  if (!error) {
    bool printed = args.show.json ? print_json(&bicycle, &a, args.show.convention)
                                  : print_tables(&bicycle, &args, &a);
    if (!printed) error = BIKE_ERROR_MEMORY;
    if (!isnan(a.weave) && !isnan(a.ended_at))
      term_message("no cycle found from a lean of %g deg on", a.ended_at * degrees);
  }
  free(a.cycles);
  return error ? term_fail_bike(error, args.file) : TERM_DONE;
}
