// SPDX-License-Identifier: Apache-2.0
// The mujoco_disc engine: the rear wheel of a bicycle, rolling alone, as plugin/examples/disc.xml
// with the wheel's numbers, kept on the ground by plugin/rolling.h.
#include "engine_disc.h"
#include "files/sha256.h"

#include <math.h>
#include <rolling.h>
#include <runner.h>
#include <runner_guard.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { OPTION_INTEGRATOR, OPTION_TIMESTEP, OPTION_COUNT };

static const char *const integrators[] = {"rk4", "euler", "implicit", NULL};

static const engine_option options[OPTION_COUNT] = {
    [OPTION_INTEGRATOR] = {"integrator", "", integrators, 0},
    [OPTION_TIMESTEP] = {"timestep", "s", NULL, 1e-3},
};

enum { X, Y, Z, YAW, ROLL, SPIN, DOFS }; // of the model: slides of the hub, hinges

typedef struct disc {
  disc_body body;
  char *text; // of the model
  mjModel *model;
  mjData *ride, *probe; // what mj_step advances; where instants are measured
} disc;

static void free_disc(void *instance) {
  disc *d = instance;
  if (d->ride) mj_deleteData(d->ride);
  if (d->probe) mj_deleteData(d->probe);
  if (d->model) mj_deleteModel(d->model);
  free(d->text);
  free(d);
}

static char *write_model(const disc_body *b) {
  char *text = NULL;
  int length =
      asprintf(&text,
               "<mujoco model=\"disc\">\n"
               "  <compiler angle=\"radian\"/>\n"
               "  <option gravity=\"0 0 %.17g\"><flag energy=\"enable\"/></option>\n"
               "  <size njmax=\"50\" nconmax=\"10\" nstack=\"20000\"/>\n"
               "  <custom><tuple name=\"rolling_discs\">\n"
               "    <element objtype=\"geom\" objname=\"rim\"/></tuple></custom>\n"
               "  <worldbody><body name=\"disc\" pos=\"0 0 %.17g\">\n"
               "    <joint name=\"x\" type=\"slide\" axis=\"1 0 0\"/>\n"
               "    <joint name=\"y\" type=\"slide\" axis=\"0 1 0\"/>\n"
               "    <joint name=\"z\" type=\"slide\" axis=\"0 0 1\"/>\n"
               "    <joint name=\"yaw\" type=\"hinge\" axis=\"0 0 1\"/>\n"
               "    <joint name=\"roll\" type=\"hinge\" axis=\"1 0 0\"/>\n"
               "    <joint name=\"spin\" type=\"hinge\" axis=\"0 1 0\"/>\n"
               "    <inertial pos=\"0 0 0\" mass=\"%.17g\" diaginertia=\"%.17g %.17g %.17g\"/>\n"
               "    <geom name=\"rim\" type=\"cylinder\" size=\"%.17g 0.005\" zaxis=\"0 1 0\"\n"
               "      contype=\"0\" conaffinity=\"0\"/>\n"
               "  </body></worldbody>\n"
               "</mujoco>\n",
               -b->gravity, b->radius, b->mass, b->diametral, b->axial, b->diametral, b->radius);
  return length < 0 ? NULL : text;
}

static term_exit compile(disc *d, const double *option, problem *p) {
  static const int integrator[] = {mjINT_RK4, mjINT_EULER, mjINT_IMPLICIT};
  mjcf_error error = {.text = ""};
  d->text = write_model(&d->body);
  if (!d->text) return problem_memory(p);
  runner_install_control(); // before the compiler, which steps the model once
  d->model = mjcf_compile(d->text, &error);
  if (!d->model)
    return problem_set(p, error.no_memory ? TERM_INVALID : TERM_USAGE, "%s", error.text);
  d->model->opt.integrator = integrator[(int)option[OPTION_INTEGRATOR]];
  d->model->opt.timestep = option[OPTION_TIMESTEP];
  d->ride = guard_make_data(d->model);
  d->probe = guard_make_data(d->model);
  return d->ride && d->probe ? TERM_DONE : problem_memory(p);
}

static void *create(const bike_bicycle *bicycle, const engine_choice *choice, term_exit *code,
                    problem *p) {
  disc *d = calloc(1, sizeof *d);
  if (!d) {
    *code = problem_memory(p);
    return NULL;
  }
  *code = engine_disc_body(&d->body, bicycle, p);
  if (*code == TERM_DONE) *code = compile(d, choice->option, p);
  if (*code == TERM_DONE) return d;
  free_disc(d);
  return NULL;
}

