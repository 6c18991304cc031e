// SPDX-License-Identifier: Apache-2.0
// The file engine: a ride that any other simulator has recorded in a CSV file.
//
// Nothing is interpolated: the file must hold a row at each of the scenario's times. Rows between
// are passed over; a file that ends before the ride does is a ride that ended.
#include "engine.h"

#include "files/csv.h"
#include "terminal/message.h"

#include <bicycle/error.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// Within this share of the sample two times are one: recorders write decimals, or sums of them.
static const double same_time = 1e-6;

typedef struct source {
  int column;                 // of the file
  double scale;               //
  const trace_signal *signal; // NULL: the time
} source;

typedef struct recording {
  char path[ENGINE_PATH_SIZE];
  bike_csv csv;
  source time;
  source signals[TRACE_SIGNAL_COUNT];
  int signal_count;
} recording;

static void free_recording(void *instance) {
  recording *r = instance;
  bike_csv_free(&r->csv);
  free(r);
}

// "a, b, c" of the file's columns, for the message.
static void list_columns(char *out, size_t size, const bike_csv *csv) {
  size_t used = 0;
  out[0] = '\0';
  for (int i = 0; i < csv->columns && used < size; i++)
    used += (size_t)snprintf(out + used, size - used, "%s%s", i ? ", " : "", csv->name[i]);
}

static term_exit no_column(const recording *r, const char *column, const char *signal, problem *p) {
  char all[400];
  list_columns(all, sizeof all, &r->csv);
  return problem_set(p, TERM_USAGE, "%s: there is no column '%s' for '%s'; there are: %s", r->path,
                     column, signal, all);
}

// The columns of a map.
static term_exit map_columns(recording *r, const engine_choice *choice, problem *p) {
  for (int i = 0; i < choice->column_count; i++) {
    const engine_column *c = &choice->columns[i];
    source s = {bike_csv_column(&r->csv, c->column), c->scale, trace_find_signal(c->signal)};
    if (s.column < 0) return no_column(r, c->column, c->signal, p);
    if (s.signal)
      r->signals[r->signal_count++] = s;
    else
      r->time = s;
  }
  return TERM_DONE;
}

// Without a map: the names of `bicycle ride`, as many as are there.
static void take_own_names(recording *r) {
  for (int i = 0; i < TRACE_SIGNAL_COUNT; i++) {
    int column = bike_csv_column(&r->csv, trace_signals[i].name);
    if (column >= 0) r->signals[r->signal_count++] = (source){column, 1, &trace_signals[i]};
  }
}

static term_exit find_columns(recording *r, const engine_choice *choice, problem *p) {
  r->time = (source){bike_csv_column(&r->csv, "time"), 1, NULL};
  term_exit code = TERM_DONE;
  if (choice->column_count)
    code = map_columns(r, choice, p);
  else
    take_own_names(r);
  if (code != TERM_DONE) return code;
  if (r->time.column < 0) return no_column(r, "time", "time", p);
  if (r->signal_count == 0) return no_column(r, "lean", "lean (or any other signal)", p);
  return TERM_DONE;
}

static double value_at(const recording *r, size_t row, const source *s) {
  return r->csv.value[row * (size_t)r->csv.columns + (size_t)s->column] * s->scale;
}

static term_exit check_time(const recording *r, problem *p) {
  if (r->csv.rows < 2)
    return problem_set(p, TERM_USAGE, "%s: a ride needs two rows at least, there %s %zu", r->path,
                       r->csv.rows == 1 ? "is" : "are", r->csv.rows);
  for (size_t k = 1; k < r->csv.rows; k++) {
    double before = value_at(r, k - 1, &r->time), now = value_at(r, k, &r->time);
    if (!(now > before))
      return problem_set(p, TERM_USAGE, "%s:%d: %s: the time does not rise: %.9g s after %.9g s",
                         r->path, r->csv.line[k], r->csv.name[r->time.column], now, before);
  }
  return TERM_DONE;
}

