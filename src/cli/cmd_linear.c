// SPDX-License-Identifier: Apache-2.0
// bicycle linear: the matrices of the linearised equations of motion.
#include "commands.h"
#include "terminal/command.h"
#include "terminal/data.h"
#include "terminal/json.h"
#include "terminal/message.h"
#include "terminal/table.h"
#include "turn_pick.h"

#include <bicycle/error.h>
#include <bicycle/linear.h>

static const char example[] = "Example: bicycle linear benchmark --speed 5 --json\n"
                              "         bicycle linear roadster --speed 5.5 --lean 10deg\n"
                              "         bicycle linear benchmark --lean 10deg --rider-offset 0\n";

static const char documentation[] =
    "M q'' + v C1 q' + (g K0 + v^2 K2) q = f with q = (lean, steer), f = (roll torque, steer "
    "torque), and x' = A x + B u with x = (steer, lean, steer rate, lean rate), u = (steer torque, "
    "roll torque, acceleration of the rider offset), about riding straight and upright at a "
    "constant speed. Steer damping is in A alone. With --lean or --rider-offset A and B are those "
    "of the stationary turn of that speed, the one nearest to upright where there are several; "
    "with --lean and --rider-offset the speed is the turn's.";

typedef struct arguments {
  term_question question;
  double speed;
  bool has_speed;
  bike_turn_def turn; // with the lean or the offset, where one is given
} arguments;

enum { KEY_SPEED = TERM_KEY_FIRST, KEY_LEAN, KEY_RIDER_OFFSET };

static void give(bike_turn_def *turn, bike_turn_variable variable, double value) {
  turn->given[variable] = true;
  turn->value[variable] = value;
}

static bool asks_for_turn(const arguments *args) {
  return args->turn.given[BIKE_TURN_LEAN] || args->turn.given[BIKE_TURN_OFFSET];
}

static void check(arguments *args) {
  const bool *given = args->turn.given;
  bool both = given[BIKE_TURN_LEAN] && given[BIKE_TURN_OFFSET];
  if (!args->has_speed && !both) term_usage("--speed is missing");
  if (args->has_speed && both)
    term_usage("two of --speed, --lean and --rider-offset make a turn, not three");
  if (!args->has_speed || !asks_for_turn(args)) return;
  if (args->speed < 0) term_usage("--speed: %g is negative, and a turn is asked for", args->speed);
  give(&args->turn, BIKE_TURN_SPEED, args->speed);
}

static error_t parse(int key, char *text, struct argp_state *state) {
  arguments *args = state->input;
  switch (key) {
  case ARGP_KEY_INIT:
    state->child_inputs[0] = &args->question;
    return 0;
  case KEY_SPEED:
    args->speed = term_number_of("--speed", text);
    args->has_speed = true;
    return 0;
  case KEY_LEAN:
    give(&args->turn, BIKE_TURN_LEAN, term_angle_of("--lean", text));
    return 0;
  case KEY_RIDER_OFFSET:
    give(&args->turn, BIKE_TURN_OFFSET, term_number_of("--rider-offset", text));
    return 0;
  case ARGP_KEY_END:
    check(args);
    return 0;
  default:
    return ARGP_ERR_UNKNOWN;
  }
}

static const struct argp_option options[] = {
    {"speed", KEY_SPEED, "V", 0, "Speed, m/s (required but for a turn of given lean and offset)",
     1},
    {"lean", KEY_LEAN, "ANGLE", 0, "About the turn with this lean, rad or 5deg", 1},
    {"rider-offset", KEY_RIDER_OFFSET, "W", 0, "About the turn with the rider there, m", 1},
    {0},
};

// What is shown. The names are those of the JSON document.
typedef struct linear_answer {
  bike_upright_matrices upright;
  bike_linear linear;
  bool has_upright; // the bicycle is mirror-symmetric
  bike_turn turn;   // about which A and B are taken; straight riding unless asked for
} linear_answer;

enum { Q_COUNT = 2, X_COUNT = 4, U_COUNT = 3 };

