// SPDX-License-Identifier: Apache-2.0
// A start that satisfies the constraints, found with MuJoCo's own kinematics.
//
// Given lean and steer, the heights of the two discs fix pitch and the height of the rear hub
// (Newton, in stages from upright: there may be several answers). Given their rates and the speed,
// the velocities of the discs' lowest points, which must be zero, and the meaning of the speed fix
// the other seven rates (linear; rank 6 + 1).
#include "runner_guard.h"
#include "runner_internal.h"

#include <math.h>

enum { YAW, ROLL, PITCH, X = 0, Y, Z, RATES = 7 };

// Newton converges in five steps from one stage to the next, and stops by itself at rounding; three
// times that many again and there is no root near.
static const int most_iterations = 20;

// Positions and everything derived from them and from the velocities.
static void refresh(const runner *r, mjData *d) {
  mj_kinematics(r->model, d);
  mj_comPos(r->model, d);
  mj_comVel(r->model, d);
}

// Yaw and pitch are one axis at 90 deg.
static const double most_lean = 85 * mjPI / 180;

typedef struct start {
  runner *r;
  mjData *d;
  const bike_state *state;
  bool found;
} start;

// The unknown rates as a vector: x', y', z', yaw', pitch', rear_spin', front_spin'.
static void write_rates(const start *s, const double u[RATES], double roll_rate,
                        double steer_rate) {
  const runner_map *map = &s->r->map;
  const double rate[3] = {u[3], roll_rate, u[4]};
  runner_write_rates(s->r, s->d, u, rate);
  s->d->qvel[map->steer.dof] = steer_rate;
  s->d->qvel[map->wheel[RUNNER_REAR].hinge.dof] = u[5];
  s->d->qvel[map->wheel[RUNNER_FRONT].hinge.dof] = u[6];
  mj_comVel(s->r->model, s->d);
}

// What must vanish: velocities of the two lowest points, and R_r (pitch' + rear_spin').
static void find_velocities(double out[RATES], const start *s, const double u[RATES]) {
  for (int i = 0; i < RUNNER_WHEELS; i++) {
    runner_disc disc;
    runner_find_disc(&disc, s->r, s->d, i);
    mju_copy3(out + 3 * i, disc.velocity);
  }
  out[6] = s->r->map.wheel[RUNNER_REAR].radius * (u[4] + u[5]);
}

// Rate of the discs' heights by one of the unknown rates: heights depend on pitch and z.
static void height_rates(double out[RUNNER_WHEELS], const start *s, int unknown) {
  double u[RATES] = {0}, v[RATES];
  u[unknown] = 1;
  write_rates(s, u, 0, 0);
  find_velocities(v, s, u);
  out[0] = v[2], out[1] = v[5];
}

// From a pitch and place near the answer.
static bool improve_position(start *s, double place[3], double angle[3]) {
  for (int i = 0; i < most_iterations; i++) {
    runner_write_posture(s->r, s->d, place, angle);
    refresh(s->r, s->d);
    runner_disc rear, front;
    runner_find_disc(&rear, s->r, s->d, RUNNER_REAR);
    runner_find_disc(&front, s->r, s->d, RUNNER_FRONT);
    double by_z[2], by_pitch[2];
    height_rates(by_z, s, Z);
    height_rates(by_pitch, s, 4);
    double determinant = by_z[0] * by_pitch[1] - by_z[1] * by_pitch[0];
    double dz = (rear.height * by_pitch[1] - front.height * by_pitch[0]) / determinant;
    double dpitch = (by_z[0] * front.height - by_z[1] * rear.height) / determinant;
    if (!isfinite(dz) || !isfinite(dpitch)) return false;
    place[Z] -= dz, angle[PITCH] -= dpitch;
    // The rear contact is the origin of the track.
    place[X] -= rear.point[0], place[Y] -= rear.point[1];
  }
  return true;
}

// In stages of at most 0.2 rad of lean and steer, as those of runner_foreign.c.
static bool find_position(start *s) {
  double place[3] = {0}, angle[3] = {0};
  int stages = 1 + (int)(fmax(fabs(s->state->lean), fabs(s->state->steer)) / 0.2);
  for (int i = 1; i <= stages; i++) {
    double share = (double)i / stages;
    angle[ROLL] = share * s->state->lean;
    s->d->qpos[s->r->map.steer.qpos] = share * s->state->steer;
    if (!improve_position(s, place, angle)) return false;
  }
  runner_write_posture(s->r, s->d, place, angle);
  refresh(s->r, s->d);
  return true;
}

static bool find_rates(start *s) {
  const bike_state *state = s->state;
  double A[RATES * RATES], column[RATES], u[RATES] = {0};
  for (int k = 0; k < RATES; k++) {
    double unit[RATES] = {0};
    unit[k] = 1;
    write_rates(s, unit, 0, 0);
    find_velocities(column, s, unit);
    for (int i = 0; i < RATES; i++) A[RATES * i + k] = column[i];
  }
  // What lean and steer rate alone would do, and the speed, are to be made up for.
  double b[RATES];
  write_rates(s, u, state->lean_rate, state->steer_rate);
  find_velocities(b, s, u);
  b[6] -= state->speed;
  for (int i = 0; i < RATES; i++) u[i] = -b[i];
  if (!runner_solve(RATES, A, u)) return false;
  write_rates(s, u, state->lean_rate, state->steer_rate);
  return true;
}

static void find_start(void *argument) {
  start *s = (start *)argument;
  if (s->r->map.foreign) {
    s->found = runner_place_foreign(s->r, s->d, s->state);
    return;
  }
  mj_resetData(s->r->model, s->d);
  s->found =
      find_position(s) && find_rates(s) && runner_residual(s->r, s->d) <= RUNNER_START_TOLERANCE;
}

static bool is_finite_state(const bike_state *s) {
  return isfinite(s->lean) && isfinite(s->steer) && isfinite(s->lean_rate) &&
         isfinite(s->steer_rate) && isfinite(s->speed);
}

bool runner_check_angles(double lean, double steer, mjcf_error *error) {
  double larger = fmax(fabs(lean), fabs(steer));
  return larger <= BIKE_LARGEST_ANGLE ||
         mjcf_fail(error, "the start has an angle of %g rad: beyond 100 turns", larger);
}

runner_status runner_place(runner *r, mjData *d, const bike_state *state, mjcf_error *error) {
  if (!is_finite_state(state)) {
    mjcf_fail(error, "a number of the start state is not finite");
    return RUNNER_ARGUMENT;
  }
  if (fabs(state->lean) >= most_lean) {
    mjcf_fail(error, "the lean of the start state must be below 85 deg");
    return RUNNER_ARGUMENT;
  }
  if (!runner_check_angles(state->lean, state->steer, error)) return RUNNER_ARGUMENT;
  start s = {.r = r, .d = d, .state = state};
  guard_report report;
  guard_call(&report, find_start, &s);
  if (s.found && !report.failed) return RUNNER_OK;
  mjcf_fail(error, "%s", report.failed ? report.error : runner_status_string(RUNNER_START));
  return RUNNER_START;
}
