// SPDX-License-Identifier: Apache-2.0
#include "motion/turn_search.h"

#include <bicycle/error.h>
#include <math.h>
#include <stdlib.h>

#include "motion/turn_branch.h"
#include "motion/turn_event.h"
#include "motion/turn_family.h"
#include "motion/turn_seed.h"
#include "motion/turn_solution.h"
#include "motion/turn_straight.h"
#include "motion/turn_terms.h"

// An enumeration under way.
typedef struct search {
  turn_curve curve;
  newton *corrector, *polisher; // of three and of two equations
  bike_turn_variable measured;  // given beside what the curve fixes; BIKE_TURN_VARIABLES: none
  turn_wanted wanted;           // folds to mark
  bool marks;                   // to be looked for: not where nothing turns the steer upright, and
                                // folds and ends are those of rounding
  turn_straight straight;       // riding, where the curve passes it
  bool straight_answers;        // and it has what is measured
  turn_family family;           // of the branch being searched
  bike_turns *out;
} search;

static double gravity(const search *s) {
  return s->curve.bicycle->model->gravity;
}

static turn_place place_on(const turn_curve *curve, const turn_point *at) {
  return (turn_place){.lean = at->y[Y_LEAN],
                      .steer = at->y[Y_STEER],
                      .square = turn_curve_square(curve, at->y) / curve->bicycle->model->gravity,
                      .offset = turn_curve_offset(curve, at->y)};
}

static bool inside(const search *s, const turn_place *at) {
  const bike_turn_def *def = s->curve.def;
  double limit = def->speed_limit * def->speed_limit / gravity(s);
  return fabs(at->lean) <= def->lean_limit && fabs(at->steer) <= def->steer_limit &&
         fabs(at->offset) <= def->offset_limit && at->square >= 0 && at->square <= limit;
}

// Solutions closer than this are one, met from two sides of a traced point or on a branch traced
// twice: polished ones agree to some 1e-12, and to the root of that beside a fold.
static bool same(const bike_turn *a, const bike_turn *b) {
  const double close = 1e-6;
  return fabs(a->lean - b->lean) <= close && fabs(a->steer - b->steer) <= close &&
         fabs(a->speed - b->speed) <= close && fabs(a->rider_offset - b->rider_offset) <= close &&
         a->mark == b->mark && (a->mark == BIKE_TURN_PLAIN || a->fold == b->fold);
}

int turn_keep(bike_turn *list, int *count, const bike_turn *turn) {
  for (int i = 0; i < *count; i++)
    if (same(&list[i], turn)) return BIKE_OK;
  if (*count == BIKE_MAX_TURNS) return BIKE_ERROR_FULL;
  list[(*count)++] = *turn;
  return BIKE_OK;
}

// Whether a speed, of either sign, is rounding where the bicycle stands still: a small one whose
// circle asks nothing either. With a wheel turned across the smallest speed asks much.
static bool stands_still(const search *s, const turn_place *at) {
  const double standing = 1e-12; // units of length, v^2/g; share of the terms
  const turn_bicycle *bicycle = s->curve.bicycle;
  turn_forces forces;
  if (!(fabs(at->square) <= standing)) return false;
  if (turn_forces_at(&forces, bicycle, at->lean, at->steer, at->offset)) return false;
  double asked = gravity(s) * at->square * sin(at->steer);
  double terms = turn_row_terms(bicycle, turn_moments(bicycle, &forces, 0, at->offset));
  return fabs(asked * forces.sweep[TURN_STEER_ROW]) <= standing * terms &&
         fabs(asked * forces.sweep[TURN_LEAN_ROW]) <= standing * terms;
}

// Describes a place and keeps it in a list.
static int collect(search *s, bike_turn *list, int *count, const turn_place *near,
                   const turn_event *event) {
  turn_place at = *near;
  if (stands_still(s, &at)) at.square = 0;
  if (!inside(s, &at)) return BIKE_OK;
  bike_turn turn;
  int code = turn_describe(&turn, s->curve.bicycle, &at);
  if (code == BIKE_ERROR_NO_CONVERGENCE) s->out->residual = turn.residual;
  if (code) return code;
  code = turn_in_main_family(&turn.main_family, &s->curve, s->corrector, s->family, &turn);
  if (code) return code;
  if (event) {
    turn.mark = event->mark;
    turn.fold = event->fold;
  }
  return turn_keep(list, count, &turn);
}

