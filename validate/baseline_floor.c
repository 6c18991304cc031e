// SPDX-License-Identifier: Apache-2.0
// Noise floors: from the scenario's own convergence study where it has one, from the rounding of
// double elsewhere. None is a share of the value.
#include "baseline.h"

#include "report_read.h"

#include <float.h>
#include <math.h>
#include <string.h>

// Steps of the engine that takes more of them.
static double most_steps(const json_t *entry) {
  size_t i;
  const json_t *player;
  double most = 1;
  json_array_foreach(json_object_get(entry, "engines"), i, player) {
    most = fmax(most, report_real(player, "steps"));
  }
  return most;
}

// The size of a signal: x, y and wheel angles grow with the way, all else is of order 1 in SI.
static double signal_size(const json_t *setup, const char *signal) {
  static const char *const far[] = {"x", "y", "rear_angle", "front_angle"};
  double way =
      report_real(setup, "duration") * report_real(json_object_get(setup, "start"), "speed");
  for (size_t i = 0; i < sizeof far / sizeof *far; i++)
    if (strcmp(signal, far[i]) == 0) return fmax(1, way);
  return 1;
}

// One rounding a step adds up like a random walk; an unstable ride amplifies it.
static double walk_floor(const json_t *entry, const report_gate *g) {
  const json_t *setup = json_object_get(entry, "setup");
  double growth = report_real(setup, "growth_rate") * report_real(setup, "duration");
  bool divided_out = strcmp(g->metric, "scaled_max") == 0;
  return DBL_EPSILON * sqrt(most_steps(entry)) * signal_size(setup, g->signal) *
         exp(divided_out || isnan(growth) ? 0 : growth);
}

// The convergence study of a signal; NULL if there is none.
static const json_t *study_of(const json_t *entry, const char *signal) {
  size_t i;
  const json_t *study;
  json_array_foreach(json_object_get(entry, "convergence"), i, study) {
    if (strcmp(report_text(study, "signal"), signal) == 0) return study;
  }
  return NULL;
}

static double study_floor(const char **source, const json_t *study, const report_gate *g) {
  *source = "convergence study";
  // An order is the slope of a line; how far the points lie off it is what it may err by.
  if (strncmp(g->metric, "order", 5) == 0) return report_real(study, "scatter");
  return report_real(study, "uncertainty");
}

double baseline_floor(const char **source, const json_t *entry, size_t index) {
  report_gate g = report_gate_at(entry, index);
  const json_t *study = study_of(entry, g.signal);
  double rounding;
  *source = "rounding";
  if (strcmp(g.layer, "Lp") == 0) {
    rounding = 1e3 * DBL_EPSILON; // some hundred roundings of MuJoCo's compiler
  } else if (strcmp(g.layer, "L0") == 0) {
    rounding = 1e4 * DBL_EPSILON; // linear systems with condition numbers of some thousand
  } else if (strcmp(g.layer, "L1") == 0) {
    rounding = pow(DBL_EPSILON, 2.0 / 3); // what central differences can reach
  } else if (strcmp(g.layer, "L5") == 0) {
    *source = "unpredictable: doubling is noise";
    return fabs(report_real(
        json_object_get(json_array_get(json_object_get(entry, "gates"), index), "baseline"),
        "value"));
  } else {
    rounding = walk_floor(entry, &g);
  }
  double studied = study ? study_floor(source, study, &g) : NAN;
  return fmax(rounding, studied); // fmax skips a NaN
}
