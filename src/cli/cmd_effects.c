// SPDX-License-Identifier: Apache-2.0
// bicycle effects: what every parameter does to the weave and capsize speeds.
#include "commands.h"
#include "effects_list.h"
#include "terminal/command.h"
#include "terminal/data.h"
#include "terminal/json.h"
#include "terminal/number.h"
#include "terminal/table.h"

#include <bicycle/error.h>
#include <math.h>
#include <stdlib.h>

static const char example[] = "Example: bicycle effects roadster\n"
                              "         bicycle effects benchmark --json\n";

static const char documentation[] =
    "What the parameters do to the weave and capsize speeds of upright riding: the changes that "
    "Franke, Suhr and Riess (1990) list, with what is held fixed, and the exact derivatives with "
    "respect to every parameter of FILE. A file that carries uncertainties also gets those of "
    "the speeds (first order, parameters independent).";

typedef struct arguments {
  const char *file;
  double search[2]; // m/s  NaN: by the bicycle's size
  double speed;     // m/s  of the lean per rider offset; NaN: the middle of the stable range
  bool json;
} arguments;

enum { KEY_SEARCH = TERM_KEY_FIRST, KEY_SPEED, KEY_JSON };

static error_t parse(int key, char *text, struct argp_state *state) {
  arguments *args = state->input;
  switch (key) {
  case ARGP_KEY_INIT:
    state->child_inputs[0] = &args->file;
    return 0;
  case KEY_SEARCH:
    term_search_of(args->search, text);
    return 0;
  case KEY_SPEED:
    args->speed = term_number_of("--speed", text);
    return 0;
  case KEY_JSON:
    args->json = true;
    return 0;
  default:
    return ARGP_ERR_UNKNOWN;
  }
}

static const struct argp_option options[] = {
    {"search", KEY_SEARCH, "LO:HI", 0,
     "Where to look for critical speeds, m/s (0:40, of very small or large bicycles by their size)",
     1},
    {"speed", KEY_SPEED, "V", 0,
     "Speed of the lean per rider offset, m/s (the middle of the stable range)", 1},
    {"json", KEY_JSON, NULL, 0, "Print one JSON document", 8},
    {0},
};

static json_t *changes_json(const effects_list *list) {
  json_t *array = json_array();
  for (int i = 0; i < list->count; i++) {
    const effects_change *c = &list->changes[i];
    json_t *item = json_pack(
        "{s:s, s:s, s:s, s:o, s:o, s:o, s:o, s:o, s:o, s:o}", "parameter", c->name, "unit", c->unit,
        "held", c->held, "from", term_json_number(c->from), "to", term_json_number(c->to),
        "weave_speed", term_json_number(c->weave), "capsize_speed", term_json_number(c->capsize),
        "stable_ranges", term_json_matrix(c->ranges[0], (size_t)c->range_count, 2), "weave_slope",
        term_json_number(c->weave_slope), "capsize_slope", term_json_number(c->capsize_slope));
    if (c->error)
      json_object_set_new(item, "not_possible", json_string(bike_error_string(c->error)));
    json_array_append_new(array, item);
  }
  return array;
}

static json_t *parameters_json(const bike_effects *effects) {
  json_t *array = json_array();
  for (int i = 0; i < effects->count; i++) {
    const bike_parameter *p = &effects->parameters[i];
    json_array_append_new(array,
                          json_pack("{s:s, s:s, s:o, s:o, s:o, s:o}", "parameter", p->name, "unit",
                                    p->unit, "value", term_json_number(p->value), "uncertainty",
                                    term_json_number(p->sigma > 0 ? p->sigma : NAN), "weave_slope",
                                    term_json_number(p->weave), "capsize_slope",
                                    term_json_number(p->capsize)));
  }
  return array;
}

static bool print_json(const effects_list *list) {
  const bike_effects *e = &list->effects;
  bool uncertain = list->file.has_uncertainty;
  return term_json_write(
      json_pack("{s:s, s:o, s:o, s:o, s:o, s:{s:o, s:o}, s:o, s:o}", "bicycle",
                list->file.bicycle.name, "weave_speed", term_json_number(e->weave), "capsize_speed",
                term_json_number(e->capsize), "weave_uncertainty",
                term_json_number(uncertain ? e->weave_sigma : NAN), "capsize_uncertainty",
                term_json_number(uncertain ? e->capsize_sigma : NAN), "lean_per_offset", "speed",
                term_json_number(list->speed), "value", term_json_number(list->lean_per_offset),
                "effects", changes_json(list), "parameters", parameters_json(e)),
      stdout);
}

typedef char cell[48];