static void version(char out[ENGINE_VERSION_SIZE]) {
  snprintf(out, ENGINE_VERSION_SIZE, "MuJoCo %s", mj_versionString());
}

static void model_hash(char out[ENGINE_HASH_SIZE], void *instance) {
  const disc *d = instance;
  sha256_hex(out, d->text, strlen(d->text));
}

static double order(const engine_choice *choice) {
  return (int)choice->option[OPTION_INTEGRATOR] == 0 ? 4 : 1;
}

// The hub above the ground and its velocity are what rolling makes of the rest.
static void place(mjData *data, const disc *d, const bike_state *state) {
  double s[DISC_STATES], R = d->body.radius, lean = state->lean, yaw = state->steer;
  engine_disc_start(s, &d->body, state);
  double ahead = R * s[DISC_W2], left = -R * s[DISC_W1] * cos(lean);
  const double qpos[DOFS] = {s[DISC_X], s[DISC_Y], R * (cos(lean) - 1), yaw, lean, 0};
  const double qvel[DOFS] = {ahead * cos(yaw) - left * sin(yaw),
                             ahead * sin(yaw) + left * cos(yaw),
                             -R * s[DISC_W1] * sin(lean),
                             state->steer_rate,
                             state->lean_rate,
                             state->speed / R};
  mj_resetData(d->model, data);
  mju_copy(data->qpos, qpos, DOFS);
  mju_copy(data->qvel, qvel, DOFS);
}

//---------------------------------- calls into MuJoCo ---------------------------------------------

typedef struct call {
  const mjModel *model;
  mjData *data;
} call;

static void forward(void *argument) {
  call *c = argument;
  mj_forward(c->model, c->data);
}

static void step(void *argument) {
  call *c = argument;
  mj_step(c->model, c->data);
}

static const char *what_is_wrong(const disc *d, const mjData *data, const guard_report *report) {
  if (report->failed) return report->error;
  if (!roll_is_installed()) return runner_status_string(RUNNER_INVALID_CALLBACK);
  if (report->warnings) return report->warning;
  for (int i = 0; i < mjNWARNING; i++) // only the first of each kind is said aloud
    if (data->warning[i].number) return mju_warningText(i, data->warning[i].lastinfo);
  for (int i = 0; i < d->model->nv; i++)
    if (!isfinite(data->qpos[i] + data->qvel[i] + data->qacc[i]))
      return runner_status_string(RUNNER_INVALID_NOT_FINITE);
  return NULL;
}

static term_exit run(const disc *d, mjData *data, void (*function)(void *), problem *p) {
  call c = {d->model, data};
  guard_report report;
  guard_call(&report, function, &c);
  const char *wrong = what_is_wrong(d, data, &report);
  return wrong ? problem_set(p, TERM_INVALID, "%s at %.6g s", wrong, data->time) : TERM_DONE;
}

// mj_forward on the probe, and where and how hard it stands on the ground: along (heading, left,
// up).
static term_exit measure(roll_disc *out, double force[3], const disc *d, problem *p) {
  term_exit code = run(d, d->probe, forward, p);
  if (code != TERM_DONE) return code;
  roll_error error = roll_discs(out, 1, d->model, d->probe);
  if (error != ROLL_OK) return problem_set(p, TERM_INVALID, "%s", roll_error_string(error));
  double c = cos(d->probe->qpos[YAW]), s = sin(d->probe->qpos[YAW]);
  force[0] = c * out->force[0] + s * out->force[1];
  force[1] = -s * out->force[0] + c * out->force[1];
  force[2] = out->force[2];
  return TERM_DONE;
}

static term_exit evaluate(engine_instant *out, void *instance, const bike_state *state,
                          problem *p) {
  const disc *d = instance;
  roll_disc at;
  *out = (engine_instant){0};
  place(d->probe, d, state);
  term_exit code = measure(&at, out->force[0], d, p);
  if (code != TERM_DONE) return code;
  const double *qacc = d->probe->qacc, *qvel = d->probe->qvel;
  out->lean_acceleration = qacc[ROLL];
  out->steer_acceleration = out->yaw_acceleration = qacc[YAW];
  out->wheel_acceleration[0] = qacc[SPIN];
  out->speed_rate = d->body.radius * qacc[SPIN];
  out->yaw_rate = qvel[YAW];
  out->wheel_rate[0] = qvel[SPIN];
  out->potential = d->probe->energy[0];
  out->kinetic = d->probe->energy[1];
  return TERM_DONE;
}

//---------------------------------- rides ---------------------------------------------------------

