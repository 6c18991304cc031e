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

static inline bool finite_state(const bike_state *s) {
  return isfinite(s->lean + s->steer + s->lean_rate + s->steer_rate + s->speed);
}

static inline bool finite_input(const bike_input *in) {
  return isfinite(in->steer_torque + in->roll_torque + in->rider_offset + in->rider_velocity +
                  in->rider_acceleration);
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
  if (!finite_state(state) || !finite_input(input)) return BIKE_ERROR_NOT_FINITE;
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
  if (!code) memcpy(out, M, sizeof M);
  return code;
}

// Large but finite arguments may overflow in products that the accelerations do not hold.
static inline bool finite_snapshot(const bike_snapshot *s) {
  double sum = s->kinetic + s->potential + s->power + s->yaw_acceleration + s->pitch_acceleration +
               s->rear_wheel_acceleration + s->front_wheel_acceleration + s->front_speed;
  for (int i = 0; i < 3; i++) sum += s->rear_force[i] + s->front_force[i];
  return isfinite(sum);
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
  if (!finite_snapshot(&is)) return BIKE_ERROR_NOT_FINITE;
  *out = is;
  return BIKE_OK;
}

#endif
