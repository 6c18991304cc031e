// SPDX-License-Identifier: Apache-2.0
// bicycle cycle: the oscillation that is left beyond the weave speed.
#include "angle_range.h"
#include "commands.h"
#include "cycle_answer.h"
#include "figures/cycle_picture.h"
#include "figures/plot_file.h"
#include "terminal/command.h"
#include "terminal/data.h"
#include "terminal/json.h"
#include "terminal/table.h"

#include <bicycle/error.h>
#include <bicycle/stability.h>
#include <math.h>

static const char example[] = "Example: bicycle cycle roadster\n"
                              "         bicycle cycle roadster --speed 4.9 -o cycle.svg\n"
                              "         bicycle cycle benchmark --leans 0.5deg:12deg:24 --json\n";

static const char documentation[] =
    "Limit cycles that are born at the first weave speed (Hopf bifurcation), one for each "
    "amplitude of the lean: the speed at which riding straight has the same energy, its distance "
    "from the weave speed, period, and stability by Floquet multipliers; and the weave mode "
    "around that speed. With --speed the cycles with the energy of riding straight at that speed, "
    "up to the largest amplitude. With -o X.svg a picture, and X.csv beside it.";

typedef struct arguments {
  const char *file, *output; // output NULL: none
  double speed;              // m/s; NaN: not given
  double search[2];          // m/s; NaN: by the bicycle's size
  term_range leans;          // rad
  term_show show;
} arguments;

enum { KEY_SEARCH = TERM_KEY_FIRST, KEY_LEANS, KEY_SPEED };

static const cli_angle_bounds amplitudes = {.high = M_PI / 2, .least = 1, .most = TERM_MAX_RANGE};

static error_t parse(int key, char *text, struct argp_state *state) {
  arguments *args = state->input;
  switch (key) {
  case ARGP_KEY_INIT:
    state->child_inputs[0] = &args->file;
    state->child_inputs[1] = &args->show;
    return 0;
  case KEY_SEARCH:
    term_search_of(args->search, text);
    return 0;
  case KEY_LEANS:
    args->leans = cli_angle_range_of("--leans", text, &amplitudes);
    return 0;
  case KEY_SPEED:
    args->speed = term_positive_of("--speed", text);
    return 0;
  case 'o':
    args->output = plot_name_of(text);
    return 0;
  default:
    return ARGP_ERR_UNKNOWN;
  }
}

static const struct argp_option options[] = {
    {"search", KEY_SEARCH, "LO:HI", 0,
     "Where to look for the weave speed, m/s (0:40, of very small or large bicycles by their size)",
     1},
    {"leans", KEY_LEANS, "A:B:N", 0, "Amplitudes of the lean, rad or deg (1deg:10deg:10)", 1},
    {"speed", KEY_SPEED, "V", 0, "The cycles of one speed, m/s", 1},
    {"output", 'o', "X.svg", 0, "Picture, with the table X.csv beside it", 1},
    {0},
};

// With steer to the right positive the lag is half a turn less or more.
static double lag_in(bike_convention convention, double lag) {
  if (term_left_sign(convention) > 0) return lag;
  return lag < M_PI ? lag + M_PI : lag - M_PI;
}

static json_t *modes_json(const cycle_answer *a, bike_convention convention) {
  json_t *array = json_array();
  for (int i = 0; i < CYCLE_MODES; i++) {
    const bike_weave_mode *m = &a->modes[i];
    if (a->has_mode[i])
      json_array_append_new(array, json_pack("{s:o, s:o, s:o, s:o, s:o}", "speed",
                                             term_json_number(cycle_shares[i] * a->weave), "growth",
                                             term_json_number(m->growth), "frequency",
                                             term_json_number(m->frequency), "steer_per_lean",
                                             term_json_number(m->ratio), "steer_lag",
                                             term_json_number(lag_in(convention, m->lag))));
  }
  return array;
}

