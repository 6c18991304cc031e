// SPDX-License-Identifier: Apache-2.0
#include "twin.h"

#include "terminal/message.h"

// Some warnings are expected, for the search for a step starts where steps are too long; what comes
// of that shows in the error of the ride, and MuJoCo would write a log file.
static void unheard(const char *text) {
  (void)text;
}

bool bench_twin_open(bench_twin *out, const bike_bicycle *bicycle, const bike_state *state) {
  *out = (bench_twin){0};
  mju_user_warning = unheard;
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
