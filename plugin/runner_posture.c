// SPDX-License-Identifier: Apache-2.0
// Yaw, roll and pitch of the rear frame, R = Rz(yaw) Rx(roll) Ry(pitch), from either root.
#include "runner_internal.h"

#include <math.h>

enum { YAW, ROLL, PITCH };

static void read_hinges(runner_posture *out, const runner *r, const mjData *d) {
  for (int k = 0; k < 3; k++) {
    out->angle[k] = d->qpos[r->map.root_qpos + 3 + k];
    out->rate[k] = d->qvel[r->map.root_dof + 3 + k];
    out->acceleration[k] = d->qacc[r->map.root_dof + 3 + k];
  }
}

// The frame's axle direction n = R y = (-sin yaw cos roll, cos yaw cos roll, sin roll) and its
// derivatives give yaw and roll; what is left of the rotation about n is pitch.
static void read_rotation(runner_posture *out, const double R[9], const double w[3],
                          const double a[3]) {
  double n[3], n1[3], n2[3], turning[3];
  for (int k = 0; k < 3; k++) n[k] = R[3 * k + 1];
  // n' = w x n,  n'' = a x n + w x n'
  mju_cross(n1, w, n);
  mju_cross(n2, a, n);
  mju_cross(turning, w, n1);
  mju_addTo3(n2, turning);
  double s2 = n[0] * n[0] + n[1] * n[1], s = sqrt(s2);

  out->angle[YAW] = atan2(-n[0], n[1]);
  out->angle[ROLL] = atan2(n[2], s);
  out->angle[PITCH] = atan2(-R[6], R[8]); // row z of R: cos(roll) (-sin pitch, ., cos pitch)
  // yaw' = (nx ny' - ny nx')/s^2,  roll' = nz'/s,  pitch' = w.n - yaw' sin(roll)
  double yaw1 = (n[0] * n1[1] - n[1] * n1[0]) / s2, roll1 = n1[2] / s;
  out->rate[YAW] = yaw1;
  out->rate[ROLL] = roll1;
  out->rate[PITCH] = mju_dot3(w, n) - yaw1 * n[2];
  // and once more; w.n' = 0
  double yaw2 = (n[0] * n2[1] - n[1] * n2[0] - 2 * yaw1 * (n[0] * n1[0] + n[1] * n1[1])) / s2;
  out->acceleration[YAW] = yaw2;
  out->acceleration[ROLL] = (n2[2] + n[2] * roll1 * roll1) / s;
  out->acceleration[PITCH] = mju_dot3(a, n) - yaw2 * n[2] - yaw1 * n1[2];
}

static void read_free(runner_posture *out, const runner *r, const mjData *d) {
  double R[9], w[3], a[3];
  mju_quat2Mat(R, d->qpos + r->map.root_qpos + 3);
  mju_rotVecMat(w, d->qvel + r->map.root_dof + 3, R); // a free joint's rotation is in its body
  mju_rotVecMat(a, d->qacc + r->map.root_dof + 3, R);
  read_rotation(out, R, w, a);
}

// From the body in the world, whatever holds it: rotations of cvel and cacc are the world's.
static void read_foreign(runner_posture *out, const runner *r, const mjData *d) {
  double R[9];
  mju_mulMatMat(R, d->xmat + 9 * r->map.frame, r->map.axes, 3, 3, 3);
  read_rotation(out, R, d->cvel + 6 * r->map.frame, d->cacc + 6 * r->map.frame);
}

void runner_read_posture(runner_posture *out, const runner *r, const mjData *d) {
  if (r->map.foreign)
    read_foreign(out, r, d);
  else if (r->map.free_root)
    read_free(out, r, d);
  else
    read_hinges(out, r, d);
}

void runner_write_posture(const runner *r, mjData *d, const double place[3],
                          const double angle[3]) {
  double *q = d->qpos + r->map.root_qpos;
  if (!r->map.free_root) {
    mju_copy3(q, place);
    mju_copy3(q + 3, angle);
    return;
  }
  static const double axes[3][3] = {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}};
  double turn[3][4], yaw_roll[4];
  for (int k = 0; k < 3; k++) mju_axisAngle2Quat(turn[k], axes[k], angle[k]);
  mju_mulQuat(yaw_roll, turn[YAW], turn[ROLL]);
  mju_add3(q, r->model->body_pos + 3 * r->map.frame, place);
  mju_mulQuat(q + 3, yaw_roll, turn[PITCH]);
}

void runner_write_rates(const runner *r, mjData *d, const double velocity[3],
                        const double rate[3]) {
  double *v = d->qvel + r->map.root_dof;
  mju_copy3(v, velocity);
  if (!r->map.free_root) {
    mju_copy3(v + 3, rate);
    return;
  }
  // w = yaw' z + roll' (Rz x) + pitch' n in the body's axes, where the first two directions are
  // (-cos roll sin pitch, sin roll, cos roll cos pitch) and (cos pitch, 0, sin pitch).
  runner_posture now;
  read_free(&now, r, d);
  double sr = sin(now.angle[ROLL]), cr = cos(now.angle[ROLL]);
  double sp = sin(now.angle[PITCH]), cp = cos(now.angle[PITCH]);
  v[3] = -cr * sp * rate[YAW] + cp * rate[ROLL];
  v[4] = sr * rate[YAW] + rate[PITCH];
  v[5] = cr * cp * rate[YAW] + sp * rate[ROLL];
}
