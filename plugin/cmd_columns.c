// SPDX-License-Identifier: Apache-2.0
#include "cmd_columns.h"

#include "cmd_tally.h"

#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

//---------------------------------- names ---------------------------------------------------------

// A body and a geom may bear one name; columns may not.
static bool make_unique(cmd_columns *c) {
  char **name = &c->names[c->count], *longer = NULL;
  bool found = false;
  for (int i = 0; i < c->count && !found; i++) found = strcmp(c->names[i], *name) == 0;
  if (!found) return true;
  bool made = asprintf(&longer, "%s#%d", *name, c->count) >= 0;
  free(*name);
  *name = longer;
  return made;
}

// The next column; false without memory. The room is doubled whenever a power of two is full.
__attribute__((format(printf, 2, 3))) static bool add(cmd_columns *c, const char *format, ...) {
  if ((c->count & (c->count - 1)) == 0) {
    size_t room = c->count ? 2 * (size_t)c->count : 1;
    char **names = (char **)realloc(c->names, room * sizeof *names);
    if (!names) return false;
    c->names = names;
  }
  va_list arguments;
  va_start(arguments, format);
  int length = vasprintf(&c->names[c->count], format, arguments);
  va_end(arguments);
  if (length < 0 || !make_unique(c)) return false;
  c->count++;
  return true;
}

static const char *joint_name(char out[CMD_NAME_SIZE], const mjModel *m, int joint) {
  const char *name = mj_id2name(m, mjOBJ_JOINT, joint);
  if (name && *name) return name;
  snprintf(out, CMD_NAME_SIZE, "joint%d", joint);
  return out;
}

// What the numbers of a joint are called: positions or velocities, NULL for the only one.
static const char *const *parts_of(int *count, int type, bool velocity) {
  static const char *const places[] = {"x", "y", "z", "qw", "qx", "qy", "qz"};
  static const char *const rates[] = {"vx", "vy", "vz", "wx", "wy", "wz"};
  bool is_free = type == mjJNT_FREE, is_ball = type == mjJNT_BALL;
  *count = is_free ? 7 - velocity : is_ball ? 4 - velocity : 1;
  if (!is_free && !is_ball) return NULL;
  return (velocity ? rates : places) + (is_ball ? 3 : 0);
}

static bool add_joints(cmd_columns *c, const char *kind, bool velocity) {
  const mjModel *m = c->model;
  char room[CMD_NAME_SIZE];
  bool whole = true;
  for (int i = 0; i < m->njnt; i++) {
    int count;
    const char *const *parts = parts_of(&count, m->jnt_type[i], velocity);
    const char *name = joint_name(room, m, i);
    for (int k = 0; whole && k < count; k++)
      whole = parts ? add(c, "%s:%s:%s", kind, name, parts[k]) : add(c, "%s:%s", kind, name);
  }
  return whole;
}

static bool add_rolling(cmd_columns *c, const runner_moment *moment) {
  static const char *const of_disc[] = {"slip", "height", "normal"};
  static const char *const of_drive[] = {"error", "force", "power"};
  bool whole = true;
  for (int i = 0; whole && i < 3 * c->disc_count; i++)
    whole = add(c, "disc:%s:%s", moment->discs[i / 3].name, of_disc[i % 3]);
  for (int i = 0; whole && i < 3 * c->drive_count; i++)
    whole = add(c, "drive:%s:%s", moment->drives[i / 3].name, of_drive[i % 3]);
  return whole;
}

static bool add_sensors(cmd_columns *c) {
  const mjModel *m = c->model;
  char room[CMD_NAME_SIZE];
  bool whole = true;
  for (int i = 0; i < m->nsensor; i++) {
    const char *name = cmd_sensor_name(room, m, i);
    for (int k = 0; whole && k < m->sensor_dim[i]; k++)
      whole = m->sensor_dim[i] == 1 ? add(c, "sensor:%s", name) : add(c, "sensor:%s:%d", name, k);
  }
  return whole;
}

bool cmd_columns_begin(cmd_columns *out, const mjModel *model, const runner_moment *moment,
                       int disc_count, int drive_count) {
  *out = (cmd_columns){.model = model, .disc_count = disc_count, .drive_count = drive_count};
  if (!add(out, "time") || !add_joints(out, "qpos", false) || !add_joints(out, "qvel", true) ||
      !add(out, "energy") || !add_rolling(out, moment) || !add_sensors(out))
    return false;
  out->values = (double *)calloc((size_t)out->count, sizeof *out->values);
  return out->values != NULL;
}

void cmd_columns_free(cmd_columns *columns) {
  for (int i = 0; i < columns->count; i++) free(columns->names[i]);
  free(columns->names);
  free(columns->values);
  *columns = (cmd_columns){0};
}

//---------------------------------- values --------------------------------------------------------

static double *put(double *to, const double *from, int count) {
  mju_copy(to, from, count);
  return to + count;
}

// In the order of the names.
void cmd_columns_take(cmd_columns *columns, const runner_moment *moment) {
  const mjModel *m = columns->model;
  const mjData *d = moment->data;
  double *to = columns->values;
  *to++ = moment->time;
  to = put(to, d->qpos, m->nq);
  to = put(to, d->qvel, m->nv);
  *to++ = d->energy[0] + d->energy[1];
  for (int i = 0; i < columns->disc_count; i++) {
    const roll_disc *disc = &moment->discs[i];
    to = put(to, (const double[]){mju_norm3(disc->slip), disc->height, disc->normal_force}, 3);
  }
  for (int i = 0; i < columns->drive_count; i++) {
    const roll_drive *drive = &moment->drives[i];
    to = put(to, (const double[]){drive->off, drive->force, drive->power}, 3);
  }
  put(to, d->sensordata, m->nsensordata);
}

//---------------------------------- out -----------------------------------------------------------

// RFC 4180, for names are anybody's text.
static void put_name(FILE *out, const char *name) {
  if (!strpbrk(name, "\",\r\n")) {
    fputs(name, out);
    return;
  }
  fputc('"', out);
  for (; *name; name++) {
    if (*name == '"') fputc('"', out);
    fputc(*name, out);
  }
  fputc('"', out);
}

void cmd_columns_put_header(FILE *out, const cmd_columns *columns) {
  for (int i = 0; i < columns->count; i++) {
    if (i) fputc(',', out);
    put_name(out, columns->names[i]);
  }
  fputc('\n', out);
}

void cmd_columns_put_row(FILE *out, const cmd_columns *columns) {
  for (int i = 0; i < columns->count; i++)
    fprintf(out, "%s%.17g", i ? "," : "", columns->values[i]);
  fputc('\n', out);
}

void cmd_columns_make_json(json_t *object, const cmd_columns *columns) {
  json_object_clear(object);
  for (int i = 0; i < columns->count; i++)
    json_object_set_new(object, columns->names[i], json_array());
}

void cmd_columns_add_json(json_t *object, const cmd_columns *columns) {
  for (int i = 0; i < columns->count; i++)
    json_array_append_new(json_object_get(object, columns->names[i]),
                          term_json_number(columns->values[i]));
}

json_t *cmd_columns_json(const cmd_columns *columns) {
  json_t *object = json_object();
  for (int i = 0; i < columns->count; i++)
    json_object_set_new(object, columns->names[i], term_json_number(columns->values[i]));
  return object;
}
