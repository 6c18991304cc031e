// SPDX-License-Identifier: Apache-2.0
// Import of MuJoCo models: numbers, types and flags of compiled models are changed, so that they
// stay models. What is taken for a bicycle is one in MuJoCo's own equations: nothing but weight and
// the steer's damper acts.
#include "fuzz.h"

#include "model_edit.h"

#include "bicycle_import.h"
#include "runner_guard.h"

#include <bicycle/error.h>
#include <math.h>
#include <string.h>

enum { MODELS = 5, MOST_EDITS = 8 };

// Room for what a bicycle needs: by default MuJoCo clears megabytes for each mjData.
static void make_small(mjModel *m) {
  m->njmax = 100;
  m->nconmax = 25;
  m->nstack = 32768;
}

// A fresh copy of a model, valid until the next call for the same index. Each model is compiled
// once.
static mjModel *load(int index) {
  static const char *const files[MODELS] = {
      "model/benchmark/benchmark.xml",
      "plugin/examples/bicycle.xml",
      "plugin/examples/bicycle_stops.xml",
      "tests/plugin/import_models/fork_first.xml",
      "validate/scenarios/models/somebodys_bicycle.xml",
  };
  static mjModel *models[MODELS], *copies[MODELS];
  mjcf_error error = {.text = ""};
  char path[4096];
  snprintf(path, sizeof path, "%s/%s", BICYCLE_SOURCE_DIR, files[index]);
  if (!models[index]) {
    models[index] = mjcf_load(path, &error);
    FUZZ_REQUIRE(models[index], "%s", error.text);
    make_small(models[index]);
  }
  copies[index] = mj_copyModel(copies[index], models[index]);
  FUZZ_REQUIRE(copies[index], "memory");
  return copies[index];
}

typedef struct ride {
  const mjModel *m;
  mjData *d;
} ride;

// A state near the model's own, in motion.
static void disturb(void *argument) {
  const ride *r = argument;
  mj_resetData(r->m, r->d);
  for (int i = 0; i < r->m->nv; i++) r->d->qvel[i] = 0.1 * sin(3 + 7 * i);
  mj_integratePos(r->m, r->d->qpos, r->d->qvel, 0.5);
  mj_fwdPosition(r->m, r->d);
  mj_fwdVelocity(r->m, r->d);
  mj_fwdActuation(r->m, r->d);
}

// In the same place, at rest.
static void stop(void *argument) {
  const ride *r = argument;
  mju_zero(r->d->qvel, r->m->nv);
  mj_fwdVelocity(r->m, r->d);
}

// The generalised weight of all bodies, g downwards.
static void weight(double *out, const ride *r, double g) {
  mju_zero(out, r->m->nv);
  double *jacobian = malloc(3 * (size_t)r->m->nv * sizeof *jacobian);
  for (int b = 1; b < r->m->nbody; b++) {
    mj_jacBodyCom(r->m, r->d, jacobian, NULL, b);
    for (int i = 0; i < r->m->nv; i++)
      out[i] -= r->m->body_mass[b] * g * jacobian[2 * r->m->nv + i];
  }
  free(jacobian);
}

static void require_damper(const ride *r, const import_map *map, const bike_bicycle *bicycle,
                           double scale) {
  int steer = r->m->jnt_dofadr[map->steer];
  for (int i = 0; i < r->m->nv; i++) {
    double expected = i == steer ? -bicycle->steer_damping * r->d->qvel[i] : 0;
    FUZZ_REQUIRE(fabs(r->d->qfrc_passive[i] - expected) <= 1e-9 * scale,
                 "passive force %g of freedom %d", r->d->qfrc_passive[i], i);
    FUZZ_REQUIRE(fabs(r->d->qfrc_actuator[i]) <= 1e-9 * scale, "actuator's force %g of freedom %d",
                 r->d->qfrc_actuator[i], i);
  }
}

static void require_bicycle(const mjModel *m, const import_map *map, const bike_bicycle *bicycle) {
  ride r = {m, mj_makeData(m)};
  guard_report report;
  double mass = 0;
  for (int i = 0; i < bicycle->part_count; i++) mass += bicycle->parts[i].mass;
  double scale = mass * bicycle->gravity + bicycle->steer_damping;
  double *expected = calloc((size_t)m->nv, sizeof *expected);
  FUZZ_REQUIRE(r.d && expected, "memory");
  guard_call(&report, disturb, &r);
  FUZZ_REQUIRE(!report.failed, "%s", report.error);
  require_damper(&r, map, bicycle, scale);
  guard_call(&report, stop, &r);
  weight(expected, &r, bicycle->gravity);
  for (int i = 0; i < m->nv; i++)
    FUZZ_REQUIRE(fabs(r.d->qfrc_bias[i] + expected[i]) <= 1e-6 * scale,
                 "weight %g, not %g, on freedom %d", -r.d->qfrc_bias[i], expected[i], i);
  free(expected);
  mj_deleteData(r.d);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  fuzz_bytes bytes = {data, size};
  static bike_bicycle bicycle;
  bike_model model;
  import_map map;
  mjcf_error error = {.text = ""};
  mjModel *m = load((int)fuzz_below(&bytes, MODELS));
  bool sound = true;
  for (int i = 0; i < MOST_EDITS && bytes.left > 0; i++) sound &= model_edit(m, &bytes);
  if (!import_bicycle(&bicycle, &map, m, &error)) {
    FUZZ_REQUIRE(fuzz_one_line(error.text), "'%s'", error.text);
  } else {
    FUZZ_REQUIRE(bike_check(&bicycle, NULL, NULL) == BIKE_OK, "accepted");
    (void)bike_model_init(&model, &bicycle);
    if (sound) require_bicycle(m, &map, &bicycle);
  }
  return 0;
}
