// SPDX-License-Identifier: Apache-2.0
// What a ride in MuJoCo says at its end of discs and sensors, on stderr and in the JSON document.
#ifndef PLUGIN_CMD_TALLY_H
#define PLUGIN_CMD_TALLY_H

#include "terminal/json.h"
#include "terminal/outside.h"

#include <mujoco/mujoco.h>
#include <stdbool.h>

//---------------------------------- discs ---------------------------------------------------------

enum { CMD_MOST_LIFTS = 32 };

// One disc or skate. Names are those of the model.
typedef struct cmd_disc {
  const char *name;
  double slip, height;          // m/s, m  largest of the rows
  int lift_count;               //         of lift-offs; the first CMD_MOST_LIFTS are kept
  double lifts[CMD_MOST_LIFTS]; // s
  bike_wheel_ground ground;     //         of any model looked at in rows
} cmd_disc;

// A row's slip and height error; a NaN stays to be seen.
void cmd_disc_take(cmd_disc *disc, double slip, double height);
void cmd_disc_lift(cmd_disc *disc, double time);

// A row's force of the ground, `normal` of it along the ground's normal, N. What holds at a row
// holds from it, a lift from its own time.
void cmd_disc_press(cmd_disc *disc, double time, const double force[3], double normal,
                    double friction_limit);

// [{name, lifts: [s], friction, slip, height_error}]; friction without bound is null.
json_t *cmd_discs_json(const cmd_disc *discs, int count);
void cmd_discs_tell(const cmd_disc *discs, int count);

// What of that no ground can do; after bike_ground_end.
json_t *cmd_discs_outside_json(const cmd_disc *discs, int count, const term_limits *limits);
void cmd_discs_outside_tell(const cmd_disc *discs, int count, const term_limits *limits);

//---------------------------------- sensors -------------------------------------------------------

// The numbers of all sensors of a model: smallest, largest and newest of the rows.
typedef struct cmd_sensors {
  const mjModel *model; // NULL: not asked for
  double *least, *most, *last;
  bool any; // there was a row
} cmd_sensors;

// False without memory.
bool cmd_sensors_begin(cmd_sensors *out, const mjModel *model);
void cmd_sensors_take(cmd_sensors *sensors, const double *data);
void cmd_sensors_free(cmd_sensors *sensors);

// {NAME: {least, most, end}}, arrays for a sensor of several numbers.
json_t *cmd_sensors_json(const cmd_sensors *sensors);
void cmd_sensors_tell(const cmd_sensors *sensors);

// The name of a sensor, or its number within the model.
enum { CMD_NAME_SIZE = 256 };
const char *cmd_sensor_name(char out[CMD_NAME_SIZE], const mjModel *model, int sensor);

#endif
