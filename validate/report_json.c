// SPDX-License-Identifier: Apache-2.0
// report.json. Everything that differs between two runs of the same program on the same machine
// stands in provenance.created and provenance.timings.
#include "report.h"

#include "layer.h"
#include "report_counts.h"
#include "report_json_layers.h"
#include "terminal/command.h"
#include "terminal/json.h"
#include "terminal/message.h"

#include <math.h>
#include <string.h>

verdict report_verdict(const report *r) {
  verdict worst = VERDICT_AGREE;
  bool differ = r->count > 0;
  for (size_t i = 0; i < r->count; i++) {
    differ = differ && r->comparisons[i].verdict == VERDICT_DIFFER;
    if (r->comparisons[i].verdict > VERDICT_DIFFER && r->comparisons[i].verdict > worst)
      worst = r->comparisons[i].verdict;
  }
  return differ ? VERDICT_DIFFER : worst;
}

const comparison *report_first_failure(const report *r) {
  verdict worst = report_verdict(r);
  for (size_t i = 0; worst > VERDICT_DIFFER && i < r->count; i++)
    if (r->comparisons[i].verdict == worst) return &r->comparisons[i];
  return NULL;
}

static json_t *text_or_null(const char *text) {
  return text && *text ? term_json_text(text) : json_null();
}

static json_t *first_failure_json(const comparison *c) {
  return text_or_null(c && c->first_failure ? c->first_failure->name : NULL);
}

static json_t *measurement_json(const measurement *m) {
  char name[MEASUREMENT_FULL_NAME];
  json_t *object = json_pack("{s:s, s:s, s:s, s:o, s:s}", "layer", m->layer, "signal",
                             measurement_full_name(name, m), "metric", m->metric, "value",
                             term_json_number(m->value), "unit", m->unit);
  if (m->from > 0) json_object_set_new(object, "from", term_json_number(m->from));
  if (m->to > 0) json_object_set_new(object, "to", term_json_number(m->to));
  if (isfinite(m->time)) json_object_set_new(object, "time", term_json_number(m->time));
  if (*m->detail) json_object_set_new(object, "detail", json_string(m->detail));
  return object;
}

static json_t *gate_json(const gate *g) {
  json_t *object = measurement_json(&g->what);
  json_object_set_new(object, "limit", term_json_number(g->rule->limit));
  json_object_set_new(object, "pass", json_boolean(g->pass));
  json_object_set_new(object, "reason", json_string(g->rule->reason));
  return object;
}

static json_t *gates_json(const gate_list *gates) {
  json_t *array = json_array();
  for (size_t i = 0; i < gates->count; i++)
    json_array_append_new(array, gate_json(&gates->items[i]));
  return array;
}

static bool is_judged(const measurement *m, const gate_list *gates) {
  for (size_t i = 0; i < gates->count; i++)
    if (measurement_is_like(&gates->items[i].what, m)) return true;
  return false;
}

// What was measured without a limit.
static json_t *information_json(const comparison *c) {
  json_t *array = json_array();
  for (size_t i = 0; i < c->measurements.count; i++)
    if (!is_judged(&c->measurements.items[i], &c->gates))
      json_array_append_new(array, measurement_json(&c->measurements.items[i]));
  return array;
}

static json_t *options_json(const engine_choice *choice) {
  json_t *object = json_object();
  if (choice->engine->plays_file) json_object_set_new(object, "file", term_json_text(choice->file));
  for (int i = 0; i < choice->engine->option_count; i++) {
    const engine_option *option = &choice->engine->options[i];
    json_t *value = option->choices ? json_string(option->choices[(int)choice->option[i]])
                                    : term_json_number(choice->option[i]);
    json_object_set_new(object, option->name, value);
  }
  return object;
}

static json_t *engine_json(const comparison_side *side, const engine_choice *choice,
                           const char *role) {
  const engine *e = side->engine;
  const trace *t = &side->trace;
  char version[ENGINE_VERSION_SIZE], hash[ENGINE_HASH_SIZE] = "";
  e->version(version);
  if (e->model_hash) e->model_hash(hash, side->instance);
  json_t *object = json_pack("{s:s, s:s, s:s, s:o, s:s, s:o}", "role", role, "engine", e->name,
                             "label", side->label, "options", options_json(choice), "version",
                             version, "model_sha256", text_or_null(hash));
  if (t->count == 0) return object;
  json_object_set_new(object, "rows", json_integer((json_int_t)t->count));
  json_object_set_new(object, "steps", json_integer(t->steps));
  json_object_set_new(object, "end_time", term_json_number(t->end_time));
  json_object_set_new(object, "ended_by", text_or_null(trace_ending(t)));
  return object;
}

// What acts on the bicycle; NULL: hands off.
static json_t *input_json(const scenario_input *input) {
  if (!scenario_has_input(input)) return NULL;
  if (input->table) return json_pack("{s:s, s:s}", "file", input->name, "sha256", input->sha256);
  return json_pack("{s:o, s:o}", "steer_torque", term_json_number(input->steer_torque),
                   "roll_torque", term_json_number(input->roll_torque));
}

