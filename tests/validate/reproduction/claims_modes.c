// SPDX-License-Identifier: Apache-2.0
// Section 4: eigenvalues, the weave mode, and what becomes of it beyond the linear.
#include "shared.h"
#include <bicycle/cycle.h>
#include <bicycle/modes.h>
#include <math.h>

// Times of two rows of a ride, and the lean at them.
typedef struct pair {
  double time[2], lean[2];
} pair;

static int take_pair(const bike_sample *s, const bike_sample_more *more, void *user) {
  (void)more;
  pair *p = user;
  for (int i = 0; i < 2; i++)
    if (fabs(s->time - p->time[i]) < 1e-9) p->lean[i] = s->lean;
  return 0;
}

// Growth measured on a ride when the slowest mode is real and alone, against eps_max.
static void growth(figures *out) {
  bike_model model = shipped_model("roadster");
  const double speeds[2] = {6.8, 8};
  for (int i = 0; i < 2; i++) {
    bike_eigenvalues e;
    must(bike_upright_eigenvalues(&e, &model, speeds[i]), "eigenvalues");
    // Late enough for the other modes to have gone, early enough to be small.
    pair p = {.time = {15, 20}};
    bike_state start = {.lean = 1e-5, .speed = speeds[i]};
    ride_of(&model, &start, 20, 0.1, take_pair, &p);
    put(out, e.re[0]);
    put(out, log(p.lean[1] / p.lean[0]) / (p.time[1] - p.time[0]));
    if (i == 1) put(out, 1 / e.re[0]);
  }
}

static bike_modes modes_at(const bike_model *model, double speed) {
  bike_modes m;
  must(bike_upright_modes(&m, model, &speed, 1), "modes");
  return m;
}

static int unstable_count(const bike_modes *m) {
  int count = 0;
  for (int i = 0; i < 4; i++) count += m->values.re[i] > 0;
  return count;
}

static void above(figures *out) {
  bike_model model = shipped_model("roadster");
  bike_modes m = modes_at(&model, 8);
  put(out, unstable_count(&m));
  put(out, m.values.re[0]);
  put(out, m.values.im[0]);
  put(out, fabs(m.vectors_re[0][1] / m.vectors_re[0][0]));
}

static void below(figures *out) {
  bike_model model = shipped_model("roadster");
  bike_modes m = modes_at(&model, 4.5);
  put(out, unstable_count(&m));
  put(out, m.values.re[0]);
  put(out, fabs(m.values.im[0]));
}

static bike_weave_mode weave_at(const char *shipped, double speed) {
  bike_model model = shipped_model(shipped);
  bike_weave_mode mode;
  must(bike_weave_mode_at(&mode, &model, speed), "weave mode");
  return mode;
}

// Stable range's lower limit, middle and upper limit.
static void range_points(double out[3], const char *shipped) {
  bike_bicycle b = bicycle_of(shipped);
  limits l = limits_of(&b, 40);
  out[0] = l.low;
  out[1] = 0.5 * (l.low + l.high);
  out[2] = l.high;
}

static void amplitudes(figures *out) {
  static const char *const names[] = {"roadster", "benchmark"};
  for (int b = 0; b < 2; b++) {
    double speeds[3];
    range_points(speeds, names[b]);
    for (int i = 0; i < 3; i++) put(out, weave_at(names[b], speeds[i]).ratio);
  }
}

// The paper's phase shift: how far steer (left positive) is ahead of lean, in degrees; pi is to the
// same side, less is steer to that side later than lean.
static double phase_shift(const char *shipped, double speed) {
  return 360 - weave_at(shipped, speed).lag / DEGREE;
}

static void phase(figures *out) {
  static const char *const names[] = {"roadster", "benchmark"};
  for (int b = 0; b < 2; b++) {
    double speeds[3];
    range_points(speeds, names[b]);
    for (int i = 0; i < 3; i++) put(out, phase_shift(names[b], speeds[i]));
  }
}

static const double slower[] = {4.5, 4, 3.5, 3, 2.5, 2};

static void slow_amplitude(figures *out) {
  for (int i = 0; i < 6; i++) put(out, weave_at("roadster", slower[i]).ratio);
}

static void slow_phase(figures *out) {
  for (int i = 0; i < 6; i++) put(out, phase_shift("roadster", slower[i]));
}

static double weave_speed(const char *shipped) {
  bike_bicycle b = bicycle_of(shipped);
  return limits_of(&b, 40).weave;
}

// 1 for a supercritical bifurcation, and how the cycle's speed changes with lean.
static void hopf_of(figures *out, const char *shipped) {
  bike_model model = shipped_model(shipped);
  bike_hopf h;
  must(bike_hopf_at(&h, &model, weave_speed(shipped)), "Hopf bifurcation");
  put(out, h.supercritical);
  put(out, h.curvature);
}

static void hopf(figures *out) {
  static const char *const names[] = {"roadster",  "benchmark",        "penny_farthing",
                                      "recumbent", "recumbent_damped", "roadster_riderless"};
  for (int i = 0; i < 6; i++) hopf_of(out, names[i]);
}

// The roadster's cycle of some degrees.
static void finite_amplitude(figures *out) {
  bike_model model = shipped_model("roadster");
  double weave = weave_speed("roadster");
  bike_cycle c, next;
  must(bike_cycle_find(&c, &model, 1 * DEGREE, weave, NULL), "cycle");
  for (int lean = 2; lean <= 6; lean++) {
    must(bike_cycle_find(&next, &model, lean * DEGREE, weave, &c), "cycle");
    c = next;
  }
  put(out, c.lean / DEGREE);
  put(out, weave - c.speed);
  put(out, c.period);
  put(out, c.multiplier);
}

const claim claims_modes[] = {{"exponential", growth},
                              {"above", above},
                              {"below", below},
                              {"amplitudes", amplitudes},
                              {"phase", phase},
                              {"slow-amplitude", slow_amplitude},
                              {"slow-phase", slow_phase},
                              {"hopf", hopf},
                              {"finite-amplitude", finite_amplitude},
                              {0}};
