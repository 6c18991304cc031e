// SPDX-License-Identifier: Apache-2.0
// Many rides to their end: one after the other, in the lanes of vector registers, and on two
// threads.
#include "plain_ride.h"
#include "ride.h"

#include <bicycle/batch.h>
#include <bicycle/ensemble.h>
#include <math.h>
#include <unistd.h>

// Two threads share what is left at the end the better the more there is.
enum { RIDES = 128, RIDES_OF_THREADS = 256, QUICK_RIDES = 8 };

typedef struct ensemble_cases {
  bench_subject *subject;
  int rides, rides_of_threads;
  bike_member members[RIDES_OF_THREADS];
  bike_member_result results[RIDES_OF_THREADS];
  bike_state reference[RIDES]; // the ends of rides at the default tolerance of bike_ride
  bool ready;
} ensemble_cases;

// Without looks on the way, which the plain stepping has not either.
static bike_ensemble_def question(const ensemble_cases *c, int threads) {
  bike_ensemble_def def = bike_default_ensemble_def();
  def.duration = c->subject->ride_time;
  def.settled = 0;
  def.watch_lift = false;
  def.threads = threads;
  return def;
}

//---------------------------------- contestants ---------------------------------------------------

static int in_lanes(ensemble_cases *c, int threads, int rides) {
  bike_ensemble_def def = question(c, threads);
  return bike_ensemble_ride(c->results, c->members, (size_t)rides, &def);
}

static void lanes(void *context, long repeats) {
  ensemble_cases *c = context;
  for (long k = 0; k < repeats; k++) in_lanes(c, 1, c->rides);
}

static void one_thread(void *context, long repeats) {
  ensemble_cases *c = context;
  for (long k = 0; k < repeats; k++) in_lanes(c, 1, c->rides_of_threads);
}

static void two_threads(void *context, long repeats) {
  ensemble_cases *c = context;
  for (long k = 0; k < repeats; k++) in_lanes(c, 2, c->rides_of_threads);
}

static int pass(const bike_sample *sample, const bike_sample_more *more, void *user) {
  (void)sample, (void)more, (void)user;
  return 0;
}

// bike_ride, sampled at its ends alone.
static bool by_sundials(bike_state *end, const ensemble_cases *c, int i, double rtol, double atol) {
  bike_ride_def def = bike_default_ride_def();
  def.start = c->members[i].start;
  def.duration = def.sample = c->subject->ride_time;
  def.rtol = rtol;
  def.atol = atol;
  def.on_sample = pass;
  bike_ride_result out;
  if (bike_ride(&out, c->members[i].model, &def) || !out.complete) return false;
  const bike_sample *s = &out.end;
  *end = (bike_state){s->lean, s->steer, s->lean_rate, s->steer_rate, s->speed};
  return true;
}

static void sundials(void *context, long repeats) {
  const ensemble_cases *c = context;
  const bike_ensemble_def def = question(c, 1);
  bike_state end;
  for (long k = 0; k < repeats; k++)
    for (int i = 0; i < c->rides; i++) by_sundials(&end, c, i, def.rtol, def.atol);
}

static bool plainly(bike_state *end, const ensemble_cases *c, int i, long *evaluations) {
  const bike_ensemble_def def = question(c, 1);
  plain_ride ride = {c->members[i].model, def.duration, def.rtol, def.atol, 0};
  *end = c->members[i].start;
  bool done = plain_ride_go(end, &ride);
  *evaluations += ride.evaluations;
  return done;
}

static void plain(void *context, long repeats) {
  const ensemble_cases *c = context;
  bike_state end;
  long evaluations = 0;
  for (long k = 0; k < repeats; k++)
    for (int i = 0; i < c->rides; i++) plainly(&end, c, i, &evaluations);
}

//---------------------------------- agreement -----------------------------------------------------

// Some hundred steps at 1e-10, of states of the order of 0.1 and a speed of 6.
static const double ENDS_AGREE = 1e-8;

static double distance(const bike_state *a, const bike_state *b) {
  const double x[] = {a->lean, a->steer, a->lean_rate, a->steer_rate, a->speed};
  const double y[] = {b->lean, b->steer, b->lean_rate, b->steer_rate, b->speed};
  return bench_ride_error(x, y);
}

// Rolls of all sizes about that of the single ride, at speeds about its speed.
static void start_all(ensemble_cases *c) {
  for (int i = 0; i < c->rides_of_threads; i++) {
    bike_state start = c->subject->ride_start;
    start.lean_rate *= 0.2 + 0.8 * (i + 1) / c->rides_of_threads;
    start.speed *= 1 + 0.01 * (i % 9 - 4);
    c->members[i] = (bike_member){.model = &c->subject->model, .start = start};
  }
}

