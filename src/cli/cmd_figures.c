// SPDX-License-Identifier: Apache-2.0
// bicycle figures: figures 2, 3 and 4 of the paper for any bicycle.
#include "angle_range.h"
#include "commands.h"
#include "figures/figure_list.h"
#include "figures/figure_map.h"
#include "figures/figure_range.h"
#include "terminal/command.h"
#include "terminal/data.h"
#include "terminal/threads.h"

#include <bicycle/error.h>
#include <bicycle/stability.h>
#include <math.h>
#include <string.h>

static const char example[] =
    "Example: bicycle figures roadster -o figures\n"
    "         bicycle figures penny_farthing -o pf --speeds 1:8:141 --leans 0:30deg:61\n";

static const char documentation[] =
    "Draws figures 2 (stationary motion over speed and lean), 3 (stable range against the wheels' "
    "inertia) and 4 (against the trail) of Franke, Suhr and Riess (1990) as SVG, with a CSV table "
    "beside each and a page index.html that holds them. Figure 2 needs a rider. With --json a list "
    "of the figures: files, axes, ranges, what is held fixed.";

typedef struct arguments {
  const char *file, *folder;
  term_range speeds, leans;              // of figure 2
  term_range inertia, trail;             // of figures 3 and 4; count 0: from the bicycle
  double fastest_inertia, fastest_trail; // m/s  ends of their axes
  bool fit;                              // nothing is known of where they should end
  int threads;
  term_show show;
} arguments;

enum {
  KEY_SPEEDS = TERM_KEY_FIRST,
  KEY_LEANS,
  KEY_INERTIA,
  KEY_TRAIL,
  KEY_FASTEST_INERTIA,
  KEY_FASTEST_TRAIL,
  KEY_THREADS
};

// Grids of figure 2 are held in memory, and two points span an axis.
enum { LEAST_POINTS = 3, MOST_POINTS = 2001 };

static term_range range_of(const char *option, const char *text, double lowest) {
  term_range range;
  if (!term_parse_range(&range, text) || range.first < lowest || range.count < LEAST_POINTS ||
      range.count > MOST_POINTS)
    term_usage("%s: '%s' is not A:B:N, N points (%d to %d) from A >= %g to B > A", option, text,
               LEAST_POINTS, MOST_POINTS, lowest);
  return range;
}

// Beyond, nothing rides; and an axis must be one that can be drawn.
static const double most_speed = 1000, least_axis = 0.1; // m/s

static term_range speeds_of(const char *text) {
  term_range range = range_of("--speeds", text, 0);
  if (range.last > most_speed)
    term_usage("--speeds: %g m/s is faster than %g m/s", range.last, most_speed);
  return range;
}

static double axis_of(const char *option, const char *text) {
  double end = term_positive_of(option, text);
  if (end < least_axis || end > most_speed)
    term_usage("%s: %s m/s is not between %g and %g m/s", option, text, least_axis, most_speed);
  return end;
}

static const cli_angle_bounds lean_bounds = {
    .high = M_PI / 2, .from_low = true, .least = LEAST_POINTS, .most = MOST_POINTS};

static error_t parse(int key, char *text, struct argp_state *state) {
  arguments *args = state->input;
  switch (key) {
  case ARGP_KEY_INIT:
    state->child_inputs[0] = &args->file;
    state->child_inputs[1] = &args->show;
    return 0;
  case 'o':
    args->folder = text;
    return 0;
  case KEY_SPEEDS:
    args->speeds = speeds_of(text);
    return 0;
  case KEY_LEANS:
    args->leans = cli_angle_range_of("--leans", text, &lean_bounds);
    return 0;
  case KEY_INERTIA:
    args->inertia = range_of("--inertia", text, 0);
    return 0;
  case KEY_TRAIL:
    args->trail = range_of("--trail", text, -10);
    return 0;
  case KEY_FASTEST_INERTIA:
    args->fastest_inertia = axis_of("--fastest-inertia", text);
    return 0;
  case KEY_FASTEST_TRAIL:
    args->fastest_trail = axis_of("--fastest-trail", text);
    return 0;
  case KEY_THREADS:
    args->threads = term_threads_of("--threads", text);
    return 0;
  case ARGP_KEY_END:
    if (!args->folder || !*args->folder) term_usage("the folder of the figures is missing: -o DIR");
    return 0;
  default:
    return ARGP_ERR_UNKNOWN;
  }
}

