// SPDX-License-Identifier: Apache-2.0
#include "evaluate.h"

#include "files/number.h"

#include <bicycle/basin.h>
#include <bicycle/cycle.h>
#include <bicycle/error.h>
#include <bicycle/stability.h>
#include <bicycle/turn.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static void print_ranges(char out[SWEEP_RANGES_SIZE], const bike_critical_speeds *speeds) {
  size_t used = 0;
  for (int i = 0; i < speeds->range_count; i++) {
    char low[BIKE_NUMBER_SIZE], high[BIKE_NUMBER_SIZE];
    bike_number_print(low, speeds->ranges[i][0]);
    bike_number_print(high, speeds->ranges[i][1]);
    used +=
        (size_t)snprintf(out + used, SWEEP_RANGES_SIZE - used, "%s%s:%s", i ? ";" : "", low, high);
  }
}

static int answer_critical(sweep_row *row, const sweep_point *point, const sweep_spec *spec) {
  bike_critical_speeds speeds;
  const bool given = !isnan(spec->search[1]);
  const double low = given ? spec->search[0] : 0;
  const double high = given ? spec->search[1] : bike_search_end(&point->model);
  const int code = bike_upright_critical_speeds(&speeds, &point->model, low, high);
  if (code) return code;
  row->numbers[SWEEP_WEAVE_SPEED] = speeds.weave_count ? speeds.weave[0] : NAN;
  row->numbers[SWEEP_CAPSIZE_SPEED] = speeds.capsize_count ? speeds.capsize[0] : NAN;
  print_ranges(row->ranges, &speeds);
  return BIKE_OK;
}

static int answer_eps_max(double *out, const sweep_point *point) {
  bike_upright_matrices upright;
  bike_eigenvalues e;
  int code = bike_linearize_upright(&upright, &point->model); // refuses what cannot ride straight
  if (!code) code = bike_upright_eigenvalues(&e, &point->model, point->start.speed);
  if (!code) *out = e.re[0];
  return code;
}

// The circle of the main family; riding straight where the lean is zero.
static int answer_turn(double *out, const sweep_point *point) {
  bike_turns found;
  bike_turn_def def = bike_default_turn_def();
  if (point->start.lean == 0) return answer_eps_max(out, point);
  def.given[BIKE_TURN_SPEED] = def.given[BIKE_TURN_LEAN] = true;
  def.value[BIKE_TURN_SPEED] = point->start.speed;
  def.value[BIKE_TURN_LEAN] = point->start.lean;
  const int code = bike_turns_find(&found, &point->model, &def);
  if (code) return code;
  *out = found.count && found.turns[0].main_family ? found.turns[0].eps_max : NAN;
  return BIKE_OK;
}

static const char *outcome_of(bike_fate fate) {
  switch (fate) {
  case BIKE_FATE_STRAIGHT:
    return "recovers";
  case BIKE_FATE_LIFTED:
    return "lifts";
  case BIKE_FATE_FALLEN:
    return "falls";
  default:
    return "undecided";
  }
}

static int answer(sweep_row *row, sweep_output output, const sweep_point *point,
                  const sweep_spec *spec) {
  switch (output) {
  case SWEEP_WEAVE_SPEED:
  case SWEEP_CAPSIZE_SPEED:
  case SWEEP_STABLE_RANGES:
    return answer_critical(row, point, spec);
  case SWEEP_EPS_MAX:
    return answer_eps_max(&row->numbers[output], point);
  case SWEEP_TURN_EPS_MAX:
    return answer_turn(&row->numbers[output], point);
  case SWEEP_OUTCOME: // ridden with the others of the call
  case SWEEP_TIME:
    return BIKE_OK;
  case SWEEP_OUTPUT_COUNT:
    break;
  }
  return BIKE_ERROR_ARGUMENT;
}

// Outputs that one computation answers together.
static int question_of(sweep_output output) {
  if (output <= SWEEP_STABLE_RANGES) return SWEEP_WEAVE_SPEED;
  return output >= SWEEP_OUTCOME ? SWEEP_OUTCOME : (int)output;
}

