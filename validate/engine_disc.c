// SPDX-License-Identifier: Apache-2.0
// The disc engine: the rear wheel of a bicycle, rolling alone, in its reduced equations.
#include "engine_disc.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

//---------------------------------- what both engines of a disc mean ------------------------------

term_exit engine_disc_body(disc_body *out, const bike_bicycle *bicycle, problem *p) {
  *out = (disc_body){.radius = bicycle->geometry.R_r, .gravity = bicycle->gravity};
  for (int i = 0; i < bicycle->part_count; i++) {
    const bike_part *part = &bicycle->parts[i];
    if (part->assembly != BIKE_REAR_WHEEL) continue;
    // Round, and about its hub: bike_check asks that of a wheel.
    out->mass += part->mass;
    out->diametral += part->inertia[0];
    out->axial += part->inertia[1];
  }
  if (out->mass > 0 && out->diametral > 0 && out->axial > 0) return TERM_DONE;
  return problem_set(p, TERM_USAGE, "a disc is the bicycle's rear wheel, and this one has no %s",
                     out->mass > 0 ? "inertia" : "mass");
}

void engine_disc_start(double out[DISC_STATES], const disc_body *b, const bike_state *state) {
  double yaw = state->steer, lean = state->lean, aside = b->radius * sin(lean);
  memset(out, 0, DISC_STATES * sizeof *out);
  out[DISC_YAW] = yaw;
  out[DISC_LEAN] = lean;
  // The hub is to the right of the contact point of a disc that leans right.
  out[DISC_X] = aside * sin(yaw);
  out[DISC_Y] = -aside * cos(yaw);
  out[DISC_W1] = state->lean_rate;
  out[DISC_W2] = state->speed / b->radius + state->steer_rate * sin(lean);
  out[DISC_W3] = state->steer_rate * cos(lean);
}

uint64_t engine_disc_missing(void) {
  uint64_t bits = 0;
  for (int i = 0; i < TRACE_SIGNAL_COUNT; i++)
    if (strcmp(trace_signals[i].name, "pitch") == 0 ||
        strncmp(trace_signals[i].name, "front_", 6) == 0)
      bits |= UINT64_C(1) << i;
  return bits;
}

double engine_disc_fall(double time, double step, double before, double now, double limit) {
  return time - step * (fabs(now) - limit) / (fabs(now) - fabs(before));
}

//---------------------------------- the engine ----------------------------------------------------

enum { OPTION_STEP, OPTION_COUNT };

// With 0.1 ms the truncation of a wheel's wobble, some rad/s, is below rounding.
static const engine_option options[OPTION_COUNT] = {[OPTION_STEP] = {"step", "s", NULL, 1e-4}};

typedef struct disc {
  disc_body body;
  double step; // s
} disc;

static void *create(const bike_bicycle *bicycle, const engine_choice *choice, term_exit *code,
                    problem *p) {
  disc *d = calloc(1, sizeof *d);
  *code = d ? engine_disc_body(&d->body, bicycle, p) : problem_memory(p);
  if (*code == TERM_DONE) {
    d->step = choice->option[OPTION_STEP];
    return d;
  }
  free(d);
  return NULL;
}

static void version(char out[ENGINE_VERSION_SIZE]) {
  snprintf(out, ENGINE_VERSION_SIZE, "%s", "reduced equations, RK4");
}

static double order(const engine_choice *choice) {
  (void)choice;
  return 4;
}

// Whether the equations hold there: their coordinates end where the disc lies.
static bool is_upright(double lean) {
  return fabs(lean) < 1.57079632679489661923;
}

// Rates of (lean, yaw, spin) are w1, w3 / cos(lean), w2 - w3 tan(lean).
static term_exit evaluate(engine_instant *out, void *instance, const bike_state *state,
                          problem *p) {
  const disc *d = instance;
  double s[DISC_STATES], rate[DISC_STATES];
  if (!is_upright(state->lean)) return problem_set(p, TERM_USAGE, "the disc lies flat");
  engine_disc_start(s, &d->body, state);
  disc_rates(rate, s, &d->body);
  double c = cos(state->lean), t = tan(state->lean);
  double yaw = rate[DISC_W3] / c + s[DISC_W3] * t / c * s[DISC_W1];
  double spin = rate[DISC_W2] - rate[DISC_W3] * t - s[DISC_W3] * s[DISC_W1] / (c * c);
  *out = (engine_instant){
      .lean_acceleration = rate[DISC_W1],
      .steer_acceleration = yaw,
      .yaw_acceleration = yaw,
      .wheel_acceleration = {spin},
      .speed_rate = d->body.radius * spin,
      .yaw_rate = rate[DISC_YAW],
      .wheel_rate = {rate[DISC_SPIN]},
      .kinetic = disc_kinetic(s, &d->body),
      .potential = disc_potential(s, &d->body),
  };
  disc_force(out->force[0], s, &d->body);
  return TERM_DONE;
}

