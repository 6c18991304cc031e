// SPDX-License-Identifier: Apache-2.0
#include "turn_show.h"

#include "terminal/json.h"
#include "terminal/table.h"

#include <bicycle/error.h>
#include <bicycle/modes.h>
#include <math.h>
#include <string.h>

static const double DEGREE = M_PI / 180;

static bool has_lifted(const bike_turn *turn) {
  return turn->rear_normal < 0 || turn->front_normal < 0;
}

static term_outside outside_of(const turn_answer *a, const bike_turn *turn) {
  term_outside out = {0};
  term_outside_wheel(&out, "rear", turn->rear_normal, turn->rear_friction, a->limits);
  term_outside_wheel(&out, "front", turn->front_normal, turn->front_friction, a->limits);
  term_outside_rider(&out, turn->rider_offset, a->limits);
  return out;
}

// Straight riding at a capsize speed, where no other eigenvalue decides: the one that vanishes is
// zero to the 1e-11 of the speed at which the library takes it for that speed.
static bool is_neutral(const bike_turn *turn) {
  const double rounding = 1e-9; // 1/s
  return turn->mark == BIKE_TURN_STRAIGHT && fabs(turn->eps_max) <= rounding;
}

static const char *stability_of(const bike_turn *turn) {
  if (is_neutral(turn)) return "neutral";
  return turn->eps_max < 0 ? "yes" : "no";
}

// For reading: what is left of a zero by rounding is none.
static double shown(double value) {
  const double rounding = 1e-12; // deg, cm, 1/s: far below what matters, far above 1e-15
  return fabs(value) < rounding ? 0 : value;
}

static int given_count(const bike_turn_def *def) {
  int count = 0;
  for (int v = 0; v < BIKE_TURN_VARIABLES; v++) count += def->given[v];
  return count;
}

static int main_count(const bike_turns *found) {
  int count = 0;
  while (count < found->count && found->turns[count].main_family) count++;
  return count;
}

// Whether riding straight at a capsize speed is among the answers.
static bool meets_straight(const bike_turns *found) {
  for (int i = 0; i < found->count; i++)
    if (found->turns[i].mark == BIKE_TURN_STRAIGHT) return true;
  return false;
}

// Why there is nothing, or what more there is; NULL: nothing to say.
static const char *remark(const turn_answer *a) {
  if (a->found->straight)
    return "riding straight and upright, at whatever speed, answers the question too";
  if (given_count(a->def) < 2)
    return "one variable leaves whole branches: only their folds and ends are shown";
  if (meets_straight(a->found))
    return "a capsize speed: hands-free turns branch off riding straight here, and none is "
           "distinct "
           "from it";
  if (main_count(a->found) > 0) return NULL;
  return a->found->count > 0 ? "no such turn in the main family, from which straight riding is "
                               "reached by moving the rider or hands free"
                             : "no stationary turn of this kind within the limits";
}

static void describe_mark(char out[64], const bike_turn *turn) {
  const char *variable = bike_turn_variable_string(turn->fold);
  switch (turn->mark) {
  case BIKE_TURN_LARGEST:
    snprintf(out, 64, "fold: largest %s", variable);
    return;
  case BIKE_TURN_SMALLEST:
    snprintf(out, 64, "fold: smallest %s", variable);
    return;
  case BIKE_TURN_STATIC:
    snprintf(out, 64, "static end");
    return;
  case BIKE_TURN_STRAIGHT:
    snprintf(out, 64, "meets straight riding");
    return;
  default:
    out[0] = '\0';
  }
}

// Names of the modes, in the order of the eigenvalues, where eigenvectors tell them.
static json_t *mode_names(const bike_model *model, const bike_turn *turn) {
  bike_state state = {.lean = turn->lean, .steer = turn->steer, .speed = turn->speed};
  bike_input input = {.steer_torque = turn->steer_torque, .rider_offset = turn->rider_offset};
  bike_linear linear;
  bike_modes modes = {0};
  if (bike_linearize(&linear, model, &state, &input) == BIKE_OK) bike_modes_of(&modes, linear.A);
  const char *names[4];
  for (int i = 0; i < 4; i++) names[i] = bike_mode_string(modes.mode[i]);
  return term_json_texts(names, 4);
}

