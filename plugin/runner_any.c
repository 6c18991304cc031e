// SPDX-License-Identifier: Apache-2.0
// Any model that rolls: loading, starting, and what can be read at a moment.
#include "runner_any_internal.h"
#include "runner_guard.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

//---------------------------------- the model -----------------------------------------------------

static bool allocate(runner_any *r) {
  r->ride = guard_make_data(r->model);
  r->probe = guard_make_data(r->model);
  r->disc_count = roll_disc_count(r->model);
  r->drive_count = roll_drive_count(r->model);
  r->discs = (roll_disc *)calloc((size_t)r->disc_count + 1, sizeof *r->discs);
  r->drives = (roll_drive *)calloc((size_t)r->drive_count + 1, sizeof *r->drives);
  return r->ride && r->probe && r->discs && r->drives;
}

// Takes the model over.
static runner_any *create(mjModel *model) {
  runner_any *r = (runner_any *)calloc(1, sizeof *r);
  if (!r) mj_deleteModel(model);
  if (r) r->model = model;
  if (r && allocate(r)) return r;
  runner_any_free(r);
  return NULL;
}

runner_any *runner_any_load(const char *path, runner_status *status, mjcf_error *error) {
  *status = RUNNER_MODEL;
  mjModel *model = mjcf_load(path, error);
  if (!model) {
    if (error->no_memory) *status = RUNNER_MEMORY;
    return NULL;
  }
  roll_error marker = runner_check_marker(model, error);
  if (marker != ROLL_OK) {
    mj_deleteModel(model);
    *status = marker == ROLL_NO_MARKER ? RUNNER_MODEL : RUNNER_ARGUMENT;
    return NULL;
  }
  runner_any *r = create(model);
  *status = r ? RUNNER_OK : RUNNER_MEMORY;
  if (!r) return mjcf_fail(error, "%s", runner_status_string(*status)), NULL;
  model->opt.enableflags |= mjENBL_ENERGY;
  runner_install_control();
  return r;
}

void runner_any_free(runner_any *r) {
  if (!r) return;
  if (r->ride) mj_deleteData(r->ride);
  if (r->probe) mj_deleteData(r->probe);
  mj_deleteModel(r->model);
  free(r->discs);
  free(r->drives);
  free(r);
}

mjModel *runner_any_model(runner_any *r) {
  return r->model;
}

int runner_any_disc_count(const runner_any *r) {
  return r->disc_count;
}

int runner_any_drive_count(const runner_any *r) {
  return r->drive_count;
}

//---------------------------------- a moment ------------------------------------------------------

// All on which a moment depends.
static void copy_state(const runner_any *r) {
  const mjModel *m = r->model;
  const mjData *from = r->ride;
  mjData *to = r->probe;
  to->time = from->time;
  mju_copy(to->qpos, from->qpos, m->nq);
  mju_copy(to->qvel, from->qvel, m->nv);
  mju_copy(to->act, from->act, m->na);
  mju_copy(to->ctrl, from->ctrl, m->nu);
  mju_copy(to->mocap_pos, from->mocap_pos, 3 * m->nmocap);
  mju_copy(to->mocap_quat, from->mocap_quat, 4 * m->nmocap);
  mju_copy(to->userdata, from->userdata, m->nuserdata);
  mju_copy(to->qacc_warmstart, from->qacc_warmstart, m->nv);
  memset(to->warning, 0, sizeof to->warning);
}

static void measure(void *argument) {
  runner_any *r = (runner_any *)argument;
  mj_forward(r->model, r->probe);
  // Errors stand in the elements.
  if (r->disc_count > 0) roll_discs(r->discs, r->disc_count, r->model, r->probe);
  if (r->drive_count > 0) roll_drives(r->drives, r->drive_count, r->model, r->probe);
}

// The bounds within which rolling.h takes a wheel for one that rolls. A point of a skate has none.
static bool keeps_the_ground(const roll_disc *disc) {
  double most = ROLL_OFF_SHARE * disc->radius,
         speed = hypot(mju_norm3(disc->slip), disc->height_rate);
  return most == 0 || (fabs(disc->height) <= most && speed <= ROLL_DECAY * most);
}

static bool all_can_roll(const runner_any *r, mjcf_error *error) {
  double time = r->probe->time;
  if (!runner_discs_roll(r->discs, r->disc_count, time, error)) return false;
  for (int i = 0; i < r->drive_count; i++)
    if (r->drives[i].error)
      return mjcf_fail(error, "'%s' at %.6g s: %s", r->drives[i].name, time,
                       roll_error_string(r->drives[i].error));
  return true;
}

