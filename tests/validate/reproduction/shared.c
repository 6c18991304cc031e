// SPDX-License-Identifier: Apache-2.0
#include "shared.h"
#include <bicycle/error.h>
#include <bicycle/file.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

void put(figures *out, double value) {
  must(out->count < MAX_FIGURES ? BIKE_OK : BIKE_ERROR_MEMORY, "figures of a row");
  out->values[out->count++] = value;
}

void must(int code, const char *what) {
  if (code == BIKE_OK) return;
  fprintf(stderr, "%s: %s\n", what, bike_error_string(code));
  exit(1);
}

bike_bicycle bicycle_of(const char *shipped) {
  char path[512];
  bike_file file;
  bike_file_error error;
  snprintf(path, sizeof path, "%s/model/%s/%s.yml", BICYCLE_SOURCE_DIR, shipped, shipped);
  int code = bike_file_read(&file, path, &error);
  must(code, code ? error.text : path);
  return file.bicycle;
}

bike_model model_of(const bike_bicycle *bicycle) {
  bike_model model;
  must(bike_model_init(&model, bicycle), bicycle->name);
  return model;
}

bike_model shipped_model(const char *shipped) {
  bike_bicycle bicycle = bicycle_of(shipped);
  return model_of(&bicycle);
}

limits limits_of(const bike_bicycle *bicycle, double fastest) {
  bike_model model = model_of(bicycle);
  bike_critical_speeds found;
  must(bike_upright_critical_speeds(&found, &model, 0, fastest), "critical speeds");
  bool stable = found.range_count > 0;
  return (limits){.weave = found.weave_count > 0 ? found.weave[0] : NAN,
                  .capsize = found.capsize_count > 0 ? found.capsize[0] : NAN,
                  .low = stable ? found.ranges[0][0] : NAN,
                  .high = stable ? found.ranges[0][1] : NAN,
                  .ranges = found.range_count};
}

bike_bicycle varied(const bike_bicycle *from, bike_variation variation, double value,
                    bike_front_hold hold) {
  bike_bicycle out;
  must(bike_vary(&out, from, variation, value, hold), bike_variation_name(variation));
  return out;
}

double present(const bike_bicycle *bicycle, bike_variation variation) {
  double value;
  must(bike_variation_value(&value, bicycle, variation), bike_variation_name(variation));
  return value;
}

bike_bicycle without_rider(const bike_bicycle *from) {
  bike_bicycle out = *from;
  out.part_count = 0;
  for (int i = 0; i < from->part_count; i++)
    if (!from->parts[i].rider) out.parts[out.part_count++] = from->parts[i];
  return out;
}

const bike_turns *turns_at(const bike_model *model, double speed, double offset) {
  static bike_turns found;
  bike_turn_def def = bike_default_turn_def();
  def.given[BIKE_TURN_SPEED] = def.given[BIKE_TURN_OFFSET] = true;
  def.value[BIKE_TURN_SPEED] = speed;
  def.value[BIKE_TURN_OFFSET] = offset;
  must(bike_turns_find(&found, model, &def), "turns");
  return &found;
}

int main_count(const bike_turns *found) {
  int count = 0;
  for (int i = 0; i < found->count; i++) count += found->turns[i].main_family;
  return count;
}

bike_ride_result ride_of(const bike_model *model, const bike_state *start, double time,
                         double sample, bike_sample_function *on_sample, void *user) {
  bike_ride_result result;
  bike_ride_def def = bike_default_ride_def();
  def.start = *start;
  def.duration = time;
  def.sample = sample;
  def.on_sample = on_sample;
  def.user = user;
  must(bike_ride(&result, model, &def), "ride");
  return result;
}

int keep_sample(const bike_sample *sample, const bike_sample_more *more, void *user) {
  (void)more;
  *(bike_sample *)user = *sample;
  return 0;
}

// Place of the largest entry in the rows from `first` on.
static int largest_entry(const double *m, int first, int rows, int columns) {
  int largest = first * columns;
  for (int i = largest; i < rows * columns; i++)
    if (fabs(m[i]) > fabs(m[largest])) largest = i;
  return largest;
}

// Elimination with full pivoting.
int rank_of(const double *matrix, int rows, int columns, double threshold) {
  double m[MAX_ENTRIES];
  must(rows * columns <= MAX_ENTRIES ? BIKE_OK : BIKE_ERROR_MEMORY, "matrix");
  for (int i = 0; i < rows * columns; i++) m[i] = matrix[i];
  int found = 0;
  for (; found < rows && found < columns; found++) {
    int place = largest_entry(m, found, rows, columns), column = place % columns;
    double *top = m + found * columns, *pivot = m + place - column;
    if (!(fabs(pivot[column]) > threshold)) break;
    for (int j = 0; j < columns; j++) {
      double moved = top[j];
      top[j] = pivot[j];
      pivot[j] = moved;
    }
    for (int i = found + 1; i < rows; i++) {
      double *row = m + i * columns, factor = row[column] / top[column];
      for (int j = 0; j < columns; j++) row[j] -= factor * top[j];
      row[column] = 0;
    }
  }
  return found;
}
