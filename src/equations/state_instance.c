// SPDX-License-Identifier: Apache-2.0
// The kernel in double, with its failures judged; compiled once for every instruction set, as
// state_baseline, state_v3, state_v4.
#include "equations/state_instance.h"

#include <bicycle/error.h>

#include "equations/number_double.h"
#include "equations/rear_angle.h"
#include "equations/regular.h"

// All of the kernel is inlined into these: what they do not read of an instant is then never
// stored, a sixth of the time.
#define FLAT __attribute__((flatten))

static bool finite_state(const bike_state *s) {
  return isfinite(s->lean + s->steer + s->lean_rate + s->steer_rate + s->speed);
}

static bool finite_input(const bike_input *in) {
  return isfinite(in->steer_torque + in->roll_torque + in->rider_offset + in->rider_velocity +
                  in->rider_acceleration);
}

static bool sways(const bike_input *in) {
  return in->rider_offset != 0 || in->rider_velocity != 0 || in->rider_acceleration != 0;
}

static form speeds_of(const bike_state *s) {
  return (form){s->steer_rate, s->lean_rate, s->speed};
}

static load load_of(const bike_input *in) {
  return (load){in->steer_torque, in->roll_torque, in->rider_offset, in->rider_velocity,
                in->rider_acceleration};
}

static int judged(const instant *now, const bike_model *model) {
  if (!yaw_determined(&now->at, model) || !regular(&now->k)) return BIKE_ERROR_SINGULAR;
  form a = now->acceleration;
  return isfinite(a.phi + a.kap + a.v) ? BIKE_OK : BIKE_ERROR_SINGULAR;
}

// Where the Newton steps from the guess near upright are not enough: from a start found by
// continuation.
__attribute__((noinline, cold)) static int solve_far(instant *now, const bike_model *model,
                                                     const bike_state *state, const load *in) {
  start from;
  int code = rear_angle_continued(&from, model, state->steer, state->lean);
  if (code) return code;
  locate(&now->at, &model->geometry, from, state->steer, state->lean);
  if (!rear_angle_found(&now->at, model)) return BIKE_ERROR_GEOMETRY;
  solve_located(now, model, speeds_of(state), in);
  return judged(now, model);
}

static inline int solve_state(instant *now, const bike_model *model, const bike_state *state,
                              const bike_input *input) {
  if (!finite_state(state) || !finite_input(input)) return BIKE_ERROR_NOT_FINITE;
  if (model->rider_mass == 0 && sways(input)) return BIKE_ERROR_NO_RIDER;
  load in = load_of(input);
  start from = guessed(model, state->steer, state->lean);
  locate(&now->at, &model->geometry, from, state->steer, state->lean);
  if (!rear_angle_found(&now->at, model)) {
    instant far; // not `now` itself, whose address must not be known
    int code = solve_far(&far, model, state, &in);
    if (!code) *now = far;
    return code;
  }
  solve_located(now, model, speeds_of(state), &in);
  return judged(now, model);
}

static bike_acceleration named(form a) {
  return (bike_acceleration){.lean = a.kap, .steer = a.phi, .speed = a.v};
}

// Hinge rates relative to frame and fork, growing when rolling forward (about -e_N).
static double rear_hinge(const instant *now) {
  return now->rate.br - now->rate.spin_r - now->rate.yaw * now->at.s_kap;
}

static double front_hinge(const instant *now) {
  return dot(now->k.velocity.turn, now->k.body.axle_f) - now->rate.spin_f;
}

static double power_of(const instant *now, const bike_model *m, const load *in) {
  double phi = now->rate.u.phi;
  double p = (in->steer_torque - m->steer_damping * phi) * phi + in->roll_torque * now->rate.u.kap;
  return in->w1 == 0 ? p : p + rider_force(now, m) * in->w1;
}

FLAT static int accelerate(bike_acceleration *out, const bike_model *model, const bike_state *state,
                           const bike_input *input) {
  instant now;
  int code = solve_state(&now, model, state, input);
  if (code) return code;
  *out = named(now.acceleration);
  return BIKE_OK;
}