static void *create(const bike_bicycle *bicycle, const engine_choice *choice, term_exit *code,
                    problem *p) {
  (void)bicycle; // of which the file says nothing
  recording *r = calloc(1, sizeof *r);
  if (!r) {
    *code = problem_memory(p);
    return NULL;
  }
  bike_file_error error;
  snprintf(r->path, sizeof r->path, "%s", choice->file);
  int read = bike_csv_read(&r->csv, r->path, &error);
  *code = read == BIKE_OK ? find_columns(r, choice, p)
                          : problem_set(p, term_exit_of(read), "%s", error.text);
  if (*code == TERM_DONE) *code = check_time(r, p);
  if (*code == TERM_DONE) return r;
  free_recording(r);
  return NULL;
}

static void version(char out[ENGINE_VERSION_SIZE]) {
  snprintf(out, ENGINE_VERSION_SIZE, "%s", "a recorded ride");
}

static void fill_row(trace_row *out, const recording *r, size_t row, double time) {
  *out = (trace_row){0};
  for (int i = 0; i < TRACE_SIGNAL_COUNT; i++) {
    double none = NAN;
    memcpy((char *)out + trace_signals[i].offset, &none, sizeof none);
  }
  out->sample.time = time;
  for (int i = 0; i < r->signal_count; i++) {
    double value = value_at(r, row, &r->signals[i]);
    memcpy((char *)out + r->signals[i].signal->offset, &value, sizeof value);
  }
}

static term_exit gap(const recording *r, size_t row, double time, problem *p) {
  return problem_set(p, TERM_USAGE,
                     "%s:%d: there is no row at %.9g s: %.9g s follows %.9g s (rows are needed at "
                     "every sample of the scenario)",
                     r->path, r->csv.line[row], time, value_at(r, row, &r->time),
                     row ? value_at(r, row - 1, &r->time) : NAN);
}

static term_exit play(trace *out, const recording *r, const engine_ride *asked, problem *p) {
  long rows = (long)floor(asked->duration / asked->sample * (1 + 1e-12));
  double slack = same_time * asked->sample, time = 0;
  size_t at = 0;
  for (long k = 0; k <= rows; k++) {
    time = (double)k * asked->sample;
    while (at < r->csv.rows && value_at(r, at, &r->time) < time - slack) at++;
    if (at == r->csv.rows) {
      if (k == 0) return gap(r, at - 1, time, p);
      trace_end(out, false, value_at(r, at - 1, &r->time), NULL, 0);
      return TERM_DONE;
    }
    if (value_at(r, at, &r->time) > time + slack) return gap(r, at, time, p);
    trace_row row;
    fill_row(&row, r, at, time);
    if (!trace_add(out, &row)) return problem_memory(p);
  }
  trace_end(out, true, asked->duration, NULL, 0);
  return TERM_DONE;
}

static term_exit ride(trace *out, void *instance, const engine_ride *asked, problem *p) {
  const recording *r = instance;
  out->missing = (UINT64_C(1) << TRACE_SIGNAL_COUNT) - 1;
  for (int i = 0; i < r->signal_count; i++)
    out->missing &= ~(UINT64_C(1) << (r->signals[i].signal - trace_signals));
  out->has_contacts = trace_has(out, trace_find_signal("rear_slip")) &&
                      trace_has(out, trace_find_signal("front_slip")) &&
                      trace_has(out, trace_find_signal("rear_height")) &&
                      trace_has(out, trace_find_signal("front_height"));
  return play(out, r, asked, p);
}

const engine engine_file = {
    .name = "file",
    .summary = "a ride recorded in a CSV file by any other simulator",
    .plays_file = true,
    .takes_input = true, // of which the recording is what came
    .create = create,
    .free = free_recording,
    .version = version,
    .ride = ride,
};
