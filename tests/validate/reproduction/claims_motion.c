// SPDX-License-Identifier: Apache-2.0
// Sections 1 and 4: degrees of freedom, momentum, energy, and how far the solution reaches.
#include "shared.h"
#include <bicycle/basin.h>
#include <bicycle/cycle.h>
#include <bicycle/state.h>
#include <math.h>
#include <stddef.h>
#include <string.h>

enum { COORDINATES = 7, VELOCITIES = 3, MAX_FIELDS = 32 };

// x, y, yaw, lean, steer and the angles of the wheels.
typedef struct field {
  double rate[COORDINATES];
} field;

// Rates of the seven coordinates when one velocity (lean rate, steer rate, speed) is 1, as the
// rolling wheels allow.
static field rolling(const bike_model *model, const double q[COORDINATES], int velocity) {
  bike_snapshot s;
  bike_state state = {.lean = q[3],
                      .steer = q[4],
                      .lean_rate = velocity == 0,
                      .steer_rate = velocity == 1,
                      .speed = velocity == 2};
  must(bike_evaluate(&s, model, &state, NULL), "rolling");
  return (field){{state.speed * cos(q[2]), state.speed * sin(q[2]), s.yaw_rate, state.lean_rate,
                  state.steer_rate, s.rear_wheel_rate, s.front_wheel_rate}};
}

// A vector field on the configurations: a rolling motion, or the bracket [a, b] of two fields.
typedef struct bracket {
  int velocity; // of a rolling motion; -1: a bracket
  const struct bracket *a, *b;
} bracket;

static field field_of(const bike_model *model, const double q[COORDINATES], const bracket *f);

// Derivative of `f` along `way`, by a central difference of order 4. Nested twice its rounding
// comes to some 1e-9, far below the threshold of `dimension`.
static field along(const bike_model *model, const double q[COORDINATES], const bracket *f,
                   const field *way) {
  const double h = 0.01, weight[4] = {1.0 / 12, -8.0 / 12, 8.0 / 12, -1.0 / 12};
  const int step[4] = {-2, -1, 1, 2};
  field sum = {{0}};
  for (int k = 0; k < 4; k++) {
    double at[COORDINATES];
    for (int i = 0; i < COORDINATES; i++) at[i] = q[i] + step[k] * h * way->rate[i];
    field here = field_of(model, at, f);
    for (int i = 0; i < COORDINATES; i++) sum.rate[i] += weight[k] / h * here.rate[i];
  }
  return sum;
}

static field field_of(const bike_model *model, const double q[COORDINATES], const bracket *f) {
  if (f->velocity >= 0) return rolling(model, q, f->velocity);
  field a = field_of(model, q, f->a), b = field_of(model, q, f->b);
  field along_a = along(model, q, f->b, &a), along_b = along(model, q, f->a, &b);
  for (int i = 0; i < COORDINATES; i++) along_a.rate[i] -= along_b.rate[i];
  return along_a;
}

// Pivots are of order 0.01 and more, or rounding.
static int dimension(const field *fields, int count) {
  return rank_of(fields[0].rate, count, COORDINATES, 1e-4);
}

// Velocities that the wheels allow, constraints on the seven rates, and the dimension reached by
// brackets of the allowed motions (Chow's theorem): 7 if no constraint can be integrated.
static void coordinates(figures *out) {
  bike_model model = shipped_model("roadster");
  const double q[COORDINATES] = {0.3, -0.2, 0.5, 0.2, -0.3, 0.1, 0.4};
  const bracket roll[VELOCITIES] = {{0, NULL, NULL}, {1, NULL, NULL}, {2, NULL, NULL}};
  const bracket first[3] = {
      {-1, &roll[0], &roll[1]}, {-1, &roll[0], &roll[2]}, {-1, &roll[1], &roll[2]}};
  field fields[MAX_FIELDS];
  int count = 0;
  for (int i = 0; i < VELOCITIES; i++) fields[count++] = field_of(&model, q, &roll[i]);
  int velocities = dimension(fields, count);
  for (int i = 0; i < 3; i++) fields[count++] = field_of(&model, q, &first[i]);
  for (int i = 0; i < VELOCITIES; i++)
    for (int k = 0; k < 3; k++) {
      const bracket second = {-1, &roll[i], &first[k]};
      fields[count++] = field_of(&model, q, &second);
    }
  put(out, velocities);
  put(out, COORDINATES - velocities);
  put(out, dimension(fields, count));
}

// Impulse of the ground on a ride, by the trapezoidal rule.
typedef struct impulse {
  double last[2], sum[2], time;
  double energy, drift; // first energy, largest |E - E0|/E0 per second of its time
} impulse;

static int add_impulse(const bike_sample *s, const bike_sample_more *more, void *user) {
  impulse *p = user;
  double c = cos(s->yaw), n = sin(s->yaw);
  double forward = more->rear_force[0] + more->front_force[0];
  double left = more->rear_force[1] + more->front_force[1];
  const double force[2] = {forward * c - left * n, forward * n + left * c};
  for (int i = 0; i < 2 && s->time > 0; i++)
    p->sum[i] += 0.5 * (force[i] + p->last[i]) * (s->time - p->time);
  memcpy(p->last, force, sizeof force);
  p->time = s->time;
  if (s->time <= 0) p->energy = s->energy;
  // The first second counts as a whole one: a rate over a shorter time is noise.
  p->drift = fmax(p->drift, fabs(s->energy - p->energy) / p->energy / fmax(1, s->time));
  return 0;
}

