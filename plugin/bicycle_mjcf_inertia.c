// SPDX-License-Identifier: Apache-2.0
// Tensors between the bicycle, which takes any positive semidefinite one, and MuJoCo, whose
// compiler takes only those of extended bodies but whose dynamics work with any.
#include "bicycle_mjcf_internal.h"
#include "runner_guard.h"

#include <math.h>
#include <string.h>

// Ten times what MuJoCo demands of a moving body (mjMINVAL = 1e-15), kg m^2: only ever a
// placeholder.
static const double least_moment = 1e-14;

static const char numeric_prefix[] = "inertia:";

static void unpack(double matrix[9], const double t[6]) {
  const double full[9] = {t[0], t[3], t[4], t[3], t[1], t[5], t[4], t[5], t[2]};
  memcpy(matrix, full, sizeof full);
}

// A Jacobi rotation that makes A[p][q] zero:  A <- G^T A G,  V <- V G.
static void rotate(double A[9], double V[9], int p, int q) {
  double apq = A[3 * p + q];
  if (apq == 0) return;
  double theta = (A[4 * q] - A[4 * p]) / (2 * apq);
  double t = copysign(1, theta) / (fabs(theta) + hypot(theta, 1));
  double c = 1 / hypot(t, 1), s = t * c;
  for (int k = 0; k < 3; k++) {
    double kp = A[3 * k + p], kq = A[3 * k + q];
    A[3 * k + p] = c * kp - s * kq, A[3 * k + q] = s * kp + c * kq;
  }
  for (int k = 0; k < 3; k++) {
    double pk = A[3 * p + k], qk = A[3 * q + k];
    A[3 * p + k] = c * pk - s * qk, A[3 * q + k] = s * pk + c * qk;
    double vp = V[3 * k + p], vq = V[3 * k + q];
    V[3 * k + p] = c * vp - s * vq, V[3 * k + q] = s * vp + c * vq;
  }
  A[3 * p + q] = A[3 * q + p] = 0;
}

// inertia = V diag(moments) V^T
static void diagonalise(double moments[3], double V[9], const double inertia[6]) {
  const double unit[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  double A[9];
  unpack(A, inertia);
  memcpy(V, unit, sizeof unit);
  // Jacobi's method converges quadratically: 3 x 3 needs five sweeps for the last bit, ten are
  // safe.
  for (int sweep = 0; sweep < 10; sweep++) {
    rotate(A, V, 0, 1);
    rotate(A, V, 0, 2);
    rotate(A, V, 1, 2);
  }
  for (int k = 0; k < 3; k++) moments[k] = A[4 * k];
}

void mjcf_principal(double moments[3], double quat[4], const double inertia[6]) {
  double V[9];
  diagonalise(moments, V, inertia);
  // A rank-1 tensor's zero moments come out as roundings of either sign.
  for (int k = 0; k < 3; k++) moments[k] = fmax(moments[k], 0);
  mju_mat2Quat(quat, V);
}

bool mjcf_make_legal(double moments[3]) {
  bool changed = false;
  for (int k = 0; k < 3; k++)
    if (moments[k] < least_moment) moments[k] = least_moment, changed = true;
  for (int k = 0; k < 3; k++) {
    double *a = &moments[(k + 1) % 3], *b = &moments[(k + 2) % 3];
    double lacking = moments[k] - *a - *b;
    if (lacking <= 0) continue;
    // Half to each of the two small moments, and a little more so that rounding cannot undo it.
    double half = lacking / 2 + 1e-15 * moments[k];
    *a += half, *b += half;
    changed = true;
  }
  return changed;
}

void mjcf_body_inertia(double out[6], const mjModel *model, int body) {
  double R[9], full[9] = {0};
  mju_quat2Mat(R, model->body_iquat + 4 * body);
  const double *moments = model->body_inertia + 3 * body;
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      for (int k = 0; k < 3; k++) full[3 * i + j] += R[3 * i + k] * moments[k] * R[3 * j + k];
  const double packed[6] = {full[0], full[4], full[8], full[1], full[2], full[5]};
  memcpy(out, packed, sizeof packed);
}

// Smallest eigenvalue against the largest; what files hold is rounded at the 17th digit.
static bool is_semidefinite(const double inertia[6]) {
  double m[3], V[9];
  diagonalise(m, V, inertia);
  double largest = fmax(m[0], fmax(m[1], m[2])), least = fmin(m[0], fmin(m[1], m[2]));
  return least >= -1e-12 * largest;
}

// MuJoCo takes a frame that the compiler found equal to the principal axes for these axes, which
// have now turned.
static void forget_same_frames(mjModel *model, int body) {
  enum { EQUALS_PRINCIPAL_AXES = 2 };
  model->body_sameframe[body] = 0;
  for (int i = 0; i < model->ngeom; i++)
    if (model->geom_bodyid[i] == body && model->geom_sameframe[i] == EQUALS_PRINCIPAL_AXES)
      model->geom_sameframe[i] = 0;
  for (int i = 0; i < model->nsite; i++)
    if (model->site_bodyid[i] == body && model->site_sameframe[i] == EQUALS_PRINCIPAL_AXES)
      model->site_sameframe[i] = 0;
}

static bool apply_one(mjModel *model, int numeric, const char *body_name, mjcf_error *error) {
  const double *data = model->numeric_data + model->numeric_adr[numeric];
  int body = mj_name2id(model, mjOBJ_BODY, body_name);
  if (body <= 0) return mjcf_fail(error, "numeric 'inertia:%s': no such body", body_name);
  if (model->numeric_size[numeric] != 6)
    return mjcf_fail(error, "numeric 'inertia:%s': six numbers are needed, there are %d", body_name,
                     model->numeric_size[numeric]);
  for (int k = 0; k < 6; k++)
    if (!isfinite(data[k]))
      return mjcf_fail(error, "numeric 'inertia:%s': number %d is not finite", body_name, k + 1);
  if (!is_semidefinite(data))
    return mjcf_fail(error, "numeric 'inertia:%s': not positive semidefinite", body_name);
  mjcf_principal(model->body_inertia + 3 * body, model->body_iquat + 4 * body, data);
  forget_same_frames(model, body);
  return true;
}

typedef struct constants {
  mjModel *model;
  mjData *data;
} constants;

static void set_constants(void *argument) {
  constants *c = (constants *)argument;
  mj_setConst(c->model, c->data);
}

bool mjcf_apply_inertia(mjModel *model, mjcf_error *error) {
  int applied = 0;
  const size_t prefix = sizeof numeric_prefix - 1;
  for (int i = 0; i < model->nnumeric; i++) {
    const char *name = model->names + model->name_numericadr[i];
    if (strncmp(name, numeric_prefix, prefix) != 0) continue;
    if (!apply_one(model, i, name + prefix, error)) return false;
    applied++;
  }
  if (applied == 0) return true;
  mjData *data = guard_make_data(model);
  if (!data) return mjcf_fail_memory(error);
  // What MuJoCo warns of here it warns of again in the first step, where it ends a ride.
  guard_report report;
  guard_call(&report, set_constants, &(constants){model, data});
  mj_deleteData(data);
  return !report.failed || guard_fail(error, &report);
}
