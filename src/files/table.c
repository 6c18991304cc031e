// SPDX-License-Identifier: Apache-2.0
#include <bicycle/table.h>

#include "csv.h"

static const char *const NAMES[BIKE_COLUMN_COUNT + 1] = {"time",
                                                         "x",
                                                         "y",
                                                         "yaw",
                                                         "lean",
                                                         "pitch",
                                                         "steer",
                                                         "lean_rate",
                                                         "steer_rate",
                                                         "speed",
                                                         "rear_angle",
                                                         "front_angle",
                                                         "energy",
                                                         "rear_normal",
                                                         "front_normal",
                                                         "rear_friction",
                                                         "front_friction",
                                                         NULL};

const char *const *bike_column_names(void) {
  return NAMES;
}

void bike_columns(double out[BIKE_COLUMN_COUNT], const bike_sample *s, bike_convention convention) {
  const bool sae = convention == BIKE_CONVENTION_SAE;
  const double left[4] = {s->y, s->yaw, s->steer, s->steer_rate};
  double turned[4]; // 0 - x: no negative zeros
  for (int i = 0; i < 4; ++i) turned[i] = sae ? 0 - left[i] : left[i];
  const double row[BIKE_COLUMN_COUNT] = {
      s->time,          s->x,           turned[0],       turned[1],
      s->lean,          s->pitch,       turned[2],       s->lean_rate,
      turned[3],        s->speed,       s->rear_angle,   s->front_angle,
      s->energy,        s->rear_normal, s->front_normal, s->rear_friction,
      s->front_friction};
  for (int i = 0; i < BIKE_COLUMN_COUNT; ++i) out[i] = row[i];
}

void bike_table_header(FILE *stream) {
  bike_csv_write_names(stream, NAMES, BIKE_COLUMN_COUNT);
}

void bike_table_row(FILE *stream, const bike_sample *sample, bike_convention convention) {
  double row[BIKE_COLUMN_COUNT];
  bike_columns(row, sample, convention);
  bike_csv_write_row(stream, row, BIKE_COLUMN_COUNT);
}