static const struct argp_option options[] = {
    {"output", 'o', "DIR", 0, "Folder of the figures, made if need be (required)", 1},
    {"speeds", KEY_SPEEDS, "A:B:N", 0, "Speeds of figure 2, m/s (around the stable range, 241)", 2},
    {"leans", KEY_LEANS, "A:B:N", 0, "Leans of figure 2, rad or deg (0:45deg:181)", 2},
    {"inertia", KEY_INERTIA, "A:B:N", 0,
     "Front wheel's inertia in figure 3, kg m^2 (zero to 2.5 times the bicycle's, 201)", 3},
    {"fastest-inertia", KEY_FASTEST_INERTIA, "V", 0,
     "End of figure 3's axis of speed, m/s (from the stable range)", 3},
    {"trail", KEY_TRAIL, "A:B:N", 0, "Trails of figure 4, m (zero to twice the bicycle's, 201)", 4},
    {"fastest-trail", KEY_FASTEST_TRAIL, "V", 0,
     "End of figure 4's axis of speed, m/s (from the stable range)", 4},
    {"threads", KEY_THREADS, "N", 0, "Threads (all processors)", 7},
    {0},
};

static arguments defaults(void) {
  return (arguments){.leans = {0, M_PI / 4, 181}, .threads = term_processors()};
}

enum { SPEEDS = 241 };

// A round number not below x.
static double round_up(double x) {
  static const double steps[] = {1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10};
  double power = pow(10, floor(log10(x)));
  for (size_t i = 0; i < sizeof steps / sizeof steps[0]; i++)
    if (x <= steps[i] * power * (1 + 1e-12)) return steps[i] * power;
  return 10 * power;
}

// Axes that were not given are made to show the stable ranges and what surrounds it.
static int choose_axes(arguments *args, const bike_model *model) {
  const double fastest = bike_search_end(model), usual = fastest / 40;
  bike_critical_speeds found;
  int code = bike_upright_critical_speeds(&found, model, 0, fastest);
  if (code) return code;
  double low = 5 * usual, high = 7 * usual; // as of what people ride
  args->fit = found.range_count == 0 && !(args->fastest_inertia > 0 || args->fastest_trail > 0);
  if (found.range_count > 0) {
    const double *last = found.ranges[found.range_count - 1];
    low = found.ranges[0][0];
    high = last[1] < fastest ? last[1] : 1.4 * last[0];
  }
  if (args->speeds.count == 0)
    args->speeds = (term_range){fmax(0.5, 0.5 * round(0.8 * low)), round_up(1.4 * high), SPEEDS};
  if (!(args->fastest_inertia > 0)) args->fastest_inertia = round_up(2.8 * high);
  if (!(args->fastest_trail > 0)) args->fastest_trail = round_up(1.7 * high);
  return BIKE_OK;
}

static int add_figure_2(figure_set *set, const bike_model *model, const arguments *args,
                        term_progress *progress) {
  turn_map map;
  if (!(model->rider_mass > 0)) {
    snprintf(set->note, sizeof set->note,
             "Figure 2 is missing: it shows the rider's displacement, and %s.",
             bike_error_string(BIKE_ERROR_NO_RIDER));
    return BIKE_OK;
  }
  int code = turn_map_make(&map, model, &args->speeds, &args->leans, args->threads, progress);
  if (!code && !figure_add_maps(set, &map)) code = BIKE_ERROR_MEMORY;
  turn_map_free(&map);
  return code;
}

#define HELD_INERTIA                                                                               \
  "the ratio of the wheels\u2019 inertias, masses, diametral inertias (the steering "              \
  "system\u2019s "                                                                                 \
  "among them), lengths"
#define HELD_TRAIL                                                                                 \
  "head angle, wheelbase, radii, masses; handlebar and fork fixed in space (shaded), or fixed to " \
  "the steering axis (limits heavy dashed)"