static term_exit record(trace *out, const disc *d, double time, problem *p) {
  roll_disc at;
  trace_row row = {.sample.time = time};
  mju_copy(d->probe->qpos, d->ride->qpos, DOFS);
  mju_copy(d->probe->qvel, d->ride->qvel, DOFS);
  term_exit code = measure(&at, row.more.rear_force, d, p);
  if (code != TERM_DONE) return code;
  const double *qpos = d->probe->qpos, *qvel = d->probe->qvel, *force = row.more.rear_force;
  bike_sample *s = &row.sample;
  s->x = at.point[0], s->y = at.point[1];
  s->yaw = s->steer = qpos[YAW];
  s->lean = qpos[ROLL];
  s->lean_rate = qvel[ROLL], s->steer_rate = qvel[YAW];
  s->speed = d->body.radius * qvel[SPIN];
  s->rear_angle = qpos[SPIN];
  s->energy = d->probe->energy[0] + d->probe->energy[1];
  s->rear_normal = force[2];
  s->rear_friction = bike_friction(force);
  row.slip[0] = mju_norm3(at.slip);
  row.height[0] = at.height;
  return trace_add(out, &row) ? TERM_DONE : problem_memory(p);
}

// How often the timestep goes into a row; 0 if it does not to the rounding of decimals.
static long steps_per_row(const disc *d, double sample) {
  double steps = sample / d->model->opt.timestep;
  return fabs(steps - round(steps)) <= 1e-9 * steps ? lround(fmin(steps, 1e9)) : 0;
}

// From row k - 1 to row k; true, with the time of it, where the disc falls.
static term_exit advance(bool *falls, double *fall, trace *out, const disc *d, long k, long steps,
                         const engine_ride *asked, problem *p) {
  double timestep = d->model->opt.timestep;
  for (long i = 0; i < steps; i++) {
    double before = d->ride->qpos[ROLL], time = (double)((k - 1) * steps + i) * timestep;
    d->ride->time = time; // not the sum of a million roundings
    double begun = engine_clock();
    term_exit code = run(d, d->ride, step, p);
    out->wall_time += engine_clock() - begun;
    if (code != TERM_DONE) return code;
    // A reset puts the time back to zero; rounding is a millionth of this.
    if (!(fabs(d->ride->time - time - timestep) <= 1e-6 * timestep))
      return problem_set(p, TERM_INVALID, "%s", runner_status_string(RUNNER_INVALID_TIME));
    out->steps++;
    out->evaluations += d->model->opt.integrator == mjINT_RK4 ? 4 : 1;
    double now = d->ride->qpos[ROLL];
    *falls = fabs(now) >= asked->lean_limit;
    if (!*falls) continue;
    *fall = engine_disc_fall(time + timestep, timestep, before, now, asked->lean_limit);
    return TERM_DONE;
  }
  return TERM_DONE;
}

static term_exit ride(trace *out, void *instance, const engine_ride *asked, problem *p) {
  const disc *d = instance;
  long rows = (long)floor(asked->duration / asked->sample * (1 + 1e-12));
  long steps = steps_per_row(d, asked->sample);
  double fall = 0;
  bool falls = false;
  if (steps < 1)
    return problem_set(p, TERM_USAGE, "the sample interval must be a multiple of the timestep");
  out->has_contacts = true;
  out->missing = engine_disc_missing();
  place(d->ride, d, &asked->start);
  mj_resetData(d->model, d->probe);
  for (long k = 0; k <= rows; k++) {
    double time = (double)k * asked->sample;
    term_exit code = TERM_DONE;
    if (k > 0) code = advance(&falls, &fall, out, d, k, steps, asked, p);
    if (code == TERM_DONE && falls) {
      trace_end(out, false, fall, &(bike_event){BIKE_EVENT_LEAN_LIMIT, fall}, 1);
      return TERM_DONE;
    }
    if (code == TERM_DONE) code = record(out, d, time, p);
    if (code != TERM_DONE) return code;
    if (asked->progress && !asked->progress(time / asked->duration, asked->user))
      return problem_set(p, TERM_INVALID, "interrupted");
  }
  trace_end(out, true, asked->duration, NULL, 0);
  return TERM_DONE;
}

const engine engine_mujoco_disc = {
    .name = "mujoco_disc",
    .summary = "the rear wheel rolling alone, in MuJoCo with exact rolling",
    .options = options,
    .option_count = OPTION_COUNT,
    .step_option = "timestep",
    .create = create,
    .free = free_disc,
    .version = version,
    .model_hash = model_hash,
    .order = order,
    .evaluate = evaluate,
    .ride = ride,
};
