// SPDX-License-Identifier: Apache-2.0
// Linearisation and eigenvalues of many states.
#include <bicycle/batch.h>

#include <bicycle/error.h>
#include <math.h>

#include "batch/eigenvalues.h"
#include "batch/lanes.h"
#include "equations/slaved.h"
#include "equations/tangent/jacobian.h"

// State i of the points is number `from + i` of the caller's, or the last.
static void gather(jacobian_points *p, const bike_state *states, const bike_input *inputs,
                   size_t used) {
  static const bike_input hands_off = {0};
  for (size_t i = 0; i < JACOBIAN_POINTS; i++) {
    size_t k = i < used ? i : used - 1;
    const bike_state *s = &states[k];
    const bike_input *in = inputs ? &inputs[k] : &hands_off;
    p->at[AT_STEER][i] = s->steer;
    p->at[AT_LEAN][i] = s->lean;
    p->at[AT_STEER_RATE][i] = s->steer_rate;
    p->at[AT_LEAN_RATE][i] = s->lean_rate;
    p->at[AT_SPEED][i] = s->speed;
    p->at[AT_STEER_TORQUE][i] = in->steer_torque;
    p->at[AT_ROLL_TORQUE][i] = in->roll_torque;
    p->at[AT_RIDER_ACCELERATION][i] = in->rider_acceleration;
    p->at[AT_RIDER_OFFSET][i] = in->rider_offset;
    p->at[AT_RIDER_VELOCITY][i] = in->rider_velocity;
  }
}

static bool all_finite(const double *a, int n) {
  double sum = 0;
  for (int i = 0; i < n; i++) sum += a[i];
  return isfinite(sum);
}

// As bike_linearize puts them together, at constant energy.
static int assemble(bike_linear *out, const jacobian *j, size_t i) {
  static const int inputs[3] = {AT_STEER_TORQUE, AT_ROLL_TORQUE, AT_RIDER_ACCELERATION};
  bike_linear linear = {0};
  linear.A[2] = linear.A[7] = 1;
  for (int row = 0; row < 2; row++) {
    const jacobian_row *slope = j->slope[row]; // OF_STEER, OF_LEAN
    double slaved = slope[AT_SPEED][i];
    int code = slave_to_energy(&slaved, j->energy_slope[AT_SPEED][i]);
    if (code) return code;
    for (int k = 0; k < 4; k++)
      linear.A[4 * (row + 2) + k] = slope[k][i] - slaved * j->energy_slope[k][i];
    for (int k = 0; k < 3; k++) linear.B[3 * (row + 2) + k] = slope[inputs[k]][i] + 0.0;
  }
  if (!all_finite(linear.A, 16) || !all_finite(linear.B, 12)) return BIKE_ERROR_NOT_FINITE;
  *out = linear;
  return BIKE_OK;
}

static bool rides_alone(const bike_model *model, const bike_input *in) {
  return model->rider_mass == 0 && in &&
         (in->rider_offset != 0 || in->rider_velocity != 0 || in->rider_acceleration != 0);
}

int bike_batch_linearize(bike_linear *out, int *codes, const bike_model *model,
                         const bike_state *states, const bike_input *inputs, size_t count) {
  if (!out || !codes || !model || !states) return BIKE_ERROR_ARGUMENT;
  for (size_t first = 0; first < count; first += JACOBIAN_POINTS) {
    size_t used = count - first < JACOBIAN_POINTS ? count - first : JACOBIAN_POINTS;
    const bike_input *in = inputs ? inputs + first : NULL;
    jacobian_points points;
    jacobian j;
    jacobian_codes here;
    gather(&points, states + first, in, used);
    jacobian_at(&j, here, model, &points);
    for (size_t i = 0; i < used; i++) {
      const bike_input *own = in ? &in[i] : NULL;
      int code = rides_alone(model, own) ? BIKE_ERROR_NO_RIDER : here[i];
      if (!code) code = assemble(&out[first + i], &j, i);
      if (code) // who can follow the rear angle further, or tell why not
        code = bike_linearize(&out[first + i], model, &states[first + i], own);
      codes[first + i] = code;
    }
  }
  return BIKE_OK;
}

// Blocks of as many matrices as lanes; spare lanes hold the last one.
static unsigned solve_block(double *re, double *im, const lanes_functions *lanes,
                            const bike_linear *linears, size_t used) {
  _Alignas(64) double K[4 * LANES_MOST], C[4 * LANES_MOST];
  size_t width = (size_t)lanes->width;
  for (size_t i = 0; i < width; i++) {
    const double *A = linears[i < used ? i : used - 1].A + 8;
    for (size_t k = 0; k < 4; k++) {
      size_t row = k / 2, column = k % 2;
      K[k * width + i] = A[4 * row + column];
      C[k * width + i] = A[4 * row + 2 + column];
    }
  }
  return lanes->eigenvalues(re, im, K, C);
}

int bike_batch_eigenvalues(bike_eigenvalues *out, int *codes, const bike_linear *linears,
                           size_t count) {
  if (!out || !codes || !linears) return BIKE_ERROR_ARGUMENT;
  const lanes_functions *lanes = lanes_in_use();
  size_t width = (size_t)lanes->width;
  for (size_t first = 0; first < count; first += width) {
    size_t used = count - first < width ? count - first : width;
    double re[4 * LANES_MOST], im[4 * LANES_MOST];
    unsigned solved = solve_block(re, im, lanes, linears + first, used);
    for (size_t i = 0; i < used; i++) {
      const double *A = linears[first + i].A;
      codes[first + i] = BIKE_OK;
      double x[4], y[4];
      for (size_t k = 0; k < 4; k++) {
        x[k] = re[k * width + i];
        y[k] = im[k * width + i];
      }
      if (solved >> i & 1 && all_finite(A, 16))
        eigenvalues_paired(&out[first + i], x, y);
      else
        codes[first + i] = bike_eigenvalues_of(&out[first + i], A);
    }
  }
  return BIKE_OK;
}
