// SPDX-License-Identifier: Apache-2.0
// The analytic engine: the corrected equations of Franke, Suhr and Riess, integrated by SUNDIALS.
#include "engine.h"
#include "terminal/command.h"

#include <bicycle/error.h>
#include <bicycle/linear.h>
#include <bicycle/ride.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sundials/sundials_version.h>

enum { OPTION_METHOD, OPTION_RTOL, OPTION_ATOL, OPTION_STEP, OPTION_COUNT };

static const char *const methods[] = {"rk8", "adams", "rk4", NULL};

// As bike_default_ride_def, which says why.
static const engine_option options[OPTION_COUNT] = {
    [OPTION_METHOD] = {"method", "", methods, 0},
    [OPTION_RTOL] = {"rtol", "", NULL, 1e-13},
    [OPTION_ATOL] = {"atol", "", NULL, 1e-13},
    [OPTION_STEP] = {"step", "s", NULL, 1e-3},
};

typedef struct analytic {
  bike_model model;
  bike_method method;
  double rtol, atol, step;
} analytic;

static void *create(const bike_bicycle *bicycle, const engine_choice *choice, term_exit *code,
                    problem *p) {
  static const bike_method method[] = {BIKE_METHOD_RK8, BIKE_METHOD_ADAMS, BIKE_METHOD_RK4};
  const double *option = choice->option;
  analytic *a = calloc(1, sizeof *a);
  if (!a) {
    *code = problem_memory(p);
    return NULL;
  }
  a->method = method[(int)option[OPTION_METHOD]];
  a->rtol = option[OPTION_RTOL];
  a->atol = option[OPTION_ATOL];
  a->step = option[OPTION_STEP];
  int error = bike_model_init(&a->model, bicycle);
  if (error == BIKE_OK) return a;
  *code = problem_set(p, term_exit_of(error), "%s", bike_error_string(error));
  free(a);
  return NULL;
}

static void version(char out[ENGINE_VERSION_SIZE]) {
  char sundials[32];
  if (SUNDIALSGetVersion(sundials, sizeof sundials) != 0) strcpy(sundials, "of unknown version");
  snprintf(out, ENGINE_VERSION_SIZE, "libbicycle %s, SUNDIALS %s", term_version(), sundials);
}

static double order(const engine_choice *choice) {
  bool fixed = strcmp(methods[(int)choice->option[OPTION_METHOD]], "rk4") == 0;
  return fixed ? 4 : 0; // the others choose their steps themselves
}

// Exact derivatives of the same equations.
static term_exit linearize(double A[16], void *instance, double speed, problem *p) {
  const analytic *a = instance;
  bike_linear linear;
  int error = bike_linearize(&linear, &a->model, &(bike_state){.speed = speed}, NULL);
  if (error != BIKE_OK) return problem_set(p, term_exit_of(error), "%s", bike_error_string(error));
  memcpy(A, linear.A, sizeof linear.A);
  return TERM_DONE;
}

// Where rides end (bike_event_kind's validity): rounding is a thousandfold there, and what engines
// say of such a state tells nothing of either.
static bool at_edge(const bike_snapshot *s) {
  double edge = BIKE_EDGE * (fabs(s->T_r) + fabs(s->T_f)), c = cos(s->phi_tilde);
  return !(fmin(fabs(s->T_r * c - s->T_f), fabs(s->T_r - s->T_f * c)) > edge);
}

static term_exit evaluate(engine_instant *out, void *instance, const bike_state *state,
                          problem *p) {
  const analytic *a = instance;
  bike_snapshot s;
  int error = bike_evaluate(&s, &a->model, state, &(bike_input){0});
  if (error != BIKE_OK) return problem_set(p, term_exit_of(error), "%s", bike_error_string(error));
  if (at_edge(&s)) return problem_set(p, TERM_USAGE, "at the edge of the geometry rides end");
  *out = (engine_instant){
      .lean_acceleration = s.acceleration.lean,
      .steer_acceleration = s.acceleration.steer,
      .yaw_acceleration = s.yaw_acceleration,
      .pitch_acceleration = s.pitch_acceleration,
      .wheel_acceleration = {s.rear_wheel_acceleration, s.front_wheel_acceleration},
      .speed_rate = s.acceleration.speed,
      .yaw_rate = s.yaw_rate,
      .pitch_rate = s.pitch_rate,
      .wheel_rate = {s.rear_wheel_rate, s.front_wheel_rate},
      .pitch = s.pitch,
      .kinetic = s.kinetic,
      .potential = s.potential,
  };
  memcpy(out->force[0], s.rear_force, sizeof out->force[0]);
  memcpy(out->force[1], s.front_force, sizeof out->force[1]);
  return TERM_DONE;
}

// A rider off the middle is part of the bicycle's numbers.
static term_exit mass_matrix(double M[9], void *instance, const bike_state *state, problem *p) {
  const analytic *a = instance;
  int error = bike_mass_matrix(M, &a->model, state, 0);
  if (error == BIKE_OK) return TERM_DONE;
  return problem_set(p, term_exit_of(error), "%s", bike_error_string(error));
}

typedef struct recorder {
  trace *out;
  const engine_ride *ride;
  bool lost;
} recorder;

static int record(const bike_sample *sample, const bike_sample_more *more, void *user) {
  recorder *r = user;
  trace_row row = {.sample = *sample, .more = *more};
  r->lost = !trace_add(r->out, &row);
  if (r->lost) return 1;
  return r->ride->progress && !r->ride->progress(sample->time / r->ride->duration, r->ride->user);
}

static void give_input(double time, bike_input *out, void *user) {
  const recorder *r = user;
  r->ride->input(time, out, r->ride->input_user);
}

static term_exit ride(trace *out, void *instance, const engine_ride *asked, problem *p) {
  const analytic *a = instance;
  recorder r = {out, asked, false};
  bike_ride_def def = bike_default_ride_def();
  def.start = asked->start;
  def.duration = asked->duration;
  def.sample = asked->sample;
  def.method = a->method;
  def.rtol = a->rtol;
  def.atol = a->atol;
  def.step = a->step;
  def.lean_limit = asked->lean_limit;
  if (asked->input) def.input = give_input;
  def.breakpoints = asked->breakpoints;
  def.breakpoint_count = asked->breakpoint_count;
  def.on_sample = record;
  def.user = &r;
  bike_ride_result result;
  double begun = engine_clock();
  int error = bike_ride(&result, &a->model, &def);
  out->wall_time = engine_clock() - begun;
  if (r.lost) return problem_memory(p);
  if (error != BIKE_OK)
    return problem_set(p, term_exit_of(error), "%s (t = %g s)", bike_error_string(error),
                       result.end_time);
  trace_end(out, result.complete, result.end_time, result.events, result.event_count);
  out->steps = result.steps;
  out->evaluations = result.evaluations;
  return TERM_DONE;
}

const engine engine_analytic = {
    .name = "analytic",
    .summary = "the corrected equations of Franke, Suhr and Riess, integrated by SUNDIALS",
    .options = options,
    .option_count = OPTION_COUNT,
    .step_option = "step",
    .takes_input = true,
    .create = create,
    .free = free,
    .version = version,
    .order = order,
    .linearize = linearize,
    .evaluate = evaluate,
    .mass_matrix = mass_matrix,
    .ride = ride,
};