static const char *speed_text(cell out, double value) {
  if (isnan(value)) return "none";
  snprintf(out, sizeof(cell), "%.4f", value);
  return out;
}

static const char *slope_text(cell out, double value) {
  if (isnan(value)) return "";
  snprintf(out, sizeof(cell), "%+.5g", value + 0.0); // no negative zero
  return out;
}

static const char *value_text(cell out, double value) {
  snprintf(out, sizeof(cell), "%.5g", value);
  return out;
}

static bool print_changes(const effects_list *list) {
  static const term_column columns[] = {
      {"change", TERM_LEFT},   {"from", TERM_RIGHT},      {"to", TERM_RIGHT},
      {"unit", TERM_LEFT},     {"weave m/s", TERM_RIGHT}, {"capsize m/s", TERM_RIGHT},
      {"d weave", TERM_RIGHT}, {"d capsize", TERM_RIGHT}, {"held fixed", TERM_LEFT}};
  term_table *table = term_table_create(columns, 9);
  for (int i = 0; i < list->count; i++) {
    const effects_change *c = &list->changes[i];
    cell text[6];
    if (c->error)
      term_table_add(
          table, TERM_DIM,
          (const char *const[]){c->name, "", "", "", "", "", "", "", bike_error_string(c->error)});
    else
      term_table_add(table, TERM_PLAIN,
                     (const char *const[]){
                         c->name, value_text(text[0], c->from), value_text(text[1], c->to), c->unit,
                         speed_text(text[2], c->weave), speed_text(text[3], c->capsize),
                         slope_text(text[4], c->weave_slope), slope_text(text[5], c->capsize_slope),
                         c->held});
  }
  bool printed = term_table_print(table, stdout);
  term_table_free(table);
  return printed;
}

static bool print_parameters(const bike_effects *effects) {
  static const term_column columns[] = {{"parameter", TERM_LEFT},    {"value", TERM_RIGHT},
                                        {"uncertainty", TERM_RIGHT}, {"unit", TERM_LEFT},
                                        {"d weave", TERM_RIGHT},     {"d capsize", TERM_RIGHT}};
  term_table *table = term_table_create(columns, 6);
  for (int i = 0; i < effects->count; i++) {
    const bike_parameter *p = &effects->parameters[i];
    cell text[4];
    term_table_add(table, TERM_PLAIN,
                   (const char *const[]){p->name, value_text(text[0], p->value),
                                         p->sigma > 0 ? value_text(text[1], p->sigma) : "", p->unit,
                                         slope_text(text[2], p->weave),
                                         slope_text(text[3], p->capsize)});
  }
  bool printed = term_table_print(table, stdout);
  term_table_free(table);
  return printed;
}

static void print_speed(const char *name, double speed, double sigma, bool uncertain) {
  cell text;
  printf("%-13s %s", name, speed_text(text, speed));
  if (uncertain && !isnan(speed)) printf(" +/- %.4f", sigma);
  puts(isnan(speed) ? "" : " m/s");
}

static bool print_tables(const effects_list *list) {
  const bike_effects *e = &list->effects;
  bool uncertain = list->file.has_uncertainty;
  printf("%s, riding straight and upright\n\n", list->file.bicycle.name);
  print_speed("weave speed", e->weave, e->weave_sigma, uncertain);
  print_speed("capsize speed", e->capsize, e->capsize_sigma, uncertain);
  if (!isnan(list->lean_per_offset))
    printf("lean per offset of the rider at %.4f m/s: %.4f deg/cm\n", list->speed,
           list->lean_per_offset * (180 / M_PI) / 100);
  puts("\nChanges; d weave, d capsize: exact derivatives, m/s per unit\n");
  if (!print_changes(list)) return false;
  puts("\nEvery parameter, the others of this list held\n");
  return print_parameters(e);
}

int cmd_effects(int argc, char **argv) {
  const struct argp_child children[] = {{&term_file_argp, 0, NULL, 0}, {0}};
  const struct argp argp = {options, parse, "FILE", documentation, children, NULL, NULL};
  arguments args = {.search = {NAN, NAN}, .speed = NAN};
  term_parse(&argp, example, argc, argv, &args);

  effects_list *list = calloc(1, sizeof *list);
  if (!list) return term_fail_bike(BIKE_ERROR_MEMORY, args.file);
  term_exit code = term_load_file(&list->file, args.file);
  if (code == TERM_DONE) {
    int error = effects_list_make(list, isnan(args.search[0]) ? NULL : args.search, args.speed);
    if (!error && !(args.json ? print_json(list) : print_tables(list))) error = BIKE_ERROR_MEMORY;
    if (error) code = term_fail_bike(error, args.file);
  }
  free(list);
  return code;
}
