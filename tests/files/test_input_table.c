// SPDX-License-Identifier: Apache-2.0
// Inputs from CSV: broken tables, what lies between the rows, and the order of the spline.
#include "scratch.h"

#include "support/near.h"

#include <bicycle/error.h>
#include <bicycle/input.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bike_input_table *create(const char *text, double duration) {
  bike_input_table *table;
  bike_file_error error = {""};
  if (bike_input_table_create(&table, scratch_write("input.csv", text), duration, &error))
    fail_msg("%s", error.text);
  return table;
}

static void wrong_files(void **state) {
  (void)state;
  static const struct {
    const char *text;
    int code;
    const char *message;
  } files[] = {
      {"", BIKE_ERROR_SYNTAX, ": the file is empty"},
      {"time,steer_torque\n", BIKE_ERROR_SYNTAX, ": needs at least two rows"},
      {"time,steer_torque\n0,1\n", BIKE_ERROR_SYNTAX, ": needs at least two rows"},
      {"steer_torque\n0\n1\n", BIKE_ERROR_SYNTAX, ": column 'time' is missing"},
      {"time\n0\n10\n", BIKE_ERROR_SYNTAX, ": needs a column steer_torque"},
      {"time,torque\n0,1\n10,1\n", BIKE_ERROR_SYNTAX, ": torque: unknown column"},
      {"time,time\n0,1\n", BIKE_ERROR_SYNTAX, ":1: time: the column is given twice"},
      {"time,a\tb\rc\n0,1\n", BIKE_ERROR_SYNTAX, ": a?b?c: unknown column"},
      {"time,\n0,1\n", BIKE_ERROR_SYNTAX, ":1: a column has no name"},
      {"time,steer_torque\n0,1\n10\n", BIKE_ERROR_SYNTAX,
       ":3: steer_torque: the number is missing"},
      {"time,steer_torque\n0,1\n10,\n", BIKE_ERROR_SYNTAX, ":3: steer_torque: '' is not a number"},
      {"time,steer_torque\n0,1,2\n10,1\n", BIKE_ERROR_SYNTAX, ":2: more numbers than columns"},
      {"time,steer_torque\n0,nan\n10,1\n", BIKE_ERROR_SYNTAX, ":2: steer_torque: 'nan' is not fin"},
      {"time,steer_torque\n0,1e999\n10,1\n", BIKE_ERROR_SYNTAX, ":2: steer_torque: '1e999' is too"},
      {"time,steer_torque\n0,1x\n10,1\n", BIKE_ERROR_SYNTAX, ":2: steer_torque: '1x' is not a num"},
      {"time,steer_torque\n0,1\n5,1\n5,2\n10,1\n", BIKE_ERROR_SYNTAX, ":4: time: must rise"},
      {"time,steer_torque\n0,1\n\n9,1\n", BIKE_ERROR_PARAMETER, ":4: time: ends at 9 s"},
      {"time,steer_torque\n1,1\n10,1\n", BIKE_ERROR_PARAMETER, ":2: time: must begin at 0"},
      {"time\xff,steer_torque\n", BIKE_ERROR_SYNTAX, ":1: this is not UTF-8 text"},
      {"time,steer_torque\n0,1\n1,1\xc3\n", BIKE_ERROR_SYNTAX, ":3: this is not UTF-8 text"},
      {"time,steer_torque\n0,1\n1,\x01\n", BIKE_ERROR_SYNTAX, ":3: control character"},
  };
  for (size_t i = 0; i < sizeof files / sizeof *files; ++i) {
    const char *path = scratch_write("wrong.csv", files[i].text);
    bike_input_table *table = (bike_input_table *)1;
    bike_file_error error = {""};
    const int code = bike_input_table_create(&table, path, 10, &error);
    char expected[512];
    snprintf(expected, sizeof expected, "%s%s", path, files[i].message);
    if (code != files[i].code || strncmp(error.text, expected, strlen(expected)) != 0)
      fail_msg("file %zu: code %d, '%s' instead of '%s'", i, code, error.text, expected);
    assert_null(table);
  }
  bike_input_table *table;
  assert_int_equal(bike_input_table_create(&table, scratch_folder(), 1, NULL), BIKE_ERROR_FILE);
}

// Lines are read in pieces: wherever one ends, rows are whole, and a line that never ends
// is refused.
static void long_files(void **state) {
  (void)state;
  enum { ROWS = 40000 };
  char *text = NULL;
  size_t size = 0;
  FILE *stream = open_memstream(&text, &size);
  fputs("time,steer_torque\n", stream);
  for (int i = 0; i < ROWS; ++i) fprintf(stream, "%d,%d.%0*d\n", i, i, 1 + i % 37, 0);
  fclose(stream);
  bike_input_table *table = create(text, 1);
  free(text);
  size_t count;
  assert_non_null(bike_input_table_times(table, &count));
  assert_int_equal(count, ROWS);
  for (int i = 0; i < ROWS; i += 7) {
    bike_input input;
    bike_input_table_at(i, &input, table);
    assert_near(input.steer_torque, i, 1e-9);
  }
  bike_input_table_free(table);

  enum { LONG = (1 << 24) + 100 };
  char *line = calloc(1, LONG);
  assert_non_null(line);
  memset(line, ' ', LONG - 1);
  memcpy(line, "time,steer_torque\n0,1\n", 22);
  bike_file_error error = {""};
  assert_int_equal(bike_input_table_create(&table, scratch_write("long.csv", line), 1, &error),
                   BIKE_ERROR_SYNTAX);
  assert_non_null(strstr(error.text, ":3: the line is too long"));
  free(line);
}

