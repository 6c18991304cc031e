// SPDX-License-Identifier: Apache-2.0
// Making a runner, and the questions one may ask it between rides.
#include "runner_guard.h"
#include "runner_internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// M = L^T D L at qpos 0, and its least D_i / M_ii: the share of an inertia that is left when all
// else may give way.
typedef struct factored {
  const mjModel *model;
  mjData *data;
  double least;
} factored;

static void factor(void *argument) {
  factored *f = (factored *)argument;
  const mjModel *m = f->model;
  mjData *d = f->data;
  mj_kinematics(m, d);
  mj_comPos(m, d);
  mj_crb(m, d);
  mj_factorM(m, d);
  f->least = 1;
  for (int i = 0; i < m->nv; i++)
    f->least = fmin(f->least, 1 / (d->qLDiagInv[i] * d->qM[m->dof_Madr[i]]));
}

// The ground makes a bicycle regular whose parts are points: MuJoCo's mass matrix, without it, is
// singular then, and what is solved with it is noise. The shipped bicycles have shares of 0.02 to
// 0.2, singular ones 1e-14 and less. Below this an acceleration has lost ten of its sixteen digits.
static bool is_regular(const mjModel *model, mjData *data, mjcf_error *error) {
  static const double least = 1e-10;
  factored f = {.model = model, .data = data};
  guard_report report; // its warning is said in our words
  guard_call(&report, factor, &f);
  mj_resetData(model, data);
  if (report.failed) return mjcf_fail(error, "%s", report.error);
  return f.least >= least ||
         mjcf_fail(error, "MuJoCo cannot hold this bicycle: without the ground its mass matrix is "
                          "singular: its parts need inertia about more axes");
}

// Takes the model, whatever comes.
typedef bool find_map_function(runner_map *map, const mjModel *model, mjcf_error *error);

// `model` is NULL where it could not be had, for the reason in `error`.
static runner *create(mjModel *model, double rider_offset, find_map_function *find_map,
                      runner_status *status, mjcf_error *error) {
  *status = RUNNER_MODEL;
  if (!model) {
    if (error->no_memory) *status = RUNNER_MEMORY;
    return NULL;
  }
  runner *r = (runner *)calloc(1, sizeof *r);
  if (!r) {
    mj_deleteModel(model);
    *status = RUNNER_MEMORY;
    mjcf_fail(error, "%s", runner_status_string(*status));
    return NULL;
  }
  r->model = model;
  r->rider_offset = rider_offset;
  *status = RUNNER_MODEL;
  if (!find_map(&r->map, model, error)) {
    if (error->no_memory) *status = RUNNER_MEMORY;
    runner_free(r);
    return NULL;
  }
  model->opt.enableflags |= mjENBL_ENERGY;
  r->ride = guard_make_data(model);
  r->probe = guard_make_data(model);
  r->disc_count = roll_disc_count(model);
  r->discs = (roll_disc *)calloc((size_t)r->disc_count + 1, sizeof *r->discs);
  if (!r->ride || !r->probe || !r->discs) {
    *status = RUNNER_MEMORY;
    mjcf_fail(error, "%s", runner_status_string(*status));
    runner_free(r);
    return NULL;
  }
  if (!is_regular(model, r->probe, error)) {
    runner_free(r);
    return NULL;
  }
  *status = RUNNER_OK;
  return r;
}

runner *runner_create(const bike_bicycle *bicycle, const mjcf_options *options,
                      runner_status *status, mjcf_error *error) {
  // What nobody sees costs a third of a step: every geom is moved at every stage.
  mjcf_options plain = *options;
  plain.visible = false;
  runner_install_control(); // before the compiler, which steps the model once
  mjModel *model = mjcf_model(bicycle, &plain, NULL, error);
  return create(model, options->rider_offset, runner_find_map, status, error);
}

runner *runner_load(const char *path, runner_status *status, mjcf_error *error) {
  runner_install_control();
  mjModel *model = mjcf_load(path, error);
  return create(model, 0, runner_find_map, status, error);
}

runner *runner_import(const char *path, runner_status *status, mjcf_error *error) {
  runner_install_control();
  mjModel *model = import_load_rolling(path, error);
  return create(model, 0, runner_find_foreign_map, status, error);
}

runner *runner_import_as_is(const char *path, runner_status *status, mjcf_error *error) {
  *status = RUNNER_MODEL;
  runner_install_control();
  mjModel *model = mjcf_load(path, error);
  if (!model || mj_name2id(model, mjOBJ_TUPLE, "rolling_discs") < 0)
    return create(model, 0, runner_find_foreign_map, status, error);
  mj_deleteModel(model);
  mjcf_fail(error, "%s: its marker 'rolling_discs' makes the wheels roll exactly", path);
  return NULL;
}

