// SPDX-License-Identifier: Apache-2.0
// Points and rows: each a function of its index alone, bit for bit, however they are grouped; and
// records that come back, or are known to be damaged.
#include "support/near.h"
#include "support/random.h"
#include "sweep/record.h"

#include <stdlib.h>
#include <string.h>

static const char *const examples[] = {"trail_and_speed.yml", "riders.yml"};

static void read_example(sweep_spec *spec, const char *name) {
  char path[1024];
  bike_file_error error;
  snprintf(path, sizeof path, "%s/src/sweep/examples/%s", BICYCLE_SOURCE_DIR, name);
  if (sweep_spec_read(spec, path, &error)) fail_msg("%s", error.text);
}

static char *record_of(const sweep_row *row, const sweep_spec *spec) {
  char *text = NULL;
  size_t size;
  FILE *stream = open_memstream(&text, &size);
  assert_true(sweep_print_record(stream, row, spec));
  assert_int_equal(fclose(stream), 0);
  return text;
}

enum { COUNT = 24 };

static void rows_do_not_depend_on_groups(void **state) {
  (void)state;
  for (size_t e = 0; e < sizeof examples / sizeof *examples; e++) {
    sweep_spec spec;
    read_example(&spec, examples[e]);
    sweep_row *together = calloc(COUNT, sizeof *together), *alone = calloc(1, sizeof *alone);
    const long first = spec.points - COUNT - 3;
    memset(together, 0x55, COUNT * sizeof *together); // what was there before must not matter
    sweep_evaluate(together, &spec, first, COUNT);
    for (int i = COUNT - 1; i >= 0; i--) {
      sweep_evaluate(alone, &spec, first + i, 1);
      char *a = record_of(&together[i], &spec), *b = record_of(alone, &spec);
      assert_string_equal(a, b);
      free(a);
      free(b);
    }
    free(together);
    free(alone);
    sweep_spec_free(&spec);
  }
}

// The last axis varies fastest; ends of a grid are exact; draws stay in their range and repeat.
static void the_order_of_points(void **state) {
  (void)state;
  sweep_spec spec;
  double values[SWEEP_MOST_AXES], again[SWEEP_MOST_AXES];
  read_example(&spec, "trail_and_speed.yml");
  assert_int_equal(spec.points, 23 * 15 * 4);
  sweep_values_at(values, &spec, 0);
  assert_true(values[0] == 0.01 && values[1] == 1.05 && values[2] == 4);
  sweep_values_at(values, &spec, 5);
  assert_near(values[1], 1.075, 1e-15);
  assert_true(values[0] == 0.01 && values[2] == 5);
  sweep_values_at(values, &spec, spec.points - 1);
  assert_true(values[0] == 0.12 && values[1] == 1.40 && values[2] == 7);
  sweep_spec_free(&spec);

  read_example(&spec, "riders.yml");
  double mean = 0;
  long same = 0; // draws of two axes in the same half of their ranges
  for (long k = 0; k < spec.points; k++) {
    sweep_values_at(values, &spec, k);
    sweep_values_at(again, &spec, k);
    assert_memory_equal(values, again, sizeof values[0] * (size_t)spec.axis_count);
    assert_true(values[0] == (k < 100 ? 5 : k < 200 ? 5.5 : 6));
    assert_true(values[2] >= 1.0 && values[2] < 1.15);
    same += (values[2] < 1.075) == (values[3] < 0.36);
    mean += values[1] / (double)spec.points;
  }
  assert_near((double)same, 150, 5 * sqrt(300.0 / 4));       // axes know nothing of each other
  assert_near(mean, 70, 5 * 10 / sqrt((double)spec.points)); // five standard errors
  sweep_spec_free(&spec);
}

// Any changed byte of a record is noticed.
static void damage_is_noticed(void **state) {
  (void)state;
  sweep_spec spec;
  sweep_record record;
  read_example(&spec, "riders.yml");
  sweep_row *row = calloc(1, sizeof *row);
  sweep_evaluate(row, &spec, 17, 1);
  snprintf(row->error, sizeof row->error, "a reason with, commas and \"quotes\"\n");
  char *line = record_of(row, &spec);
  const size_t size = strcspn(line, "\n");
  assert_int_equal(strlen(line), size + 1); // one line
  assert_true(sweep_parse_record(&record, line, size));
  assert_int_equal(record.index, 17);
  assert_true(record.failed);
  for (size_t i = 0; i < size; i++) {
    line[i] ^= 1;
    assert_false(sweep_parse_record(&record, line, size));
    line[i] ^= 1;
    assert_false(sweep_parse_record(&record, line, i)); // torn
  }
  free(line);
  free(row);
  sweep_spec_free(&spec);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(rows_do_not_depend_on_groups),
      cmocka_unit_test(the_order_of_points),
      cmocka_unit_test(damage_is_noticed),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
