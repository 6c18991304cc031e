// SPDX-License-Identifier: Apache-2.0
// bicycle state: the equations evaluated once.
#include "commands.h"
#include "terminal/json.h"
#include "terminal/outside.h"
#include "terminal/start.h"
#include "terminal/table.h"

#include <bicycle/error.h>

static const char example[] =
    "Example: bicycle state roadster --speed 6 --lean 10deg --steer -8deg\n";

static const char documentation[] =
    "Accelerations, geometry, energy and ground forces of the bicycle at one instant. FILE is a "
    "bicycle file or the name of a shipped bicycle. What no ground and no rider can do (a wheel "
    "that is pulled, more friction than --friction, a rider beyond --reach) is marked as outside "
    "physics: the equations answer there too.";

typedef struct arguments {
  term_start start;
  bike_input input;
  term_limits limits;
  term_show show;
} arguments;

enum { KEY_STEER_TORQUE = TERM_KEY_FIRST, KEY_RIDER_OFFSET };

static error_t parse(int key, char *text, struct argp_state *state) {
  arguments *args = state->input;
  switch (key) {
  case ARGP_KEY_INIT:
    state->child_inputs[0] = &args->start;
    state->child_inputs[1] = &args->limits;
    state->child_inputs[2] = &args->show;
    return 0;
  case KEY_STEER_TORQUE:
    args->input.steer_torque = term_number_of("--steer-torque", text);
    return 0;
  case KEY_RIDER_OFFSET:
    args->input.rider_offset = term_number_of("--rider-offset", text);
    return 0;
  default:
    return ARGP_ERR_UNKNOWN;
  }
}

static const struct argp_option options[] = {
    {"steer-torque", KEY_STEER_TORQUE, "T", 0, "Torque on the steer, left positive, N m", 2},
    {"rider-offset", KEY_RIDER_OFFSET, "W", 0, "Rider to the right of the file's place, m", 2},
    {0},
};

// One number of the answer.
typedef struct answer {
  const char *key;
  double value;
  const char *unit;
} answer;

enum { ANSWER_COUNT = 23 };

// Every number of a state under its key; `left` is the sign of what is left positive in ISO.
static void collect(answer out[ANSWER_COUNT], const bike_state *state,
                    const bike_snapshot *snapshot, double left) {
  const answer answers[ANSWER_COUNT] = {
      {"lean", state->lean, "rad"},
      {"steer", left * state->steer, "rad"},
      {"lean_rate", state->lean_rate, "rad/s"},
      {"steer_rate", left * state->steer_rate, "rad/s"},
      {"speed", state->speed, "m/s"},
      {"pitch", snapshot->pitch, "rad"},
      {"beta_r", snapshot->beta_r, "rad"},
      {"beta_f", snapshot->beta_f, "rad"},
      {"psi", snapshot->psi, "rad"},
      {"phi_tilde", left * snapshot->phi_tilde, "rad"},
      {"T_r", snapshot->T_r, "m"},
      {"T_f", snapshot->T_f, "m"},
      {"Z_0", snapshot->Z_0, "m"},
      {"yaw_rate", left * snapshot->yaw_rate, "rad/s"},
      {"front_speed", snapshot->front_speed, "m/s"},
      {"lean_acc", snapshot->acceleration.lean, "rad/s^2"},
      {"steer_acc", left * snapshot->acceleration.steer, "rad/s^2"},
      {"speed_rate", snapshot->acceleration.speed, "m/s^2"},
      {"kinetic", snapshot->kinetic, "J"},
      {"potential", snapshot->potential, "J"},
      {"energy", snapshot->kinetic + snapshot->potential, "J"},
      {"rear_friction", bike_friction(snapshot->rear_force), ""},
      {"front_friction", bike_friction(snapshot->front_force), ""},
  };
  for (int i = 0; i < ANSWER_COUNT; i++) out[i] = answers[i];
}

static json_t *force_json(const double force[3], double left) {
  const double shown[3] = {force[0], left * force[1], force[2]};
  return term_json_numbers(shown, 3);
}

static term_outside outside_of(const bike_snapshot *snapshot, const arguments *args) {
  term_outside out = {0};
  const double *rear = snapshot->rear_force, *front = snapshot->front_force;
  term_outside_wheel(&out, "rear", rear[2], bike_friction(rear), &args->limits);
  term_outside_wheel(&out, "front", front[2], bike_friction(front), &args->limits);
  term_outside_rider(&out, args->input.rider_offset, &args->limits);
  return out;
}

