// SPDX-License-Identifier: Apache-2.0
// The MuJoCo engine: the bicycle as an mjModel, with exactly rolling wheels.
#include "engine_mujoco.h"

#include "engine_differences.h"
#include "files/sha256.h"
#include "terminal/message.h"

#include <bicycle_import.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
  OPTION_INTEGRATOR,
  OPTION_TIMESTEP,
  OPTION_ROOT,
  OPTION_ROLLING,
  OPTION_SOLREF,
  OPTION_TOLERANCE,
  OPTION_COUNT
};

static const char *const integrators[] = {"rk4", "euler", "implicit", "cvode", NULL};
enum { CVODE = 3 };
static const char *const roots[] = {"hinge", "free", NULL};
static const char *const rollings[] = {"exact", "contact", NULL};

// As mjcf_default_options.
static const engine_option options[OPTION_COUNT] = {
    [OPTION_INTEGRATOR] = {"integrator", "", integrators, 0},
    [OPTION_TIMESTEP] = {"timestep", "s", NULL, 1e-3},
    [OPTION_ROOT] = {"root", "", roots, 0},
    [OPTION_ROLLING] = {"rolling", "", rollings, 0},
    // Time constant of contacts; 0: two timesteps, the least that MuJoCo takes.
    [OPTION_SOLREF] = {"solref", "s", NULL, 0},
    // Relative and absolute, of cvode, per step: as the analytic engine's.
    [OPTION_TOLERANCE] = {"tolerance", "", NULL, 1e-13},
};

typedef struct mujoco {
  runner *run;
  bike_bicycle bicycle;
  mjcf_options options;
  double tolerance; // 0: MuJoCo integrates
  bool imported;    // the model is the user's own
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
  // Under CVODE no mj_step is made.
  static const mjcf_integrator integrator[] = {MJCF_RK4, MJCF_EULER, MJCF_IMPLICIT, MJCF_RK4};
  static const mjcf_rolling rolling[] = {MJCF_ROLLING_EXACT, MJCF_ROLLING_CONTACT};
  static const mjcf_root root[] = {MJCF_ROOT_HINGE, MJCF_ROOT_FREE};
  mjcf_options chosen = mjcf_default_options();
  chosen.integrator = integrator[(int)option[OPTION_INTEGRATOR]];
  chosen.timestep = option[OPTION_TIMESTEP];
  chosen.root = root[(int)option[OPTION_ROOT]];
  chosen.rolling = rolling[(int)option[OPTION_ROLLING]];
  chosen.contact_time = option[OPTION_SOLREF];
  chosen.visible = false;
  return chosen;
}

// What a status of the runner and its text mean for the comparison.
static term_exit fail(problem *p, runner_status status, const mjcf_error *error) {
  const char *text = *error->text ? error->text : runner_status_string(status);
  return problem_set(p, (term_exit)runner_exit_code(status), "%s", text);
}

// The user's own model keeps its root; integrator and timestep are the scenario's.
static runner *import(const mujoco *m, const char *path, runner_status *status, mjcf_error *error) {
  static const int integrator[] = {
      [MJCF_RK4] = mjINT_RK4, [MJCF_EULER] = mjINT_EULER, [MJCF_IMPLICIT] = mjINT_IMPLICIT};
  bool contact = m->options.rolling == MJCF_ROLLING_CONTACT;
  if (m->options.contact_time > 0) {
    *status = RUNNER_UNSUPPORTED;
    mjcf_fail(error, "solref is for models made here, %s has contacts of its own", path);
    return NULL;
  }
  runner *run =
      contact ? runner_import_as_is(path, status, error) : runner_import(path, status, error);
  if (!run) return NULL;
  runner_model(run)->opt.integrator = integrator[m->options.integrator];
  runner_model(run)->opt.timestep = m->options.timestep;
  return run;
}

// Exact rolling has no time constant: one that is given was meant for contacts.
static bool may_have_solref(const mujoco *m, runner_status *status, mjcf_error *error) {
  if (!(m->options.contact_time > 0) || m->options.rolling == MJCF_ROLLING_CONTACT) return true;
  *status = RUNNER_UNSUPPORTED;
  return mjcf_fail(error, "solref is for rolling: contact");
}

static void *create(const bike_bicycle *bicycle, const engine_choice *choice, term_exit *code,
                    problem *p) {
  mujoco *m = calloc(1, sizeof *m);
  if (!m) {
    *code = problem_memory(p);
    return NULL;
  }
  runner_status status = RUNNER_OK;
  mjcf_error error = {.text = ""};
  m->bicycle = *bicycle;
  m->options = choose(choice->option);
  m->options.moving_rider = choice->moving_rider;
  if ((int)choice->option[OPTION_INTEGRATOR] == CVODE)
    m->tolerance = choice->option[OPTION_TOLERANCE];
  m->run = !may_have_solref(m, &status, &error) ? NULL
           : *choice->model                     ? import(m, choice->model, &status, &error)
                            : runner_create(bicycle, &m->options, &status, &error);
  m->imported = *choice->model != '\0';
  if (m->run) return m;
  *code = fail(p, status, &error);
  free_mujoco(m);
  return NULL;
}