// Also with BIKE_OK: it did not.
static void fail(sweep_row *row, int question, int code) {
  for (int i = 0; i < SWEEP_OUTPUT_COUNT; i++)
    if (question_of((sweep_output)i) == question) row->codes[i] = code;
}

static void begin_row(sweep_row *row, const sweep_point *point, long index) {
  row->index = index;
  row->outcome = "";
  row->ranges[0] = '\0';
  memcpy(row->values, point->values, sizeof row->values);
  memcpy(row->error, point->error, sizeof row->error);
  memset(row->codes, 0, sizeof row->codes);
  for (int i = 0; i < SWEEP_OUTPUT_COUNT; i++) row->numbers[i] = NAN;
}

// All answers but those of a ride. False where memory is short.
static bool evaluate_point(sweep_row *row, const sweep_point *point, const sweep_spec *spec) {
  unsigned asked = 0; // bit: a question
  for (int i = 0; i < spec->output_count; i++) {
    const sweep_output output = spec->outputs[i];
    const int question = question_of(output);
    if (asked >> question & 1U) continue;
    asked |= 1U << question;
    const int code = answer(row, output, point, spec);
    if (code == BIKE_ERROR_MEMORY) return false;
    if (code) fail(row, question, code);
  }
  return true;
}

// The rides of one call, side by side in the lanes of an ensemble.
typedef struct rides {
  size_t count;
  bike_member members[SWEEP_MOST_ROWS];
  sweep_row *rows[SWEEP_MOST_ROWS];
} rides;

static void add_ride(rides *all, sweep_row *row, const sweep_point *point, const sweep_spec *spec) {
  bike_state start = point->start;
  int code = spec->same_energy
                 ? bike_speed_of_equal_energy(&start.speed, &point->model, &start, start.speed)
                 : BIKE_OK;
  fail(row, SWEEP_OUTCOME, code);
  if (code) return;
  all->rows[all->count] = row;
  all->members[all->count++] = (bike_member){
      .model = &point->model, .start = start, .input = {.rider_offset = point->rider_offset}};
}

static bool ride_all(rides *all, const sweep_spec *spec) {
  bike_fate fates[SWEEP_MOST_ROWS];
  double times[SWEEP_MOST_ROWS];
  int codes[SWEEP_MOST_ROWS];
  bike_basin_def def = bike_default_basin_def();
  def.duration = spec->ride_time;
  def.settled = spec->settled;
  const int failed = bike_fates_of_starts(fates, times, codes, all->members, all->count, &def);
  for (size_t i = 0; i < all->count; i++) {
    sweep_row *row = all->rows[i];
    int code = failed ? failed : codes[i];
    if (code == BIKE_ERROR_MEMORY) return false;
    if (!code && fates[i] == BIKE_FATE_NO_START) code = BIKE_ERROR_GEOMETRY;
    fail(row, SWEEP_OUTCOME, code);
    if (code) continue;
    row->outcome = outcome_of(fates[i]);
    row->numbers[SWEEP_TIME] = times[i];
  }
  return true;
}

static bool asks_for_rides(const sweep_spec *spec) {
  for (int i = 0; i < spec->output_count; i++)
    if (question_of(spec->outputs[i]) == SWEEP_OUTCOME) return true;
  return false;
}

bool sweep_evaluate(sweep_row *rows, const sweep_spec *spec, long first, long count) {
  sweep_point points[SWEEP_MOST_ROWS];
  rides all = {0};
  for (long i = 0; i < count; i++) {
    sweep_point_at(&points[i], spec, first + i);
    begin_row(&rows[i], &points[i], first + i);
    if (points[i].code == BIKE_ERROR_MEMORY) return false;
    if (points[i].code) continue;
    if (!evaluate_point(&rows[i], &points[i], spec)) return false;
    if (asks_for_rides(spec)) add_ride(&all, &rows[i], &points[i], spec);
  }
  return ride_all(&all, spec);
}
