// SPDX-License-Identifier: Apache-2.0
// Exact first derivatives of the kernel by complex step: f'(x) = Im f(x + ih)/h, without
// cancellation, so h can be as small as to leave the real parts untouched.
#include <bicycle/error.h>
#include <bicycle/linear.h>
#include <math.h>
#include <string.h>

#include "equations/number_complex.h"
#include "equations/slaved.h"

static const double STEP = 1e-100;

enum { PHI, KAPPA, PHI_RATE, KAPPA_RATE, SPEED, VARIABLES };
enum { INPUTS = 3 };

typedef struct perturbed {
  real s_br, c_br;
  real x[VARIABLES];
  load in;
} perturbed;

static perturbed perturbed_state(const bike_state *s, const bike_input *in, double beta_r) {
  return (perturbed){.s_br = sin(beta_r),
                     .c_br = cos(beta_r),
                     .x = {s->steer, s->lean, s->steer_rate, s->lean_rate, s->speed},
                     .in = {in->steer_torque, in->roll_torque, in->rider_offset, in->rider_velocity,
                            in->rider_acceleration}};
}

// The instant with variable `which` moved by i STEP.
static void solve_perturbed(instant *now, const kernel_model *model, perturbed at, int which) {
  at.x[which] += I * STEP;
  const real *x = at.x;
  form u = {x[PHI_RATE], x[KAPPA_RATE], x[SPEED]};
  solve_known(now, model, at.s_br, at.c_br, x[PHI], x[KAPPA], u, &at.in);
}

static double derivative(real value) {
  return cimag(value) / STEP;
}

typedef struct gradients {
  double J[2][VARIABLES]; // of phi'', kappa''
  double E[VARIABLES];    // of the energy
  double B[2][INPUTS];    // of phi'', kappa'' over steer torque, roll torque, rider's acceleration
} gradients;

// Accelerations are linear in the inputs: M u' = f. M is that of any perturbed instant: only its
// imaginary part, which is not used, knows of the perturbation.
static void differentiate_inputs(double B[2][INPUTS], const instant *now, const kernel_model *m) {
  wrench push = {0};
  push_rider(&push, &now->k.body, m, (vec){1, 0, 0});
  form rider = along_motions(&push, &now->at, &now->forms, m->geometry.R_r);
  const real f[INPUTS][3] = {{1, 0, 0}, {0, 1, 0}, {-rider.phi, -rider.kap, -rider.v}};
  kane k = now->k;
  for (int j = 0; j < INPUTS; j++) {
    memcpy(k.f, f[j], sizeof k.f);
    form response = solved(&k);
    B[0][j] = creal(response.phi) + 0.0; // no -0
    B[1][j] = creal(response.kap) + 0.0;
  }
}

static void differentiate(gradients *d, const kernel_model *m, const perturbed *at) {
  instant now;
  for (int j = 0; j < VARIABLES; j++) {
    solve_perturbed(&now, m, *at, j);
    d->J[0][j] = derivative(now.acceleration.phi);
    d->J[1][j] = derivative(now.acceleration.kap);
    energy e = energy_of(&now, m, &at->in);
    d->E[j] = derivative(e.kinetic + e.potential);
  }
  differentiate_inputs(d->B, &now, m);
}

// A result made of doubles.
static int put_finite(void *out, const void *result, size_t size) {
  const double *x = result;
  for (size_t i = 0; i < size / sizeof *x; i++)
    if (!isfinite(x[i])) return BIKE_ERROR_NOT_FINITE;
  memcpy(out, result, size);
  return BIKE_OK;
}

int bike_linearize(bike_linear *out, const bike_model *model, const bike_state *state,
                   const bike_input *input) {
  const bike_input hands_off = {0};
  if (!out || !model || !state) return BIKE_ERROR_ARGUMENT;
  if (!input) input = &hands_off;
  bike_snapshot now; // judges the state, and finds beta_r
  int code = bike_evaluate(&now, model, state, input);
  if (code) return code;

  kernel_model m;
  kernel_model_of(&m, model);
  perturbed at = perturbed_state(state, input, now.beta_r);
  gradients d;
  differentiate(&d, &m, &at);
  bike_linear linear = {0};
  linear.A[2] = linear.A[7] = 1; // phi' = phi', kappa' = kappa'
  for (int i = 0; i < 2; i++) {
    double slaved = d.J[i][SPEED];
    if ((code = slave_to_energy(&slaved, d.E[SPEED]))) return code;
    for (int j = 0; j < 4; j++) linear.A[4 * (i + 2) + j] = d.J[i][j] - slaved * d.E[j];
    for (int j = 0; j < INPUTS; j++) linear.B[INPUTS * (i + 2) + j] = d.B[i][j];
  }
  return put_finite(out, &linear, sizeof linear);
}

// Lateral places and products of inertia are nothing but rounding.
static bool mirror_symmetric(const bike_model *m) {
  const double rounding = 1e-14; // some tens of roundings of the sums over parts
  const bike_body *lumps[] = {&m->rear, &m->front};
  for (int i = 0; i < 2; i++) {
    const double *c = lumps[i]->centre, *J = lumps[i]->inertia;
    if (fabs(c[0]) > rounding * (fabs(c[1]) + fabs(c[2]))) return false;
    if (fabs(J[3]) + fabs(J[4]) > rounding * (J[0] + J[1] + J[2])) return false;
  }
  return true;
}

// -d f/d x of the generalised forces (lean, steer) for x at column `which`, upright at a speed.
static void stiffness(double out[2], const kernel_model *m, double tilt, double speed, int which) {
  bike_state straight = {.speed = speed};
  bike_input hands_off = {0};
  perturbed at = perturbed_state(&straight, &hands_off, tilt);
  instant now;
  solve_perturbed(&now, m, at, which);
  out[0] = -derivative(now.k.f[1]);
  out[1] = -derivative(now.k.f[0]);
}

// Both columns of a matrix over q = (lean, steer).
static void matrix(double out[4], const kernel_model *m, double tilt, double speed,
                   const int which[2]) {
  for (int j = 0; j < 2; j++) {
    double column_j[2];
    stiffness(column_j, m, tilt, speed, which[j]);
    out[j] = column_j[0];
    out[2 + j] = column_j[1];
  }
}

int bike_linearize_upright(bike_upright_matrices *out, const bike_model *model) {
  if (!out || !model) return BIKE_ERROR_ARGUMENT;
  if (!mirror_symmetric(model)) return BIKE_ERROR_NOT_STATIONARY;
  bike_state standing = {0};
  double mass[9];
  int code = bike_mass_matrix(mass, model, &standing, 0);
  if (code) return code;

  const int angles[2] = {KAPPA, PHI}, speeds[2] = {KAPPA_RATE, PHI_RATE};
  bike_upright_matrices m = {.M = {mass[0], mass[1], mass[3], mass[4]}};
  // K0 without speed at unit gravity, C1 and K2 at unit speed without gravity: no differences
  kernel_model heavy, weightless;
  kernel_model_of(&heavy, model);
  kernel_model_of(&weightless, model);
  heavy.steer_damping = weightless.steer_damping = 0;
  heavy.gravity = 1;
  weightless.gravity = 0;
  matrix(m.K0, &heavy, model->tilt, 0, angles);
  matrix(m.K2, &weightless, model->tilt, 1, angles);
  matrix(m.C1, &weightless, model->tilt, 1, speeds);
  return put_finite(out, &m, sizeof m);
}