FLAT static int rates_of(bike_rates *out, const bike_model *model, const bike_state *state,
                         const bike_input *input) {
  instant now;
  int code = solve_state(&now, model, state, input);
  if (code) return code;
  load in = load_of(input);
  *out = (bike_rates){.acceleration = named(now.acceleration),
                      .yaw = now.rate.yaw,
                      .rear_angle = rear_hinge(&now),
                      .front_angle = front_hinge(&now),
                      .power = power_of(&now, model, &in)};
  bool finite = isfinite(out->yaw + out->rear_angle + out->front_angle + out->power);
  return finite ? BIKE_OK : BIKE_ERROR_NOT_FINITE;
}

static int mass_matrix_of(double out[9], const bike_model *model, const bike_state *state,
                          double rider_offset) {
  instant now;
  bike_input input = {.rider_offset = rider_offset};
  int code = solve_state(&now, model, state, &input);
  if (code) return code;
  const double *M = now.k.M; // phi phi, kap kap, v v, phi kap, phi v, kap v
  double rows[9] = {M[1], M[3], M[5], M[3], M[0], M[4], M[5], M[4], M[2]};
  for (int i = 0; i < 9; i++) out[i] = rows[i];
  return BIKE_OK;
}

static void put_geometry(bike_snapshot *out, const instant *now, const bike_model *m) {
  const position *g = &now->at;
  out->beta_r = atan2(g->s_br, g->c_br);
  out->beta_f = atan2(g->s_bf, g->c_bf);
  out->psi = atan2(g->s_psi, g->c_psi);
  out->phi_tilde = atan2(g->s_phit, g->c_phit);
  out->pitch = m->tilt - out->beta_r;
  out->T_r = g->T_r;
  out->T_f = g->T_f;
  out->Z_0 = g->Z_0;
}

static void put_rates(bike_snapshot *out, const instant *now, const bike_model *m) {
  form a = now->acceleration;
  out->acceleration = named(a);
  out->yaw_rate = now->rate.yaw;
  out->pitch_rate = -now->rate.br;
  out->front_speed = now->rate.v_f;
  out->rear_wheel_rate = rear_hinge(now);
  out->front_wheel_rate = front_hinge(now);
  out->yaw_acceleration = now->rest.yaw + applied(now->forms.yaw, a);
  out->pitch_acceleration = -(now->rest.br + applied(now->forms.br, a));
  // derivatives of the hinge rates; e_N turns with the frame, e_N^f with the fork
  const masses *body = &now->k.body;
  vec w = now->k.velocity.turn, al = accelerated(now, m).turn;
  double fork = dot(al, body->axle_f) + now->rate.u.phi * dot(w, cross(body->axis, body->axle_f));
  out->rear_wheel_acceleration = al.x - spin_up_rear(now);
  out->front_wheel_acceleration = fork - spin_up_front(now);
}

static void put_force(double out[3], vec force) {
  out[0] = force.x;
  out[1] = force.y;
  out[2] = force.z;
}

// Large but finite arguments may overflow in products that the accelerations do not hold.
static bool finite_snapshot(const bike_snapshot *s) {
  double sum = s->kinetic + s->potential + s->power + s->yaw_acceleration + s->pitch_acceleration +
               s->rear_wheel_acceleration + s->front_wheel_acceleration + s->front_speed;
  for (int i = 0; i < 3; i++) sum += s->rear_force[i] + s->front_force[i];
  return isfinite(sum);
}

FLAT static int evaluate(bike_snapshot *out, const bike_model *model, const bike_state *state,
                         const bike_input *input) {
  instant now;
  int code = solve_state(&now, model, state, input);
  if (code) return code;
  load in = load_of(input);
  bike_snapshot is;
  put_geometry(&is, &now, model);
  put_rates(&is, &now, model);
  energy e = energy_of(&now, model, &in);
  is.kinetic = e.kinetic;
  is.potential = e.potential;
  is.power = power_of(&now, model, &in);
  ground forces = ground_forces(&now, model, &in);
  put_force(is.rear_force, forces.rear);
  put_force(is.front_force, forces.front);
  if (!finite_snapshot(&is)) return BIKE_ERROR_NOT_FINITE;
  *out = is;
  return BIKE_OK;
}

const state_functions INSTANCE(state) = {.accelerate = accelerate,
                                         .rates_of = rates_of,
                                         .mass_matrix = mass_matrix_of,
                                         .evaluate = evaluate};