static json_t *turn_json(const turn_answer *a, const bike_turn *t, double left) {
  double values[8];
  for (int i = 0; i < 4; i++) {
    values[2 * i] = t->eigenvalues.re[i];
    values[2 * i + 1] = t->eigenvalues.im[i];
  }
  const struct {
    const char *key;
    double value;
  } numbers[] = {{"lean", t->lean},
                 {"steer", left * t->steer},
                 {"speed", t->speed},
                 {"rider_offset", t->rider_offset},
                 {"yaw_rate", left * t->yaw_rate},
                 {"radius", t->radius},
                 {"steer_torque", left * t->steer_torque},
                 {"eps_max", t->eps_max},
                 {"rear_normal", t->rear_normal},
                 {"front_normal", t->front_normal},
                 {"rear_friction", t->rear_friction},
                 {"front_friction", t->front_friction},
                 {"residual", t->residual}};
  json_t *object = json_object();
  for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++)
    json_object_set_new(object, numbers[i].key, term_json_number(numbers[i].value));
  json_object_set_new(object, "eigenvalues", term_json_matrix(values, 4, 2));
  json_object_set_new(object, "modes", mode_names(a->model, t));
  const term_outside outside = outside_of(a, t);
  json_object_set_new(object, "lifted", json_boolean(has_lifted(t)));
  json_object_set_new(object, "outside_physics", term_outside_json(&outside));
  json_object_set_new(object, "neutral", json_boolean(is_neutral(t)));
  json_object_set_new(object, "main_family", json_boolean(t->main_family));
  return object;
}

static json_t *list_json(const turn_answer *a, const bike_turn *turns, int count, double left) {
  json_t *list = json_array();
  for (int i = 0; i < count; i++) {
    json_t *object = turn_json(a, &turns[i], left);
    char mark[64];
    describe_mark(mark, &turns[i]);
    if (mark[0]) json_object_set_new(object, "mark", json_string(mark));
    json_array_append_new(list, object);
  }
  return list;
}

bool turn_print_json(const turn_answer *a, bike_convention convention) {
  double left = term_left_sign(convention);
  const bike_turns *f = a->found;
  int first = main_count(f);
  json_t *given = json_object();
  for (int v = 0; v < BIKE_TURN_VARIABLES; v++)
    if (a->def->given[v])
      json_object_set_new(given, bike_turn_variable_string((bike_turn_variable)v),
                          term_json_number((v == BIKE_TURN_STEER ? left : 1) * a->def->value[v]));
  json_t *document =
      json_pack("{s:s, s:s, s:o, s:o, s:o, s:o, s:b}", "bicycle", a->bicycle->name, "convention",
                term_convention_name(convention), "given", given, "solutions",
                list_json(a, f->turns, first, left), "elsewhere",
                list_json(a, f->turns + first, f->count - first, left), "marks",
                list_json(a, f->marks, f->mark_count, left), "straight_at_any_speed", f->straight);
  const char *text = remark(a);
  if (text) json_object_set_new(document, "reason", json_string(text));
  return term_json_write(document, stdout);
}

static bool print_list(const turn_answer *a, const char *title, const bike_turn *turns, int count,
                       double left, bool marks) {
  static const term_column columns[] = {{"lean deg", TERM_RIGHT},  {"steer deg", TERM_RIGHT},
                                        {"speed m/s", TERM_RIGHT}, {"rider cm", TERM_RIGHT},
                                        {"radius m", TERM_RIGHT},  {"eps_max 1/s", TERM_RIGHT},
                                        {"stable", TERM_LEFT},     {"friction asked", TERM_RIGHT},
                                        {"", TERM_LEFT},           {"outside physics", TERM_LEFT}};
  if (count == 0) return true;
  term_table *table = term_table_create(columns, 10);
  for (int i = 0; i < count; i++) {
    const bike_turn *t = &turns[i];
    const double numbers[6] = {t->lean / DEGREE, left * t->steer / DEGREE,
                               t->speed,         100 * t->rider_offset,
                               t->radius,        t->eps_max};
    char text[6][32], friction[32], mark[64], outside[TERM_OUTSIDE_SIZE];
    for (int k = 0; k < 6; k++) snprintf(text[k], sizeof text[k], "%.6g", shown(numbers[k]));
    snprintf(friction, sizeof friction, "%.2f", fmax(t->rear_friction, t->front_friction));
    describe_mark(mark, t);
    const term_outside what = outside_of(a, t);
    term_outside_brief(outside, &what);
    const char *note = marks ? mark : "", *stable = stability_of(t);
    const char *cells[] = {text[0], text[1], text[2], text[3],
                           text[4], text[5], stable,  has_lifted(t) ? "lifted" : friction,
                           note,    outside};
    term_table_add(table, strcmp(stable, "yes") == 0 ? TERM_GOOD : TERM_PLAIN, cells);
  }
  printf("\n%s\n", title);
  bool printed = term_table_print(table, stdout);
  term_table_free(table);
  return printed;
}

bool turn_print_tables(const turn_answer *a, bike_convention convention) {
  double left = term_left_sign(convention);
  const bike_turns *f = a->found;
  int first = main_count(f);
  const char *text = remark(a);
  printf("%s, stationary turns, convention %s\n", a->bicycle->name,
         term_convention_name(convention));
  if (text) printf("\n%s\n", text);
  return print_list(a, "turns:", f->turns, first, left, false) &&
         print_list(a, "elsewhere (families that do not meet straight riding):", f->turns + first,
                    f->count - first, left, false) &&
         print_list(a, "folds and ends:", f->marks, f->mark_count, left, true);
}
