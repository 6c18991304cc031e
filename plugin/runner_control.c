// SPDX-License-Identifier: Apache-2.0
// Torques of the input, applied at every stage of a step, and the work they do.
#include "runner_internal.h"

#include "rolling.h"

#include <math.h>
#include <pthread.h>

// mjcb_control gets a model and its data and nothing else: the runner of a thread is found here.
static _Thread_local runner *active;

static bool is_finite_input(const bike_input *in) {
  return isfinite(in->steer_torque) && isfinite(in->roll_torque) && isfinite(in->rider_offset) &&
         isfinite(in->rider_velocity) && isfinite(in->rider_acceleration);
}

// The input at a time; a rider who moves or sits elsewhere than in the model is refused, unless he
// is a body of his own there.
static bike_input read_input(runner *r, double time) {
  bike_input in = {.rider_offset = r->rider_offset};
  if (r->input) r->input(time, &in, r->user);
  if (!is_finite_input(&in)) {
    r->refused = RUNNER_ARGUMENT;
  } else if (!r->map.rider.moves && (in.rider_offset != r->rider_offset || in.rider_velocity != 0 ||
                                     in.rider_acceleration != 0)) {
    r->refused = RUNNER_UNSUPPORTED;
  }
  return r->refused ? (bike_input){.rider_offset = r->rider_offset} : in;
}

// The drive's motion, at this stage; qpos 0 is where the model was built with him.
static void drive_rider(const runner *r, mjData *d, const bike_input *in) {
  if (!r->map.rider.moves) return;
  mjtNum *motion = d->userdata + r->map.rider.userdata;
  motion[0] = in->rider_offset - r->rider_offset;
  motion[1] = in->rider_velocity;
  motion[2] = in->rider_acceleration;
}

void runner_place_rider(runner *r, mjData *d) {
  const runner_rider *rider = &r->map.rider;
  if (!rider->moves) return;
  bike_input in = read_input(r, d->time);
  d->qpos[rider->qpos] = in.rider_offset - r->rider_offset;
  d->qvel[rider->dof] = in.rider_velocity;
}

double runner_work(const runner *r) {
  return r->work + (r->map.rider.works ? r->ride->act[r->map.rider.work] : 0);
}

double runner_probe_power(const runner *r) {
  return r->probe_power + (r->map.rider.works ? r->probe->act_dot[r->map.rider.work] : 0);
}

// Heading e_R of the rear wheel: horizontal, square to its axle n.  e_R = n x z / |n x z|
static void find_heading(double out[3], const runner *r, const mjData *d) {
  const double *n = d->xaxis + 3 * r->map.wheel[RUNNER_REAR].hinge.joint;
  double s = hypot(n[0], n[1]);
  s *= r->map.wheel[RUNNER_REAR].hinge.sign; // n to the left
  out[0] = n[1] / s, out[1] = -n[0] / s, out[2] = 0;
}

// Runge-Kutta's weight of a stage, so that the work is one more state under the same integrator.
static double stage_weight(const mjModel *m, int stage) {
  static const double rk4[4] = {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6};
  return m->opt.integrator == mjINT_RK4 ? rk4[stage % 4] : 1;
}

static void control(const mjModel *m, mjData *d) {
  runner *r = active;
  if (!r || m != r->model || (d != r->ride && d != r->probe)) return;
  bike_input in = read_input(r, d->time);
  drive_rider(r, d, &in);
  const runner_hinge *steer = &r->map.steer;

  // M_S about the steering axis, the roll torque on the rear frame about its heading.
  double heading[3], torque[3];
  static const double no_force[3] = {0};
  find_heading(heading, r, d);
  mju_scl3(torque, heading, in.roll_torque);
  mju_zero(d->qfrc_applied, m->nv);
  mj_applyFT(m, d, no_force, torque, d->xpos + 3 * r->map.frame, r->map.frame, d->qfrc_applied);
  d->qfrc_applied[steer->dof] += steer->sign * in.steer_torque;

  // P = (M_S - d phi') phi' + roll torque . omega
  double phi_rate = steer->sign * d->qvel[steer->dof];
  double power = (in.steer_torque - m->dof_damping[steer->dof] * phi_rate) * phi_rate +
                 mju_dot3(torque, d->cvel + 6 * r->map.frame);
  if (d == r->ride)
    r->work += m->opt.timestep * stage_weight(m, r->stages) * power;
  else
    r->probe_power = power;
  r->stages++;
}

// A roll_install before ours, by whomever, would leave out our callback: take its place.
static void install(void) {
  roll_uninstall();
  mjcb_control = control;
  roll_install();
}

void runner_install_control(void) {
  static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
  static bool installed;
  pthread_mutex_lock(&lock);
  if (!installed || !roll_is_installed()) install();
  installed = true;
  pthread_mutex_unlock(&lock);
}

runner *runner_activate(runner *r) {
  runner *before = active;
  active = r;
  return before;
}
