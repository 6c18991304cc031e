// SPDX-License-Identifier: Apache-2.0
// Faults chosen by seed in kind, size and place, one at a time: the first failing layer and its
// cause must name them. A comparator that has never failed on purpose is not tested.
#include "support/near.h"
#include "support/random.h"
#include "validate_support.h"

#include <engine_mujoco.h>
#include <layer.h>
#include <runner_internal.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

// A ride of half a second, judged by every layer that can be.
static const char scenario_text[] =
    "title: seeded\n"
    "bicycle: benchmark\n"
    "start: {speed: 4.6, lean_rate: 0.5}\n"
    "duration: %s\n"
    "sample: 0.01\n"
    "instants: {count: 20, seed: 7}\n"
    "reference: {engine: analytic}\n"
    "candidate: {engine: mujoco}\n"
    "convergence: {timesteps: [1e-2, 5e-3, 2.5e-3, 1.25e-3], tolerance: 1e-11}\n"
    "gates:\n"
    "  - {layer: Lp, metric: relative, limit: 1e-12, reason: test}\n"
    "  - {layer: L0, metric: relative, limit: 1e-9, reason: test}\n"
    "  - {layer: L2, metric: max, signals: [lean, steer], limit: 1e-11, reason: test}\n"
    "  - {layer: L3, metric: balance_max, signals: [energy], limit: 1e-11, reason: test}\n"
    "  - {layer: L4, metric: order_error, limit: 0.2, reason: test}\n"
    "  - {layer: L4, metric: plateau, limit: 1e-11, reason: test}\n";

static const char *const bodies[4] = {"rear_frame", "rear_wheel", "front_frame", "front_wheel"};
static const char *const body_words[4] = {"rear frame", "rear wheel", "front frame", "front wheel"};

// The fault at work, for the functions of a wrong engine.
static struct {
  double size, time;
  int integrator;
} fault;

static int pick(random_source *seed, int count) {
  return (int)(random_between(seed, 0, 1) * count) % count;
}

// 10^-from .. 10^-to, of either sign.
static double pick_size(random_source *seed, double from, double to) {
  double size = pow(10, -random_between(seed, from, to));
  return pick(seed, 2) ? size : -size;
}

static support_run *open_run(const engine *wrong, const char *duration) {
  char text[2000];
  snprintf(text, sizeof text, scenario_text, duration);
  return support_open(wrong, text);
}

static mjModel *model_of(support_run *f) {
  return runner_model(engine_mujoco_runner(f->comparison.side[CANDIDATE].instance));
}

static int body_of(const mjModel *m, int index) {
  return mj_name2id(m, mjOBJ_BODY, bodies[index]);
}

// A wheel of a wrong size may not even roll: the run is invalid then, and still its size is why.
static void expect(support_run *f, const char *layer_name, const char *named, const char *also) {
  comparison *c = support_play(f);
  assert_int_not_equal(c->verdict, VERDICT_AGREE);
  assert_non_null(c->first_failure);
  assert_string_equal(c->first_failure->name, layer_name);
  if (!strstr(c->cause, named) || !strstr(c->cause, also))
    fail_msg("'%s' does not say '%s' and '%s'", c->cause, named, also);
  assert_null(strchr(f->comparison.cause, '\n'));
  support_close(f);
}

static void expect_invalid(support_run *f, const char *layer_name, const char *named) {
  comparison *c = support_play(f);
  assert_int_equal(c->verdict, VERDICT_INVALID);
  assert_string_equal(c->first_failure->name, layer_name);
  if (!strstr(c->cause, named)) fail_msg("'%s' does not say %s", c->cause, named);
  support_close(f);
}

//---------------------------------- wrong parameters ----------------------------------------------

static void wrong_mass(random_source *seed) {
  support_run *f = open_run(NULL, "0.5");
  int body = pick(seed, 4);
  model_of(f)->body_mass[body_of(model_of(f), body)] *= 1 + pick_size(seed, 2, 8);
  expect(f, "Lp", body_words[body], "mass differs");
}

static void wrong_centre(random_source *seed) {
  support_run *f = open_run(NULL, "0.5");
  int body = 2 * pick(seed, 2), axis = pick(seed, 3);
  static const char *const axes[3] = {"x differs", "y differs", "z differs"};
  model_of(f)->body_ipos[3 * body_of(model_of(f), body) + axis] += pick_size(seed, 2, 9);
  expect(f, "Lp", body_words[body], axes[axis]);
}

// A tensor mirrored forward and back: Ixz changes its sign, the principal moments stay.
static void wrong_sign(random_source *seed) {
  support_run *f = open_run(NULL, "0.5");
  mjModel *m = model_of(f);
  int body = 2 * pick(seed, 2), id = body_of(m, body);
  double before[6], after[6];
  mjcf_body_inertia(before, m, id);
  m->body_iquat[4 * id + 2] *= -1;
  m->body_iquat[4 * id + 3] *= -1;
  mjcf_body_inertia(after, m, id);
  assert_near(after[4], -before[4], 1e-12);
  char says[80];
  snprintf(says, sizeof says, "%s Ixz differs: %.3g", body_words[body], after[4]);
  expect(f, "Lp", says, "against");
}

