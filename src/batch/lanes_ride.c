// SPDX-License-Identifier: Apache-2.0
// Rides in lanes: the Runge-Kutta pair of order 8(7), each lane with a time, a step and an error
// control of its own; a lane that has ended takes the next ride.
#include "batch/lanes_block.h"
#include "batch/lanes_instance.h"
#include "motion/ride_table.h"

#include <bicycle/ride.h>
#include <math.h>

// The first step, s; the error control finds the right one within two or three.
static const double FIRST_STEP = 0.01;
// A step is aimed at this share of the allowed error's root, and changes by no more than these.
static const double SAFETY = 0.9, SHRINK = 0.2, GROW = 5;
// Where no step as short as this, s, is accurate, the ride is left to those who know why.
static const double SMALLEST_STEP = 1e-9;
// A ride's end is found by going back before it and on in steps cut by this, until one so short, s,
// leads there.
static const double APPROACH = 0.25, RESOLUTION = 1e-9;

typedef struct book {
  size_t member;
  bool alive, lifted;
  int quiet, quiet_before; // looks in a row; before the last accepted step
  long looks, looks_before;
  double forward; // sign of the speed at the start; 0 at rest: there is no standstill then
  double longest; // s  of a step, while an end is near
  double beyond;  // s  where one has been seen
  long steps, evaluations;
  double checkpoint; // s  see `stalled`
} book;

typedef struct pen {
  lanes_models block;
  load in;
  real side;
  real t, h;
  real y[LANES_STATE];
  start from;                         // beta_r of the last evaluation at the start of a step
  real before_t, before[LANES_STATE]; // before the last accepted step
  start before_from;                  // from there, the root beyond may be out of Newton's reach
  book books[LANES];
} pen;

static inline lanes_mask rates_in_lanes(real dy[LANES_STATE], instant *now, const pen *p,
                                        const real *y) {
  form u = {y[LANES_STEER_RATE], y[LANES_LEAN_RATE], y[LANES_SPEED]};
  solve_instant(now, &p->block.model, p->from, y[LANES_STEER], y[LANES_LEAN], u, &p->in);
  dy[LANES_LEAN] = y[LANES_LEAN_RATE];
  dy[LANES_STEER] = y[LANES_STEER_RATE];
  dy[LANES_LEAN_RATE] = now->acceleration.kap;
  dy[LANES_STEER_RATE] = now->acceleration.phi;
  dy[LANES_SPEED] = now->acceleration.v;
  real sum = dy[LANES_LEAN_RATE] + dy[LANES_STEER_RATE] + dy[LANES_SPEED];
  return lanes_found(root_checks_of(&now->at), p->block.reach) & (now->at.D * p->side > 0.0 * sum) &
         (sum - sum == 0.0 * p->side);
}

// to = y + h sum_j w_j k_j
static inline void combine(real to[LANES_STATE], const real y[LANES_STATE], real h, const double *w,
                           real k[][LANES_STATE], int stages) {
  real sum[LANES_STATE] = {0};
  for (int j = 0; j < stages; j++) {
    if (w[j] == 0) continue;
    for (int i = 0; i < LANES_STATE; i++) sum[i] += w[j] * k[j][i];
  }
  for (int i = 0; i < LANES_STATE; i++) to[i] = y[i] + h * sum[i];
}

typedef struct trial {
  real y[LANES_STATE];
  real error;          // in units of what is allowed
  lanes_mask solved;   // all stages
  lanes_mask at_start; // the first stage
  lanes_mask inside;   // not at the model's edge at the start
  lanes_mask aloft;    // a wheel is pulled on at the start
} trial;

// The largest error of a component, in units of rtol |y| + atol.
static inline real error_of(const trial *tr, const pen *p, real h, real k[][LANES_STATE],
                            const lanes_ride_def *def) {
  const ride_table *table = &RIDE_TABLE_8;
  double gap[RIDE_MAX_STAGES];
  for (int j = 0; j < table->stages; j++) gap[j] = table->b[j] - table->d[j];
  real nought[LANES_STATE] = {0}, wrong[LANES_STATE], most = nought[0];
  combine(wrong, nought, h, gap, k, table->stages);
  for (int i = 0; i < LANES_STATE; i++) {
    real size = lanes_max(lanes_abs(p->y[i]), lanes_abs(tr->y[i]));
    most = lanes_max(most, lanes_abs(wrong[i]) / (def->rtol * size + def->atol));
  }
  return most;
}

__attribute__((noinline, flatten)) static lanes_mask one_stage(real dy[LANES_STATE], const pen *p,
                                                               const real *y) {
  instant now;
  return rates_in_lanes(dy, &now, p, y);
}