static trace_row row_of(const disc *d, const double s[DISC_STATES], double time) {
  double rate[DISC_STATES], force[3], aside = d->body.radius * sin(s[DISC_LEAN]);
  disc_rates(rate, s, &d->body);
  disc_force(force, s, &d->body);
  trace_row row = {.sample = {.time = time,
                              .x = s[DISC_X] - aside * sin(s[DISC_YAW]),
                              .y = s[DISC_Y] + aside * cos(s[DISC_YAW]),
                              .yaw = s[DISC_YAW],
                              .lean = s[DISC_LEAN],
                              .steer = s[DISC_YAW],
                              .lean_rate = s[DISC_W1],
                              .steer_rate = rate[DISC_YAW],
                              .speed = d->body.radius * rate[DISC_SPIN],
                              .rear_angle = s[DISC_SPIN],
                              .energy = disc_kinetic(s, &d->body) + disc_potential(s, &d->body),
                              .rear_normal = force[2],
                              .rear_friction = bike_friction(force)}};
  memcpy(row.more.rear_force, force, sizeof force);
  return row;
}

// From one row to the next. False, with the time of it, where the disc falls.
static bool advance(double *fall, double s[DISC_STATES], const disc *d, double time,
                    const engine_ride *asked) {
  long steps = (long)fmax(1, ceil(asked->sample / d->step * (1 - 1e-9)));
  double step = asked->sample / (double)steps;
  for (long i = 1; i <= steps; i++) {
    double before = s[DISC_LEAN];
    disc_advance(s, &d->body, step);
    if (fabs(s[DISC_LEAN]) < asked->lean_limit) continue;
    *fall =
        engine_disc_fall(time + (double)i * step, step, before, s[DISC_LEAN], asked->lean_limit);
    return !isfinite(s[DISC_LEAN]); // what is no number is told of, not taken for a fall
  }
  return true;
}

static term_exit ride_rows(trace *out, const disc *d, const engine_ride *asked, problem *p) {
  long rows = (long)floor(asked->duration / asked->sample * (1 + 1e-12));
  double s[DISC_STATES], fall;
  engine_disc_start(s, &d->body, &asked->start);
  for (long k = 0; k <= rows; k++) {
    double time = (double)k * asked->sample;
    if (k > 0 && !advance(&fall, s, d, time - asked->sample, asked)) {
      trace_end(out, false, fall, &(bike_event){BIKE_EVENT_LEAN_LIMIT, fall}, 1);
      return TERM_DONE;
    }
    trace_row row = row_of(d, s, time);
    if (!trace_add(out, &row)) return problem_memory(p);
    if (asked->progress && !asked->progress(time / asked->duration, asked->user))
      return problem_set(p, TERM_INVALID, "interrupted");
  }
  trace_end(out, true, asked->duration, NULL, 0);
  return TERM_DONE;
}

static term_exit ride(trace *out, void *instance, const engine_ride *asked, problem *p) {
  const disc *d = instance;
  double begun = engine_clock();
  out->missing = engine_disc_missing();
  term_exit code = ride_rows(out, d, asked, p);
  out->wall_time = engine_clock() - begun;
  out->steps = (long)(out->end_time / d->step + 0.5);
  out->evaluations = 4 * out->steps;
  return code;
}

const engine engine_disc = {
    .name = "disc",
    .summary = "the rear wheel rolling alone, in its reduced equations",
    .options = options,
    .option_count = OPTION_COUNT,
    .step_option = "step",
    .create = create,
    .free = free,
    .version = version,
    .order = order,
    .evaluate = evaluate,
    .ride = ride,
};
