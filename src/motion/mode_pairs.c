// SPDX-License-Identifier: Apache-2.0
#include "motion/mode_pairs.h"

#include <bicycle/error.h>
#include <math.h>

enum { SIZE = 4 };

static double complex eigenvalue(const bike_eigenvalues *e, int k) {
  return e->re[k] + I * e->im[k];
}

mode_cluster mode_cluster_of(const bike_eigenvalues *e) {
  int first = 0, second = 1, other = 0;
  for (int i = 0; i < SIZE; i++) {
    for (int k = i + 1; k < SIZE; k++) {
      double closest = cabs(eigenvalue(e, first) - eigenvalue(e, second));
      if (!(cabs(eigenvalue(e, i) - eigenvalue(e, k)) < closest)) continue;
      first = i;
      second = k;
    }
  }
  mode_cluster out = {.centre = 0.5 * (eigenvalue(e, first) + eigenvalue(e, second))};
  for (int i = 0; i < SIZE; i++)
    if (i != first && i != second) out.others[other++] = eigenvalue(e, i);
  return out;
}

// Two oscillations, the upper ones of their pairs: the one that is followed, and the other.
typedef struct two_pairs {
  double complex at[2];
} two_pairs;

// In falling order. Beside a collision, where a pair may come out as two real eigenvalues, that is
// still one.
static int pairs_at(two_pairs *out, const bike_model *model, double speed) {
  bike_eigenvalues e;
  int code = bike_upright_eigenvalues(&e, model, speed), count = 0;
  if (code) return code;
  for (int k = 0; k < SIZE; k++)
    if (e.im[k] > 0 && count < 2) out->at[count++] = eigenvalue(&e, k);
  if (count == 2) return BIKE_OK;
  mode_cluster c = mode_cluster_of(&e);
  *out = (two_pairs){{c.centre, c.others[0]}};
  return BIKE_OK;
}

static two_pairs swapped(two_pairs p) {
  return (two_pairs){{p.at[1], p.at[0]}};
}

static double distance(two_pairs a, two_pairs b) {
  return fmax(cabs(a.at[0] - b.at[0]), cabs(a.at[1] - b.at[1]));
}

static double apart(two_pairs p) {
  return cabs(p.at[0] - p.at[1]);
}

// Whether the step from one speed to the next is short enough: both move by much less than they are
// apart.
static bool is_short(two_pairs from, two_pairs to) {
  const double share = 0.25;
  return distance(from, to) <= share * fmin(apart(from), apart(to));
}

int mode_pair_follow(double complex *out, const bike_model *model, double entry, double speed) {
  const int most = 2000; // steps; some ten are usual, each pass of one pair by the other takes more
  bike_eigenvalues e;
  int code = bike_upright_eigenvalues(&e, model, entry);
  if (code) return code;
  mode_cluster c = mode_cluster_of(&e);
  two_pairs now = {{c.centre, c.others[0]}};
  double at = entry, step = speed - entry;
  for (int i = 0; i < most && at != speed; i++) {
    double next = fabs(speed - at) <= fabs(step) ? speed : at + step;
    two_pairs found;
    code = pairs_at(&found, model, next);
    if (code) return code;
    if (distance(swapped(found), now) < distance(found, now)) found = swapped(found);
    bool made = is_short(now, found);
    step *= made ? 2 : 0.5;
    if (!made) continue;
    now = found;
    at = next;
  }
  *out = now.at[0];
  return at == speed ? BIKE_OK : BIKE_ERROR_NO_CONVERGENCE;
}
