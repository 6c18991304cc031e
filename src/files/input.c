// SPDX-License-Identifier: Apache-2.0
#include <bicycle/error.h>
#include <bicycle/input.h>

#include "csv.h"
#include "message.h"
#include "spline.h"

#include <stdlib.h>
#include <string.h>

// Columns beside the time, in the order of their storage.
enum { STEER_TORQUE, ROLL_TORQUE, RIDER_OFFSET, INPUT_COUNT };
static const char *const NAMES[INPUT_COUNT] = {"steer_torque", "roll_torque", "rider_offset"};

struct bike_input_table {
  size_t count;               // rows, at least 2
  bool has_rider;             //
  double *time;               // count, strictly rising
  double *input[INPUT_COUNT]; // count each, zero where the file has no such column
  double *second;             // count: second derivatives of the rider's offset
  double storage[];           // all of the above
};

enum { ARRAYS = 1 + INPUT_COUNT + 1, SCRATCH = 2 }; // arrays of `count` numbers

static bike_input_table *allocate(size_t count) {
  bike_input_table *table =
      calloc(1, sizeof *table + (ARRAYS + SCRATCH) * count * sizeof *table->storage);
  if (!table) return NULL;
  table->count = count;
  table->time = table->storage;
  for (int i = 0; i < INPUT_COUNT; ++i) table->input[i] = table->time + (size_t)(i + 1) * count;
  table->second = table->time + (ARRAYS - 1) * count;
  return table;
}

static int check_columns(const bike_csv *csv, const char *path, bike_file_error *error) {
  int known = 0;
  for (int i = 0; i < INPUT_COUNT; ++i) known += bike_csv_column(&csv->header, NAMES[i]) >= 0;
  if (bike_csv_column(&csv->header, "time") < 0)
    return bike_message(error, BIKE_ERROR_SYNTAX, "%s: column 'time' is missing", path);
  for (int i = 0; i < csv->header.columns && known + 1 < csv->header.columns; ++i) {
    const char *name = csv->header.name[i];
    bool found = strcmp(name, "time") == 0;
    for (int k = 0; k < INPUT_COUNT; ++k) found = found || strcmp(name, NAMES[k]) == 0;
    if (!found)
      return bike_message(error, BIKE_ERROR_SYNTAX,
                          "%s: %s: unknown column (time, steer_torque, roll_torque, rider_offset)",
                          path, name);
  }
  if (known) return BIKE_OK;
  return bike_message(error, BIKE_ERROR_SYNTAX,
                      "%s: needs a column steer_torque, roll_torque or rider_offset", path);
}

static int check_times(const bike_csv *csv, double duration, const char *path,
                       bike_file_error *error) {
  const int column = bike_csv_column(&csv->header, "time");
  if (csv->rows < 2)
    return bike_message(error, BIKE_ERROR_SYNTAX, "%s: needs at least two rows", path);
  const double *time = csv->value + column;
  const size_t stride = (size_t)csv->header.columns;
  for (size_t i = 1; i < csv->rows; ++i)
    if (!(time[i * stride] > time[(i - 1) * stride]))
      return bike_message_at(error, BIKE_ERROR_SYNTAX, path, (int)csv->line[i], "time",
                             "must rise from row to row");
  if (time[0] > 0)
    return bike_message_at(error, BIKE_ERROR_PARAMETER, path, (int)csv->line[0], "time",
                           "must begin at 0 or before");
  const double end = time[(csv->rows - 1) * stride];
  if (end >= duration) return BIKE_OK;
  return bike_message(error, BIKE_ERROR_PARAMETER,
                      "%s:%ld: time: ends at %.9g s, before the ride does at %.9g s", path,
                      csv->line[csv->rows - 1], end, duration);
}

static void copy_column(double *out, const bike_csv *csv, const char *name) {
  const int column = bike_csv_column(&csv->header, name);
  for (size_t i = 0; column >= 0 && i < csv->rows; ++i)
    out[i] = csv->value[i * (size_t)csv->header.columns + (size_t)column];
}

static bike_input_table *make_table(const bike_csv *csv) {
  bike_input_table *table = allocate(csv->rows);
  if (!table) return NULL;
  copy_column(table->time, csv, "time");
  for (int i = 0; i < INPUT_COUNT; ++i) copy_column(table->input[i], csv, NAMES[i]);
  table->has_rider = bike_csv_column(&csv->header, NAMES[RIDER_OFFSET]) >= 0;
  bike_spline_fit(table->second, table->time, table->input[RIDER_OFFSET], table->count,
                  table->second + table->count);
  return table;
}

int bike_input_table_create(bike_input_table **out, const char *path, double duration,
                            bike_file_error *error) {
  *out = NULL;
  bike_csv csv;
  int code = bike_csv_read(&csv, path, error);
  if (!code) code = check_columns(&csv, path, error);
  if (!code) code = check_times(&csv, duration, path, error);
  if (!code) {
    *out = make_table(&csv);
    if (!*out) code = bike_message(error, BIKE_ERROR_MEMORY, "%s: out of memory", path);
  }
  bike_csv_free(&csv);
  return code;
}

void bike_input_table_free(bike_input_table *table) {
  free(table);
}

// The interval with t[i] <= time < t[i + 1]; the first or last one beyond the ends.
static size_t interval(const bike_input_table *table, double time) {
  size_t low = 0, high = table->count - 1;
  while (high - low > 1) {
    const size_t middle = low + (high - low) / 2;
    if (time < table->time[middle])
      high = middle;
    else
      low = middle;
  }
  return low;
}

void bike_input_table_at(double time, bike_input *out, void *user) {
  const bike_input_table *table = user;
  const size_t i = interval(table, time);
  const double *t = table->time;
  const double part = (time - t[i]) / (t[i + 1] - t[i]);
  double torque[RIDER_OFFSET], rider[3];
  for (int k = 0; k < RIDER_OFFSET; ++k) {
    const double *y = table->input[k];
    torque[k] = y[i] + part * (y[i + 1] - y[i]);
  }
  bike_spline_at(rider, time, t, table->input[RIDER_OFFSET], table->second, i);
  *out = (bike_input){.steer_torque = torque[STEER_TORQUE],
                      .roll_torque = torque[ROLL_TORQUE],
                      .rider_offset = rider[0],
                      .rider_velocity = rider[1],
                      .rider_acceleration = rider[2]};
}

const double *bike_input_table_times(const bike_input_table *table, size_t *count) {
  *count = table->count;
  return table->time;
}

bool bike_input_table_has_rider(const bike_input_table *table) {
  return table->has_rider;
}