runner_status runner_any_measure(runner_any *r, char note[RUNNER_NOTE_SIZE], mjcf_error *error) {
  guard_report report;
  copy_state(r);
  guard_call(&report, measure, r);
  snprintf(note, RUNNER_NOTE_SIZE, "%s", report.warnings ? report.warning : "");
  runner_status status = runner_check_any(r->model, r->probe, &report, error);
  if (status != RUNNER_OK) return status;
  return all_can_roll(r, error) ? RUNNER_OK : RUNNER_INVALID_WARNING;
}

runner_status runner_any_check_rolling(const runner_any *r, mjcf_error *error) {
  for (int i = 0; i < r->disc_count; i++) {
    const roll_disc *disc = &r->discs[i];
    if (keeps_the_ground(disc)) continue;
    mjcf_fail(
        error,
        "'%s' is off the ground or slips at %.6g s (by %.3g m, %.3g m/s): is the timestep too "
        "long?",
        disc->name, r->probe->time, disc->height, mju_norm3(disc->slip));
    return RUNNER_INVALID_WARNING;
  }
  return RUNNER_OK;
}

//---------------------------------- the start -----------------------------------------------------

static double largest_of(const double *values, int count, double largest) {
  for (int i = 0; i < count; i++)
    if (!(fabs(values[i]) <= largest)) largest = fabs(values[i]); // a NaN stays
  return largest;
}

// Height errors and slips of all discs and drives, in the terms of RUNNER_ANY_START_TOLERANCE.
static double residual(const runner_any *r) {
  double off = 0;
  for (int i = 0; i < r->disc_count; i++) {
    const roll_disc *disc = &r->discs[i];
    off = largest_of((const double[]){disc->height, disc->height_rate}, 2, off);
    off = largest_of(disc->slip, 3, off);
  }
  for (int i = 0; i < r->drive_count; i++)
    off = largest_of((const double[]){r->drives[i].off, r->drives[i].rate_off}, 2, off);
  double scale = largest_of(r->ride->qpos, r->model->nq, 0);
  return off / (1 + largest_of(r->ride->qvel, r->model->nv, scale));
}

static void reset(void *argument) {
  runner_any *r = (runner_any *)argument;
  int key = mj_name2id(r->model, mjOBJ_KEY, "test");
  if (key >= 0)
    mj_resetDataKeyframe(r->model, r->ride, key);
  else
    mj_resetData(r->model, r->ride);
  r->ride->time = 0;
}

typedef struct projecting {
  runner_any *r;
  roll_error code;
} projecting;

static void project(void *argument) {
  projecting *p = (projecting *)argument;
  p->code = roll_project(p->r->model, p->r->ride);
}

// Puts the ride's state right. The keyframe's own is still at the probe.
static runner_status put_right(runner_any *r, double *moved, mjcf_error *error) {
  guard_report report;
  projecting p = {r, ROLL_OK};
  guard_call(&report, project, &p);
  if (report.failed || p.code != ROLL_OK) {
    mjcf_fail(error, "%s", report.failed ? report.error : roll_error_string(p.code));
    return RUNNER_START;
  }
  double most = 0;
  for (int i = 0; i < r->model->nq; i++)
    most = fmax(most, fabs(r->ride->qpos[i] - r->probe->qpos[i]));
  for (int i = 0; i < r->model->nv; i++)
    most = fmax(most, fabs(r->ride->qvel[i] - r->probe->qvel[i]));
  if (moved) *moved = most;
  memset(r->ride->warning, 0, sizeof r->ride->warning);
  char note[RUNNER_NOTE_SIZE];
  return runner_any_measure(r, note, error);
}

runner_status runner_any_start(runner_any *r, bool may_project, double *moved, mjcf_error *error) {
  guard_report report;
  char note[RUNNER_NOTE_SIZE];
  guard_call(&report, reset, r);
  if (moved) *moved = 0;
  if (report.failed) return mjcf_fail(error, "%s", report.error), RUNNER_START;
  runner_status status = runner_any_measure(r, note, error);
  if (status != RUNNER_OK) return status;
  double off = residual(r);
  if (off <= RUNNER_ANY_START_TOLERANCE) return RUNNER_OK;
  if (may_project) return put_right(r, moved, error);
  mjcf_fail(error,
            "%s: wheels are off the ground, slip, or a driven joint is off its motion (by "
            "%.3g)",
            mj_name2id(r->model, mjOBJ_KEY, "test") >= 0 ? "keyframe 'test'" : "start at qpos0",
            off);
  return RUNNER_START;
}
