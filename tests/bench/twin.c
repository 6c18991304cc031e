// SPDX-License-Identifier: Apache-2.0
#include "twin.h"

#include "terminal/message.h"

bool bench_twin_open(bench_twin *out, const bike_bicycle *bicycle, const bike_state *state) {
  *out = (bench_twin){0};
  mjcf_options options = mjcf_default_options();
  options.visible = false;
  mjcf_error error;
  runner_status status;
  out->runner = runner_create(bicycle, &options, &status, &error);
  if (!out->runner || runner_start(out->runner, state, &error)) {
    term_message("%s", error.text);
    return false;
  }
  out->start = mj_copyData(NULL, runner_model(out->runner), runner_data(out->runner));
  return out->start != NULL;
}

void bench_twin_close(bench_twin *twin) {
  if (twin->start) mj_deleteData(twin->start);
  runner_free(twin->runner);
}

int bench_twin_bare(const bench_twin *twin) {
  mjModel *m = runner_model(twin->runner);
  int flags = m->opt.disableflags;
  m->opt.disableflags |= mjDSBL_CONTACT | mjDSBL_SENSOR;
  return flags;
}

void bench_twin_restore(const bench_twin *twin, int flags) {
  runner_model(twin->runner)->opt.disableflags = flags;
}