// A number with more digits than the first buffer holds, and the smallest ones in full.
static void long_numbers(void **state) {
  (void)state;
  char *text = NULL;
  size_t size = 0;
  FILE *stream = open_memstream(&text, &size);
  fprintf(stream, "time,steer_torque,roll_torque\n0,%.1080f,%.400f\n1,0.25%0200000d,0\n", 0x1p-1074,
          2.2250738585072014e-308, 1);
  fclose(stream);
  bike_input_table *table = create(text, 1);
  free(text);
  bike_input begin = {0}, end = {0};
  bike_input_table_at(0, &begin, table);
  bike_input_table_at(1, &end, table);
  assert_true(begin.steer_torque == 0x1p-1074);
  assert_true(begin.roll_torque == 2.2250738585072014e-308);
  assert_true(end.steer_torque == 0.25);
  bike_input_table_free(table);
}

// A file without an end, and one of more numbers than fit.
static void endless_files(void **state) {
  (void)state;
  bike_input_table *table;
  bike_file_error error = {""};
  assert_int_equal(bike_input_table_create(&table, "/dev/zero", 1, &error), BIKE_ERROR_SYNTAX);
  assert_non_null(strstr(error.text, "/dev/zero:1: "));
  const char *path = scratch_write("many.csv", "time,steer_torque\n");
  FILE *stream = fopen(path, "ae");
  assert_non_null(stream);
  for (int i = 0; i <= 8 << 20; ++i) fprintf(stream, "%d,0\n", i); // twice that many numbers
  fclose(stream);
  assert_int_equal(bike_input_table_create(&table, path, 1, &error), BIKE_ERROR_FILE);
  assert_non_null(strstr(error.text, "more than 16777216 numbers"));
  assert_null(table);
}

static void torques_are_linear(void **state) {
  (void)state;
  bike_input_table *table = create(
      "\xef\xbb\xbf roll_torque , time , steer_torque\r\n4,0,1\r\n\r\n2,1,3\r\n-1e1,4,0\r\n", 4);
  static const double rows[][3] = {// time, steer torque, roll torque
                                   {0, 1, 4},
                                   {0.25, 1.5, 3.5},
                                   {1, 3, 2},
                                   {2.5, 1.5, -4},
                                   {4, 0, -10}};
  for (int i = 0; i < 5; ++i) {
    bike_input input = {0};
    bike_input_table_at(rows[i][0], &input, table);
    assert_near(input.steer_torque, rows[i][1], 1e-15);
    assert_near(input.roll_torque, rows[i][2], 1e-14);
    assert_near(input.rider_offset, 0, 0);
    assert_near(input.rider_acceleration, 0, 0);
  }
  size_t count;
  const double *times = bike_input_table_times(table, &count);
  assert_int_equal(count, 3);
  assert_near(times[2], 4, 0);
  assert_false(bike_input_table_has_rider(table));
  bike_input_table_free(table);
}

// A cubic is its own not-a-knot spline: exact, uneven rows, the ends included.
static void spline_of_a_cubic(void **state) {
  (void)state;
  static const double times[] = {0, 0.3, 0.5, 1.2, 1.4, 2};
  for (size_t rows = 2; rows <= 6; ++rows) {
    const double a = rows > 3 ? 0.7 : 0, b = rows > 2 ? -1.1 : 0; // cubic, parabola, line
    char text[1024] = "time,rider_offset\n";
    for (size_t i = 0; i < rows; ++i) {
      const double t = times[i];
      snprintf(text + strlen(text), 64, "%.17g,%.17g\n", t, ((a * t + b) * t + 0.2) * t - 0.3);
    }
    bike_input_table *table = create(text, 0.3);
    for (double t = 0; t <= times[rows - 1]; t += 0.05) {
      bike_input input;
      bike_input_table_at(t, &input, table);
      assert_near(input.rider_offset, ((a * t + b) * t + 0.2) * t - 0.3, 1e-14);
      assert_near(input.rider_velocity, (3 * a * t + 2 * b) * t + 0.2, 1e-13);
      assert_near(input.rider_acceleration, 6 * a * t + 2 * b, 1e-12);
    }
    assert_true(bike_input_table_has_rider(table));
    bike_input_table_free(table);
  }
}

// Largest error of the acceleration of 2 cm sin 2t, sampled with n intervals of 2 s.
static double acceleration_error(int n) {
  char *text = NULL;
  size_t size = 0;
  FILE *stream = open_memstream(&text, &size);
  fputs("time,rider_offset\n", stream);
  for (int i = 0; i <= n; ++i)
    fprintf(stream, "%.17g,%.17g\n", 2.0 * i / n, 0.02 * sin(4.0 * i / n));
  fclose(stream);
  bike_input_table *table = create(text, 2);
  free(text);
  double worst = 0;
  for (double t = 0; t <= 2; t += 0.001) {
    bike_input input;
    bike_input_table_at(t, &input, table);
    worst = fmax(worst, fabs(input.rider_acceleration + 0.08 * sin(2 * t)));
  }
  bike_input_table_free(table);
  return worst;
}

// The second derivative of a cubic spline converges with the square of the step, up to the ends.
static void spline_order(void **state) {
  (void)state;
  const double coarse = acceleration_error(40), fine = acceleration_error(80);
  print_message("error of the rider's acceleration: %.3g, %.3g m/s^2\n", coarse, fine);
  assert_near(coarse / fine, 4, 0.4);
  assert_below(fine, 1e-3);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(wrong_files),        cmocka_unit_test(long_files),
      cmocka_unit_test(long_numbers),       cmocka_unit_test(endless_files),
      cmocka_unit_test(torques_are_linear), cmocka_unit_test(spline_of_a_cubic),
      cmocka_unit_test(spline_order)};
  return cmocka_run_group_tests(tests, scratch_create, scratch_remove);
}
