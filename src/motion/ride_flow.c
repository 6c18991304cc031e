// SPDX-License-Identifier: Apache-2.0
#include "motion/ride_flow.h"

#include <bicycle/error.h>
#include <math.h>

static bike_state state_of(const double y[RIDE_SIZE]) {
  return (bike_state){.lean = y[RIDE_LEAN],
                      .steer = y[RIDE_STEER],
                      .lean_rate = y[RIDE_LEAN_RATE],
                      .steer_rate = y[RIDE_STEER_RATE],
                      .speed = y[RIDE_SPEED]};
}

static bool within_range(const bike_input *in) {
  return fabs(in->steer_torque) <= BIKE_LARGEST && fabs(in->roll_torque) <= BIKE_LARGEST &&
         fabs(in->rider_offset) <= BIKE_LARGEST && fabs(in->rider_velocity) <= BIKE_LARGEST &&
         fabs(in->rider_acceleration) <= BIKE_LARGEST;
}

// A fatal error stays: an integrator may try elsewhere and get through.
static int failure(ride_flow *flow, int code, bool fatal) {
  if (!flow->fatal) flow->error = code;
  flow->fatal |= fatal;
  return fatal ? 2 : 1;
}

static int ask_input(bike_input *in, double t, ride_flow *flow) {
  *in = (bike_input){0};
  if (!flow->input) return 0;
  flow->input(fmin(fmax(t, flow->from), flow->to), in, flow->user);
  return within_range(in) ? 0 : failure(flow, BIKE_ERROR_NOT_FINITE, true);
}

// With finite inputs every error but a missing rider is the trial state's: a shorter step may help.
static int judge(int code, ride_flow *flow) {
  return code ? failure(flow, code, code == BIKE_ERROR_NO_RIDER) : 0;
}

int ride_rates(double dy[RIDE_SIZE], double t, const double y[RIDE_SIZE], ride_flow *flow) {
  flow->evaluations++;
  bike_input in;
  int failed = ask_input(&in, t, flow);
  if (failed) return failed;
  bike_state state = state_of(y);
  bike_rates rates;
  failed = judge(bike_rates_of(&rates, flow->model, &state, &in), flow);
  if (failed) return failed;
  double speed = y[RIDE_SPEED],
         yaw = y[RIDE_YAW]; // once: dy might be y, for all the compiler knows
  dy[RIDE_STEER] = y[RIDE_STEER_RATE];
  dy[RIDE_LEAN] = y[RIDE_LEAN_RATE];
  dy[RIDE_STEER_RATE] = rates.acceleration.steer;
  dy[RIDE_LEAN_RATE] = rates.acceleration.lean;
  dy[RIDE_SPEED] = rates.acceleration.speed;
  dy[RIDE_X] = speed * cos(yaw);
  dy[RIDE_Y] = speed * sin(yaw);
  dy[RIDE_YAW] = rates.yaw;
  dy[RIDE_REAR_ANGLE] = rates.rear_angle;
  dy[RIDE_FRONT_ANGLE] = rates.front_angle;
  dy[RIDE_WORK] = rates.power;
  return 0;
}

int ride_look(bike_snapshot *out, const ride_point *at, ride_flow *flow) {
  bike_input in;
  int failed = ask_input(&in, at->t, flow);
  if (failed) return failed;
  bike_state state = state_of(at->y);
  return judge(bike_evaluate(out, flow->model, &state, &in), flow);
}

ride_point ride_start(const bike_state *state) {
  ride_point p = {0};
  p.y[RIDE_STEER] = state->steer;
  p.y[RIDE_LEAN] = state->lean;
  p.y[RIDE_STEER_RATE] = state->steer_rate;
  p.y[RIDE_LEAN_RATE] = state->lean_rate;
  p.y[RIDE_SPEED] = state->speed;
  return p;
}

void ride_describe(bike_sample *sample, bike_sample_more *more, const ride_point *at,
                   const bike_snapshot *now) {
  const double *y = at->y;
  *sample = (bike_sample){.time = at->t,
                          .x = y[RIDE_X],
                          .y = y[RIDE_Y],
                          .yaw = y[RIDE_YAW],
                          .lean = y[RIDE_LEAN],
                          .pitch = now->pitch,
                          .steer = y[RIDE_STEER],
                          .lean_rate = y[RIDE_LEAN_RATE],
                          .steer_rate = y[RIDE_STEER_RATE],
                          .speed = y[RIDE_SPEED],
                          .rear_angle = y[RIDE_REAR_ANGLE],
                          .front_angle = y[RIDE_FRONT_ANGLE],
                          .energy = now->kinetic + now->potential,
                          .rear_normal = now->rear_force[2],
                          .front_normal = now->front_force[2],
                          .rear_friction = bike_friction(now->rear_force),
                          .front_friction = bike_friction(now->front_force)};
  more->work = y[RIDE_WORK];
  for (int i = 0; i < 3; i++) {
    more->rear_force[i] = now->rear_force[i];
    more->front_force[i] = now->front_force[i];
  }
}
