// SPDX-License-Identifier: Apache-2.0
// CSV through all its doors: as a whole and row by row, which must agree, as the input of a ride,
// and as a recorded ride.
#include "fuzz.h"

#include "engine.h"
#include "files/csv.h"

#include <bicycle/error.h>
#include <bicycle/input.h>
#include <math.h>
#include <string.h>

static void require_same_rows(const char *path) {
  bike_csv whole;
  bike_csv_reader reader;
  bike_file_error error[2] = {{""}, {""}};
  double row[BIKE_CSV_COLUMNS];
  bool found = true;
  size_t rows = 0;
  int code = bike_csv_read(&whole, path, &error[0]);
  int by_row = bike_csv_open(&reader, path, &error[1]);
  FUZZ_REQUIRE(code == BIKE_OK || fuzz_one_line(error[0].text), "'%s'", error[0].text);
  for (int k = 0; by_row == BIKE_OK && k < reader.header.columns; k++)
    FUZZ_REQUIRE(fuzz_one_line(reader.header.name[k]), "name of column %d", k);
  while (by_row == BIKE_OK && found) {
    by_row = bike_csv_next(row, &found, &reader, &error[1]);
    if (by_row != BIKE_OK || !found) break;
    for (int k = 0; k < reader.header.columns; k++) {
      FUZZ_REQUIRE(isfinite(row[k]), "row %zu", rows);
      FUZZ_REQUIRE(code != BIKE_OK ||
                       whole.value[rows * (size_t)whole.header.columns + (size_t)k] == row[k],
                   "row %zu, column %d", rows, k);
    }
    rows++;
  }
  FUZZ_REQUIRE(code == by_row && strcmp(error[0].text, error[1].text) == 0, "'%s' and '%s'",
               error[0].text, error[1].text);
  FUZZ_REQUIRE(code != BIKE_OK || rows == whole.rows, "%zu and %zu", rows, whole.rows);
  bike_csv_close(&reader);
  bike_csv_free(&whole);
}

static void require_input(const char *path) {
  bike_input_table *table;
  bike_file_error error = {""};
  size_t count;
  if (bike_input_table_create(&table, path, 1, &error) != BIKE_OK) {
    FUZZ_REQUIRE(!table && fuzz_one_line(error.text), "'%s'", error.text);
    return;
  }
  const double *times = bike_input_table_times(table, &count);
  FUZZ_REQUIRE(count >= 2 && times[0] <= 0 && times[count - 1] >= 1, "%zu rows", count);
  for (size_t i = 0; i < count; i++) {
    bike_input input = {0};
    bike_input_table_at(times[i], &input, table);
    FUZZ_REQUIRE(i == 0 || times[i] > times[i - 1], "time %g", times[i]);
    FUZZ_REQUIRE(isfinite(input.steer_torque) && isfinite(input.roll_torque) &&
                     isfinite(input.rider_offset),
                 "at %g s", times[i]);
  }
  bike_input_table_free(table);
}

static void require_recording(const char *path, bool mapped) {
  static const engine_column columns[] = {{"time", "t", 1e-3}, {"lean", "phi", -1}};
  static engine_choice choice;
  const engine_ride ride = {.duration = 1, .sample = 0.25, .lean_limit = 1.4};
  problem p = {""};
  choice = (engine_choice){.engine = &engine_file};
  snprintf(choice.file, sizeof choice.file, "%s", path);
  if (mapped) {
    memcpy(choice.columns, columns, sizeof columns);
    choice.column_count = 2;
  }
  if (engine_file.check(&choice, &ride, &p) != TERM_DONE) {
    FUZZ_REQUIRE(fuzz_one_line(p.text), "'%s'", p.text);
    return;
  }
  term_exit code = TERM_DONE;
  trace rows = {0};
  void *recording = engine_file.create(NULL, &choice, &code, &p);
  FUZZ_REQUIRE(recording, "'%s'", p.text);
  code = engine_file.ride(&rows, recording, &ride, &p);
  if (code == TERM_DONE)
    FUZZ_REQUIRE(rows.count >= 1 && rows.count <= 5, "%zu rows", rows.count);
  else // a time that is not finite makes the run invalid
    FUZZ_REQUIRE(code == TERM_INVALID && fuzz_one_line(p.text), "'%s'", p.text);
  engine_file.free(recording);
  trace_clear(&rows);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  const char *path = fuzz_write("table.csv", data, size);
  require_same_rows(path);
  require_input(path);
  require_recording(path, false);
  require_recording(path, true);
  return 0;
}