static bool print_json(const bike_bicycle *bicycle, const answer answers[ANSWER_COUNT],
                       const bike_snapshot *snapshot, const term_outside *outside,
                       bike_convention convention) {
  double left = term_left_sign(convention);
  json_t *document = json_pack("{s:s, s:s}", "bicycle", bicycle->name, "convention",
                               term_convention_name(convention));
  for (int i = 0; i < ANSWER_COUNT; i++)
    json_object_set_new(document, answers[i].key, term_json_number(answers[i].value));
  json_object_set_new(document, "rear_force", force_json(snapshot->rear_force, left));
  json_object_set_new(document, "front_force", force_json(snapshot->front_force, left));
  json_object_set_new(document, "force_axes",
                      json_pack("[s, s, s]", "forward", term_lateral_name(convention), "up"));
  json_object_set_new(document, "outside_physics", term_outside_json(outside));
  return term_json_write(document, stdout);
}

static void add_number(term_table *table, const char *name, double value, const char *unit) {
  char text[32];
  snprintf(text, sizeof text, "%.10g", value + 0.0); // no "-0"
  term_table_add(table, TERM_PLAIN, (const char *const[]){name, text, unit});
}

static void add_force(term_table *table, const char *wheel, const double force[3],
                      bike_convention convention) {
  const char *const axis[3] = {"forward", term_lateral_name(convention), "up"};
  for (int i = 0; i < 3; i++) {
    char name[64];
    snprintf(name, sizeof name, "%s_force %s", wheel, axis[i]);
    add_number(table, name, (i == 1 ? term_left_sign(convention) : 1) * force[i], "N");
  }
}

static bool print_table(const bike_bicycle *bicycle, const answer answers[ANSWER_COUNT],
                        const bike_snapshot *snapshot, const term_outside *outside,
                        bike_convention convention) {
  static const term_column columns[] = {
      {"quantity", TERM_LEFT}, {"value", TERM_RIGHT}, {"unit", TERM_LEFT}};
  term_table *table = term_table_create(columns, 3);
  for (int i = 0; i < ANSWER_COUNT; i++)
    add_number(table, answers[i].key, answers[i].value, answers[i].unit);
  add_force(table, "rear", snapshot->rear_force, convention);
  add_force(table, "front", snapshot->front_force, convention);
  printf("%s, convention %s\n", bicycle->name, term_convention_name(convention));
  bool printed = term_table_print(table, stdout);
  term_table_free(table);
  for (int i = 0; i < outside->count; i++) {
    char text[TERM_OUTSIDE_SIZE];
    term_outside_text(text, &outside->items[i]);
    printf("outside physics: %s\n", text);
  }
  return printed;
}

int cmd_state(int argc, char **argv) {
  const struct argp_child children[] = {{&term_start_argp, 0, NULL, 0},
                                        {&term_limits_argp, 0, NULL, 0},
                                        {&term_show_argp, 0, NULL, 0},
                                        {0}};
  const struct argp argp = {options, parse, "FILE", documentation, children, NULL, NULL};
  arguments args = {0};
  term_parse(&argp, example, argc, argv, &args);

  bike_bicycle bicycle;
  bike_model model;
  term_exit code = term_load_with_rider(&bicycle, &model, args.start.file, args.input.rider_offset);
  if (code != TERM_DONE) return code;

  bike_snapshot snapshot;
  int error = bike_evaluate(&snapshot, &model, &args.start.state, &args.input);
  if (error != BIKE_OK) return term_fail_bike(error, args.start.file);

  term_set_reach(&args.limits, &bicycle);
  const term_outside outside = outside_of(&snapshot, &args);
  answer answers[ANSWER_COUNT];
  collect(answers, &args.start.state, &snapshot, term_left_sign(args.show.convention));
  bool printed = args.show.json
                     ? print_json(&bicycle, answers, &snapshot, &outside, args.show.convention)
                     : print_table(&bicycle, answers, &snapshot, &outside, args.show.convention);
  return printed ? TERM_DONE : term_fail_bike(BIKE_ERROR_MEMORY, args.start.file);
}
