// SPDX-License-Identifier: Apache-2.0
#include <bicycle/error.h>
#include <bicycle/modes.h>
#include <complex.h>
#include <lapacke.h>
#include <math.h>
#include <stdlib.h>

enum { STEER, LEAN, SIZE = 4 };

const char *bike_mode_string(bike_mode mode) {
  static const char *const names[] = {"unnamed", "weave", "capsize", "castering",
                                      "capsize and castering"};
  return (unsigned)mode < sizeof names / sizeof names[0] ? names[mode] : "unnamed";
}

// One mode while it is put in order.
typedef struct single {
  double re, im;
  double complex vector[SIZE];
} single;

static int falling(const void *a, const void *b) {
  const single *x = a, *y = b;
  if (x->re != y->re) return x->re < y->re ? 1 : -1;
  return (x->im < y->im) - (x->im > y->im);
}

// Column `mode` of dgeev's vectors: conjugate pairs share two columns, real and imaginary parts.
static void unpack(single *out, const double *V, const double *im, int mode) {
  int first = im[mode] < 0 ? mode - 1 : mode;
  for (int i = 0; i < SIZE; i++) {
    double complex v = V[SIZE * i + first];
    if (im[mode] != 0) v += copysign(1, im[mode]) * I * V[SIZE * i + first + 1];
    out->vector[i] = v;
  }
}

// Unit length, and the larger of steer and lean real and positive.
static void normalise(single *s) {
  double square = 0;
  for (int i = 0; i < SIZE; i++) square += creal(s->vector[i] * conj(s->vector[i]));
  double complex lead =
      cabs(s->vector[STEER]) > cabs(s->vector[LEAN]) ? s->vector[STEER] : s->vector[LEAN];
  double complex factor = cabs(lead) > 0 ? conj(lead) / cabs(lead) : 1;
  for (int i = 0; i < SIZE; i++) s->vector[i] *= factor / sqrt(square);
}

static double share_of_steer(const bike_modes *m, int mode) {
  const double *re = m->vectors_re[mode], *im = m->vectors_im[mode];
  double steer = hypot(re[STEER], im[STEER]), lean = hypot(re[LEAN], im[LEAN]);
  return steer / (steer + lean);
}

// One oscillation and two real modes name themselves.
static bool name_by_vectors(bike_modes *m) {
  int real[SIZE], count = 0;
  for (int i = 0; i < SIZE; i++)
    if (m->values.im[i] == 0) real[count++] = i;
  if (count != 2) return false;
  for (int i = 0; i < SIZE; i++) m->mode[i] = BIKE_MODE_WEAVE;
  bool first = share_of_steer(m, real[0]) > share_of_steer(m, real[1]);
  m->mode[real[first ? 0 : 1]] = BIKE_MODE_CASTERING;
  m->mode[real[first ? 1 : 0]] = BIKE_MODE_CAPSIZE;
  return true;
}

int bike_modes_of(bike_modes *out, const double A[16]) {
  if (!out || !A) return BIKE_ERROR_ARGUMENT;
  double copy[SIZE * SIZE], re[SIZE], im[SIZE], V[SIZE * SIZE];
  for (int i = 0; i < SIZE * SIZE; i++)
    if (!isfinite(copy[i] = A[i])) return BIKE_ERROR_NOT_FINITE;
  if (LAPACKE_dgeev(LAPACK_ROW_MAJOR, 'N', 'V', SIZE, copy, SIZE, re, im, NULL, 1, V, SIZE))
    return BIKE_ERROR_NO_CONVERGENCE;
  single modes[SIZE];
  for (int k = 0; k < SIZE; k++) {
    modes[k].re = re[k];
    modes[k].im = im[k];
    unpack(&modes[k], V, im, k);
    normalise(&modes[k]);
  }
  qsort(modes, SIZE, sizeof modes[0], falling);
  bike_modes m = {0};
  for (int k = 0; k < SIZE; k++) {
    m.values.re[k] = modes[k].re;
    m.values.im[k] = modes[k].im;
    for (int i = 0; i < SIZE; i++) {
      m.vectors_re[k][i] = creal(modes[k].vector[i]);
      m.vectors_im[k][i] = cimag(modes[k].vector[i]);
    }
  }
  name_by_vectors(&m);
  *out = m;
  return BIKE_OK;
}

// How far two modes are from being one: 0 the same, of the order of one for strangers.
static double strangeness(const bike_modes *a, int i, const bike_modes *b, int k) {
  double complex product = 0;
  for (int n = 0; n < SIZE; n++)
    product += (a->vectors_re[i][n] - I * a->vectors_im[i][n]) *
               (b->vectors_re[k][n] + I * b->vectors_im[k][n]);
  double complex x = a->values.re[i] + I * a->values.im[i];
  double complex y = b->values.re[k] + I * b->values.im[k];
  double size = cabs(x) + cabs(y) + 1; // 1/s: slower modes are told apart by their vectors
  return 1 - creal(product * conj(product)) + cabs(x - y) / size;
}

