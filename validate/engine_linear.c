// SPDX-License-Identifier: Apache-2.0
// The linear engine: small motions about upright straight riding, solved exactly.
//
// M q'' + (v C1 + D) q' + (g K0 + v^2 K2) q = 0, q = (lean, steer), of Meijaard et al. (2007);
// yaw' = (v steer + trail steer') cos(tilt)/wheelbase and y' = v yaw follow. All of it is one
// x' = F x with constant F; a row follows from the one before by exp(F sample).
#include "engine.h"
#include "terminal/command.h"

#include <bicycle/error.h>
#include <bicycle/linear.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { STEER, LEAN, STEER_RATE, LEAN_RATE, YAW, Y, STATES };

typedef struct linear {
  bike_model model;
  bike_upright upright;
  bike_upright_matrices matrices;
} linear;

static int prepare(linear *l, const bike_bicycle *bicycle) {
  int error = bike_model_init(&l->model, bicycle);
  if (error == BIKE_OK) error = bike_upright_position(&l->upright, &bicycle->geometry);
  return error == BIKE_OK ? bike_linearize_upright(&l->matrices, &l->model) : error;
}

static void *create(const bike_bicycle *bicycle, const engine_choice *choice, term_exit *code,
                    problem *p) {
  (void)choice;
  linear *l = calloc(1, sizeof *l);
  if (!l) {
    *code = problem_memory(p);
    return NULL;
  }
  int error = prepare(l, bicycle);
  if (error == BIKE_OK) return l;
  *code = problem_set(p, term_exit_of(error), "%s", bike_error_string(error));
  free(l);
  return NULL;
}

static void version(char out[ENGINE_VERSION_SIZE]) {
  snprintf(out, ENGINE_VERSION_SIZE, "libbicycle %s, linearised", term_version());
}

// A of x' = A x:  q'' = -M^-1 ((v C1 + D) q' + (g K0 + v^2 K2) q)
static void fill_A(double A[16], const linear *l, double v) {
  const bike_upright_matrices *u = &l->matrices;
  const double *M = u->M;
  double determinant = M[0] * M[3] - M[1] * M[2];
  memset(A, 0, 16 * sizeof *A);
  A[4 * STEER + STEER_RATE] = A[4 * LEAN + LEAN_RATE] = 1;
  for (int j = 0; j < 2; j++) { // q_j: lean, steer
    double damping = j == 1 ? l->model.steer_damping : 0;
    double stiff[2], slow[2];
    for (int i = 0; i < 2; i++) {
      stiff[i] = l->model.gravity * u->K0[2 * i + j] + v * v * u->K2[2 * i + j];
      slow[i] = v * u->C1[2 * i + j] + (i == 1 ? damping : 0);
    }
    int place = j == 0 ? LEAN : STEER, rate = j == 0 ? LEAN_RATE : STEER_RATE;
    A[4 * LEAN_RATE + place] = -(M[3] * stiff[0] - M[1] * stiff[1]) / determinant;
    A[4 * STEER_RATE + place] = -(M[0] * stiff[1] - M[2] * stiff[0]) / determinant;
    A[4 * LEAN_RATE + rate] = -(M[3] * slow[0] - M[1] * slow[1]) / determinant;
    A[4 * STEER_RATE + rate] = -(M[0] * slow[1] - M[2] * slow[0]) / determinant;
  }
}

static term_exit linearize(double A[16], void *instance, double speed, problem *p) {
  (void)p;
  fill_A(A, instance, speed);
  return TERM_DONE;
}

typedef double matrix[STATES][STATES];

static void multiply(matrix out, matrix a, matrix b) {
  matrix product = {{0}};
  for (int i = 0; i < STATES; i++)
    for (int k = 0; k < STATES; k++)
      for (int j = 0; j < STATES; j++) product[i][j] += a[i][k] * b[k][j];
  memcpy(out, product, sizeof product);
}

// exp(F t): Taylor's series of F t/2^squarings, whose norm is below 1/8, then squared. Twelve terms
// leave 8^-13/13! = 3e-22.
static void exponential(matrix out, matrix F, double t) {
  double norm = 0;
  for (int i = 0; i < STATES; i++)
    for (int j = 0; j < STATES; j++) norm = fmax(norm, STATES * fabs(F[i][j] * t));
  int squarings = norm > 0.125 ? (int)ceil(log2(norm / 0.125)) : 0;
  matrix part, term = {{0}};
  memset(out, 0, sizeof term);
  for (int i = 0; i < STATES; i++) {
    out[i][i] = term[i][i] = 1;
    for (int j = 0; j < STATES; j++) part[i][j] = ldexp(F[i][j] * t, -squarings);
  }
  for (int k = 1; k <= 12; k++) {
    multiply(term, term, part);
    for (int i = 0; i < STATES; i++)
      for (int j = 0; j < STATES; j++) {
        term[i][j] /= k;
        out[i][j] += term[i][j];
      }
  }
  for (; squarings > 0; squarings--) multiply(out, out, out);
}