static void wrong_trail(random_source *seed) {
  support_run *f = open_run(NULL, "0.5");
  mjModel *m = model_of(f);
  m->body_pos[3 * body_of(m, BIKE_FRONT_WHEEL)] += pick_size(seed, 2, 8);
  expect(f, "Lp", "trail", "wheelbase");
}

static void wrong_radius(random_source *seed) {
  support_run *f = open_run(NULL, "0.5");
  mjModel *m = model_of(f);
  int wheel = pick(seed, 2), tuple = mj_name2id(m, mjOBJ_TUPLE, "rolling_discs");
  m->tuple_objprm[m->tuple_adr[tuple] + wheel] *= 1 + pick_size(seed, 2, 8);
  expect(f, "Lp", wheel ? "front radius" : "rear radius", "differ");
}

//---------------------------------- wrong constraint ----------------------------------------------

// J v at a position, J being that of the two contact points there.
static void contact_velocity(double out[6], double J[6 * 9], const runner *r, mjData *d) {
  const mjModel *m = r->model;
  mj_kinematics(m, d);
  mj_comPos(m, d);
  mj_comVel(m, d);
  for (int i = 0; i < 2; i++) {
    runner_disc disc;
    runner_find_disc(&disc, r, d, i);
    mj_jac(m, d, J + 27 * i, NULL, disc.point, r->map.wheel[i].body);
  }
  mju_mulMatVec(out, J, d->qvel, 6, 9);
}

// What the accelerations lack if J' v is forgotten: M^-1 J^T (J M^-1 J^T)^-1 J' v, J' v by
// differences along the motion.
static void find_drift(double out[9], const runner *r) {
  const mjModel *m = r->model;
  mjData *d = mj_makeData(m);
  double J[6 * 9], MJ[6 * 9], A[36], back[6], forth[6], rate[6], multiplier[6];
  static const double h = 1e-5; // s
  mju_copy(d->qvel, r->probe->qvel, 9);
  for (int k = 0; k < 9; k++) d->qpos[k] = r->probe->qpos[k] - h * d->qvel[k];
  contact_velocity(back, J, r, d);
  for (int k = 0; k < 9; k++) d->qpos[k] = r->probe->qpos[k] + h * d->qvel[k];
  contact_velocity(forth, J, r, d);
  for (int k = 0; k < 6; k++) rate[k] = (forth[k] - back[k]) / (2 * h);
  mju_copy(d->qpos, r->probe->qpos, 9);
  contact_velocity(back, J, r, d);
  mj_solveM(m, r->probe, MJ, J, 6);
  mju_mulMatMatT(A, J, MJ, 6, 9, 6);
  assert_int_equal(mju_cholFactor(A, 6, mjMINVAL), 6);
  mju_cholSolve(multiplier, A, rate, 6);
  mju_mulMatTVec(out, MJ, multiplier, 6, 9);
  mj_deleteData(d);
}

static term_exit evaluate_without_drift(engine_instant *out, void *instance,
                                        const bike_state *state, problem *p) {
  term_exit code = engine_mujoco.evaluate(out, instance, state, p);
  if (code != TERM_DONE) return code;
  const runner *r = engine_mujoco_runner(instance);
  double lacking[9];
  find_drift(lacking, r);
  int root = r->map.root_dof;
  out->yaw_acceleration += lacking[root + 3];
  out->lean_acceleration += lacking[root + 4];
  out->pitch_acceleration += lacking[root + 5];
  out->steer_acceleration += lacking[r->map.steer.dof];
  for (int i = 0; i < 2; i++) out->wheel_acceleration[i] += lacking[r->map.wheel[i].hinge.dof];
  return code;
}

static void missing_drift(random_source *seed) {
  (void)seed;
  engine wrong = engine_mujoco;
  wrong.evaluate = evaluate_without_drift;
  expect(open_run(&wrong, "0.5"), "L0", "velocities of rolling agree, energies agree",
         "accelerations differ");
}

static void *create_on_contacts(const bike_bicycle *bicycle, const engine_choice *choice,
                                term_exit *code, problem *p) {
  engine_choice other = *choice;
  other.option[engine_option_index(&engine_mujoco, "rolling")] = 1;
  other.option[engine_option_index(&engine_mujoco, "solref")] = fault.size;
  return engine_mujoco.create(bicycle, &other, code, p);
}

static void soft_contact(random_source *seed) {
  engine wrong = engine_mujoco;
  wrong.create = create_on_contacts;
  fault.size = fabs(pick_size(seed, 1.7, 2.5));
  expect(open_run(&wrong, "0.5"), "L0", "the parameters agree, but", "accelerations differ");
}

//---------------------------------- wrong rides ---------------------------------------------------

static void steal(const mjModel *m, mjData *d) {
  (void)m;
  (void)d;
}

