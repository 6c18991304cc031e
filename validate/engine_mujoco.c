// SPDX-License-Identifier: Apache-2.0
// The MuJoCo engine: the bicycle as an mjModel, with exactly rolling wheels.
#include "engine_mujoco.h"

#include "sha256.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { OPTION_INTEGRATOR, OPTION_TIMESTEP, OPTION_ROOT, OPTION_COUNT };

static const char *const integrators[] = {"rk4", "euler", "implicit", NULL};
static const char *const roots[] = {"hinge", "free", NULL};

// As mjcf_default_options.
static const engine_option options[OPTION_COUNT] = {
    [OPTION_INTEGRATOR] = {"integrator", "", integrators, 0},
    [OPTION_TIMESTEP] = {"timestep", "s", NULL, 1e-3},
    [OPTION_ROOT] = {"root", "", roots, 0},
};

typedef struct mujoco {
  runner *run;
  bike_bicycle bicycle;
  mjcf_options options;
} mujoco;

runner *engine_mujoco_runner(void *instance) {
  return ((mujoco *)instance)->run;
}

static void free_mujoco(void *instance) {
  mujoco *m = instance;
  if (!m) return;
  runner_free(m->run);
  free(m);
}

static mjcf_options choose(const double *option) {
  static const mjcf_integrator integrator[] = {MJCF_RK4, MJCF_EULER, MJCF_IMPLICIT};
  static const mjcf_root root[] = {MJCF_ROOT_HINGE, MJCF_ROOT_FREE};
  mjcf_options chosen = mjcf_default_options();
  chosen.integrator = integrator[(int)option[OPTION_INTEGRATOR]];
  chosen.timestep = option[OPTION_TIMESTEP];
  chosen.root = root[(int)option[OPTION_ROOT]];
  chosen.visible = false;
  return chosen;
}

// What a status of the runner and its text mean for the comparison.
static term_exit fail(problem *p, runner_status status, const mjcf_error *error) {
  const char *text = *error->text ? error->text : runner_status_string(status);
  return problem_set(p, (term_exit)runner_exit_code(status), "%s", text);
}

static void *create(const bike_bicycle *bicycle, const double *option, term_exit *code,
                    problem *p) {
  mujoco *m = calloc(1, sizeof *m);
  if (!m) {
    *code = problem_memory(p);
    return NULL;
  }
  runner_status status = RUNNER_OK;
  mjcf_error error = {""};
  m->bicycle = *bicycle;
  m->options = choose(option);
  m->run = runner_create(bicycle, &m->options, &status, &error);
  if (m->run) return m;
  *code = fail(p, status, &error);
  free_mujoco(m);
  return NULL;
}

static void version(char out[ENGINE_VERSION_SIZE]) {
  snprintf(out, ENGINE_VERSION_SIZE, "MuJoCo %s", mj_versionString());
}

static void model_hash(char out[ENGINE_HASH_SIZE], void *instance) {
  const mujoco *m = instance;
  mjcf_error error;
  char *text = mjcf_text(&m->bicycle, &m->options, NULL, &error);
  sha256_hex(out, text ? text : "", text ? strlen(text) : 0);
  free(text);
}

static term_exit parameters(bike_bicycle *out, void *instance, problem *p) {
  return engine_mujoco_read_back(out, runner_model(engine_mujoco_runner(instance)), p);
}

static term_exit evaluate(engine_instant *out, void *instance, const bike_state *state,
                          problem *p) {
  runner_instant i;
  mjcf_error error = {""};
  runner_status status = runner_evaluate(&i, engine_mujoco_runner(instance), state, NULL, &error);
  if (status != RUNNER_OK) return fail(p, status, &error);
  *out = (engine_instant){
      .lean_acceleration = i.lean_acceleration,
      .steer_acceleration = i.steer_acceleration,
      .yaw_acceleration = i.yaw_acceleration,
      .pitch_acceleration = i.pitch_acceleration,
      .wheel_acceleration = {i.wheel_acceleration[0], i.wheel_acceleration[1]},
      .speed_rate = i.speed_rate,
      .yaw_rate = i.yaw_rate,
      .pitch_rate = i.pitch_rate,
      .wheel_rate = {i.wheel_rate[0], i.wheel_rate[1]},
      .pitch = i.pitch,
      .kinetic = i.kinetic,
      .potential = i.potential,
  };
  memcpy(out->force, i.force, sizeof out->force);
  return TERM_DONE;
}

typedef struct recorder {
  trace *out;
  const engine_ride *ride;
  bool lost;
} recorder;

static int record(const runner_sample *sample, void *user) {
  recorder *r = user;
  trace_row row = {.sample = sample->row, .more = sample->more};
  memcpy(row.slip, sample->slip, sizeof row.slip);
  memcpy(row.height, sample->height, sizeof row.height);
  r->lost = !trace_add(r->out, &row);
  if (r->lost) return 1;
  double share = sample->row.time / r->ride->duration;
  return r->ride->progress && !r->ride->progress(share, r->ride->user);
}

static term_exit ride(trace *out, void *instance, const engine_ride *asked, problem *p) {
  runner *run = engine_mujoco_runner(instance);
  recorder r = {out, asked, false};
  mjcf_error error = {""};
  runner_status status = runner_start(run, &asked->start, &error);
  if (status != RUNNER_OK) return fail(p, status, &error);
  runner_ride_def def = runner_default_ride_def();
  def.duration = asked->duration;
  def.sample = asked->sample;
  def.lean_limit = asked->lean_limit;
  def.on_sample = record;
  def.user = &r;
  runner_ride_result result;
  status = runner_ride(&result, run, &def, &error);
  if (r.lost) return problem_memory(p);
  if (status != RUNNER_OK) return fail(p, status, &error);
  trace_end(out, result.complete, result.end_time, result.events, result.event_count);
  out->has_contacts = true;
  out->steps = result.steps;
  out->wall_time = result.wall_time;
  return TERM_DONE;
}

const engine engine_mujoco = {
    .name = "mujoco",
    .summary = "MuJoCo with exactly rolling wheels (plugin/rolling.h)",
    .options = options,
    .option_count = OPTION_COUNT,
    .create = create,
    .free = free_mujoco,
    .version = version,
    .model_hash = model_hash,
    .parameters = parameters,
    .evaluate = evaluate,
    .ride = ride,
};