// What is given, into a place that has it but for rounding.
static void give(turn_place *place, const search *s) {
  const bike_turn_def *def = s->curve.def;
  double speed = def->value[BIKE_TURN_SPEED];
  if (def->given[BIKE_TURN_SPEED]) place->square = speed * speed / gravity(s);
  if (def->given[BIKE_TURN_LEAN]) place->lean = def->value[BIKE_TURN_LEAN];
  if (def->given[BIKE_TURN_STEER]) place->steer = def->value[BIKE_TURN_STEER];
  if (def->given[BIKE_TURN_OFFSET]) place->offset = def->value[BIKE_TURN_OFFSET];
}

// A point of the curve with the given value, improved.
static int add_solution(search *s, const turn_point *at) {
  const double reach = 1e-5; // guesses are right to 1e-10, or to its root beside a fold
  turn_place place = place_on(&s->curve, at);
  give(&place, s);
  turn_place_polish(&place, &s->out->residual, s->curve.bicycle, s->polisher, s->curve.def->given,
                    reach);
  return collect(s, s->out->turns, &s->out->count, &place, NULL);
}

// Where the bicycle stands still the speed is zero, and lean and steer follow from that.
static void stand_still(search *s, turn_place *place) {
  const bool held[BIKE_TURN_VARIABLES] = {[BIKE_TURN_SPEED] = true, [BIKE_TURN_OFFSET] = true};
  const double reach = 1e-6; // the event is right to 1e-12
  place->square = 0;
  turn_place_polish(place, &s->out->residual, s->curve.bicycle, s->polisher, held, reach);
}

static int add_mark(search *s, const turn_event *event) {
  turn_place place = place_on(&s->curve, &event->at);
  if (event->mark == BIKE_TURN_STATIC) stand_still(s, &place);
  if (event->mark == BIKE_TURN_STRAIGHT && !s->curve.at_speed) place.square = s->straight.square;
  return collect(s, s->out->marks, &s->out->mark_count, &place, event);
}

// The branch passes straight riding: an answer, at the speed given or at whatever speed, and a mark
// where hands-free turns branch off, if that is at the branch's speed.
static int meet_straight(search *s) {
  const turn_straight *straight = &s->straight;
  turn_event met = {.at = straight->at, .mark = BIKE_TURN_STRAIGHT};
  int code = BIKE_OK;
  if (!s->curve.at_speed || straight->neutral) code = add_mark(s, &met);
  if (code || !s->straight_answers) return code;
  s->out->straight = !s->curve.def->given[BIKE_TURN_SPEED];
  if (s->out->straight) return BIKE_OK;
  turn_place place = place_on(&s->curve, &straight->at);
  give(&place, s);
  return collect(s, s->out->turns, &s->out->count, &place, straight->neutral ? &met : NULL);
}

// A piece that straight riding may end, and does not pass.
static int search_piece(search *s, const turn_piece *piece) {
  turn_event events[PIECE_EVENTS];
  int count = s->marks ? turn_piece_marks(events, piece, s->wanted) : 0, code = BIKE_OK;
  if (count < 0) return BIKE_ERROR_NO_CONVERGENCE;
  for (int i = 0; i < count && !code; i++)
    if (turn_straight_apart(&s->straight, events[i].at.y)) code = add_mark(s, &events[i]);
  if (code || s->measured == BIKE_TURN_VARIABLES) return code;

  turn_point found[2];
  bool but_straight = piece->straight && s->straight_answers;
  count = turn_piece_crossings(found, piece, s->measured, s->curve.def->value[s->measured],
                               but_straight);
  if (count < 0) return BIKE_ERROR_NO_CONVERGENCE;
  for (int i = 0; i < count && !code; i++)
    if (!but_straight || turn_straight_apart(&s->straight, found[i].y))
      code = add_solution(s, &found[i]);
  return code;
}