static bool settle(ensemble_cases *c, bench_notes *notes) {
  if (c->ready) return true;
  start_all(c);
  const bike_ride_def exact = bike_default_ride_def();
  for (int i = 0; i < c->rides; i++)
    if (!by_sundials(&c->reference[i], c, i, exact.rtol, exact.atol))
      return bench_note_reason(notes, "the bicycle does not ride for %g s", c->subject->ride_time);
  c->ready = true;
  return true;
}

// How far the lanes are from the rides at the default tolerance.
static bool note_lanes(ensemble_cases *c, int rides, int threads, bench_notes *notes) {
  if (!settle(c, notes)) return false;
  if (in_lanes(c, threads, rides)) return bench_note_reason(notes, "the ensemble is refused");
  double worst = 0, evaluations = 0;
  for (int i = 0; i < c->rides; i++) {
    bool complete = c->results[i].outcome == BIKE_OUTCOME_COMPLETE;
    worst = fmax(worst, complete ? distance(&c->results[i].end, &c->reference[i]) : INFINITY);
    evaluations += (double)c->results[i].evaluations / c->rides;
  }
  bench_note_value(notes, "lanes", bike_batch_width());
  bench_note_check(notes, "our error", worst, ENDS_AGREE);
  bench_note_value(notes, "our evaluations", evaluations);
  return true;
}

static bool prepare_sundials(void *context, bench_notes *notes) {
  ensemble_cases *c = context;
  if (!note_lanes(c, c->rides, 1, notes)) return false;
  const bike_ensemble_def def = question(c, 1);
  double worst = 0;
  for (int i = 0; i < c->rides; i++) {
    bike_state end;
    bool done = by_sundials(&end, c, i, def.rtol, def.atol);
    worst = fmax(worst, done ? distance(&end, &c->reference[i]) : INFINITY);
  }
  bench_note_check(notes, "their error", worst, ENDS_AGREE);
  return true;
}

static bool prepare_plain(void *context, bench_notes *notes) {
  ensemble_cases *c = context;
  if (!note_lanes(c, c->rides, 1, notes)) return false;
  double worst = 0;
  long evaluations = 0;
  for (int i = 0; i < c->rides; i++) {
    bike_state end;
    bool done = plainly(&end, c, i, &evaluations);
    worst = fmax(worst, done ? distance(&end, &c->reference[i]) : INFINITY);
  }
  bench_note_check(notes, "their error", worst, ENDS_AGREE);
  bench_note_value(notes, "their evaluations", (double)evaluations / c->rides);
  return true;
}

static bool prepare_threads(void *context, bench_notes *notes) {
  if (sysconf(_SC_NPROCESSORS_ONLN) < 2) return bench_note_reason(notes, "one core alone");
  ensemble_cases *c = context;
  return note_lanes(c, c->rides_of_threads, 2, notes);
}

bool bench_ensemble_cases(bench_list *list) {
  ensemble_cases *c = bench_new(list, sizeof *c, NULL);
  c->subject = list->subject;
  c->rides = c->subject->quick ? QUICK_RIDES : RIDES;
  c->rides_of_threads = c->subject->quick ? QUICK_RIDES : RIDES_OF_THREADS;
  const bench_runner ours = {"bike_ensemble_ride", lanes, .context = c, .units = c->rides};
  double asked = bike_batch_width() == 8 ? 5 : 0, possible = bike_batch_width() == 8 ? 6.6 : 0;
  const bench_contest contests[] = {
      {.name = "ensemble-sundials",
       .question = "rides of an ensemble: bike_ride, one by one / lanes",
       .ours = ours,
       .theirs = {"bike_ride", sundials, .context = c, .units = c->rides},
       .asked = asked,
       .possible = possible,
       .prepare = prepare_sundials},
      {.name = "ensemble-plain",
       .question = "rides of an ensemble: the same steps in scalar code / lanes",
       .ours = ours,
       .theirs = {"scalar steps", plain, .context = c, .units = c->rides},
       .asked = asked,
       .possible = possible,
       .prepare = prepare_plain},
      {.name = "ensemble-threads",
       .question = "rides of an ensemble, by the clock: 1 thread / 2 threads",
       .ours = {"2 threads", two_threads, .context = c, .threads = true,
                .units = c->rides_of_threads},
       .theirs = {"1 thread", one_thread, .context = c, .threads = true,
                  .units = c->rides_of_threads},
       .asked = 1.7,
       .possible = 1.83,
       .prepare = prepare_threads}};
  bench_add_all(list, contests, sizeof contests / sizeof contests[0], c);
  return true;
}
