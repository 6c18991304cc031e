// SPDX-License-Identifier: Apache-2.0
// The file engine: a ride that any other simulator has recorded in a CSV file.
//
// Nothing is interpolated: the file must hold a row at each of the scenario's times. Rows between
// are passed over; a file that ends before the ride does is a ride that ended. The file is read
// row by row, all of it, so that its length costs time alone.
#include "engine.h"

#include "files/csv.h"
#include "terminal/message.h"

#include <bicycle/error.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

// Within this share of the sample two times are one: recorders write decimals, or sums of them.
static const double same_time = 1e-6;

typedef struct source {
  int column;                 // of the file
  double scale;               //
  const trace_signal *signal; // NULL: the time
} source;

typedef struct recording {
  char path[ENGINE_PATH_SIZE];
  bike_csv_reader reader; // before its first row, or closed: the next ride opens the file again
  source time;
  source signals[TRACE_SIGNAL_COUNT];
  int signal_count;
} recording;

static void free_recording(void *instance) {
  recording *r = instance;
  bike_csv_close(&r->reader);
  free(r);
}

// "a, b, c" of the file's columns, for the message.
static void list_columns(char *out, size_t size, const bike_csv_header *header) {
  size_t used = 0;
  out[0] = '\0';
  for (int i = 0; i < header->columns && used < size; i++)
    used += (size_t)snprintf(out + used, size - used, "%s%s", i ? ", " : "", header->name[i]);
}

static term_exit no_column(const recording *r, const char *column, const char *signal, problem *p) {
  char all[400];
  list_columns(all, sizeof all, &r->reader.header);
  if (strcmp(column, signal) == 0)
    return problem_set(p, TERM_USAGE, "%s: there is no column '%s'; there are: %s", r->path, column,
                       all);
  return problem_set(p, TERM_USAGE, "%s: there is no column '%s' for '%s'; there are: %s", r->path,
                     column, signal, all);
}

// The columns of a map.
static term_exit map_columns(recording *r, const engine_choice *choice, problem *p) {
  for (int i = 0; i < choice->column_count; i++) {
    const engine_column *c = &choice->columns[i];
    source s = {bike_csv_column(&r->reader.header, c->column), c->scale,
                trace_find_signal(c->signal)};
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
    int column = bike_csv_column(&r->reader.header, trace_signals[i].name);
    if (column >= 0) r->signals[r->signal_count++] = (source){column, 1, &trace_signals[i]};
  }
}

