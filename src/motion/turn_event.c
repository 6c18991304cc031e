// SPDX-License-Identifier: Apache-2.0
#include "motion/turn_event.h"

#include <math.h>

// A function along the branch whose zero is the event.
typedef double event_function(const turn_curve *curve, const turn_point *at,
                              bike_turn_variable variable, double value);

typedef struct event_question {
  event_function *function;
  bike_turn_variable variable;
  double value;
  bool but_straight; // straight riding, at an end of the piece, is a zero and not asked for
} event_question;

static double length_of(const turn_piece *p) {
  double length = 0;
  for (int j = 0; j < Y_SIZE; j++) length += p->from->along[j] * (p->to->y[j] - p->from->y[j]);
  return length;
}

// Where straight riding is a zero it is divided out: what is left has its sign right beside it, and
// only the zeros that branch off.
static double ask(const event_question *q, const turn_piece *p, const turn_point *at,
                  double reached) {
  double value = q->function(p->curve, at, q->variable, q->value);
  if (!q->but_straight) return value;
  if (at == p->straight) return turn_curve_growth(p->curve, at, q->variable, q->value);
  return value / (p->straight == p->from ? reached : reached - length_of(p));
}

static double beyond_value(const turn_curve *c, const turn_point *at, bike_turn_variable variable,
                           double value) {
  return turn_curve_beyond(c, at, variable, value);
}

static double slope(const turn_curve *c, const turn_point *at, bike_turn_variable variable,
                    double value) {
  (void)value;
  return turn_curve_slope(c, at, variable);
}

static double last_coordinate(const turn_curve *c, const turn_point *at,
                              bike_turn_variable variable, double value) {
  (void)c, (void)variable, (void)value;
  return at->y[Y_LAST];
}

// Zero belongs to the positive side, so that a zero at a traced point counts once.
static bool changes(double a, double b) {
  return (a < 0) != (b < 0);
}

// The branch's point at a distance along from's tangent.
static bool point_at(turn_point *out, const turn_piece *p, double reached, double length) {
  turn_point at;
  for (int j = 0; j < Y_SIZE; j++)
    at.y[j] = p->from->y[j] + (p->to->y[j] - p->from->y[j]) * (reached / length);
  if (turn_curve_correct_between(&at, p->residual, p->curve, p->solver, p->from, reached))
    return false;
  *out = at;
  return true;
}

// The zero between two points at which the function differs in sign: regula falsi in the Illinois
// form. It ends when the bracket is rounding, which takes some ten evaluations.
static bool pin_down(turn_point *out, const turn_piece *p, const event_question *q) {
  const double length = length_of(p), rounding = 1e-15;
  const int most = 100; // bisection alone would need 50
  double low = 0, high = length;
  double f_low = ask(q, p, p->from, low), f_high = ask(q, p, p->to, high);
  int side = 0;
  for (int i = 0; i < most && high - low > rounding; i++) {
    double middle =
        i % 8 == 7 ? 0.5 * (low + high) : low + (high - low) * (f_low / (f_low - f_high));
    if (!(middle > low && middle < high)) break;
    turn_point at;
    if (!point_at(&at, p, middle, length)) return false;
    double f = ask(q, p, &at, middle);
    *out = at;
    if (f == 0) break;
    bool right = changes(f_low, f);
    if (right) {
      high = middle, f_high = f;
      if (side == 1) f_low *= 0.5;
    } else {
      low = middle, f_low = f;
      if (side == -1) f_high *= 0.5;
    }
    side = right ? 1 : -1;
  }
  return true;
}

// True where the sign differs at the piece's ends; then `found` tells whether the zero was pinned.
static bool event_between(turn_point *out, bool *found, const turn_piece *p,
                          event_question question) {
  double first = ask(&question, p, p->from, 0), last = ask(&question, p, p->to, length_of(p));
  if (!changes(first, last)) return false;
  *out = fabs(first) <= fabs(last) ? *p->from : *p->to; // where the zero is at the very end
  *found = pin_down(out, p, &question);
  return true;
}

// The speed's slope changes its sign with that of the steer, and vanishes at straight riding.
static bool has_fold(const turn_piece *p, bike_turn_variable variable) {
  const double *a = p->from->y, *b = p->to->y;
  if (p->curve->at_speed ? variable == BIKE_TURN_SPEED : variable == BIKE_TURN_OFFSET) return false;
  return variable != BIKE_TURN_SPEED || !(p->straight || changes(a[Y_STEER], b[Y_STEER]));
}

// Where the slope is nothing but rounding the branch is level: no fold.
static bool is_level(const turn_piece *p, bike_turn_variable variable) {
  const double level = 1e-9; // tangents have length one, and are right to some 1e-12
  return fabs(turn_curve_slope(p->curve, p->from, variable)) <= level &&
         fabs(turn_curve_slope(p->curve, p->to, variable)) <= level;
}

// A fold of v^2 sin(steer) as the function sees it: the slope before it, in the variable itself.
static bool rises(const turn_piece *p, bike_turn_variable variable) {
  return turn_curve_slope(p->curve, p->from, variable) > 0;
}

static int fold(turn_event *out, const turn_piece *p, bike_turn_variable variable) {
  bool found;
  if (!has_fold(p, variable) || is_level(p, variable)) return 0;
  if (!event_between(&out->at, &found, p,
                     (event_question){.function = slope, .variable = variable}))
    return 0;
  out->mark = rises(p, variable) ? BIKE_TURN_LARGEST : BIKE_TURN_SMALLEST;
  out->fold = variable;
  return found ? 1 : -1;
}

// At a fixed offset the last coordinate vanishes with the speed, and at straight riding.
static int end_of_speed(turn_event *out, const turn_piece *p) {
  bool found;
  if (p->curve->at_speed || p->straight) return 0;
  if (!event_between(&out->at, &found, p, (event_question){.function = last_coordinate})) return 0;
  out->mark = BIKE_TURN_STATIC;
  return found ? 1 : -1;
}

int turn_piece_marks(turn_event out[PIECE_EVENTS], const turn_piece *p, const turn_wanted wanted) {
  int count = end_of_speed(&out[0], p);
  for (int v = 0; v < BIKE_TURN_VARIABLES && count >= 0; v++) {
    if (!wanted[v]) continue;
    int more = fold(&out[count], p, (bike_turn_variable)v);
    count = more < 0 ? -1 : count + more;
  }
  return count;
}

int turn_piece_crossings(turn_point out[2], const turn_piece *p, bike_turn_variable variable,
                         double value, bool but_straight) {
  turn_event turning;
  event_question question = {beyond_value, variable, value, but_straight};
  // divided, the function has another fold, if any: beside straight riding it has none
  int folds = but_straight ? 0 : fold(&turning, p, variable), count = 0;
  if (folds < 0) return -1;
  turn_piece parts[2] = {*p, *p};
  if (folds > 0) parts[0].to = parts[1].from = &turning.at;
  for (int i = 0; i <= folds; i++) {
    bool found;
    if (!event_between(&out[count], &found, &parts[i], question)) continue;
    if (!found) return -1;
    count++;
  }
  return count;
}
