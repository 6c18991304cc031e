// SPDX-License-Identifier: Apache-2.0
#include "oracle_gap.h"
#include "nine_equations.h"
#include "support/near.h"
#include <bicycle/error.h>
#include <stdio.h>

// A NaN must stay a NaN in the worst value, which fmax would drop.
static void worsen(double *worst, double error) {
  if (!(error <= *worst)) *worst = error;
}

static void worsen_relative(double *worst, double actual, real expected, double scale) {
  worsen(worst, fabs((double)(actual - expected)) / scale);
}

static void add_geometry(oracle_gap *gap, const bike_snapshot *is, const paper_motion *m) {
  const paper_pose *p = &m->pose;
  const struct {
    double actual;
    real expected;
  } rows[] = {
      {is->beta_r, p->beta_r.v},
      {is->beta_f, p->beta_f.v},
      {is->psi, p->psi.v},
      {is->phi_tilde, p->phi_tilde.v},
      {is->T_r, p->T_r.v},
      {is->T_f, p->T_f.v},
      {is->Z_0, p->Z_0.v},
      {is->pitch, m->tilt - p->beta_r.v},
      {is->pitch_rate, -p->beta_r.d},
      {is->yaw_rate, m->yaw_rate.v},
      {is->front_speed, m->front_speed.v},
      {is->rear_wheel_rate, m->rear_wheel.v},
      {is->front_wheel_rate, m->front_wheel.v},
  };
  for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
    worsen_relative(&gap->geometry, rows[i].actual, rows[i].expected,
                    fmax(1, fabs((double)rows[i].expected)));
}

static void add_accelerations(oracle_gap *gap, const bike_snapshot *is, const nine_solution *n) {
  const paper_acceleration *a = &n->acceleration;
  const paper_motion *m = &n->motion;
  double size = fmax(1, fmax((double)fabsl(a->phi), (double)fmaxl(fabsl(a->kappa), fabsl(a->v))));
  worsen_relative(&gap->acceleration, is->acceleration.steer, a->phi, size);
  worsen_relative(&gap->acceleration, is->acceleration.lean, a->kappa, size);
  worsen_relative(&gap->acceleration, is->acceleration.speed, a->v, size);
  const double turning[4] = {is->yaw_acceleration, is->pitch_acceleration,
                             is->rear_wheel_acceleration, is->front_wheel_acceleration};
  const real expected[4] = {m->yaw_rate.d, -m->pose.beta_r.dd, m->rear_wheel.d, m->front_wheel.d};
  for (int i = 0; i < 4; i++) {
    double own = fmax(size, fabs((double)expected[i]));
    worsen_relative(&gap->rotation, turning[i], expected[i], own);
  }
}

static void add_forces(oracle_gap *gap, const bike_snapshot *is, const nine_solution *n,
                       double weight) {
  double rear[3], front[3];
  nine_level(rear, &n->motion, n->F_r);
  nine_level(front, &n->motion, n->F_f);
  for (int i = 0; i < 3; i++) {
    worsen(&gap->force, fabs(is->rear_force[i] - rear[i]) / weight);
    worsen(&gap->force, fabs(is->front_force[i] - front[i]) / weight);
  }
}

// The power is the rate of the energy; cancellation in it is measured by its terms.
static void add_energies(oracle_gap *gap, const bike_snapshot *is, const paper_motion *m,
                         double gravity, double weight) {
  double kinetic = (double)paper_kinetic(m), scale = kinetic + weight;
  worsen(&gap->energy, fabs(is->kinetic - kinetic) / scale);
  worsen(&gap->energy, fabs(is->potential - (double)paper_potential(m, gravity)) / scale);
  real size = 0;
  for (const paper_part *q = m->part; q < m->part + m->part_count; q++)
    size += q->mass * vec_norm(q->velocity) * (vec_norm(q->acceleration) + gravity) +
            vec_norm(q->angular_velocity) * vec_norm(q->torque);
  worsen(&gap->power, (double)(fabsl(is->power - paper_energy_rate(m, gravity)) / size));
}

// The same accelerations through every door of the library.
static void check_doors(const bike_snapshot *is, const bike_model *model, const bike_state *state,
                        const bike_input *input) {
  bike_acceleration a;
  bike_rates r;
  assert_int_equal(bike_accelerate(&a, model, state, input), 0);
  assert_int_equal(bike_rates_of(&r, model, state, input), 0);
  const bike_acceleration *of = &is->acceleration;
  // The same arithmetic, contracted differently by the compiler: as close as to the oracle.
  double tolerance = 1e-11 * fmax(1, fmax(fabs(of->lean), fmax(fabs(of->steer), fabs(of->speed))));
  assert_near(a.lean, of->lean, tolerance);
  assert_near(a.steer, of->steer, tolerance);
  assert_near(a.speed, of->speed, tolerance);
  assert_near(r.acceleration.lean, of->lean, tolerance);
  assert_near(r.acceleration.steer, of->steer, tolerance);
  assert_near(r.acceleration.speed, of->speed, tolerance);
  assert_near(r.yaw, is->yaw_rate, 1e-12 * fmax(1, fabs(is->yaw_rate)));
  assert_near(r.rear_angle, is->rear_wheel_rate, 1e-12 * fmax(1, fabs(is->rear_wheel_rate)));
  assert_near(r.front_angle, is->front_wheel_rate, 1e-12 * fmax(1, fabs(is->front_wheel_rate)));
  assert_near(r.power, is->power, 1e-11 * fmax(model->total_mass * tolerance * 1e11, 1));
}

void oracle_gap_add(oracle_gap *gap, const bike_bicycle *bicycle, const bike_model *model,
                    const bike_state *state, const bike_input *input) {
  bike_snapshot is;
  nine_solution n;
  int error = bike_evaluate(&is, model, state, input);
  bool exists = nine_solve(&n, bicycle, state, input);
  if ((error == 0) != exists)
    fail_msg("lean %.17g steer %.17g: the library says %s, the oracle %s", state->lean,
             state->steer, bike_error_string(error), exists ? "has a solution" : "has none");
  if (error != 0) {
    gap->no_geometry++;
    return;
  }
  const double weight = model->total_mass * model->gravity;
  gap->states++;
  add_geometry(gap, &is, &n.motion);
  add_accelerations(gap, &is, &n);
  add_forces(gap, &is, &n, weight);
  add_energies(gap, &is, &n.motion, model->gravity, weight);
  check_doors(&is, model, state, input);
  paper_roots roots;
  paper_acceleration a = {is.acceleration.steer, is.acceleration.lean, is.acceleration.speed};
  assert_true(paper_roots_of(&roots, &bicycle->geometry, state));
  paper_motion at = paper_motion_of(bicycle, &roots, state, input, a);
  worsen(&gap->equation_23, (double)equation_23(bicycle, state, input, &at, -1));
}

void oracle_gap_judge(const oracle_gap *g, const char *name) {
  printf("%-19s %d states (%d more without geometry): acc %.1e geometry %.1e rotation %.1e "
         "force %.1e energy %.1e power %.1e (23) %.1e\n",
         name, g->states, g->no_geometry, g->acceleration, g->geometry, g->rotation, g->force,
         g->energy, g->power, g->equation_23);
  // What was set beforehand; round-off in double leaves at least a factor 10 to each.
  assert_below(g->acceleration, 1e-11);
  assert_below(g->geometry, 1e-12);
  assert_below(g->rotation, 1e-11);
  assert_below(g->force, 1e-9);
  assert_below(g->energy, 1e-12);
  assert_below(g->power, 1e-12);
  assert_below(g->equation_23, 1e-12);
}