// The first stage also tells where the bicycle stands.
__attribute__((noinline, flatten)) static void first_stage(trial *tr, real dy[LANES_STATE], pen *p,
                                                           bool watch_lift) {
  instant now;
  tr->at_start = rates_in_lanes(dy, &now, p, p->y);
  const position *g = &now.at;
  tr->inside = (g->D * p->side > BIKE_EDGE * (lanes_abs(g->T_r) + lanes_abs(g->T_f))) &
               (g->Q > BIKE_EDGE * (lanes_abs(g->T_r) + lanes_abs(g->T_f)));
  start next = begun(&p->block.model, g->s_br, g->c_br);
  p->from.s = lanes_either(tr->at_start, next.s, p->from.s);
  p->from.c = lanes_either(tr->at_start, next.c, p->from.c);
  tr->aloft = (lanes_mask){0};
  if (!watch_lift) return;
  ground forces = ground_forces(&now, &p->block.model, &p->in);
  tr->aloft = (forces.rear.z < 0.0 * p->side) | (forces.front.z < 0.0 * p->side);
}

static void try_step(trial *tr, pen *p, real h, const lanes_ride_def *def) {
  const ride_table *table = &RIDE_TABLE_8;
  real k[RIDE_MAX_STAGES][LANES_STATE];
  first_stage(tr, k[0], p, def->watch_lift);
  tr->solved = tr->at_start;
  for (int s = 1; s < table->stages; s++) {
    real stage[LANES_STATE];
    combine(stage, p->y, h, table->A[s], k, s);
    tr->solved &= one_stage(k[s], p, stage);
  }
  combine(tr->y, p->y, h, table->b, k, table->stages);
  tr->error = error_of(tr, p, h, k, def);
}

static bike_state state_of(const real y[LANES_STATE], int lane) {
  return (bike_state){.lean = y[LANES_LEAN][lane],
                      .steer = y[LANES_STEER][lane],
                      .lean_rate = y[LANES_LEAN_RATE][lane],
                      .steer_rate = y[LANES_STEER_RATE][lane],
                      .speed = y[LANES_SPEED][lane]};
}

static void put_start(start *to, const start *from, int lane) {
  to->s[lane] = from->s[lane];
  to->c[lane] = from->c[lane];
  to->r[lane] = from->r[lane];
}

static void take_next(pen *p, int lane, const lanes_ride_def *def) {
  lanes_rider r;
  book *b = &p->books[lane];
  if (!def->next(&r, def->user)) {
    b->alive = false;
    return;
  }
  *b = (book){.member = r.member,
              .alive = true,
              .forward = r.state.speed == 0 ? 0 : copysign(1, r.state.speed),
              .longest = INFINITY};
  INSTANCE(lanes_pack)(&p->block, r.model, lane);
  const double y[LANES_STATE] = {[LANES_LEAN] = r.state.lean,
                                 [LANES_STEER] = r.state.steer,
                                 [LANES_LEAN_RATE] = r.state.lean_rate,
                                 [LANES_STEER_RATE] = r.state.steer_rate,
                                 [LANES_SPEED] = r.state.speed};
  for (int i = 0; i < LANES_STATE; i++) p->before[i][lane] = p->y[i][lane] = y[i];
  b->quiet = def->look > 0 && def->quiet(r.member, &r.state, def->user);
  p->before_t[lane] = p->t[lane] = 0;
  p->h[lane] = FIRST_STEP;
  p->side[lane] = r.side;
  p->from.r[lane] = r.model->newton_scale;
  p->from.s[lane] = r.model->newton_scale * r.rear_angle[0];
  p->from.c[lane] = r.model->newton_scale * r.rear_angle[1];
  p->in.w[lane] = r.w;
  p->in.steer_torque[lane] = r.steer_torque;
  p->in.roll_torque[lane] = r.roll_torque;
}

static void finish(pen *p, int lane, lanes_end end, const lanes_ride_def *def) {
  const book *b = &p->books[lane];
  lanes_ended ended = {.member = b->member,
                       .end = end,
                       .time = p->t[lane],
                       .state = state_of(p->y, lane),
                       .lifted = b->lifted,
                       .steps = b->steps,
                       .evaluations = b->evaluations};
  def->done(&ended, def->user);
  take_next(p, lane, def);
}

// A duration that is a multiple of the looks but for rounding ends with one.
static double next_look(const book *b, const lanes_ride_def *def) {
  double look = def->look > 0 ? (double)(b->looks + 1) * def->look : INFINITY;
  return fabs(look - def->duration) <= 1e-14 * look ? def->duration : look;
}

// Where a lane's next step must end at the latest.
static double stop_of(const book *b, const lanes_ride_def *def) {
  return fmin(def->duration, next_look(b, def));
}

// Whether the last accepted step has led beyond an end; which.
static bool has_ended(lanes_end *end, const pen *p, int lane, const lanes_ride_def *def) {
  bool fallen = !(fabs(p->y[LANES_LEAN][lane]) < def->lean_limit);
  *end = fallen ? LANES_LEAN_LIMIT : LANES_STANDSTILL;
  double forward = p->books[lane].forward;
  return fallen || (forward != 0 && forward * p->y[LANES_SPEED][lane] <= 0);
}