static const char *const coordinates[Q_COUNT] = {"lean", "steer"};
static const char *const states[X_COUNT] = {"steer", "lean", "steer_rate", "lean_rate"};
static const char *const inputs[U_COUNT] = {"steer_torque", "roll_torque",
                                            "rider_offset_acceleration"};
// Whether an entry is left positive in ISO and so changes its sign with the convention.
static const bool q_left[Q_COUNT] = {false, true};
static const bool x_left[X_COUNT] = {true, false, true, false};
static const bool u_left[U_COUNT] = {true, false, false};

// A matrix between quantities some of which are left positive: entry (i, j) takes the sign of the
// row times that of the column.
static void convert(double *matrix, const bool *row_left, int rows, const bool *column_left,
                    int columns, double left) {
  for (int i = 0; i < rows; i++)
    for (int j = 0; j < columns; j++)
      if (row_left[i] != column_left[j]) matrix[i * columns + j] *= left;
}

static void convert_all(linear_answer *out, double left) {
  out->turn.steer *= left;
  double *const upright[] = {out->upright.M, out->upright.C1, out->upright.K0, out->upright.K2};
  for (int i = 0; i < 4; i++) convert(upright[i], q_left, Q_COUNT, q_left, Q_COUNT, left);
  convert(out->linear.A, x_left, X_COUNT, x_left, X_COUNT, left);
  convert(out->linear.B, x_left, X_COUNT, u_left, U_COUNT, left);
}

// The upright matrices, or null for a bicycle that has none.
static json_t *upright_json(const linear_answer *answer, const double matrix[4]) {
  return answer->has_upright ? term_json_matrix(matrix, Q_COUNT, Q_COUNT) : json_null();
}

static const char no_upright[] = "the bicycle is not mirror-symmetric: upright straight riding is "
                                 "not a stationary motion";

static bool print_json(const bike_bicycle *bicycle, const arguments *args,
                       const linear_answer *answer) {
  const bike_upright_matrices *upright = &answer->upright;
  json_t *document = json_pack(
      "{s:s, s:s, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o}", "bicycle", bicycle->name,
      "convention", term_convention_name(args->question.show.convention), "speed",
      term_json_number(answer->turn.speed), "coordinates", term_json_texts(coordinates, Q_COUNT),
      "M", upright_json(answer, upright->M), "C1", upright_json(answer, upright->C1), "K0",
      upright_json(answer, upright->K0), "K2", upright_json(answer, upright->K2), "states",
      term_json_texts(states, X_COUNT), "inputs", term_json_texts(inputs, U_COUNT), "A",
      term_json_matrix(answer->linear.A, X_COUNT, X_COUNT), "B",
      term_json_matrix(answer->linear.B, X_COUNT, U_COUNT));
  const bike_turn *turn = &answer->turn;
  if (asks_for_turn(args))
    json_object_set_new(document, "turn",
                        json_pack("{s:o, s:o, s:o}", "lean", term_json_number(turn->lean), "steer",
                                  term_json_number(turn->steer), "rider_offset",
                                  term_json_number(turn->rider_offset)));
  if (!answer->has_upright) json_object_set_new(document, "reason", json_string(no_upright));
  return term_json_write(document, stdout);
}

// A matrix with its rows and columns named.
static bool print_matrix(const char *title, const double *matrix, const char *const *row_names,
                         int rows, const char *const *column_names, int columns) {
  term_column heads[1 + X_COUNT] = {{title, TERM_LEFT}};
  for (int j = 0; j < columns; j++) heads[1 + j] = (term_column){column_names[j], TERM_RIGHT};
  term_table *table = term_table_create(heads, 1 + columns);
  for (int i = 0; i < rows; i++) {
    char text[X_COUNT][32];
    const char *cells[1 + X_COUNT] = {row_names[i]};
    for (int j = 0; j < columns; j++) {
      snprintf(text[j], sizeof text[j], "%.10g", matrix[i * columns + j] + 0.0); // no "-0"
      cells[1 + j] = text[j];
    }
    term_table_add(table, TERM_PLAIN, cells);
  }
  putchar('\n');
  bool printed = term_table_print(table, stdout);
  term_table_free(table);
  return printed;
}

