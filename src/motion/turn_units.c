// SPDX-License-Identifier: Apache-2.0
#include "motion/turn_units.h"

#include <math.h>
#include <stddef.h>

// The exponent of two of the unit of time, and half that of the unit of length.
static int size_of(const bike_model *model) {
  // 4^k m between half and twice a reach of 2 m, that of a bicycle with wheels of 0.3 m
  const double usual = 2;
  return (int)round(0.5 * log2(model->reach / usual));
}

double bike_length_unit(const bike_model *model) {
  return ldexp(1, 2 * size_of(model));
}

turn_units turn_units_of(const bike_model *model) {
  return (turn_units){.length = bike_length_unit(model), .time = ldexp(1, size_of(model))};
}

static void divide_body(bike_body *body, double length) {
  for (int i = 0; i < 3; i++) body->centre[i] /= length, body->moment[i] /= length;
  for (int i = 0; i < 6; i++) body->inertia[i] /= length * length;
  body->spin_inertia /= length * length;
}

bike_model turn_units_model(const bike_model *model, turn_units units) {
  const double length = units.length;
  bike_model out = *model;
  bike_geometry *g = &out.geometry;
  double *const lengths[] = {&g->L_r, &g->L_f, &g->L_s, &g->R_r, &g->R_f, &out.reach};
  for (size_t i = 0; i < sizeof lengths / sizeof lengths[0]; i++) *lengths[i] /= length;
  for (int i = 0; i < 3; i++) out.rider_place[i] /= length;
  out.over_R_r *= length;
  out.over_R_f *= length;
  out.newton_scale *= units.time; // m^-1/2
  out.steer_damping *= units.time / (length * length);
  divide_body(&out.rear, length);
  divide_body(&out.front, length);
  return out;
}

// What one unit of a variable is.
static double unit_of(bike_turn_variable variable, turn_units units) {
  if (variable == BIKE_TURN_SPEED) return units.length / units.time;
  return variable == BIKE_TURN_OFFSET ? units.length : 1;
}

bike_turn_def turn_units_def(const bike_turn_def *def, turn_units units) {
  bike_turn_def out = *def;
  for (int v = 0; v < BIKE_TURN_VARIABLES; v++)
    out.value[v] /= unit_of((bike_turn_variable)v, units);
  out.steer_torque /= units.length; // kg m^2/s^2
  out.offset_limit /= unit_of(BIKE_TURN_OFFSET, units);
  out.speed_limit /= unit_of(BIKE_TURN_SPEED, units);
  if (def->offset_limit == 0) out.offset_limit = 1; // m   no rider reaches farther
  if (def->speed_limit == 0) out.speed_limit = 50;  // m/s no bicycle rides circles faster
  return out;
}

bike_turn turn_units_out(const bike_turn *turn, turn_units units) {
  const double length = units.length, time = units.time;
  bike_turn out = *turn;
  out.speed *= length / time;
  out.rider_offset *= length;
  out.radius *= length;
  out.steer_torque *= length; // kg m^2/s^2, as above
  double *const rates[] = {&out.yaw_rate, &out.eps_max};
  for (int i = 0; i < 2; i++) *rates[i] /= time;
  for (int i = 0; i < 4; i++) out.eigenvalues.re[i] /= time, out.eigenvalues.im[i] /= time;
  out.residual /= time * time;
  return out;
}

bike_turn turn_units_in(const bike_turn *turn, turn_units units) {
  return turn_units_out(turn, (turn_units){.length = 1 / units.length, .time = 1 / units.time});
}