static bool steal_at(double share, void *user) {
  (void)user;
  if (share >= fault.time) mjcb_control = steal;
  return true;
}

static term_exit ride_and_be_robbed(trace *out, void *instance, const engine_ride *asked,
                                    problem *p) {
  engine_ride watched = *asked;
  mjfGeneric ours = mjcb_control;
  watched.progress = steal_at;
  term_exit code = engine_mujoco.ride(out, instance, &watched, p);
  mjcb_control = ours;
  return code;
}

static void stolen_callback(random_source *seed) {
  engine wrong = engine_mujoco;
  wrong.ride = ride_and_be_robbed;
  fault.time = random_between(seed, 0, 0.9);
  expect_invalid(open_run(&wrong, "0.5"), "L2", "mjcb_control is no longer");
}

// Every signal as it was a little earlier, by the slope between rows; the start is the start.
static term_exit ride_late(trace *out, void *instance, const engine_ride *asked, problem *p) {
  term_exit code = engine_mujoco.ride(out, instance, asked, p);
  double share = fault.size / asked->sample;
  for (size_t k = out->count; k-- > 1;) {
    double *now = (double *)&out->rows[k];
    const double *before = (const double *)&out->rows[k - 1];
    for (size_t i = 1; i < sizeof(trace_row) / sizeof(double); i++)
      now[i] += share * (before[i] - now[i]);
  }
  return code;
}

static void time_offset(random_source *seed) {
  engine wrong = engine_mujoco;
  wrong.ride = ride_late;
  fault.size = fabs(pick_size(seed, 3, 6));
  support_run *f = open_run(&wrong, "0.5");
  comparison *c = support_play(f);
  support_expect_failure(c, "L2", "a time offset, mujoco is late by");
  assert_near(c->study.shift[0].time, fault.size, 0.05 * fault.size);
  support_close(f);
}

static void *create_with_another(const bike_bicycle *bicycle, const engine_choice *choice,
                                 term_exit *code, problem *p) {
  engine_choice other = *choice;
  other.option[engine_option_index(&engine_mujoco, "integrator")] = fault.integrator;
  return engine_mujoco.create(bicycle, &other, code, p);
}

static void wrong_integrator(random_source *seed) {
  engine wrong = engine_mujoco;
  wrong.create = create_with_another;
  fault.integrator = 1 + pick(seed, 2); // Euler or implicit instead of RK4
  expect(open_run(&wrong, "0.5"), "L2", "not 4: another integrator", "agree on instants");
}

static term_exit ride_into_nan(trace *out, void *instance, const engine_ride *asked, problem *p) {
  term_exit code = engine_mujoco.ride(out, instance, asked, p);
  for (size_t k = 0; k < out->count; k++)
    if (out->rows[k].sample.time > fault.time) out->rows[k].sample.lean_rate = NAN;
  return code;
}

static void nan_after_two_seconds(random_source *seed) {
  engine wrong = engine_mujoco;
  wrong.ride = ride_into_nan;
  fault.time = random_between(seed, 2, 2.04);
  expect_invalid(open_run(&wrong, "2.1"), "L2", "mujoco: not a finite number at 2.0");
}

//---------------------------------- all of them ---------------------------------------------------

static void (*const kinds[])(random_source *seed) = {
    wrong_mass,   wrong_centre,     wrong_sign,           wrong_trail,
    wrong_radius, missing_drift,    soft_contact,         stolen_callback,
    time_offset,  wrong_integrator, nan_after_two_seconds};

enum { KIND_COUNT = sizeof kinds / sizeof *kinds, SEEDS = 6 };

// Each kind with several seeds: chance alone would leave one out.
static void test_every_fault_is_named(void **state) {
  (void)state;
  for (int k = 0; k < KIND_COUNT; k++)
    for (uint64_t s = 1; s <= SEEDS; s++) {
      random_source seed = {1000 * (uint64_t)k + s};
      printf("fault %d, seed %" PRIu64 "\n", k, s); // the last line before a failure
      kinds[k](&seed);
    }
}

static void test_no_false_alarm(void **state) {
  (void)state;
  for (int s = 1; s <= 20; s++) {
    char text[900];
    snprintf(text, sizeof text,
             "title: seeds\nbicycle: %s\nstart: {speed: 5}\nduration: 0.01\nsample: 0.01\n"
             "instants: {count: 100, seed: %d}\n"
             "reference: {engine: analytic}\ncandidate: {engine: mujoco, root: %s}\ngates:\n"
             "  - {layer: L0, metric: relative, limit: 1e-10, reason: test}\n"
             "  - {layer: L0, metric: relative, signals: [rear_force, front_force], limit: 1e-9,"
             " reason: test}\n",
             s % 2 ? "benchmark" : "roadster", s, s % 4 < 2 ? "hinge" : "free");
    support_run *f = support_open(NULL, text);
    comparison *c = support_play(f);
    assert_string_equal(c->cause, "");
    support_close(f);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_every_fault_is_named),
      cmocka_unit_test(test_no_false_alarm),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