static bool print_q(const char *title, const double matrix[4]) {
  return print_matrix(title, matrix, coordinates, Q_COUNT, coordinates, Q_COUNT);
}

static bool print_tables(const bike_bicycle *bicycle, const arguments *args,
                         const linear_answer *answer) {
  const bike_upright_matrices *upright = &answer->upright;
  printf("%s at %g m/s, convention %s\n", bicycle->name, answer->turn.speed,
         term_convention_name(args->question.show.convention));
  if (asks_for_turn(args))
    printf("A and B about the turn with lean %.10g rad, steer %.10g rad, rider %.10g m\n",
           answer->turn.lean, answer->turn.steer, answer->turn.rider_offset + 0.0);
  bool printed = true;
  if (answer->has_upright)
    printed = print_q("M", upright->M) && print_q("C1", upright->C1) &&
              print_q("K0", upright->K0) && print_q("K2", upright->K2);
  else
    printf("\nno M, C1, K0, K2: %s\n", no_upright);
  return printed && print_matrix("A", answer->linear.A, states, X_COUNT, states, X_COUNT) &&
         print_matrix("B", answer->linear.B, states, X_COUNT, inputs, U_COUNT);
}

// The linearisations. An error code of the library.
static int linearise(linear_answer *out, const bike_model *model, const arguments *args) {
  out->turn.speed = args->speed;
  int error = bike_linearize_upright(&out->upright, model);
  out->has_upright = error == BIKE_OK;
  if (error == BIKE_ERROR_NOT_STATIONARY) error = BIKE_OK;
  if (error == BIKE_OK && asks_for_turn(args)) error = turn_pick(&out->turn, model, &args->turn);
  if (error != BIKE_OK) return error;
  const bike_turn *turn = &out->turn;
  const bike_state state = {.lean = turn->lean, .steer = turn->steer, .speed = turn->speed};
  const bike_input input = {.rider_offset = turn->rider_offset};
  return bike_linearize(&out->linear, model, &state, &input);
}

static term_exit fail(int error, const arguments *args) {
  const char *file = args->question.file;
  if (error == BIKE_ERROR_NO_RIDER && args->has_speed && args->turn.given[BIKE_TURN_LEAN])
    return term_fail(TERM_USAGE,
                     "%s: no part is the rider, so that the lean decides the speed: give --lean "
                     "and --rider-offset 0, and no --speed",
                     file);
  if (error == BIKE_ERROR_NO_RIDER)
    return term_fail(TERM_USAGE, "%s: no part is the rider: --rider-offset can only be 0", file);
  if (error == BIKE_ERROR_NOT_STATIONARY && asks_for_turn(args))
    return term_fail(TERM_USAGE, "%s: there is no such turn ('bicycle turn' tells which there are)",
                     file);
  return term_fail_bike(error, file);
}

int cmd_linear(int argc, char **argv) {
  const struct argp_child children[] = {{&term_question_argp, 0, NULL, 0}, {0}};
  const struct argp argp = {options, parse, "FILE", documentation, children, NULL, NULL};
  arguments args = {.turn = bike_default_turn_def()};
  term_parse(&argp, example, argc, argv, &args);

  bike_bicycle bicycle;
  bike_model model;
  term_exit code = term_load_bicycle(&bicycle, &model, args.question.file);
  if (code != TERM_DONE) return code;

  linear_answer answer = {0};
  int error = linearise(&answer, &model, &args);
  if (error != BIKE_OK) return fail(error, &args);
  convert_all(&answer, term_left_sign(args.question.show.convention));
  bool printed = args.question.show.json ? print_json(&bicycle, &args, &answer)
                                         : print_tables(&bicycle, &args, &answer);
  return printed ? TERM_DONE : term_fail_bike(BIKE_ERROR_MEMORY, args.question.file);
}
