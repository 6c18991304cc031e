// SPDX-License-Identifier: Apache-2.0
#include "tensor.h"

#include <math.h>

// Of the lump's tensor: sums of a few dozen products lose less than 1e-14 of the largest, and no
// measured inertia is known to 1e-12.
static const double ROUNDING = 1e-12;

// Jacobi's method on 3x3 converges quadratically: five sweeps reach the last digit, this is ample.
enum { SWEEPS = 12 };

void bike_add_point(double tensor[6], double mass, const double arm[3]) {
  const double x = arm[0], y = arm[1], z = arm[2];
  tensor[0] += mass * (y * y + z * z);
  tensor[1] += mass * (x * x + z * z);
  tensor[2] += mass * (x * x + y * y);
  tensor[3] -= mass * x * y;
  tensor[4] -= mass * x * z;
  tensor[5] -= mass * y * z;
}

bike_lump bike_lump_parts(const bike_bicycle *bicycle, bike_assembly assembly) {
  bike_lump lump = {0};
  for (int i = 0; i < bicycle->part_count; ++i) {
    const bike_part *part = &bicycle->parts[i];
    if (part->assembly != assembly) continue;
    lump.mass += part->mass;
    for (int k = 0; k < 3; ++k) lump.centre[k] += part->mass * part->position[k];
  }
  if (!(lump.mass > 0)) return lump;
  for (int k = 0; k < 3; ++k) lump.centre[k] /= lump.mass;
  for (int i = 0; i < bicycle->part_count; ++i) {
    const bike_part *part = &bicycle->parts[i];
    if (part->assembly != assembly) continue;
    double arm[3];
    for (int k = 0; k < 3; ++k) arm[k] = part->position[k] - lump.centre[k];
    for (int k = 0; k < 6; ++k) lump.inertia[k] += part->inertia[k];
    bike_add_point(lump.inertia, part->mass, arm);
  }
  return lump;
}

// One Jacobi rotation: makes a[p][q] zero, keeps v's columns the eigenvectors.
static void rotate(double a[3][3], double v[3][3], int p, int q) {
  if (a[p][q] == 0) return;
  const double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
  const double t = copysign(1, theta) / (fabs(theta) + hypot(theta, 1));
  const double c = 1 / hypot(t, 1), s = t * c;
  for (int k = 0; k < 3; ++k) { // a R
    const double akp = a[k][p], akq = a[k][q], vkp = v[k][p], vkq = v[k][q];
    a[k][p] = c * akp - s * akq;
    a[k][q] = s * akp + c * akq;
    v[k][p] = c * vkp - s * vkq;
    v[k][q] = s * vkp + c * vkq;
  }
  for (int k = 0; k < 3; ++k) { // R' a R
    const double apk = a[p][k], aqk = a[q][k];
    a[p][k] = c * apk - s * aqk;
    a[q][k] = s * apk + c * aqk;
  }
}

bool bike_make_semidefinite(double tensor[6], double rounding) {
  const double *t = tensor;
  double a[3][3] = {{t[0], t[3], t[4]}, {t[3], t[1], t[5]}, {t[4], t[5], t[2]}};
  double v[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (int sweep = 0; sweep < SWEEPS; ++sweep) {
    rotate(a, v, 0, 1);
    rotate(a, v, 0, 2);
    rotate(a, v, 1, 2);
  }
  static const int row[6] = {0, 1, 2, 0, 0, 1}, column[6] = {0, 1, 2, 1, 2, 2};
  for (int i = 0; i < 3; ++i) {
    if (!(a[i][i] >= -rounding)) return false;
    if (a[i][i] > rounding) continue;
    // take a_ii v_i v_i' out
    for (int k = 0; k < 6; ++k) tensor[k] -= a[i][i] * v[row[k]][i] * v[column[k]][i];
  }
  bool zero = true;
  for (int i = 0; i < 3; ++i) zero = zero && a[i][i] <= rounding;
  for (int k = 0; zero && k < 6; ++k) tensor[k] = 0;
  return true;
}

bool bike_take_point(bike_lump *lump, double mass, const double position[3]) {
  const double left = lump->mass - mass;
  if (!(left > 0)) return false;
  double arm[3]; // from the rest's centre to the point
  for (int k = 0; k < 3; ++k) {
    const double centre = (lump->mass * lump->centre[k] - mass * position[k]) / left;
    arm[k] = position[k] - centre;
    lump->centre[k] = centre;
  }
  const double rounding = ROUNDING * (lump->inertia[0] + lump->inertia[1] + lump->inertia[2]);
  bike_add_point(lump->inertia, -mass * left / lump->mass, arm);
  lump->mass = left;
  return bike_make_semidefinite(lump->inertia, rounding);
}
