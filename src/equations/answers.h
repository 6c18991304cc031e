// SPDX-License-Identifier: Apache-2.0
// Questions about a state, asked of the kernel as compiled for one instruction set, and its answers
// judged. Errors as in bicycle/state.h; `out` is untouched then. Inline, for the sake of the
// hundred million times that a map asks.
#ifndef BICYCLE_EQUATIONS_ANSWERS_H
#define BICYCLE_EQUATIONS_ANSWERS_H

#include "equations/regular.h"
#include "equations/state_instance.h"

#include <bicycle/error.h>
#include <string.h>

// NaN is not within anything. Bits of the comparisons are joined without branches.
static inline bool state_within_range(const bike_state *s) {
  return (fabs(s->lean) <= BIKE_LARGEST_ANGLE) & (fabs(s->steer) <= BIKE_LARGEST_ANGLE) &
         (fabs(s->lean_rate) <= BIKE_LARGEST) & (fabs(s->steer_rate) <= BIKE_LARGEST) &
         (fabs(s->speed) <= BIKE_LARGEST);
}

static inline bool input_within_range(const bike_input *in) {
  return (fabs(in->steer_torque) <= BIKE_LARGEST) & (fabs(in->roll_torque) <= BIKE_LARGEST) &
         (fabs(in->rider_offset) <= BIKE_LARGEST) & (fabs(in->rider_velocity) <= BIKE_LARGEST) &
         (fabs(in->rider_acceleration) <= BIKE_LARGEST);
}

static inline bool sways(const bike_input *in) {
  return in->rider_offset != 0 || in->rider_velocity != 0 || in->rider_acceleration != 0;
}

static inline load load_of(const bike_input *in) {
  return (load){in->steer_torque, in->roll_torque, in->rider_offset, in->rider_velocity,
                in->rider_acceleration};
}

static inline bool hands_off(const bike_input *in) {
  return in->steer_torque == 0 && in->roll_torque == 0 && !sways(in);
}

static inline int asked(question *q, const bike_model *model, const bike_state *state,
                        const bike_input *input) {
  if (!state_within_range(state) || !input_within_range(input)) return BIKE_ERROR_NOT_FINITE;
  if (model->rider_mass == 0 && sways(input)) return BIKE_ERROR_NO_RIDER;
  *q = (question){.model = model, .state = state, .in = load_of(input)};
  return BIKE_OK;
}

// From the guess near upright, and where that leads to no root from a start found by continuation.
static inline int answered(evaluation *evaluate, void *out, const question *q) {
  checks c = evaluate(out, q, NULL);
  int code = judged(&c, q->model);
  if (code != BIKE_ERROR_GEOMETRY) return code;
  start from;
  code = rear_angle_continued(&from, q->model, q->state->steer, q->state->lean);
  if (code) return code;
  c = evaluate(out, q, &from);
  return judged(&c, q->model);
}

// A sum over numbers that are not all finite is not; four at a time, which need not wait for each
// other.
static inline bool all_finite(const double *x, int count) {
  double sum[4] = {0};
  for (int i = 0; i < count; i++) sum[i % 4] += x[i];
  return isfinite((sum[0] + sum[1]) + (sum[2] + sum[3]));
}

static inline bool finite_acceleration(const bike_acceleration *a) {
  return isfinite(a->lean + a->steer + a->speed);
}

static inline int answer_acceleration(bike_acceleration *out, const state_evaluations *by,
                                      const bike_model *model, const bike_state *state,
                                      const bike_input *input) {
  question q;
  bike_acceleration a;
  int code = asked(&q, model, state, input);
  if (!code)
    code = answered(hands_off(input) ? by->free_acceleration : by->loaded_acceleration, &a, &q);
  if (code) return code;
  if (!finite_acceleration(&a)) return BIKE_ERROR_SINGULAR;
  *out = a;
  return BIKE_OK;
}

static inline int answer_rates(bike_rates *out, const state_evaluations *by,
                               const bike_model *model, const bike_state *state,
                               const bike_input *input) {
  question q;
  bike_rates r;
  int code = asked(&q, model, state, input);
  if (!code) code = answered(hands_off(input) ? by->free_rates : by->loaded_rates, &r, &q);
  if (code) return code;
  if (!finite_acceleration(&r.acceleration)) return BIKE_ERROR_SINGULAR;
  if (!isfinite(r.yaw + r.rear_angle + r.front_angle + r.power)) return BIKE_ERROR_NOT_FINITE;
  *out = r;
  return BIKE_OK;
}

static inline int answer_mass_matrix(double out[9], const state_evaluations *by,
                                     const bike_model *model, const bike_state *state,
                                     double rider_offset) {
  question q;
  double M[9];
  bike_input input = {.rider_offset = rider_offset};
  int code = asked(&q, model, state, &input);
  if (!code) code = answered(by->mass_matrix, M, &q);
  if (code) return code;
  if (!all_finite(M, 9)) return BIKE_ERROR_SINGULAR;
  memcpy(out, M, sizeof M);
  return BIKE_OK;
}

static inline int answer_snapshot(bike_snapshot *out, const state_evaluations *by,
                                  const bike_model *model, const bike_state *state,
                                  const bike_input *input) {
  question q;
  bike_snapshot is;
  int code = asked(&q, model, state, input);
  if (!code) code = answered(by->snapshot, &is, &q);
  if (code) return code;
  if (!finite_acceleration(&is.acceleration)) return BIKE_ERROR_SINGULAR;
  if (!all_finite((const double *)&is, sizeof is / sizeof(double))) return BIKE_ERROR_NOT_FINITE;
  *out = is;
  return BIKE_OK;
}

#endif