// The assignment with the least strangeness in all; returns that of its worst pair.
static double recognise(int of[SIZE], const bike_modes *a, const bike_modes *b) {
  double least = INFINITY, worst = INFINITY;
  for (int code = 0; code < 256; code++) { // all maps of four to four, as digits of base four
    int map[SIZE] = {code & 3, code >> 2 & 3, code >> 4 & 3, code >> 6 & 3};
    unsigned used = 0;
    for (int i = 0; i < SIZE; i++) used |= 1u << map[i];
    if (used != 15) continue;
    double sum = 0, most = 0;
    for (int i = 0; i < SIZE; i++) {
      double s = strangeness(a, i, b, map[i]);
      sum += s;
      most = fmax(most, s);
    }
    if (!(sum < least)) continue;
    least = sum;
    worst = most;
    for (int i = 0; i < SIZE; i++) of[i] = map[i];
  }
  return worst;
}

typedef struct mode_path {
  bike_matrix_function *function;
  void *user;
} mode_path;

static int modes_at(bike_modes *out, const mode_path *path, double parameter) {
  double A[SIZE * SIZE];
  int code = path->function(A, parameter, path->user);
  return code ? code : bike_modes_of(out, A);
}

static bool oscillates(const bike_modes *m, int mode) {
  return m->values.im[mode] != 0;
}

// Where capsize and castering join into an oscillation neither can be told; where they part again
// the larger share of steer is castering.
static void settle(bike_modes *m) {
  int of_two[SIZE], count = 0;
  for (int i = 0; i < SIZE; i++)
    if (m->mode[i] != BIKE_MODE_WEAVE) of_two[count++] = i;
  if (count != 2) return;
  bool joined = oscillates(m, of_two[0]) && oscillates(m, of_two[1]);
  bool parted = m->mode[of_two[0]] == BIKE_MODE_JOINED || m->mode[of_two[1]] == BIKE_MODE_JOINED;
  if (joined) {
    m->mode[of_two[0]] = m->mode[of_two[1]] = BIKE_MODE_JOINED;
  } else if (parted) {
    bool first = share_of_steer(m, of_two[0]) > share_of_steer(m, of_two[1]);
    m->mode[of_two[0]] = first ? BIKE_MODE_CASTERING : BIKE_MODE_CAPSIZE;
    m->mode[of_two[1]] = first ? BIKE_MODE_CAPSIZE : BIKE_MODE_CASTERING;
  }
}

// Gives b the names of a, halving the interval until each mode is recognised.
static int pass_on(bike_modes *b, double to, const bike_modes *a, double from,
                   const mode_path *path, int halvings) {
  const double familiar = 0.1; // a tenth of a stranger: nothing else comes as near
  int of[SIZE];
  if (recognise(of, a, b) > familiar && halvings > 0) {
    double half = 0.5 * (from + to);
    bike_modes middle;
    int code = modes_at(&middle, path, half);
    if (!code) code = pass_on(&middle, half, a, from, path, halvings - 1);
    return code ? code : pass_on(b, to, &middle, half, path, halvings - 1);
  }
  for (int i = 0; i < SIZE; i++) b->mode[of[i]] = a->mode[i];
  settle(b);
  return BIKE_OK;
}

// The place with the fastest oscillation among those that name themselves; -1: there is none.
static int clearest(const bike_modes *modes, int count) {
  int best = -1;
  double fastest = 0;
  for (int i = 0; i < count; i++) {
    if (modes[i].mode[0] == BIKE_MODE_UNNAMED) continue;
    for (int k = 0; k < SIZE; k++) {
      if (!(modes[i].values.im[k] > fastest)) continue;
      fastest = modes[i].values.im[k];
      best = i;
    }
  }
  return best;
}

// Names from the place `start` on, one way along the list.
static int spread(bike_modes *out, const double *parameters, int count, int start, int step,
                  const mode_path *path) {
  const int halvings = 12; // of an interval of the list; at a collision, where vectors change like
                           // a root, a fraction of 1/4000 is told by the other modes
  for (int i = start; i + step >= 0 && i + step < count; i += step) {
    int k = i + step;
    int code = pass_on(&out[k], parameters[k], &out[i], parameters[i], path, halvings);
    if (code) return code;
  }
  return BIKE_OK;
}

static bool monotone(const double *x, int count) {
  for (int i = 2; i < count; i++)
    if (!((x[i] > x[i - 1]) == (x[1] > x[0]))) return false;
  return true;
}

int bike_modes_follow(bike_modes *out, const double *parameters, int count,
                      bike_matrix_function *function, void *user) {
  if (!out || !parameters || !function || count < 1 || !monotone(parameters, count))
    return BIKE_ERROR_ARGUMENT;
  const mode_path path = {function, user};
  int code = BIKE_OK;
  for (int i = 0; i < count && !code; i++) code = modes_at(&out[i], &path, parameters[i]);
  if (code) return code;
  int start = clearest(out, count);
  if (start < 0) return BIKE_OK;
  code = spread(out, parameters, count, start, 1, &path);
  return code ? code : spread(out, parameters, count, start, -1, &path);
}

static int upright_matrix(double A[16], double speed, void *user) {
  const bike_model *model = user;
  bike_state straight = {.speed = speed};
  bike_linear linear;
  int code = bike_linearize(&linear, model, &straight, NULL);
  for (int i = 0; i < 16 && !code; i++) A[i] = linear.A[i];
  return code;
}

int bike_upright_modes(bike_modes *out, const bike_model *model, const double *speeds, int count) {
  if (!model) return BIKE_ERROR_ARGUMENT;
  bike_model copy = *model; // the path's user is not const
  return bike_modes_follow(out, speeds, count, upright_matrix, &copy);
}
