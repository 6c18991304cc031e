// SPDX-License-Identifier: Apache-2.0
// L5: how far an unstable ride can be predicted, and whether it parts as fast as its linear theory
// says. Up to that time layer L2 judges; what comes after is information.
#include "layer.h"

#include <math.h>
#include <stdio.h>

static void add(comparison *c, const char *signal, const char *metric, const char *unit,
                double value) {
  measurement m = measurement_of(layer_horizon.name, signal, metric, unit);
  m.value = value;
  if (*c->study.horizon.signal)
    measurement_detail(&m, "a twin off by %.3g rad uses up its share in %s first",
                       c->study.horizon.disturbance, c->study.horizon.signal);
  measurement_add(&c->measurements, &m);
}

static term_exit measure(comparison *c, problem *p) {
  const study_horizon *h = &c->study.horizon;
  if (!c->scenario->horizon.asked) return TERM_DONE;
  term_exit code = comparison_ride(c, p);
  if (code != TERM_DONE) return code;
  add(c, "horizon", "time", "s", h->time);
  add(c, "divergence", "exponent", "1/s", h->exponent);
  add(c, "divergence", "exponent_error", "1/s", fabs(h->exponent - h->eigenvalue));
  // A scenario that is judged for a moment only says nothing: a limit can forbid that.
  add(c, "horizon", "lost_share", "", 1 - h->time / c->scenario->duration);
  return TERM_DONE;
}

static bool knows(const char *signal, const char *metric) {
  static const char *const divergence[] = {"divergence", NULL}, *const horizon[] = {"horizon",
                                                                                    NULL};
  static const char *const of_divergence[] = {"exponent", "exponent_error", NULL};
  static const char *const of_horizon[] = {"lost_share", NULL};
  if (layer_names(of_divergence, metric)) return !signal || layer_names(divergence, signal);
  return layer_names(of_horizon, metric) && (!signal || layer_names(horizon, signal));
}

const layer layer_horizon = {
    .name = "L5",
    .title = "horizon",
    .agreed = "the rides part as the linear theory says",
    .failure = "the rides part otherwise than the linear theory says",
    .knows = knows,
    .measure = measure,
};
