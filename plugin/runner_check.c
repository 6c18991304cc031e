// SPDX-License-Identifier: Apache-2.0
// Whether what MuJoCo has just computed means anything, and its names for when it does not.
#include "runner_guard.h"
#include "runner_internal.h"

#include <math.h>

const char *runner_status_string(runner_status status) {
  switch (status) {
#define RUNNER_STATUS_TEXT(code, text)                                                             \
  case code:                                                                                       \
    return text;
    RUNNER_STATUSES(RUNNER_STATUS_TEXT)
#undef RUNNER_STATUS_TEXT
  }
  return "unknown status";
}

int runner_exit_code(runner_status status) {
  if (status == RUNNER_OK) return 0;
  return status == RUNNER_MEMORY || status >= RUNNER_INVALID_ERROR ? 3 : 2;
}

roll_error runner_check_marker(const mjModel *m, mjcf_error *error) {
  roll_object where;
  roll_error code = roll_check(&where, m);
  if (code != ROLL_OK) roll_fault_string(error->text, sizeof error->text, code, where, m);
  return code;
}

bool runner_discs_roll(const roll_disc *discs, int count, double time, mjcf_error *error) {
  for (int i = 0; i < count; i++)
    if (discs[i].error)
      return mjcf_fail(error, "'%s' at %.6g s: %s", discs[i].name, time,
                       roll_error_string(discs[i].error));
  return true;
}

static runner_status fail(mjcf_error *error, runner_status status, double time, const char *more) {
  mjcf_fail(error, "%s at %.6g s%s%s", runner_status_string(status), time, *more ? ": " : "", more);
  return status;
}

static bool is_finite_state(const mjModel *m, const mjData *d) {
  for (int i = 0; i < m->nq; i++)
    if (!isfinite(d->qpos[i])) return false;
  for (int i = 0; i < m->nv; i++)
    if (!isfinite(d->qvel[i]) || !isfinite(d->qacc[i])) return false;
  return true;
}

static const char *first_of_counters(const mjData *d) {
  for (int i = 0; i < mjNWARNING; i++)
    if (d->warning[i].number) return mju_warningText(i, d->warning[i].lastinfo);
  return NULL;
}

static const char *first_warning(const mjData *d, const guard_report *report) {
  // Only the first warning of each kind in the life of a mjData is said aloud.
  return report->warnings ? report->warning : first_of_counters(d);
}

runner_status runner_check_any(const mjModel *m, const mjData *d, const guard_report *report,
                               mjcf_error *error) {
  if (report->failed) return fail(error, RUNNER_INVALID_ERROR, d->time, report->error);
  if (!roll_is_installed()) return fail(error, RUNNER_INVALID_CALLBACK, d->time, "");
  const char *warning = first_of_counters(d);
  if (warning) return fail(error, RUNNER_INVALID_WARNING, d->time, warning);
  return is_finite_state(m, d) ? RUNNER_OK : fail(error, RUNNER_INVALID_NOT_FINITE, d->time, "");
}

runner_status runner_check_time(const mjData *d, double from, double step, mjcf_error *error) {
  // A reset puts the time back to zero; rounding is a millionth of this.
  if (fabs(d->time - from - step) <= 1e-6 * step) return RUNNER_OK;
  mjcf_fail(error, "%s (from %.6g s)", runner_status_string(RUNNER_INVALID_TIME), from);
  return RUNNER_INVALID_TIME;
}

runner_status runner_check(const runner *r, const mjData *d, const guard_report *report, int stages,
                           mjcf_error *error) {
  if (report->failed) return fail(error, RUNNER_INVALID_ERROR, d->time, report->error);
  if (!roll_is_installed()) return fail(error, RUNNER_INVALID_CALLBACK, d->time, "");
  if (r->refused != RUNNER_OK) return fail(error, r->refused, d->time, "");
  const char *warning = first_warning(d, report);
  if (warning) return fail(error, RUNNER_INVALID_WARNING, d->time, warning);
  // Without a warning, after which MuJoCo may begin anew: not called as often as the integrator has
  // stages, somebody took ours out of the chain.
  if (r->stages != stages) return fail(error, RUNNER_INVALID_CALLBACK, d->time, "");
  if (!is_finite_state(r->model, d)) return fail(error, RUNNER_INVALID_NOT_FINITE, d->time, "");
  return RUNNER_OK;
}