// From one traced point to the next: two pieces where straight riding lies between.
static int search_step(search *s, const turn_point *from, const turn_point *to) {
  turn_piece piece = {&s->curve, s->corrector, from, to, NULL, &s->out->residual};
  double reached[2];
  const double nothing = 1e-6; // rad, m: no length of a piece
  if (!turn_straight_between(&s->straight, reached, from, to)) return search_piece(s, &piece);
  int code = meet_straight(s);
  piece.straight = piece.to = &s->straight.at;
  if (!code && reached[0] > nothing) code = search_piece(s, &piece);
  piece.from = &s->straight.at;
  piece.to = to;
  return !code && reached[1] > nothing ? search_piece(s, &piece) : code;
}

static int search_branch(search *s, const turn_branch *branch) {
  int code = BIKE_OK;
  for (size_t i = 1; i < branch->count && !code; i++)
    code = search_step(s, &branch->at[i - 1], &branch->at[i]);
  return code;
}

static bool covered(const turn_branch *branches, int count, const double y[Y_SIZE]) {
  for (int i = 0; i < count; i++)
    if (turn_branch_covers(&branches[i], y)) return true;
  return false;
}

// Follows the branch of a seed unless that has been done.
static int follow(search *s, turn_branch *branches, const double y[Y_SIZE]) {
  int count = s->out->branch_count;
  turn_point start;
  double residual;
  if (covered(branches, count, y)) return BIKE_OK;
  if (turn_branch_land(&start, &residual, &s->curve, s->corrector, y)) return BIKE_OK;
  if (covered(branches, count, start.y)) return BIKE_OK;
  if (count == BIKE_MAX_TURNS) return BIKE_ERROR_FULL;
  int code = turn_branch_trace(&branches[count], &s->curve, s->corrector, &start);
  if (code) return code;
  s->out->branch_count++;
  s->family = turn_family_of(&branches[count], &s->curve, count == 0);
  return search_branch(s, &branches[count]);
}

static int follow_all(search *s, const turn_seeds *seeds) {
  turn_branch *branches = calloc(BIKE_MAX_TURNS, sizeof *branches);
  if (!branches) return BIKE_ERROR_MEMORY;
  int code = BIKE_OK;
  for (size_t i = 0; i < seeds->count && !code; i++) code = follow(s, branches, seeds->y[i]);
  for (int i = 0; i < BIKE_MAX_TURNS; i++) turn_branch_free(&branches[i]);
  free(branches);
  return code;
}

static bike_turn_variable other_given(const bike_turn_def *def, bike_turn_variable fixed) {
  for (int v = 0; v < BIKE_TURN_VARIABLES; v++)
    if (def->given[v] && v != (int)fixed) return (bike_turn_variable)v;
  return BIKE_TURN_VARIABLES;
}

int turn_search(bike_turns *out, const turn_bicycle *bicycle, const bike_turn_def *def) {
  bool at_speed = def->given[BIKE_TURN_SPEED] && bicycle->model->rider_mass > 0;
  search s = {.curve = turn_curve_of(bicycle, def, at_speed), .out = out};
  s.measured = other_given(def, at_speed ? BIKE_TURN_SPEED : BIKE_TURN_OFFSET);
  for (int v = 0; v < BIKE_TURN_VARIABLES; v++)
    s.wanted[v] = s.measured == BIKE_TURN_VARIABLES || (int)s.measured == v;
  s.corrector = newton_create(3);
  s.polisher = newton_create(2);
  s.marks = at_speed || !turn_curve_degenerate(&s.curve, (const double[Y_SIZE]){0});
  turn_seeds seeds = {0};
  turn_straight_find(&s.straight, &s.curve);
  s.straight_answers =
      s.measured != BIKE_TURN_VARIABLES &&
      turn_straight_answers(&s.straight, &s.curve, s.measured, def->value[s.measured]);
  int code = s.corrector && s.polisher ? turn_seeds_find(&seeds, &s.curve) : BIKE_ERROR_MEMORY;
  if (!code) code = follow_all(&s, &seeds);
  // branches that could not be followed to their ends hold answers that were not seen
  bool spent = s.corrector && s.polisher && (newton_spent(s.corrector) || newton_spent(s.polisher));
  if (spent) code = BIKE_ERROR_FULL;
  turn_seeds_free(&seeds);
  newton_free(s.corrector);
  newton_free(s.polisher);
  return code;
}