void runner_free(runner *r) {
  if (!r) return;
  if (r->ride) mj_deleteData(r->ride);
  if (r->probe) mj_deleteData(r->probe);
  mj_deleteModel(r->model);
  free(r->discs);
  free(r);
}

mjModel *runner_model(runner *r) {
  return r->model;
}

bool runner_rider_moves(const runner *r) {
  return r->map.rider.moves;
}

mjData *runner_data(runner *r) {
  return r->ride;
}

const mjData *runner_measured(const runner *r) {
  return r->probe;
}

// An input that does not change.
static void give_constant(double time, bike_input *out, void *user) {
  (void)time;
  *out = *(const bike_input *)user;
}

runner_status runner_evaluate(runner_instant *out, runner *r, const bike_state *state,
                              const bike_input *input, mjcf_error *error) {
  runner_status status = runner_place(r, r->probe, state, error);
  if (status != RUNNER_OK) return status;
  bike_input copy = input ? *input : (bike_input){.rider_offset = r->rider_offset};
  bike_input_function *ride_input = r->input;
  void *ride_user = r->user;
  r->input = give_constant;
  r->user = &copy;
  runner_place_rider(r, r->probe);
  status = runner_measure_probe(out, r, error);
  r->input = ride_input;
  r->user = ride_user;
  return status;
}

// After the ride's state was set: as if it never had moved.
static void begin(runner *r, const bike_state *asked) {
  r->asked = *asked;
  r->ride->time = 0;
  r->work = 0;
  r->input = NULL;
  runner_posture posture;
  runner_read_posture(&posture, r, r->ride);
  r->yaw = posture.angle[0];
}

runner_status runner_start(runner *r, const bike_state *state, mjcf_error *error) {
  runner_status status = runner_place(r, r->ride, state, error);
  if (status == RUNNER_OK) begin(r, state);
  return status;
}

typedef struct key_start {
  runner *r;
  int key;
} key_start;

static void load_key(void *argument) {
  key_start *s = (key_start *)argument;
  mj_resetDataKeyframe(s->r->model, s->r->ride, s->key);
  mj_kinematics(s->r->model, s->r->ride);
  mj_comPos(s->r->model, s->r->ride);
  mj_comVel(s->r->model, s->r->ride);
}

runner_status runner_start_at_keyframe(runner *r, mjcf_error *error) {
  key_start s = {r, mj_name2id(r->model, mjOBJ_KEY, "test")};
  if (s.key < 0) {
    mjcf_fail(error, "the model has no keyframe 'test' to start from");
    return RUNNER_MODEL;
  }
  guard_report report;
  guard_call(&report, load_key, &s);
  double residual = report.failed ? NAN : runner_residual(r, r->ride);
  if (!(residual <= RUNNER_START_TOLERANCE)) {
    mjcf_fail(error,
              "keyframe 'test': the wheels do not stand and roll on the ground (off by %.3g)",
              residual);
    return RUNNER_START;
  }
  const runner_hinge *steer = &r->map.steer;
  runner_posture posture;
  runner_read_posture(&posture, r, r->ride);
  if (!runner_check_angles(posture.angle[1],
                           steer->sign * (r->ride->qpos[steer->qpos] - steer->zero), error))
    return RUNNER_ARGUMENT;
  // A keyframe says no more than qpos and qvel; but at rest is at rest, not a rounding's speed.
  begin(r, &(bike_state){NAN, NAN, NAN, NAN, 0});
  return RUNNER_OK;
}

// What an instant depends on; the warm start is what MuJoCo's contact solver begins with.
static void copy_state(const runner *r) {
  const mjModel *m = r->model;
  r->probe->time = r->ride->time;
  mju_copy(r->probe->qpos, r->ride->qpos, m->nq);
  mju_copy(r->probe->qvel, r->ride->qvel, m->nv);
  mju_copy(r->probe->act, r->ride->act, m->na);
  mju_copy(r->probe->qacc_warmstart, r->ride->qacc_warmstart, m->nv);
  memset(r->probe->warning, 0, sizeof r->probe->warning);
}

runner_status runner_measure(runner_instant *out, runner *r, mjcf_error *error) {
  copy_state(r);
  runner_status status = runner_measure_probe(out, r, error);
  if (status != RUNNER_OK) return status;
  // A free joint's yaw comes back from its rotation matrix within half a turn.
  double turn = 2 * mjPI;
  out->yaw += turn * round((r->yaw - out->yaw) / turn);
  r->yaw = out->yaw;
  return RUNNER_OK;
}
