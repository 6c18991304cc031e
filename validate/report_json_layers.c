// SPDX-License-Identifier: Apache-2.0
#include "report_json_layers.h"

#include "terminal/json.h"

#include <stdio.h>

//---------------------------------- L1 ------------------------------------------------------------

static json_t *eigenvalues_json(const bike_eigenvalues *e) {
  json_t *array = json_array();
  for (int i = 0; i < 4; i++)
    json_array_append_new(
        array, json_pack("[o, o]", term_json_number(e->re[i]), term_json_number(e->im[i])));
  return array;
}

static json_t *critical_json(const bike_critical_speeds *s) {
  return json_pack("{s:o, s:o}", "weave_speeds",
                   term_json_numbers(s->weave, (size_t)s->weave_count), "capsize_speeds",
                   term_json_numbers(s->capsize, (size_t)s->capsize_count));
}

static json_t *linear_json(const study_linear *study) {
  json_t *points = json_array();
  for (int k = 0; k < study->count; k++) {
    const study_modes *m = &study->modes[k];
    json_array_append_new(points,
                          json_pack("{s:o, s:o, s:o, s:o}", "speed", term_json_number(m->speed),
                                    "reference", eigenvalues_json(&m->engine[REFERENCE]),
                                    "candidate", eigenvalues_json(&m->engine[CANDIDATE]), "error",
                                    term_json_number(m->error)));
  }
  return json_pack("{s:o, s:o, s:o}", "points", points, "reference",
                   critical_json(&study->speed[REFERENCE]), "candidate",
                   critical_json(&study->speed[CANDIDATE]));
}

//---------------------------------- L4 ------------------------------------------------------------

static json_t *points_json(const study_convergence *study, int signal) {
  json_t *points = json_array();
  for (int i = 0; i < study->count; i++) {
    const study_point *point = &study->point[i];
    json_array_append_new(
        points, json_pack("{s:o, s:o, s:I, s:I}", "timestep", term_json_number(point->step),
                          "error", term_json_number(point->error[signal]), "steps",
                          (json_int_t)point->steps, "evaluations", (json_int_t)point->evaluations));
  }
  return points;
}

static json_t *signal_json(const comparison *c, int index) {
  const study_convergence *study = &c->study.convergence;
  const study_signal *s = &study->signal[index];
  const scenario_convergence *asked = &c->scenario->convergence;
  study_verdict expected = asked->different ? STUDY_DIFFERENT : STUDY_SAME;
  json_t *object = json_pack(
      "{s:s, s:s, s:s, s:s, s:s, s:b, s:o, s:o, s:o}", "signal", study_signals[index], "engine",
      c->side[CANDIDATE].label, "unit", "rad", "verdict", study_verdict_string(s->verdict),
      "expected_verdict", study_verdict_string(expected), "complete", study->complete, "order",
      term_json_number(s->order), "expected_order", term_json_number(study->order), "scatter",
      term_json_number(s->scatter));
  json_object_set_new(object, "first_power", term_json_number(s->power));
  json_object_set_new(object, "plateau", term_json_number(s->plateau));
  json_object_set_new(object, "plateau_time", term_json_number(s->plateau_time));
  json_object_set_new(object, "uncertainty", term_json_number(s->uncertainty));
  json_object_set_new(object, "tolerance", term_json_number(asked->tolerance));
  json_object_set_new(object, "terms", json_integer(study->terms));
  json_object_set_new(object, "points", points_json(study, index));
  return object;
}

static json_t *convergence_json(const comparison *c) {
  json_t *array = json_array();
  for (int s = 0; s < STUDY_SIGNALS; s++) json_array_append_new(array, signal_json(c, s));
  return array;
}

//---------------------------------- L5, L6 --------------------------------------------------------

static json_t *horizon_json(const study_horizon *h, double share) {
  return json_pack("{s:o, s:o, s:o, s:o, s:o, s:o}", "time", term_json_number(h->time), "signal",
                   *h->signal ? json_string(h->signal) : json_null(), "share",
                   term_json_number(share), "disturbance", term_json_number(h->disturbance),
                   "exponent", term_json_number(h->exponent), "eigenvalue",
                   term_json_number(h->eigenvalue));
}

static json_t *cost_point(const char *setting, long steps, long evaluations, double error) {
  return json_pack("{s:s, s:I, s:I, s:o}", "setting", setting, "steps", (json_int_t)steps, "cost",
                   (json_int_t)evaluations, "error", term_json_number(error));
}

// What is the same in every run, cost in right-hand sides; seconds stand among the timings. The
// candidate's steps of the convergence study are points too.
static json_t *cost_side_json(const comparison *c, int side) {
  const study_cost *cost = &c->study.cost;
  const study_convergence *convergence = &c->study.convergence;
  json_t *points = json_array();
  for (int i = 0; i < cost->count; i++) {
    const study_run *run = &cost->run[i];
    if (run->side == side)
      json_array_append_new(points,
                            cost_point(run->setting, run->steps, run->evaluations, run->error));
  }
  for (int i = 0; side == CANDIDATE && i < convergence->count; i++) {
    const study_point *point = &convergence->point[i];
    char setting[64];
    snprintf(setting, sizeof setting, "timestep %g", point->step);
    json_array_append_new(points,
                          cost_point(setting, point->steps, point->evaluations, point->error[0]));
  }
  return json_pack("{s:s, s:s, s:i, s:o}", "engine", c->side[side].label, "label", "lean",
                   "repeats", cost->repeats, "points", points);
}

static json_t *cost_json(const comparison *c) {
  return json_pack("[o, o]", cost_side_json(c, REFERENCE), cost_side_json(c, CANDIDATE));
}

void report_add_layers(json_t *object, const comparison *c) {
  const study_results *s = &c->study;
  if (s->linear.count) json_object_set_new(object, "linear", linear_json(&s->linear));
  if (s->convergence.count) json_object_set_new(object, "convergence", convergence_json(c));
  if (s->horizon.asked)
    json_object_set_new(object, "horizon", horizon_json(&s->horizon, c->scenario->horizon.share));
  if (s->cost.count) json_object_set_new(object, "cost", cost_json(c));
}

void report_add_timings(json_t *ride, const comparison *c) {
  const study_convergence *convergence = &c->study.convergence;
  const study_cost *cost = &c->study.cost;
  double duration = c->scenario->duration;
  json_t *points = json_array(), *processor = json_array(), *runs = json_array();
  for (int i = 0; i < convergence->count; i++) {
    json_array_append_new(points, term_json_number(convergence->point[i].wall_time));
    json_array_append_new(processor, term_json_number(convergence->point[i].cpu_time));
  }
  for (int i = 0; i < cost->count; i++) {
    const study_run *run = &cost->run[i];
    json_array_append_new(
        runs, json_pack("{s:o, s:o, s:o, s:o, s:o, s:o}", "median", term_json_number(run->median),
                        "low", term_json_number(run->low), "high", term_json_number(run->high),
                        "cpu", term_json_number(run->cpu), "real_time_factor",
                        term_json_number(duration / run->median), "steps_per_second",
                        term_json_number((double)run->steps / run->median)));
  }
  if (convergence->count) {
    json_object_set(ride, "convergence", points);
    json_object_set(ride, "convergence_cpu", processor);
  }
  if (cost->count) json_object_set(ride, "cost", runs);
  json_decref(points);
  json_decref(processor);
  json_decref(runs);
}
