// SPDX-License-Identifier: Apache-2.0
#include "terminal/ride_record.h"

#include <math.h>

void term_record_make_columns(term_record *record) {
  record->columns = json_object();
  for (int i = 0; i < BIKE_COLUMN_COUNT; i++)
    json_object_set_new(record->columns, bike_column_names()[i], json_array());
}

void term_record_free(term_record *record) {
  json_decref(record->columns);
  record->columns = NULL;
}

static void add_balance(term_record *record, const bike_sample *sample,
                        const bike_sample_more *more) {
  if (record->count == 0) record->start_energy = sample->energy;
  double error = fabs(sample->energy - record->start_energy - more->work) / record->start_energy;
  record->work = more->work;
  if (!(error <= record->balance)) record->balance = error; // a NaN stays to be seen
}

void term_record_add(term_record *record, const bike_sample *sample, const bike_sample_more *more) {
  add_balance(record, sample, more);
  if (record->rows && record->count == 0) bike_table_header(record->rows);
  bike_columns(record->last, sample, record->convention);
  if (record->rows) bike_table_row(record->rows, sample, record->convention);
  for (int i = 0; record->columns && i < BIKE_COLUMN_COUNT; i++)
    json_array_append_new(json_object_get(record->columns, bike_column_names()[i]),
                          term_json_number(record->last[i]));
  term_record_count(record, sample->time);
}

void term_record_count(term_record *record, double time) {
  record->count++;
  if (record->shows_progress)
    term_progress_show(&record->progress, "riding", time / record->duration);
}

json_t *term_record_end(const term_record *record, const bike_sample *end) {
  double columns[BIKE_COLUMN_COUNT];
  json_t *object = json_object();
  if (end) bike_columns(columns, end, record->convention);
  for (int i = 0; i < BIKE_COLUMN_COUNT; i++)
    json_object_set_new(object, bike_column_names()[i],
                        term_json_number(end ? columns[i] : record->last[i]));
  return object;
}
