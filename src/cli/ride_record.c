// SPDX-License-Identifier: Apache-2.0
#include "ride_record.h"

#include <math.h>

void ride_record_begin(ride_record *record, bool wants_columns) {
  if (record->rows) bike_table_header(record->rows);
  if (!wants_columns) return;
  record->columns = json_object();
  for (int i = 0; i < BIKE_COLUMN_COUNT; i++)
    json_object_set_new(record->columns, bike_column_names()[i], json_array());
}

void ride_record_free(ride_record *record) {
  json_decref(record->columns);
  record->columns = NULL;
}

static void add_balance(ride_record *record, const bike_sample *sample,
                        const bike_sample_more *more) {
  if (record->count == 0) record->start_energy = sample->energy;
  double error = fabs(sample->energy - record->start_energy - more->work) / record->start_energy;
  record->work = more->work;
  if (!(error <= record->balance)) record->balance = error; // a NaN stays to be seen
}

void ride_record_add(ride_record *record, const bike_sample *sample, const bike_sample_more *more) {
  add_balance(record, sample, more);
  record->count++;
  bike_columns(record->last, sample, record->convention);
  if (record->rows) bike_table_row(record->rows, sample, record->convention);
  for (int i = 0; record->columns && i < BIKE_COLUMN_COUNT; i++)
    json_array_append_new(json_object_get(record->columns, bike_column_names()[i]),
                          term_json_number(record->last[i]));
  if (record->shows_progress)
    term_progress_show(&record->progress, "riding", sample->time / record->duration);
}

json_t *ride_record_end(const ride_record *record) {
  json_t *end = json_object();
  for (int i = 0; i < BIKE_COLUMN_COUNT; i++)
    json_object_set_new(end, bike_column_names()[i], term_json_number(record->last[i]));
  return end;
}