static json_t *setup_json(const comparison *c) {
  const scenario *s = c->scenario;
  const scenario_instants *i = &s->instants;
  json_t *start = json_object();
  const double values[] = {s->start.lean, s->start.steer, s->start.lean_rate, s->start.steer_rate,
                           s->start.speed};
  static const char *const names[] = {"lean", "steer", "lean_rate", "steer_rate", "speed"};
  for (int k = 0; k < 5; k++) json_object_set_new(start, names[k], term_json_number(values[k]));
  json_t *instants =
      json_pack("{s:i, s:I, s:o, s:o, s:o, s:o, s:o}", "count", i->count, "seed",
                (json_int_t)i->seed, "lean", term_json_number(i->lean), "steer",
                term_json_number(i->steer), "rate", term_json_number(i->rate), "slow",
                term_json_number(i->slow), "fast", term_json_number(i->fast));
  return json_pack("{s:o, s:o, s:o, s:o, s:o, s:o*}", "start", start, "duration",
                   term_json_number(s->duration), "sample", term_json_number(s->sample),
                   "growth_rate", term_json_number(c->growth_rate), "instants", instants, "input",
                   input_json(&s->input));
}

static json_t *scenario_json(const comparison *c) {
  const scenario *s = c->scenario;
  char hash[SHA256_HEX_SIZE], files[REPORT_FILES_PER_SCENARIO][REPORT_FILE_NAME];
  if (!provenance_bicycle_hash(hash, &s->bicycle)) return NULL;
  report_file_names(files, c);
  json_t *engines = json_array();
  json_array_append_new(engines, engine_json(&c->side[REFERENCE], &s->reference, "reference"));
  json_array_append_new(engines, engine_json(&c->side[CANDIDATE], &s->candidate, "candidate"));
  json_t *object = json_pack(
      "{s:s, s:s, s:s, s:s, s:o, s:o, s:o, s:o, s:s, s:o, s:o, s:[s, s, s]}", "name", s->name,
      "title", s->title, "bicycle", s->bicycle_name, "verdict", verdict_string(c->verdict),
      "first_failure", first_failure_json(c), "cause", text_or_null(c->cause), "setup",
      setup_json(c), "engines", engines, "parameter_sha256", hash, "gates", gates_json(&c->gates),
      "information", information_json(c), "files", files[0], files[1], files[2]);
  report_add_layers(object, c);
  return object;
}

static json_t *timings_json(const report *r) {
  json_t *rides = json_array();
  for (size_t i = 0; i < r->count; i++) {
    const comparison *c = &r->comparisons[i];
    json_t *ride = json_pack("{s:s}", "scenario", c->scenario->name);
    for (int k = 0; k < 2; k++)
      json_object_set_new(ride, c->side[k].label, term_json_number(c->side[k].trace.wall_time));
    report_add_timings(ride, c);
    json_array_append_new(rides, ride);
  }
  return json_pack("{s:o, s:o}", "elapsed", term_json_number(r->provenance.elapsed), "rides",
                   rides);
}

static json_t *provenance_json(const report *r) {
  return json_pack("{s:s, s:s, s:s, s:s, s:o, s:s, s:o}", "project", term_version(), "compiler",
                   provenance_compiler(), "cpu", r->provenance.cpu, "convention", "iso", "command",
                   term_json_text(r->provenance.command), "created", r->provenance.created,
                   "timings", timings_json(r));
}

static json_t *files_json(const report *r) {
  json_t *array = json_array();
  for (int i = 0; i < REPORT_VIEWS; i++)
    json_array_append_new(array, json_string(report_view_name(i)));
  for (size_t i = 0; i < r->count; i++) {
    char names[REPORT_FILES_PER_SCENARIO][REPORT_FILE_NAME];
    report_file_names(names, &r->comparisons[i]);
    for (int k = 0; k < REPORT_FILES_PER_SCENARIO; k++)
      json_array_append_new(array, json_string(names[k]));
  }
  return array;
}

json_t *report_document(const report *r) {
  const comparison *failure = report_first_failure(r);
  json_t *scenarios = json_array();
  for (size_t i = 0; i < r->count; i++)
    json_array_append_new(scenarios, scenario_json(&r->comparisons[i]));
  const bool whole = json_array_size(scenarios) == r->count;
  json_t *document =
      json_pack("{s:s, s:i, s:s, s:o, s:o, s:o, s:o, s:o, s:o}", "schema", REPORT_SCHEMA, "version",
                REPORT_VERSION, "verdict", verdict_string(report_verdict(r)), "first_failure",
                first_failure_json(failure), "cause", text_or_null(failure ? failure->cause : NULL),
                "counts", report_counts(scenarios), "scenarios", scenarios, "provenance",
                provenance_json(r), "files", files_json(r));
  if (whole && !term_has_lost()) return document;
  json_decref(document);
  return NULL;
}