static term_exit find_columns(recording *r, const engine_choice *choice, problem *p) {
  r->time = (source){bike_csv_column(&r->reader.header, "time"), 1, NULL};
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

static term_exit open_file(recording *r, problem *p) {
  bike_file_error error;
  int code = bike_csv_open(&r->reader, r->path, &error);
  r->reader.not_finite = true; // what is not needed does not matter; what is, is told by the ride
  return code == BIKE_OK ? TERM_DONE : problem_set(p, term_exit_of(code), "%s", error.text);
}

static void *create(const bike_bicycle *bicycle, const engine_choice *choice, term_exit *code,
                    problem *p) {
  (void)bicycle; // of which the file says nothing
  recording *r = calloc(1, sizeof *r);
  if (!r) {
    *code = problem_memory(p);
    return NULL;
  }
  snprintf(r->path, sizeof r->path, "%s", choice->file);
  *code = open_file(r, p);
  if (*code == TERM_DONE) *code = find_columns(r, choice, p);
  if (*code == TERM_DONE) return r;
  free_recording(r);
  return NULL;
}

static void version(char out[ENGINE_VERSION_SIZE]) {
  snprintf(out, ENGINE_VERSION_SIZE, "%s", "a recorded ride");
}

//---------------------------------- playing -------------------------------------------------------

// A ride under way: what is left of the file.
typedef struct playing {
  recording *r;
  trace *out; // NULL: only to see whether it can be played
  const engine_ride *asked;
  double numbers[BIKE_CSV_COLUMNS]; // the row last read
  double time, before;              // s  of it, and of the one before
  long rows;                        //    read so far
  long next, last;                  //    samples: the one waited for, and the ride's last
  problem gap;                      //    the first sample that the file passes over; empty: none
  bool lost;                        //    a row has no time: what follows it cannot be placed
} playing;

static double value_of(const playing *g, const source *s) {
  return g->numbers[s->column] * s->scale;
}

static const char *column_of(const playing *g, const source *s) {
  return g->r->reader.header.name[s->column];
}

// Notes where a signal is not finite for the first time; false when out of memory.
static bool note_flaw(playing *g, const source *s) {
  trace_flaw *flaw = &g->out->flaws[s->signal - trace_signals];
  if (flaw->place) return true;
  flaw->row = g->out->count;
  if (asprintf(&flaw->place, "%s:%ld: %s", g->r->path, g->r->reader.line, column_of(g, s)) >= 0)
    return true;
  flaw->place = NULL;
  return false;
}

static term_exit record(playing *g) {
  if (!g->out) {
    g->next++;
    return TERM_DONE;
  }
  trace_row row = {.sample.time = (double)g->next * g->asked->sample};
  for (int i = 0; i < g->r->signal_count; i++) {
    double value = value_of(g, &g->r->signals[i]);
    if (!isfinite(value) && !note_flaw(g, &g->r->signals[i])) return TERM_INVALID;
    memcpy((char *)&row + g->r->signals[i].signal->offset, &value, sizeof value);
  }
  g->next++;
  return trace_add(g->out, &row) ? TERM_DONE : TERM_INVALID;
}

static void note_gap(playing *g) {
  char before[48] = "";
  if (*g->gap.text) return;
  if (g->rows > 1) snprintf(before, sizeof before, " follows %.9g s", g->before);
  problem_set(&g->gap, TERM_USAGE,
              "%s:%ld: there is no row at %.9g s: %.9g s%s (rows are needed at every sample of the "
              "scenario)",
              g->r->path, g->r->reader.line, (double)g->next * g->asked->sample, g->time,
              g->rows > 1 ? before : " is the first");
}

// A row without a time matters up to the end of the ride; it makes the ride invalid, not the input.
static term_exit take_lost_row(playing *g, problem *p) {
  if (g->next > g->last) return TERM_DONE;
  g->lost = true;
  if (!g->out) return TERM_DONE;
  return problem_set(p, TERM_INVALID, "%s:%ld: %s: the time is not finite", g->r->path,
                     g->r->reader.line, column_of(g, &g->r->time));
}

static term_exit take_row(playing *g, problem *p) {
  double slack = same_time * g->asked->sample, wanted = (double)g->next * g->asked->sample;
  double time = value_of(g, &g->r->time);
  if (!isfinite(time)) return take_lost_row(g, p);
  g->before = g->time;
  g->time = time;
  if (g->rows++ > 0 && !(g->time > g->before))
    return problem_set(p, TERM_USAGE, "%s:%ld: %s: the time does not rise: %.9g s after %.9g s",
                       g->r->path, g->r->reader.line, column_of(g, &g->r->time), g->time,
                       g->before);
  if (g->next > g->last || g->time < wanted - slack) return TERM_DONE;
  if (g->time > wanted + slack) {
    note_gap(g);
    return TERM_DONE; // what is wrong with the rows themselves is told first
  }
  if (record(g) != TERM_DONE) return problem_memory(p);
  double share = wanted / g->asked->duration;
  if (g->asked->progress && !g->asked->progress(share, g->asked->user))
    return problem_set(p, TERM_INVALID, "interrupted");
  return TERM_DONE;
}

static term_exit end(playing *g, problem *p) {
  if (g->rows < 2)
    return problem_set(p, TERM_USAGE, "%s: a ride needs two rows at least, there %s %ld",
                       g->r->path, g->rows == 1 ? "is" : "are", g->rows);
  if (g->next == 0) note_gap(g);
  if (*g->gap.text) return problem_set(p, TERM_USAGE, "%s", g->gap.text);
  if (!g->out) return TERM_DONE;
  bool complete = g->next > g->last;
  g->out->ending = "end of the recording";
  trace_end(g->out, complete, complete ? g->asked->duration : g->time, NULL, 0);
  return TERM_DONE;
}

static term_exit play(playing *g, problem *p) {
  for (;;) {
    bool found;
    bike_file_error error;
    int read = bike_csv_next(g->numbers, &found, &g->r->reader, &error);
    if (read != BIKE_OK) return problem_set(p, term_exit_of(read), "%s", error.text);
    if (!found) return end(g, p);
    term_exit code = take_row(g, p);
    if (code != TERM_DONE || g->lost) return code;
  }
}

// From its first row to its last; `out` as of `playing`.
static term_exit play_all(trace *out, recording *r, const engine_ride *asked, problem *p) {
  term_exit code = r->reader.stream ? TERM_DONE : open_file(r, p);
  if (code != TERM_DONE) return code;
  playing g = {.r = r, .out = out, .asked = asked};
  g.last = (long)floor(asked->duration / asked->sample * (1 + 1e-12));
  code = play(&g, p);
  bike_csv_close(&r->reader);
  return code;
}

static bool can_be_read_twice(const char *path) {
  struct stat status;
  return stat(path, &status) != 0 || S_ISREG(status.st_mode); // what is missing is told
}

// All of it, so that a wrong row is told before anything is played. It is read again to be played,
// which a pipe cannot be.
static term_exit check(const engine_choice *choice, const engine_ride *asked, problem *p) {
  term_exit code = TERM_DONE;
  if (!can_be_read_twice(choice->file)) return code;
  recording *r = create(NULL, choice, &code, p);
  if (!r) return code;
  code = play_all(NULL, r, asked, p);
  free_recording(r);
  return code;
}

static term_exit ride(trace *out, void *instance, const engine_ride *asked, problem *p) {
  recording *r = instance;
  out->missing = (UINT64_C(1) << TRACE_SIGNAL_COUNT) - 1;
  for (int i = 0; i < r->signal_count; i++)
    out->missing &= ~(UINT64_C(1) << (r->signals[i].signal - trace_signals));
  out->has_contacts = trace_has(out, trace_find_signal("rear_slip")) &&
                      trace_has(out, trace_find_signal("front_slip")) &&
                      trace_has(out, trace_find_signal("rear_height")) &&
                      trace_has(out, trace_find_signal("front_height"));
  return play_all(out, r, asked, p);
}

const engine engine_file = {
    .name = "file",
    .summary = "a ride recorded in a CSV file by any other simulator",
    .plays_file = true,
    .takes_input = true, // of which the recording is what came
    .check = check,
    .create = create,
    .free = free_recording,
    .version = version,
    .ride = ride,
};
