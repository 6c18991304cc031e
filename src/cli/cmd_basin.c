// SPDX-License-Identifier: Apache-2.0
// bicycle basin: from which leans and steers the bicycle comes back to riding straight.
#include "angle_range.h"
#include "commands.h"
#include "figures/basin_picture.h"
#include "figures/plot_file.h"
#include "terminal/command.h"
#include "terminal/data.h"
#include "terminal/json.h"
#include "terminal/progress.h"
#include "terminal/threads.h"

#include <bicycle/error.h>
#include <bicycle/stability.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char example[] =
    "Example: bicycle basin roadster --speed 5.8 -o basin.svg\n"
    "         bicycle basin benchmark --speed 5 --leans -40deg:40deg:41 --steers "
    "-60deg:60deg:41\n";

static const char documentation[] =
    "The basin of attraction of riding straight at a speed, hands off: which starts with zero "
    "rates, and the energy of riding straight at that speed, come back to it. With -o X.svg a "
    "picture, and X.csv beside it.";

typedef struct arguments {
  const char *file, *output; // output NULL: none
  double time;               // s
  term_range leans, steers;  // rad
  double speed;              // m/s; NaN: not given
  int threads;
  term_show show;
} arguments;

enum { KEY_SPEED = TERM_KEY_FIRST, KEY_LEANS, KEY_STEERS, KEY_TIME, KEY_THREADS };
// A map has two sides; a million rides are the most that a picture can use.
static const cli_angle_bounds bounds = {.low = -M_PI, .high = M_PI, .least = 2, .most = 1001};

static error_t parse(int key, char *text, struct argp_state *state) {
  arguments *args = state->input;
  switch (key) {
  case ARGP_KEY_INIT:
    state->child_inputs[0] = &args->file;
    state->child_inputs[1] = &args->show;
    return 0;
  case 'o':
    args->output = plot_name_of(text);
    return 0;
  case KEY_SPEED:
    args->speed = term_positive_of("--speed", text);
    return 0;
  case KEY_LEANS:
    args->leans = cli_angle_range_of("--leans", text, &bounds);
    return 0;
  case KEY_STEERS:
    args->steers = cli_angle_range_of("--steers", text, &bounds);
    return 0;
  case KEY_TIME:
    args->time = term_positive_of("--time", text);
    if (args->time < 2) term_usage("--time: %s s is too short to tell a fate (2 s or more)", text);
    return 0;
  case KEY_THREADS:
    args->threads = term_threads_of("--threads", text);
    return 0;
  case ARGP_KEY_END:
    if (isnan(args->speed)) term_usage("--speed is missing");
    return 0;
  default:
    return ARGP_ERR_UNKNOWN;
  }
}

static const struct argp_option options[] = {
    {"speed", KEY_SPEED, "V", 0, "Speed of riding straight, m/s (required)", 1},
    {"leans", KEY_LEANS, "A:B:N", 0, "Leans, rad or deg (-45deg:45deg:61)", 1},
    {"steers", KEY_STEERS, "A:B:N", 0, "Steers, rad or deg (-60deg:60deg:61)", 1},
    {"time", KEY_TIME, "T", 0, "When a ride is given up, s (60)", 1},
    {"threads", KEY_THREADS, "N", 0, "Threads (all processors)", 1},
    {"output", 'o', "X.svg", 0, "Picture, with the table X.csv beside it", 1},
    {0},
};

static arguments defaults(void) {
  return (arguments){.time = 60,
                     .leans = {-M_PI / 4, M_PI / 4, 61},
                     .steers = {-M_PI / 3, M_PI / 3, 61},
                     .speed = NAN,
                     .threads = term_processors()};
}

static void show_progress(double done, void *user) {
  term_progress_show(user, "basin", done);
}

static double *points_of(const term_range *range) {
  double *points = calloc((size_t)range->count, sizeof *points);
  for (long i = 0; points && i < range->count; i++) points[i] = term_range_point(range, i);
  return points;
}

static int find_basin(basin_map *map, const bike_model *model, const arguments *args) {
  term_progress progress = {0};
  bike_basin_def def = bike_default_basin_def();
  map->nx = (int)args->leans.count;
  map->ny = (int)args->steers.count;
  map->leans = points_of(&args->leans);
  map->steers = points_of(&args->steers);
  map->fates = calloc((size_t)map->nx * (size_t)map->ny, sizeof *map->fates);
  if (!map->leans || !map->steers || !map->fates) return BIKE_ERROR_MEMORY;
  def.speed = args->speed;
  def.duration = args->time;
  def.leans = map->leans;
  def.steers = map->steers;
  def.lean_count = (size_t)map->nx;
  def.steer_count = (size_t)map->ny;
  def.threads = args->threads;
  def.progress = show_progress;
  def.user = &progress;
  int code = bike_basin(map->fates, model, &def);
  term_progress_clear(&progress);
  return code;
}

