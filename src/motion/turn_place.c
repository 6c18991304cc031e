// SPDX-License-Identifier: Apache-2.0
// Lean and steer given: v^2 sin(steer) goes out by crossing the two rows,
//   fall_steer(w) sweep_lean(w) - fall_lean(w) sweep_steer(w) = 0,
// a cubic in the rider's offset w.
#include <bicycle/error.h>
#include <float.h>
#include <math.h>

#include "motion/turn_family.h"
#include "motion/turn_search.h"
#include "motion/turn_solution.h"
#include "motion/turn_straight.h"

typedef struct cubic {
  double c[4]; // lowest power first
} cubic;

static double value(const cubic *p, double w) {
  return p->c[0] + w * (p->c[1] + w * (p->c[2] + w * p->c[3]));
}

// p = (a0 + a1 w)(b0 + b1 w + b2 w^2), times a sign
static void add_product(cubic *p, const double a[2], const double b[3], double sign) {
  for (int i = 0; i < 2; i++)
    for (int j = 0; j < 3; j++) p->c[i + j] += sign * a[i] * b[j];
}

// Both forces in powers of the offset, from offsets of -1, 0 and 1 m.
static int crossed_rows(cubic *out, const turn_bicycle *bicycle, double lean, double steer) {
  turn_forces at[3];
  for (int k = 0; k < 3; k++) {
    int code = turn_forces_at(&at[k], bicycle, lean, steer, k - 1);
    if (code) return code;
  }
  double fall[TURN_ROWS][2], sweep[TURN_ROWS][3];
  for (int i = 0; i < TURN_ROWS; i++) {
    fall[i][0] = at[1].fall[i];
    fall[i][1] = 0.5 * (at[2].fall[i] - at[0].fall[i]);
    sweep[i][0] = at[1].sweep[i];
    sweep[i][1] = 0.5 * (at[2].sweep[i] - at[0].sweep[i]);
    sweep[i][2] = 0.5 * (at[2].sweep[i] + at[0].sweep[i]) - at[1].sweep[i];
  }
  *out = (cubic){0};
  add_product(out, fall[TURN_STEER_ROW], sweep[TURN_LEAN_ROW], 1);
  add_product(out, fall[TURN_LEAN_ROW], sweep[TURN_STEER_ROW], -1);
  return BIKE_OK;
}

// The zero between two places of different sign.
static double bisected(const cubic *p, double low, double high) {
  bool rising = value(p, low) < 0;
  for (int i = 0; i < 100; i++) { // enough to end at neighbouring doubles
    double middle = 0.5 * (low + high);
    if ((value(p, middle) < 0) == rising)
      low = middle;
    else
      high = middle;
  }
  return 0.5 * (low + high);
}

// All zeros with |w| <= limit: the cubic is monotone between the zeros of its derivative.
static int zeros(double out[3], const cubic *p, double limit) {
  double a = 3 * p->c[3], b = 2 * p->c[2], c = p->c[1];
  double ends[4] = {-limit, -limit, -limit, limit};
  double root = sqrt(b * b - 4 * a * c), sum = b > 0 ? -b - root : -b + root;
  double turning[2] = {sum / (2 * a), 2 * c / sum}; // not finite where there is none
  if (turning[0] > turning[1]) {
    double first = turning[1];
    turning[1] = turning[0];
    turning[0] = first;
  }
  for (int i = 0; i < 2; i++) {
    bool between = fabs(turning[i]) < limit;
    ends[i + 1] = between ? turning[i] : ends[i];
  }
  int count = 0;
  for (int i = 0; i < 3; i++)
    if ((value(p, ends[i]) < 0) != (value(p, ends[i + 1]) < 0))
      out[count++] = bisected(p, ends[i], ends[i + 1]);
  return count;
}

// Two equations for the solutions, three for the branches that tell their family.
typedef struct place_solvers {
  newton *two, *three;
} place_solvers;

// The solution with an offset, if a speed goes with it.
static int add_offset(bike_turns *out, const turn_bicycle *bicycle, const bike_turn_def *def,
                      place_solvers solvers, double offset) {
  const double reach = 1e-5; // the offset is right to 1e-12, or to its root where two zeros meet
  turn_place at = {
      .lean = def->value[BIKE_TURN_LEAN], .steer = def->value[BIKE_TURN_STEER], .offset = offset};
  turn_forces f;
  int code = turn_forces_at(&f, bicycle, at.lean, at.steer, at.offset);
  if (code) return code;
  double dot = f.fall[0] * f.sweep[0] + f.fall[1] * f.sweep[1];
  double square = f.sweep[0] * f.sweep[0] + f.sweep[1] * f.sweep[1];
  at.square = -dot / square / (sin(at.steer) * bicycle->model->gravity);
  turn_place_polish(&at, &out->residual, bicycle, solvers.two, def->given, reach);
  double speed = sqrt(at.square * bicycle->model->gravity);
  if (!(speed <= def->speed_limit)) return BIKE_OK; // NaN: no speed
  bike_turn turn;
  code = turn_describe(&turn, bicycle, &at);
  if (code == BIKE_ERROR_NO_CONVERGENCE) out->residual = turn.residual;
  if (code) return code;
  turn_curve curve = turn_curve_of(bicycle, def, false);
  code = turn_in_main_family(&turn.main_family, &curve, solvers.three, FAMILY_MIXED, &turn);
  return code ? code : turn_keep(out->turns, &out->count, &turn);
}

// Riding straight on, at whatever speed.
static int straight_on(bike_turns *out, const turn_bicycle *bicycle, double lean, double limit) {
  bool rides;
  double offset;
  int code = turn_straight_offset(&rides, &offset, bicycle, lean);
  out->straight = !code && rides && fabs(offset) <= limit;
  return code;
}

int turn_search_place(bike_turns *out, const turn_bicycle *bicycle, const bike_turn_def *def) {
  double lean = def->value[BIKE_TURN_LEAN], steer = def->value[BIKE_TURN_STEER], offsets[3];
  if (fabs(lean) > def->lean_limit || fabs(steer) > def->steer_limit) return BIKE_OK;
  if (steer == 0) return straight_on(out, bicycle, lean, def->offset_limit);
  cubic p;
  int code = crossed_rows(&p, bicycle, lean, steer);
  if (code) return code == BIKE_ERROR_GEOMETRY ? BIKE_OK : code; // no place: no motion
  place_solvers solvers = {newton_create(2), newton_create(3)};
  if (!solvers.two || !solvers.three) code = BIKE_ERROR_MEMORY;
  int count = zeros(offsets, &p, def->offset_limit);
  for (int i = 0; i < count && !code; i++)
    code = add_offset(out, bicycle, def, solvers, offsets[i]);
  if (!code && (newton_spent(solvers.two) || newton_spent(solvers.three))) code = BIKE_ERROR_FULL;
  newton_free(solvers.two);
  newton_free(solvers.three);
  return code;
}