static void fill_F(matrix F, const linear *l, double v) {
  double A[16], turn = cos(l->upright.tilt) / l->upright.wheelbase;
  fill_A(A, l, v);
  memset(F, 0, sizeof(matrix));
  for (int i = 0; i < 4; i++)
    for (int j = 0; j < 4; j++) F[i][j] = A[4 * i + j];
  F[YAW][STEER] = v * turn;
  F[YAW][STEER_RATE] = l->upright.trail * turn;
  F[Y][YAW] = v;
}

static void apply(double out[STATES], matrix E, const double x[STATES]) {
  double y[STATES] = {0};
  for (int i = 0; i < STATES; i++)
    for (int j = 0; j < STATES; j++) y[i] += E[i][j] * x[j];
  memcpy(out, y, sizeof y);
}

// What small motions do not change, to first order: a row of straight riding.
static term_exit straight_row(trace_row *out, const linear *l, double speed, problem *p) {
  bike_snapshot s;
  int error = bike_evaluate(&s, &l->model, &(bike_state){.speed = speed}, &(bike_input){0});
  if (error != BIKE_OK) return problem_set(p, term_exit_of(error), "%s", bike_error_string(error));
  *out = (trace_row){.sample = {.speed = speed, .energy = s.kinetic + s.potential}};
  out->sample.rear_normal = s.rear_force[2];
  out->sample.front_normal = s.front_force[2];
  return TERM_DONE;
}

static void fill_row(trace_row *row, const linear *l, const double x[STATES], double time) {
  bike_sample *s = &row->sample;
  s->time = time;
  s->steer = x[STEER], s->lean = x[LEAN];
  s->steer_rate = x[STEER_RATE], s->lean_rate = x[LEAN_RATE];
  s->yaw = x[YAW], s->y = x[Y];
  s->x = s->speed * time;
  s->rear_angle = s->x / l->model.geometry.R_r;
  s->front_angle = s->x / l->model.geometry.R_f;
}

// Time at which |lean| passes the limit within a stretch that begins at x, by bisection.
static double fall_time(matrix F, const double x[STATES], double stretch, double limit) {
  double low = 0, high = stretch;
  for (int i = 0; i < 60; i++) { // down to rounding
    double middle = (low + high) / 2, at[STATES];
    matrix E;
    exponential(E, F, middle);
    apply(at, E, x);
    *(fabs(at[LEAN]) < limit ? &low : &high) = middle;
  }
  return low;
}

static term_exit ride_rows(trace *out, const linear *l, const engine_ride *asked, trace_row *row,
                           problem *p) {
  matrix F, E;
  const bike_state *s = &asked->start;
  double x[STATES] = {s->steer, s->lean, s->steer_rate, s->lean_rate, 0, 0};
  long rows = (long)floor(asked->duration / asked->sample * (1 + 1e-12));
  fill_F(F, l, s->speed);
  exponential(E, F, asked->sample);
  for (long k = 0; k <= rows; k++) {
    double time = (double)k * asked->sample, before[STATES];
    memcpy(before, x, sizeof x);
    if (k > 0) apply(x, E, before);
    if (!(fabs(x[LEAN]) < asked->lean_limit)) {
      double end = time - asked->sample + fall_time(F, before, asked->sample, asked->lean_limit);
      trace_end(out, false, end, &(bike_event){BIKE_EVENT_LEAN_LIMIT, end}, 1);
      return TERM_DONE;
    }
    fill_row(row, l, x, time);
    if (!trace_add(out, row)) return problem_memory(p);
    if (asked->progress && !asked->progress(time / asked->duration, asked->user))
      return problem_set(p, TERM_INVALID, "interrupted");
  }
  trace_end(out, true, asked->duration, NULL, 0);
  return TERM_DONE;
}

// Side forces and friction are of first order too, but nobody asks a linear model for them.
static uint64_t missing_signals(void) {
  static const char *const unknown[] = {"rear_friction",    "front_friction", "rear_force_forward",
                                        "rear_force_left",  "rear_force_up",  "front_force_forward",
                                        "front_force_left", "front_force_up", NULL};
  uint64_t bits = 0;
  for (int i = 0; unknown[i]; i++)
    bits |= UINT64_C(1) << (trace_find_signal(unknown[i]) - trace_signals);
  return bits;
}

static term_exit ride(trace *out, void *instance, const engine_ride *asked, problem *p) {
  const linear *l = instance;
  trace_row row;
  double begun = engine_clock();
  term_exit code = straight_row(&row, l, asked->start.speed, p);
  out->missing = missing_signals();
  if (code == TERM_DONE) code = ride_rows(out, l, asked, &row, p);
  out->wall_time = engine_clock() - begun;
  return code;
}

const engine engine_linear = {
    .name = "linear",
    .summary = "the linearised equations of upright riding, solved exactly",
    .create = create,
    .free = free,
    .version = version,
    .linearize = linearize,
    .ride = ride,
};
