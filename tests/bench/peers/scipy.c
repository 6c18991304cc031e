// SPDX-License-Identifier: Apache-2.0
#include "scipy.h"

#include "sympy_bicycle.h"

#include <math.h>
#include <string.h>

static json_t *numbers(const double *values, size_t count) {
  json_t *array = json_array();
  for (size_t i = 0; i < count; i++) json_array_append_new(array, json_real(values[i]));
  return array;
}

bool scipy_load(python_peer *peer, const bench_subject *s, const double *end, bench_notes *notes) {
  enum { PARAMETERS = sizeof(sympy_bicycle) / sizeof(double), STATES = 5 };
  sympy_bicycle bicycle;
  if (!sympy_bicycle_init(&bicycle, &s->bicycle, &s->model))
    return bench_note_reason(notes, "the bicycle is not laterally symmetric");
  double parameters[PARAMETERS];
  memcpy(parameters, &bicycle, sizeof parameters);
  const bike_state *y = &s->ride_start;
  const double start[STATES] = {y->lean, y->steer, y->lean_rate, y->steer_rate, y->speed};
  json_t *answer = python_ask(
      peer,
      json_pack("{s:s, s:s, s:o, s:o, s:o, s:f}", "do", "load", "library", BENCH_FLOW_LIBRARY,
                "parameters", numbers(parameters, PARAMETERS), "start", numbers(start, STATES),
                "end", numbers(end, STATES), "duration", s->ride_time),
      notes);
  json_decref(answer);
  return answer != NULL;
}

static double number(const json_t *answer, const char *key) {
  const json_t *value = json_object_get(answer, key);
  return json_is_number(value) ? json_number_value(value) : NAN;
}

// The share of a ride's time that is spent in sympy's C; the rest is the integrator's and Python's.
static double share_in_c(const scipy_ride *ride, double evaluations) {
  enum { RIDES = 5, EVALUATIONS = 5000 };
  double one = python_seconds(ride->peer,
                              json_pack("{s:s, s:i}", "do", "evaluate", "repeats", EVALUATIONS)) /
               EVALUATIONS;
  return evaluations * one * RIDES / scipy_rides((void *)ride, RIDES);
}

bool scipy_tune(scipy_ride *ride, double error, bench_notes *notes) {
  json_t *answer = python_ask(
      ride->peer,
      json_pack("{s:s, s:s, s:f}", "do", "tune", "method", ride->method, "wanted", error), notes);
  if (!answer) return false;
  ride->tolerance = number(answer, "tolerance");
  double evaluations = number(answer, "evaluations");
  bench_note_check(notes, "their error", number(answer, "error"), error);
  bench_note_value(notes, "their tolerance", ride->tolerance);
  bench_note_value(notes, "their evaluations", evaluations);
  bench_note_value(notes, "their share in C", share_in_c(ride, evaluations));
  json_decref(answer);
  return true;
}

double scipy_rides(void *context, long repeats) {
  const scipy_ride *ride = context;
  return python_seconds(ride->peer,
                        json_pack("{s:s, s:s, s:f, s:I}", "do", "ride", "method", ride->method,
                                  "tolerance", ride->tolerance, "repeats", (json_int_t)repeats));
}
