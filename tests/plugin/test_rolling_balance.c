// SPDX-License-Identifier: Apache-2.0
// MuJoCo's stock recipe for a balancing controller on a rolling bicycle: linearise the step by
// mjd_transitionFD, solve the discrete Riccati equation, feed the state back.
#include "rolling_support.h"

enum { X, Y, Z, YAW, ROLL, PITCH, REAR, STEER, FRONT, DOFS, STATES = 2 * DOFS };

static const mjtNum speed = 3; // m/s; below the weave speed, 4.29 m/s: unstable without control

static void start_at_speed(mjData *d, const mjModel *m, mjtNum lean) {
  d->qpos[ROLL] = lean;
  d->qvel[X] = speed;
  d->qvel[REAR] = speed / 0.3;
  d->qvel[FRONT] = speed / 0.35;
  assert_int_equal(roll_project(m, d), ROLL_OK);
}

static mjtNum quadratic(const mjtNum *P, const mjtNum *x, const mjtNum *y) {
  mjtNum sum = 0;
  for (int i = 0; i < STATES; i++) sum += x[i] * mju_dot(P + i * STATES, y, STATES);
  return sum;
}

// One step of value iteration: P = Q + A^T P A - (A^T P B)(A^T P B)^T / (r + B^T P B), in place,
// and the gain K = (B^T P A) / (r + B^T P B). Returns the largest change of the gain.
static mjtNum improve(mjtNum *P, mjtNum *K, const mjtNum *A, const mjtNum *B, const mjtNum *Q,
                      mjtNum r) {
  static mjtNum PA[STATES * STATES], next[STATES * STATES], PB[STATES], APB[STATES];
  mju_mulMatMat(PA, P, A, STATES, STATES, STATES);
  mju_mulMatTMat(next, A, PA, STATES, STATES, STATES);
  mju_mulMatVec(PB, P, B, STATES, STATES);
  mju_mulMatTVec(APB, A, PB, STATES, STATES);
  mjtNum weight = r + quadratic(P, B, B), change = 0;
  for (int i = 0; i < STATES; i++) {
    change = fmax(change, fabs(APB[i] / weight - K[i]));
    K[i] = APB[i] / weight;
    for (int j = 0; j < STATES; j++)
      P[i * STATES + j] = next[i * STATES + j] - APB[i] * APB[j] / weight;
    P[i * STATES + i] += Q[i];
  }
  return change;
}

// Gains that keep lean and steer small, whatever heading and place become.
static void find_gains(mjtNum *K, const mjModel *m) {
  static mjtNum A[STATES * STATES], P[STATES * STATES];
  mjtNum B[STATES], Q[STATES] = {[ROLL] = 1, [STEER] = 0.1};
  mjModel *euler = mj_copyModel(NULL, m);
  euler->opt.integrator = mjINT_EULER;
  mjData *d = mj_makeData(euler);
  start_at_speed(d, euler, 0);
  mjd_transitionFD(euler, d, 1e-6, 1, A, B, NULL, NULL);
  for (int i = 0; i < STATES; i++) P[i * STATES + i] = Q[i];
  mju_zero(K, STATES);
  mjtNum change = INFINITY;
  int most = 20000; // twenty seconds of it at 1 ms
  while (most-- && change > 1e-9) change = improve(P, K, A, B, Q, 1e-3);
  mj_deleteData(d);
  mj_deleteModel(euler);
}

// Lean after `time` from a lean of 0.1 rad, with u = -K x; INFINITY if it falls.
static mjtNum lean_after(mjtNum time, const mjtNum *K, const mjModel *m) {
  mjData *d = mj_makeData(m), *upright = mj_makeData(m);
  start_at_speed(d, m, 0.1);
  start_at_speed(upright, m, 0);
  mjtNum x[STATES], lean;
  while (d->time < time && fabs(d->qpos[ROLL]) < 1) {
    mj_differentiatePos(m, x, 1, upright->qpos, d->qpos);
    mju_sub(x + DOFS, d->qvel, upright->qvel, DOFS);
    d->ctrl[0] = -mju_dot(K, x, STATES);
    mj_step(m, d);
  }
  lean = fabs(d->qpos[ROLL]) < 1 ? d->qpos[ROLL] : INFINITY;
  mj_deleteData(upright);
  mj_deleteData(d);
  return lean;
}

static void test_balance_below_weave_speed(void **unused) {
  (void)unused;
  mjModel *m = load("bicycle.xml");
  mjtNum K[STATES], nothing[STATES] = {0};
  find_gains(K, m);
  mjtNum lean = lean_after(10, K, m);
  print_message("lean of 0.1 rad at %g m/s: %.1e rad after 10 s\n", speed, lean);
  assert_true(isinf(lean_after(10, nothing, m))); // it falls by itself
  assert_below(lean, 5e-3); // what is left goes with the slow drift of the heading
  assert_below(K[X], 1e-3);
  assert_below(K[Y], 1e-3);
  mj_deleteModel(m);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_balance_below_weave_speed)};
  return cmocka_run_group_tests(tests, install_rolling, uninstall_rolling);
}