// Goes back before the last accepted step, which led beyond an end; false: it was so short that the
// end is here.
static bool retreat(pen *p, int lane) {
  book *b = &p->books[lane];
  double h = p->t[lane] - p->before_t[lane];
  if (!(h > RESOLUTION)) return false;
  b->beyond = p->t[lane];
  p->t[lane] = p->before_t[lane];
  for (int i = 0; i < LANES_STATE; i++) p->y[i][lane] = p->before[i][lane];
  put_start(&p->from, &p->before_from, lane);
  b->looks = b->looks_before;
  b->quiet = b->quiet_before;
  b->steps--;
  p->h[lane] = b->longest = APPROACH * h;
  return true;
}

// A step has landed at its stop: is the ride straight, or over?
static bool is_over(lanes_end *end, pen *p, int lane, const lanes_ride_def *def) {
  book *b = &p->books[lane];
  if (p->t[lane] >= next_look(b, def)) {
    bike_state now = state_of(p->y, lane);
    b->looks++;
    b->quiet = def->quiet(b->member, &now, def->user) ? b->quiet + 1 : 0;
    if (b->quiet >= def->looks_settled) {
      *end = LANES_SETTLED;
      if (def->settled(b->member, &now, def->user)) return true;
      b->quiet = 0;
    }
  }
  *end = LANES_COMPLETE;
  return p->t[lane] >= def->duration;
}

static void accept(pen *p, int lane, const trial *tr, double h, double stop, bool landed) {
  book *b = &p->books[lane];
  p->before_t[lane] = p->t[lane];
  p->t[lane] = landed ? stop : p->t[lane] + h;
  for (int i = 0; i < LANES_STATE; i++) {
    p->before[i][lane] = p->y[i][lane];
    p->y[i][lane] = tr->y[i][lane];
  }
  put_start(&p->before_from, &p->from, lane);
  b->looks_before = b->looks;
  b->quiet_before = b->quiet;
  b->steps++;
  if (p->t[lane] > b->beyond) b->longest = INFINITY; // shorter steps have led past that end
}

// The step after one of length h: error ~ h^8, whose root is exact on every machine by square
// roots.
static double next_step(double h, double error) {
  double root = sqrt(sqrt(sqrt(error)));
  double factor = root == 0 ? GROW : SAFETY / root; // fmax: NaN shrinks
  return h * fmin(GROW, fmax(SHRINK, factor));
}

static void judge_accepted(pen *p, int lane, const trial *tr, double h, bool landed,
                           const lanes_ride_def *def) {
  book *b = &p->books[lane];
  lanes_end end;
  // a step cut short to land tells little of how long the next may be
  double next = next_step(h, tr->error[lane]);
  p->h[lane] = fmin(b->longest, landed ? fmax(p->h[lane], next) : next);
  accept(p, lane, tr, h, stop_of(b, def), landed);
  bool over = has_ended(&end, p, lane, def);
  if (over)
    over = !retreat(p, lane);
  else
    over = landed && is_over(&end, p, lane, def);
  if (over) finish(p, lane, end, def);
}

// As a ride alone (ride.c), but of all steps, accepted or not.
static bool stalled(pen *p, int lane) {
  book *b = &p->books[lane];
  if (b->evaluations % ((long)RIDE_STALL_STEPS * RIDE_TABLE_8.stages)) return false;
  bool stall = p->t[lane] - b->checkpoint < RIDE_STALL_TIME;
  b->checkpoint = p->t[lane];
  return stall;
}

static void judge_lane(pen *p, int lane, const trial *tr, double h, bool landed,
                       const lanes_ride_def *def) {
  book *b = &p->books[lane];
  b->evaluations += RIDE_TABLE_8.stages;
  if (stalled(p, lane)) {
    finish(p, lane, LANES_UNDECIDED, def);
    return;
  }
  if (!tr->at_start[lane] || !tr->inside[lane]) {
    bool started = b->steps > 0; // otherwise there is nothing to go back to
    if (!started || !retreat(p, lane))
      finish(p, lane, started ? LANES_VALIDITY : LANES_UNDECIDED, def);
    return;
  }
  b->lifted |= tr->aloft[lane] != 0;
  if (tr->solved[lane] && tr->error[lane] <= 1) {
    judge_accepted(p, lane, tr, h, landed, def);
    return;
  }
  p->h[lane] = tr->solved[lane] ? next_step(h, tr->error[lane]) : SHRINK * h;
  if (!(p->h[lane] > SMALLEST_STEP)) finish(p, lane, LANES_UNDECIDED, def);
}

static bool any_alive(const pen *p) {
  for (int i = 0; i < LANES; i++)
    if (p->books[i].alive) return true;
  return false;
}

void INSTANCE(lanes_ride)(const lanes_ride_def *def) {
  pen p = {0};
  for (int i = 0; i < LANES; i++) take_next(&p, i, def);
  while (any_alive(&p)) {
    real h = p.h;
    bool landed[LANES];
    for (int i = 0; i < LANES; i++) {
      double rest = stop_of(&p.books[i], def) - p.t[i];
      // a rest hardly longer than the step is taken with it
      landed[i] = rest <= h[i] * (1 + 1e-9);
      if (landed[i]) h[i] = rest;
    }
    trial tr;
    try_step(&tr, &p, h, def);
    for (int i = 0; i < LANES; i++)
      if (p.books[i].alive) judge_lane(&p, i, &tr, h[i], landed[i], def);
  }
}
