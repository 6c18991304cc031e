// SPDX-License-Identifier: Apache-2.0
#include "motion/turn_terms.h"

#include <bicycle/error.h>
#include <math.h>

// Radius of gyration about the hubs, and the lengths of the frame: no moment has a longer arm.
static double arm(const bike_model *model, double offset) {
  const bike_body *bodies[] = {&model->rear, &model->front};
  double inertia = 0;
  for (int i = 0; i < 2; i++) {
    const double *J = bodies[i]->inertia;
    inertia += J[0] + J[1] + J[2] + bodies[i]->spin_inertia;
  }
  return model->reach + sqrt(inertia / model->total_mass) + fabs(offset);
}

double turn_moments(const turn_bicycle *b, const turn_forces *at, double swept, double offset) {
  double sum = b->model->total_mass * b->model->gravity * arm(b->model, offset) + fabs(b->torque);
  for (int i = 0; i < TURN_ROWS; i++) sum += fabs(swept * at->sweep[i]) / b->per_inertia[i];
  return sum;
}

double turn_row_terms(const turn_bicycle *b, double moments) {
  return moments * fmax(b->per_inertia[TURN_LEAN_ROW], b->per_inertia[TURN_STEER_ROW]);
}

// One entry of the inverse of a symmetric matrix, by its cofactor.
static double inverse_entry(const double M[9], int i, int j, double determinant) {
  int a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
  return (M[3 * a + c] * M[3 * b + d] - M[3 * a + d] * M[3 * b + c]) / determinant;
}

int turn_acceleration_terms(bike_acceleration *out, const turn_bicycle *b, const bike_state *state,
                            double offset, double moments) {
  double M[9], determinant = 0, size[3];
  int code = bike_mass_matrix(M, b->model, state, offset);
  if (code) return code;
  for (int j = 0; j < 3; j++) determinant += M[j] * inverse_entry(M, 0, j, 1);
  const double forces[3] = {moments, moments, moments / b->model->reach};
  for (int i = 0; i < 3; i++) {
    size[i] = 0;
    for (int j = 0; j < 3; j++) size[i] += fabs(inverse_entry(M, i, j, determinant)) * forces[j];
  }
  *out = (bike_acceleration){size[0], size[1], size[2]};
  return BIKE_OK;
}
