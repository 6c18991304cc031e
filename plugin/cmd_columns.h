// SPDX-License-Identifier: Apache-2.0
// The columns of a ride of any model: time, joints, energy, what rolls, sensors.
#ifndef PLUGIN_CMD_COLUMNS_H
#define PLUGIN_CMD_COLUMNS_H

#include "runner_any.h"

#include "terminal/json.h"

typedef struct cmd_columns {
  const mjModel *model;
  int disc_count, drive_count;
  int count;      // of the columns
  char **names;   //
  double *values; // of the newest row
} cmd_columns;

// time; qpos:JOINT and qvel:JOINT (a free joint: :x :y :z :qw :qx :qy :qz and :vx .. :wz, a ball:
// :qw .. :wz); energy; disc:NAME:slip, :height, :normal; drive:JOINT:error, :force, :power;
// sensor:NAME (of several numbers: :0, :1, ...). Needs the names of discs and drives, of any
// moment. False without memory; free in any case.
bool cmd_columns_begin(cmd_columns *out, const mjModel *model, const runner_moment *moment,
                       int disc_count, int drive_count);
void cmd_columns_free(cmd_columns *columns);

void cmd_columns_take(cmd_columns *columns, const runner_moment *moment);

// Lines of a CSV: names that need it are quoted.
void cmd_columns_put_header(FILE *out, const cmd_columns *columns);
void cmd_columns_put_row(FILE *out, const cmd_columns *columns);

// An array for each column, and one more number in each.
void cmd_columns_make_json(json_t *object, const cmd_columns *columns);
void cmd_columns_add_json(json_t *object, const cmd_columns *columns);

// The newest row as an object.
json_t *cmd_columns_json(const cmd_columns *columns);

#endif