static void momentum(figures *out) {
  bike_model model = shipped_model("roadster");
  bike_state start = {.lean = 5 * DEGREE, .speed = 5.5};
  impulse p = {0};
  bike_ride_result r = ride_of(&model, &start, 10, 0.01, add_impulse, &p);
  put(out, hypot(p.sum[0], p.sum[1]) / (model.total_mass * start.speed));
  put(out, r.end.yaw / DEGREE);
  put(out, p.drift);
}

// The speed that a ride has reached, from its other variables and the energy alone.
static void speed_from_energy(figures *out) {
  bike_model model = shipped_model("roadster");
  bike_state start = {.lean = 10 * DEGREE};
  must(bike_speed_of_equal_energy(&start.speed, &model, &start, 5.5), "equal energy");
  bike_sample end;
  ride_of(&model, &start, 2, 0.1, keep_sample, &end);
  bike_state at = {.lean = end.lean,
                   .steer = end.steer,
                   .lean_rate = end.lean_rate,
                   .steer_rate = end.steer_rate};
  must(bike_speed_of_equal_energy(&at.speed, &model, &at, 5.5), "equal energy");
  put(out, end.speed - start.speed);
  put(out, at.speed - end.speed);
}

static double drift_of(const bike_model *model, const bike_state *start, bike_method method,
                       double step) {
  impulse p = {0};
  bike_ride_result result;
  bike_ride_def def = bike_default_ride_def();
  def.start = *start;
  def.duration = 5;
  def.sample = 0.01;
  def.step = step;
  def.method = method;
  def.on_sample = add_impulse;
  def.user = &p;
  must(bike_ride(&result, model, &def), "ride");
  return p.drift;
}

static void energy(figures *out) {
  bike_model model = shipped_model("roadster");
  bike_state calm = {.lean = 5 * DEGREE, .speed = 5.5};
  bike_state wild = {.lean = 20 * DEGREE, .steer = -17 * DEGREE, .speed = 5.5};
  put(out, drift_of(&model, &calm, BIKE_METHOD_RK4, 0.01));
  put(out, drift_of(&model, &wild, BIKE_METHOD_RK4, 0.01));
  put(out, drift_of(&model, &wild, BIKE_METHOD_RK4, 0.001));
  put(out, drift_of(&model, &wild, BIKE_METHOD_RK8, 0.001));
}

// Shares of the states |lean| < 45 deg, |steer| < 60 deg with accelerations, in percent.
static void finite_angles(figures *out) {
  static const char *const names[] = {"roadster", "benchmark", "recumbent", "penny_farthing"};
  for (int b = 0; b < 4; b++) {
    bike_model model = shipped_model(names[b]);
    int solved = 0, all = 0;
    for (int lean = -44; lean <= 44; lean += 2)
      for (int steer = -60; steer <= 60; steer += 3, all++) {
        bike_acceleration a;
        bike_state s = {lean * DEGREE, steer * DEGREE, 0.5, -0.5, 5};
        solved += bike_accelerate(&a, &model, &s, NULL) == 0;
      }
    put(out, 100.0 * solved / all);
  }
}

static void basin(figures *out) {
  enum { SIDE = 9 };
  bike_model model = shipped_model("roadster");
  double leans[SIDE], steers[SIDE];
  for (int i = 0; i < SIDE; i++) leans[i] = steers[i] = (i - SIDE / 2) * 7.5 * DEGREE;
  bike_basin_def def = bike_default_basin_def();
  def.speed = 5.5;
  def.leans = leans;
  def.steers = steers;
  def.lean_count = def.steer_count = SIDE;
  bike_fate fates[SIDE * SIDE];
  must(bike_basin(fates, &model, &def), "basin");
  int straight = 0;
  for (int i = 0; i < SIDE * SIDE; i++) straight += fates[i] == BIKE_FATE_STRAIGHT;
  put(out, 100.0 * straight / (SIDE * SIDE));
  int lean = 0;
  bike_fate fate = BIKE_FATE_STRAIGHT;
  while (fate == BIKE_FATE_STRAIGHT && lean < 60)
    must(bike_fate_of(&fate, NULL, &model, &def, ++lean * DEGREE, 0), "fate");
  put(out, lean - 1);
}

// Volume in (phi, kappa, phi', kappa') shrinks at the rate of the trace, although energy is kept.
static void not_hamiltonian(figures *out) {
  bike_model model = shipped_model("roadster");
  bike_eigenvalues e;
  must(bike_upright_eigenvalues(&e, &model, 5.5), "eigenvalues");
  put(out, e.re[0] + e.re[1] + e.re[2] + e.re[3]);
}

const claim claims_motion[] = {{"coordinates", coordinates},
                               {"momentum", momentum},
                               {"finite-angles", finite_angles},
                               {"energy", energy},
                               {"speed-from-energy", speed_from_energy},
                               {"basin", basin},
                               {"not-hamiltonian", not_hamiltonian},
                               {0}};
