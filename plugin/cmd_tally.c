// SPDX-License-Identifier: Apache-2.0
#include "cmd_tally.h"

#include "terminal/message.h"

#include <math.h>
#include <stdlib.h>

//---------------------------------- discs ---------------------------------------------------------

static void keep_largest(double *largest, double value) {
  if (!(value <= *largest)) *largest = value;
}

void cmd_disc_take(cmd_disc *disc, double slip, double height) {
  keep_largest(&disc->slip, fabs(slip));
  keep_largest(&disc->height, fabs(height));
}

void cmd_disc_lift(cmd_disc *disc, double time) {
  if (disc->lift_count < CMD_MOST_LIFTS) disc->lifts[disc->lift_count] = time;
  disc->lift_count++;
  bike_spells_set(&disc->ground.lifted, true, time);
}

void cmd_disc_press(cmd_disc *disc, double time, const double force[3], double normal,
                    double friction_limit) {
  double square = force[0] * force[0] + force[1] * force[1] + force[2] * force[2];
  const double parts[3] = {sqrt(fmax(0, square - normal * normal)), 0, normal};
  bike_ground_look(&disc->ground, time, parts);
  bike_spells_set(&disc->ground.lifted, !(normal > 0), time);
  bike_spells_set(&disc->ground.no_grip, !(bike_grip(parts, friction_limit) > 0), time);
}

static int kept(const cmd_disc *disc) {
  return disc->lift_count < CMD_MOST_LIFTS ? disc->lift_count : CMD_MOST_LIFTS;
}

json_t *cmd_discs_json(const cmd_disc *discs, int count) {
  json_t *array = json_array();
  for (int i = 0; i < count; i++)
    json_array_append_new(array,
                          json_pack("{s:s, s:o, s:o, s:o, s:o}", "name", discs[i].name, "lifts",
                                    term_json_numbers(discs[i].lifts, (size_t)kept(&discs[i])),
                                    "friction", term_json_number(discs[i].ground.friction), "slip",
                                    term_json_number(discs[i].slip), "height_error",
                                    term_json_number(discs[i].height)));
  return array;
}

void cmd_discs_tell(const cmd_disc *discs, int count) {
  for (int i = 0; i < count; i++) {
    char lifts[64] = "never lifts";
    if (discs[i].lift_count > 0)
      snprintf(lifts, sizeof lifts, "lifts %d time%s, first at %.6g s", discs[i].lift_count,
               discs[i].lift_count == 1 ? "" : "s", discs[i].lifts[0]);
    char friction[32];
    term_friction_text(friction, discs[i].ground.friction);
    term_message("%s: %s; asks friction %s; slip %.1e m/s, height error %.1e m", discs[i].name,
                 lifts, friction, discs[i].slip, discs[i].height);
  }
}

static term_outside outside_of(const cmd_disc *disc, const term_limits *limits) {
  term_outside out = {0};
  term_outside_ride(&out, disc->name, true, &disc->ground, limits);
  return out;
}

json_t *cmd_discs_outside_json(const cmd_disc *discs, int count, const term_limits *limits) {
  json_t *all = json_array();
  for (int i = 0; i < count; i++) {
    const term_outside outside = outside_of(&discs[i], limits);
    json_t *list = term_outside_json(&outside);
    json_array_extend(all, list);
    json_decref(list);
  }
  return all;
}

void cmd_discs_outside_tell(const cmd_disc *discs, int count, const term_limits *limits) {
  for (int i = 0; i < count; i++) {
    const term_outside outside = outside_of(&discs[i], limits);
    for (int k = 0; k < outside.count; k++) {
      char text[TERM_OUTSIDE_SIZE];
      term_outside_text(text, &outside.items[k]);
      term_message("outside physics: %s", text);
    }
  }
}

//---------------------------------- sensors -------------------------------------------------------

bool cmd_sensors_begin(cmd_sensors *out, const mjModel *model) {
  size_t count = (size_t)model->nsensordata + 1;
  *out = (cmd_sensors){.model = model};
  out->least = (double *)calloc(3 * count, sizeof *out->least);
  if (!out->least) return false;
  out->most = out->least + count;
  out->last = out->most + count;
  return true;
}

void cmd_sensors_free(cmd_sensors *sensors) {
  free(sensors->least);
  *sensors = (cmd_sensors){0};
}

void cmd_sensors_take(cmd_sensors *sensors, const double *data) {
  if (!sensors->model) return;
  for (int i = 0; i < sensors->model->nsensordata; i++) {
    if (!sensors->any || !(data[i] >= sensors->least[i])) sensors->least[i] = data[i];
    if (!sensors->any || !(data[i] <= sensors->most[i])) sensors->most[i] = data[i];
    sensors->last[i] = data[i];
  }
  sensors->any = true;
}

const char *cmd_sensor_name(char out[CMD_NAME_SIZE], const mjModel *model, int sensor) {
  const char *name = mj_id2name(model, mjOBJ_SENSOR, sensor);
  if (name && *name) return name;
  snprintf(out, CMD_NAME_SIZE, "sensor%d", sensor);
  return out;
}

static json_t *numbers_json(const double *data, int count) {
  return count == 1 ? term_json_number(*data) : term_json_numbers(data, (size_t)count);
}

json_t *cmd_sensors_json(const cmd_sensors *sensors) {
  json_t *object = json_object();
  const mjModel *m = sensors->model;
  char name[CMD_NAME_SIZE];
  for (int i = 0; m && sensors->any && i < m->nsensor; i++) {
    int from = m->sensor_adr[i], count = m->sensor_dim[i];
    json_object_set_new(object, cmd_sensor_name(name, m, i),
                        json_pack("{s:o, s:o, s:o}", "least",
                                  numbers_json(sensors->least + from, count), "most",
                                  numbers_json(sensors->most + from, count), "end",
                                  numbers_json(sensors->last + from, count)));
  }
  return object;
}

void cmd_sensors_tell(const cmd_sensors *sensors) {
  const mjModel *m = sensors->model;
  char name[CMD_NAME_SIZE];
  if (m && m->nsensor == 0) term_message("the model has no sensors");
  for (int i = 0; m && sensors->any && i < m->nsensor; i++)
    for (int k = 0; k < m->sensor_dim[i]; k++) {
      int at = m->sensor_adr[i] + k;
      char place[16] = "";
      if (m->sensor_dim[i] > 1) snprintf(place, sizeof place, "[%d]", k);
      term_message("sensor %s%s: %.6g to %.6g, %.6g at the end", cmd_sensor_name(name, m, i), place,
                   sensors->least[at], sensors->most[at], sensors->last[at]);
    }
}