static bool has_quaternion(const char *path) {
  mjcf_error error;
  mjModel *m = mjcf_load(path, &error);
  bool has = false;
  if (!m) term_lose(); // it has been loaded before
  for (int i = 0; m && i < m->njnt; i++)
    has = has || m->jnt_type[i] == mjJNT_FREE || m->jnt_type[i] == mjJNT_BALL;
  if (m) mj_deleteModel(m);
  return has;
}

// RK4 is of order 4 with slides and hinges, of order 2 with MuJoCo's quaternions. Contacts are not
// smooth: whatever the integrator, no more than order 1 is to be had from them.
static double order(const engine_choice *choice) {
  int integrator = (int)choice->option[OPTION_INTEGRATOR];
  if (integrator == CVODE) return 0; // it chooses its steps itself
  if ((int)choice->option[OPTION_ROLLING] != 0 || integrator != 0) return 1;
  if (*choice->model) return has_quaternion(choice->model) ? 2 : 4;
  return (int)choice->option[OPTION_ROOT] == 0 ? 4 : 2;
}

static term_exit linearize(double A[16], void *instance, double speed, problem *p) {
  const mujoco *m = instance;
  if (m->options.rolling == MJCF_ROLLING_CONTACT)
    return problem_set(p, TERM_USAGE, "a bicycle on soft contacts has no linearisation");
  return engine_differences(A, &engine_mujoco, instance, speed, p);
}

static void version(char out[ENGINE_VERSION_SIZE]) {
  snprintf(out, ENGINE_VERSION_SIZE, "MuJoCo %s", mj_versionString());
}

// All numbers and names of a compiled model: they stand in one block.
static void hash_model(char out[ENGINE_HASH_SIZE], const mjModel *m) {
  sha256_hex(out, m->buffer, (size_t)m->nbuffer);
}

static void model_hash(char out[ENGINE_HASH_SIZE], void *instance) {
  const mujoco *m = instance;
  mjcf_error error;
  if (m->imported) {
    hash_model(out, runner_model(m->run));
    return;
  }
  char *text = mjcf_text(&m->bicycle, &m->options, NULL, &error);
  if (!text) term_lose(); // it has been written before
  sha256_hex(out, text ? text : "", text ? strlen(text) : 0);
  free(text);
}

static term_exit parameters(bike_bicycle *out, void *instance, problem *p) {
  const mujoco *m = instance;
  mjcf_error error;
  if (!m->imported) return engine_mujoco_read_back(out, runner_model(m->run), p);
  // What was read from the file once is read from the model that is ridden.
  if (import_bicycle(out, NULL, runner_model(m->run), &error)) return TERM_DONE;
  return fail(p, error.no_memory ? RUNNER_MEMORY : RUNNER_MODEL, &error);
}

static term_exit evaluate(engine_instant *out, void *instance, const bike_state *state,
                          problem *p) {
  runner_instant i;
  mjcf_error error = {.text = ""};
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
      .at_stop = runner_at_stop(engine_mujoco_runner(instance)),
  };
  memcpy(out->force, i.force, sizeof out->force);
  return TERM_DONE;
}

static term_exit mass_matrix(double M[9], void *instance, const bike_state *state, problem *p) {
  mjcf_error error = {.text = ""};
  runner_status status = runner_mass_matrix(M, engine_mujoco_runner(instance), state, &error);
  return status == RUNNER_OK ? TERM_DONE : fail(p, status, &error);
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

static void give_input(double time, bike_input *out, void *user) {
  const recorder *r = user;
  r->ride->input(time, out, r->ride->input_user);
}

static term_exit ride(trace *out, void *instance, const engine_ride *asked, problem *p) {
  runner *run = engine_mujoco_runner(instance);
  recorder r = {out, asked, false};
  mjcf_error error = {.text = ""};
  runner_status status = runner_start(run, &asked->start, &error);
  if (status != RUNNER_OK) return fail(p, status, &error);
  runner_ride_def def = runner_default_ride_def();
  def.duration = asked->duration;
  def.sample = asked->sample;
  def.lean_limit = asked->lean_limit;
  def.tolerance = ((const mujoco *)instance)->tolerance;
  if (asked->input) def.input = give_input;
  def.on_sample = record;
  def.user = &r;
  runner_ride_result result;
  status = runner_ride(&result, run, &def, &error);
  if (r.lost) return problem_memory(p);
  if (status != RUNNER_OK) return fail(p, status, &error);
  trace_end(out, result.complete, result.end_time, result.events, result.event_count);
  out->has_contacts = true;
  out->steps = result.steps;
  out->evaluations = result.evaluations;
  out->wall_time = result.wall_time;
  return TERM_DONE;
}

const engine engine_mujoco = {
    .name = "mujoco",
    .summary = "MuJoCo, with exactly rolling wheels (plugin/rolling.h) or its own contacts",
    .options = options,
    .option_count = OPTION_COUNT,
    .step_option = "timestep",
    .takes_input = true,
    .create = create,
    .free = free_mujoco,
    .version = version,
    .model_hash = model_hash,
    .parameters = parameters,
    .order = order,
    .linearize = linearize,
    .evaluate = evaluate,
    .mass_matrix = mass_matrix,
    .ride = ride,
};