static void count_fates(long counts[BIKE_FATES], const basin_map *map) {
  memset(counts, 0, BIKE_FATES * sizeof counts[0]);
  for (int k = 0; k < map->nx * map->ny; k++) counts[map->fates[k]]++;
}

static bool print_json(const bike_bicycle *bicycle, const arguments *args, const basin_map *map,
                       bool stable) {
  long counts[BIKE_FATES];
  count_fates(counts, map);
  json_t *rows = json_array(), *totals = json_object();
  double left = term_left_sign(args->show.convention);
  for (int f = 0; f < BIKE_FATES; f++)
    json_object_set_new(totals, bike_fate_string((bike_fate)f), json_integer(counts[f]));
  for (int k = 0; k < map->nx * map->ny; k++)
    json_array_append_new(rows, json_pack("[o, o, s]", term_json_number(map->leans[k % map->nx]),
                                          term_json_number(left * map->steers[k / map->nx]),
                                          bike_fate_string(map->fates[k])));
  return term_json_write(json_pack("{s:s, s:s, s:o, s:b, s:o, s:o, s:o}", "bicycle", bicycle->name,
                                   "convention", term_convention_name(args->show.convention),
                                   "speed", term_json_number(args->speed), "straight_is_stable",
                                   stable, "time", term_json_number(args->time), "starts", totals,
                                   "fates", rows),
                         stdout);
}

// A map in characters, steer upwards, and how many starts have which fate.
static void print_map(const bike_bicycle *bicycle, const arguments *args, const basin_map *map) {
  static const char marks[BIKE_FATES] = {'#', '+', '~', '.', ' '};
  long counts[BIKE_FATES];
  const double degrees = 180 / M_PI, left = term_left_sign(args->show.convention);
  printf(
      "%s at %g m/s, convention %s; lean %g to %g deg to the right, steer %g to %g deg upwards\n",
      bicycle->name, args->speed, term_convention_name(args->show.convention),
      args->leans.first * degrees, args->leans.last * degrees,
      fmin(left * args->steers.first, left * args->steers.last) * degrees,
      fmax(left * args->steers.first, left * args->steers.last) * degrees);
  for (int row = map->ny - 1; row >= 0; row--) {
    int j = left > 0 ? row : map->ny - 1 - row;
    for (int i = 0; i < map->nx; i++) putchar(marks[map->fates[j * map->nx + i]]);
    putchar('\n');
  }
  count_fates(counts, map);
  for (int f = 0; f < BIKE_FATES; f++)
    printf("%c %-9s %5.1f %%\n", marks[f], bike_fate_string((bike_fate)f),
           100.0 * (double)counts[f] / (map->nx * map->ny));
}

static bool is_stable(const bike_model *model, double speed) {
  bike_eigenvalues e;
  return !bike_upright_eigenvalues(&e, model, speed) && bike_all_decay(&e);
}

static term_exit answer(const bike_bicycle *bicycle, const bike_model *model, const arguments *args,
                        const basin_map *map) {
  bool stable = is_stable(model, args->speed);
  if (!stable) term_message("riding straight at %g m/s is not stable", args->speed);
  if (args->output) {
    term_exit code =
        basin_write(map, bicycle, args->speed, args->time, args->show.convention, args->output);
    if (code != TERM_DONE) return code;
  }
  if (args->show.json)
    return print_json(bicycle, args, map, stable) ? TERM_DONE
                                                  : term_fail_bike(BIKE_ERROR_MEMORY, args->file);
  print_map(bicycle, args, map);
  return TERM_DONE;
}

int cmd_basin(int argc, char **argv) {
  const struct argp_child children[] = {
      {&term_file_argp, 0, NULL, 0}, {&term_show_argp, 0, NULL, 0}, {0}};
  const struct argp argp = {options, parse, "FILE", documentation, children, NULL, NULL};
  arguments args = defaults();
  term_parse(&argp, example, argc, argv, &args);

  bike_bicycle bicycle;
  bike_model model;
  basin_map map = {0};
  term_exit code = term_load_bicycle(&bicycle, &model, args.file);
  if (code == TERM_DONE) {
    int error = find_basin(&map, &model, &args);
    code = error ? term_fail_bike(error, args.file) : answer(&bicycle, &model, &args, &map);
  }
  free(map.leans);
  free(map.steers);
  free(map.fates);
  return code;
}
