// SPDX-License-Identifier: Apache-2.0
#include "modes.h"

#include "terminal/message.h"

#include <bicycle/error.h>
#include <complex.h>
#include <math.h>

term_exit modes_at(bike_eigenvalues *out, const engine *e, void *instance, double speed,
                   problem *p) {
  double A[16];
  term_exit code = e->linearize(A, instance, speed, p);
  if (code != TERM_DONE) return code;
  int error = bike_eigenvalues_of(out, A);
  return error == BIKE_OK ? TERM_DONE
                          : problem_set(p, term_exit_of(error), "%s", bike_error_string(error));
}

static double complex value_of(const bike_eigenvalues *e, int i) {
  return e->re[i] + I * e->im[i];
}

// The best over all matchings of a[first..3] with those of b that `used` leaves.
static double best_match(const bike_eigenvalues *a, const bike_eigenvalues *b, int first,
                         unsigned used) {
  double best = INFINITY;
  if (first == 4) return 0;
  for (int j = 0; j < 4; j++) {
    if (used >> j & 1) continue;
    double complex is = value_of(a, first);
    double error = cabs(value_of(b, j) - is) / fmax(1, cabs(is));
    double rest = best_match(a, b, first + 1, used | 1U << j);
    best = fmin(best, isnan(error) ? NAN : fmax(error, rest));
  }
  return best;
}

double modes_difference(const bike_eigenvalues *a, const bike_eigenvalues *b) {
  for (int i = 0; i < 4; i++)
    if (!isfinite(a->re[i] + a->im[i] + b->re[i] + b->im[i])) return NAN;
  return best_match(a, b, 0, 0);
}

// Zero where an eigenvalue is.
static double product(const bike_eigenvalues *e) {
  double complex p = 1;
  for (int i = 0; i < 4; i++) p *= value_of(e, i);
  return creal(p);
}

// Product of all sums of two (Orlando): zero where a pair is imaginary, or two reals are opposite.
static double product_of_sums(const bike_eigenvalues *e) {
  double complex p = 1;
  for (int i = 0; i < 4; i++)
    for (int j = i + 1; j < 4; j++) p *= value_of(e, i) + value_of(e, j);
  return creal(p);
}

// Of the two that are closest to being opposite: whether they oscillate.
static bool is_weave(const bike_eigenvalues *e) {
  double smallest = INFINITY;
  bool oscillates = false;
  for (int i = 0; i < 4; i++)
    for (int j = i + 1; j < 4; j++) {
      double sum = cabs(value_of(e, i) + value_of(e, j));
      if (sum >= smallest) continue;
      smallest = sum;
      oscillates = e->im[i] != 0;
    }
  return oscillates;
}

typedef double indicator(const bike_eigenvalues *modes);

// Regula falsi in Illinois' form between two speeds at which f has different signs.
static term_exit find_zero(double *zero, bike_eigenvalues *modes, indicator *f, const engine *e,
                           void *instance, const double speed[2], const double value[2],
                           problem *p) {
  double a = speed[0], b = speed[1], fa = value[0], fb = value[1];
  // Eigenvalues are known to some 1e-12: closer than that there is nothing to be found.
  for (int i = 0; i < 100 && fabs(b - a) > 1e-14 * b; i++) {
    double c = (a * fb - b * fa) / (fb - fa);
    term_exit code = modes_at(modes, e, instance, c, p);
    if (code != TERM_DONE) return code;
    double fc = f(modes);
    *zero = c;
    if (fc == 0) break;
    if ((fc > 0) != (fb > 0))
      a = b, fa = fb;
    else
      fa /= 2;
    if (fabs(c - b) <= 1e-14 * fabs(c)) break;
    b = c, fb = fc;
  }
  return TERM_DONE;
}

static void keep(double speeds[BIKE_MAX_CRITICAL], int *count, double speed) {
  if (*count < BIKE_MAX_CRITICAL) speeds[(*count)++] = speed;
}

term_exit modes_critical_speeds(bike_critical_speeds *out, const engine *e, void *instance,
                                const double *speed, const bike_eigenvalues *modes, int count,
                                problem *p) {
  static indicator *const indicators[2] = {product_of_sums, product};
  *out = (bike_critical_speeds){0};
  for (int k = 1; k < count; k++)
    for (int i = 0; i < 2; i++) {
      double value[2] = {indicators[i](&modes[k - 1]), indicators[i](&modes[k])};
      double zero = NAN;
      bike_eigenvalues there;
      if ((value[0] > 0) == (value[1] > 0)) continue;
      term_exit code =
          find_zero(&zero, &there, indicators[i], e, instance, &speed[k - 1], value, p);
      if (code != TERM_DONE) return code;
      if (i == 1)
        keep(out->capsize, &out->capsize_count, zero);
      else if (is_weave(&there))
        keep(out->weave, &out->weave_count, zero);
    }
  return TERM_DONE;
}