static json_t *cycle_json(const bike_cycle *c, const cycle_answer *a, bike_convention convention) {
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

static json_t *cycles_json(const bike_cycle *cycles, int count, const cycle_answer *a,
                           bike_convention convention) {
  json_t *array = json_array();
  for (int i = 0; i < count; i++)
    json_array_append_new(array, cycle_json(&cycles[i], a, convention));
  return array;
}

// Null unless a speed was asked for.
static json_t *at_speed_json(const arguments *args, const cycle_answer *a) {
  if (isnan(args->speed)) return json_null();
  return json_pack("{s:o, s:o}", "speed", term_json_number(args->speed), "cycles",
                   cycles_json(a->at_speed, a->at_speed_count, a, args->show.convention));
}

static bool print_json(const bike_bicycle *bicycle, const arguments *args, const cycle_answer *a) {
  bike_convention convention = args->show.convention;
  bool born = !isnan(a->weave);
  const bike_weave_mode *m = &a->hopf.mode;
  json_t *hopf =
      born ? json_pack("{s:b, s:o, s:s, s:o, s:o, s:o}", "supercritical", a->hopf.supercritical,
                       "curvature", term_json_number(a->hopf.curvature), "unstable",
                       a->hopf.unstable_side < 0 ? "below" : "above", "frequency",
                       term_json_number(m->frequency), "steer_per_lean", term_json_number(m->ratio),
                       "steer_lag", term_json_number(lag_in(convention, m->lag)))
           : json_null();
  return term_json_write(
      json_pack("{s:s, s:s, s:o, s:o, s:o, s:o, s:o, s:o}", "bicycle", bicycle->name, "convention",
                term_convention_name(convention), "weave_speed", term_json_number(a->weave), "hopf",
                hopf, "modes", born ? modes_json(a, convention) : json_array(), "cycles",
                cycles_json(a->cycles, a->count, a, convention), "ended_at",
                term_json_number(born ? a->ended_at : NAN), "at_speed", at_speed_json(args, a)),
      stdout);
}

typedef char cell[32];

static const char *show(cell out, int decimals, double value) {
  snprintf(out, sizeof(cell), "%.*f", decimals, value);
  return out;
}

static const double degrees = 180 / M_PI;

static bool print_modes(const cycle_answer *a, bike_convention convention) {
  static const term_column columns[] = {{"speed m/s", TERM_RIGHT},
                                        {"growth 1/s", TERM_RIGHT},
                                        {"frequency rad/s", TERM_RIGHT},
                                        {"steer/lean", TERM_RIGHT},
                                        {"steer behind lean, deg", TERM_RIGHT}};
  term_table *table = term_table_create(columns, 5);
  for (int i = 0; i < CYCLE_MODES; i++) {
    const bike_weave_mode *m = &a->modes[i];
    cell t[5];
    if (!a->has_mode[i]) continue;
    term_table_add(table, m->growth < 0 ? TERM_GOOD : TERM_PLAIN,
                   (const char *const[]){show(t[0], 4, cycle_shares[i] * a->weave),
                                         show(t[1], 4, m->growth), show(t[2], 4, m->frequency),
                                         show(t[3], 4, m->ratio),
                                         show(t[4], 2, lag_in(convention, m->lag) * degrees)});
  }
  bool printed = term_table_print(table, stdout);
  term_table_free(table);
  return printed;
}

static bool print_cycles(const bike_cycle *cycles, int count, const cycle_answer *a,
                         bike_convention convention) {
  static const term_column columns[] = {
      {"lean deg", TERM_RIGHT},          {"steer deg", TERM_RIGHT},  {"speed m/s", TERM_RIGHT},
      {"distance m/s", TERM_RIGHT},      {"period s", TERM_RIGHT},   {"steer/lean", TERM_RIGHT},
      {"steer behind, deg", TERM_RIGHT}, {"multiplier", TERM_RIGHT}, {"stable", TERM_LEFT}};
  term_table *table = term_table_create(columns, 9);
  for (int i = 0; i < count; i++) {
    const bike_cycle *c = &cycles[i];
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

static bool print_at_speed(const arguments *args, const cycle_answer *a) {
  if (isnan(args->speed)) return true;
  double most = a->count > 0 ? a->cycles[a->count - 1].lean * degrees : 0;
  printf("\ncycles at %g m/s up to a lean of %g deg: %s\n", args->speed, most,
         a->at_speed_count > 0 ? "these" : "none");
  return a->at_speed_count == 0 ||
         print_cycles(a->at_speed, a->at_speed_count, a, args->show.convention);
}

static bool print_tables(const bike_bicycle *bicycle, const arguments *args,
                         const cycle_answer *a) {
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
  return print_cycles(a->cycles, a->count, a, convention) && print_at_speed(args, a);
}

// The picture, then the text. A bicycle without a weave speed has nothing to be drawn.
static term_exit answer(const bike_bicycle *bicycle, const arguments *args, const cycle_answer *a) {
  bool born = !isnan(a->weave);
  if (born && !isnan(a->ended_at))
    term_message("no cycle found from a lean of %g deg on", a->ended_at * degrees);
  if (args->output && (!born || a->count == 0))
    term_message("%s not written: no cycle", args->output);
  if (args->output && born && a->count > 0) {
    const cycle_branch branch = {&a->hopf, a->cycles, a->count};
    term_exit code = cycle_write(&branch, bicycle, args->show.convention, args->output);
    if (code != TERM_DONE) return code;
  }
  bool printed = args->show.json ? print_json(bicycle, args, a) : print_tables(bicycle, args, a);
  return printed ? TERM_DONE : term_fail_bike(BIKE_ERROR_MEMORY, args->file);
}

int cmd_cycle(int argc, char **argv) {
  const struct argp_child children[] = {
      {&term_file_argp, 0, NULL, 0}, {&term_show_argp, 0, NULL, 0}, {0}};
  const struct argp argp = {options, parse, "FILE", documentation, children, NULL, NULL};
  arguments args = {.speed = NAN, .search = {NAN, NAN}, .leans = {M_PI / 180, M_PI / 18, 10}};
  term_parse(&argp, example, argc, argv, &args);

  bike_bicycle bicycle;
  bike_model model;
  term_exit code = term_load_bicycle(&bicycle, &model, args.file);
  if (code != TERM_DONE) return code;
  if (isnan(args.search[1])) {
    args.search[0] = 0;
    args.search[1] = bike_search_end(&model);
  }
  cycle_answer a;
  int error = cycle_answer_find(&a, &model, args.search, &args.leans, args.speed);
  code = error ? term_fail_bike(error, args.file) : answer(&bicycle, &args, &a);
  cycle_answer_free(&a);
  return code;
}