static int add_figure_3(figure_set *set, const arguments *args, term_progress *progress) {
  range_figure wanted = {
      .words = {"fig3", "3", "stable range against the wheels\u2019 inertia",
                "Self-stability region (shaded) of upright riding as a function of the "
                "moment of inertia of both wheels; heavy dashed: limits if the rear wheel keeps "
                "its own. Held fixed: " HELD_INERTIA ". Arrows: the bicycle as it is.",
                HELD_INERTIA},
      .family_column = "rear_wheel_kept",
      .value_column = "front_wheel_inertia",
      .axis = {"front wheel\u2019s moment of inertia", "\u0398", "f", "kg m\u00b2"},
      .factor = 1,
      .families = {{BIKE_VARY_WHEEL_INERTIA, BIKE_FRONT_IN_SPACE, "both wheels alike"},
                   {BIKE_VARY_FRONT_WHEEL_INERTIA, BIKE_FRONT_IN_SPACE, "rear wheel kept"}},
      .values = args->inertia,
      .fastest = args->fastest_inertia,
      .fit = args->fit};
  double now;
  int code = bike_variation_value(&now, set->bicycle, BIKE_VARY_WHEEL_INERTIA);
  if (code == BIKE_ERROR_PARAMETER) {
    snprintf(set->note + strlen(set->note), sizeof set->note - strlen(set->note),
             "%sFigure 3 is missing: this bicycle's front wheel has no inertia to vary.",
             *set->note ? " " : "");
    return BIKE_OK;
  }
  if (!code && wanted.values.count == 0) wanted.values = (term_range){0, 2.5 * now, 201};
  return code ? code : figure_add_range(set, &wanted, progress);
}

static int add_figure_4(figure_set *set, const arguments *args, term_progress *progress) {
  range_figure wanted = {
      .words = {"fig4", "4", "stable range against the trail",
                "Self-stability region (shaded) of upright riding as a function of the "
                "trail. Held fixed: " HELD_TRAIL ". Arrows: the bicycle as it is.",
                HELD_TRAIL},
      .family_column = "front_on_axis",
      .value_column = "trail",
      .axis = {"trail", "T", "f", "cm"},
      .factor = 100,
      .families = {{BIKE_VARY_TRAIL, BIKE_FRONT_IN_SPACE, "fork fixed in space"},
                   {BIKE_VARY_TRAIL, BIKE_FRONT_ON_AXIS, "fork fixed to the axis"}},
      .values = args->trail,
      .fastest = args->fastest_trail,
      .fit = args->fit};
  double now;
  int code = bike_variation_value(&now, set->bicycle, BIKE_VARY_TRAIL);
  // where the trail is small or negative, the usual trails of bicycles
  const double usual = 0.08;
  if (!code && wanted.values.count == 0)
    wanted.values = (term_range){fmin(0, 2 * now), 2 * fmax(now, usual), 201};
  return code ? code : figure_add_range(set, &wanted, progress);
}

int cmd_figures(int argc, char **argv) {
  const struct argp_child children[] = {
      {&term_file_argp, 0, NULL, 0}, {&term_show_argp, 0, NULL, 0}, {0}};
  const struct argp argp = {options, parse, "FILE", documentation, children, NULL, NULL};
  arguments args = defaults();
  term_parse(&argp, example, argc, argv, &args);

  bike_bicycle bicycle;
  bike_model model;
  term_exit code = term_load_bicycle(&bicycle, &model, args.file);
  if (code != TERM_DONE) return code;
  figure_set set = {.bicycle = &bicycle, .convention = args.show.convention};
  term_progress progress = {0};
  int error = choose_axes(&args, &model);
  if (!error) error = add_figure_2(&set, &model, &args, &progress);
  if (!error) error = add_figure_3(&set, &args, &progress);
  if (!error) error = add_figure_4(&set, &args, &progress);
  term_progress_clear(&progress);
  if (!error && *set.note) term_message("%s", set.note);
  code = error ? term_fail_bike(error, args.file) : figure_write_all(&set, args.folder);
  if (code == TERM_DONE)
    term_message("%d figures in %s, convention %s", set.count, args.folder,
                 term_convention_name(args.show.convention));
  if (code == TERM_DONE && args.show.json &&
      !term_json_write(figure_list_json(&set, args.folder, args.show.convention), stdout))
    code = term_fail_bike(BIKE_ERROR_MEMORY, args.file);
  figure_set_free(&set);
  return code;
}
