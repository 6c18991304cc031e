// SPDX-License-Identifier: Apache-2.0
// Ten seconds of riding at equal measured end error, and what SUNDIALS adds to the equations.
#include "peers/scipy.h"
#include "ride.h"
#include "tune.h"
#include "work.h"

#include <math.h>

// Of each of the five states: ten digits, in reach of all methods.
static const double END_ERROR = 1e-10;

// As tight as bike_ride takes it, but for a factor.
static const double TIGHTEST = 1e-15;

typedef struct ride_cases {
  bench_subject *subject;
  double end[BENCH_RIDE_STATES]; // of the tightest ride
  bench_ride equal, standard;    // ours: tuned, and as bike_default_ride_def has it
  long evaluations;              // of the standard ride
  bool ready;
  bench_twin twin; // MuJoCo's
  long steps;      //
  python_peer *python;
  bool loaded;
} ride_cases;

//---------------------------------- ours ----------------------------------------------------------

static void note_own(bench_notes *notes, const ride_cases *c, const bench_ride *ride) {
  bike_ride_result result;
  double states[BENCH_RIDE_STATES] = {NAN};
  if (bench_ride_go(&result, ride)) bench_ride_states(states, &result.end);
  bench_note_check(notes, "our error", bench_ride_error(states, c->end), END_ERROR);
  bench_note_value(notes, "our tolerance", ride->tolerance);
  bench_note_value(notes, "our evaluations", (double)result.evaluations);
}

// The reference and our own settings, once for all contests.
static bool settle(ride_cases *c, bench_notes *notes) {
  if (c->ready) return true;
  bench_ride tightest = {c->subject, TIGHTEST};
  bike_ride_result result;
  if (!bench_ride_go(&result, &tightest))
    return bench_note_reason(notes, "the ride is not possible");
  bench_ride_states(c->end, &result.end);
  c->standard = (bench_ride){c->subject, bike_default_ride_def().rtol};
  double tolerance = bench_ride_tolerance(c->subject, c->end, END_ERROR);
  if (!bench_ride_go(&result, &c->standard) || tolerance == 0)
    return bench_note_reason(notes, "our rides do not reach an end error of %g", END_ERROR);
  c->evaluations = result.evaluations;
  c->equal = (bench_ride){c->subject, tolerance};
  c->ready = true;
  return true;
}

static void own_evaluations(void *context, long repeats) {
  ride_cases *c = context;
  for (long i = 0; i < repeats; i++) bench_right_hand_sides(c->subject, c->evaluations);
}

static bool prepare_own(void *context, bench_notes *notes) {
  ride_cases *c = context;
  if (!settle(c, notes)) return false;
  note_own(notes, c, &c->standard);
  return true;
}

//---------------------------------- scipy's -------------------------------------------------------

// One way to ride with scipy.
typedef struct scipy_case {
  ride_cases *common;
  scipy_ride ride;
  const bench_ride *ours;
} scipy_case;

static bool prepare_scipy(void *context, bench_notes *notes) {
  scipy_case *s = context;
  ride_cases *c = s->common;
  if (!settle(c, notes)) return false;
  if (!c->loaded) c->loaded = scipy_load(c->python, c->subject, c->end, notes);
  if (!c->loaded || !scipy_tune(&s->ride, END_ERROR, notes)) return false;
  note_own(notes, c, s->ours);
  return true;
}

static void add_scipy_cases(bench_list *list, ride_cases *c) {
  static const struct {
    const char *name, *question, *method, *says;
    bool standard; // ours as it is by default
    double asked, possible;
  } CASES[] = {{"ride-lsoda", "ride, equal error: LSODA over sympy's C / ours", "lsoda",
                "LSODA, C callback", false, 5, 10},
               {"ride-odeint", "ride, equal error: odeint, Python, sympy's C / ours", "odeint",
                "LSODA, odeint", false, 0, 0},
               {"ride-solve-ivp", "ride, equal error: solve_ivp LSODA, Python, sympy's C / ours",
                "solve_ivp LSODA", "LSODA, solve_ivp", false, 5, 10},
               {"ride-lsoda-default", "ride: LSODA at 1e-10 / our default at its own error",
                "lsoda", "LSODA, C callback", true, 0, 0},
               {"ride-dop853", "ride, equal error: DOP853 over sympy's C / ours", "dop853",
                "DOP853, C callback", false, 0, 0},
               {"ride-dop853-python",
                "ride, equal error: solve_ivp DOP853, Python, sympy's C / ours", "solve_ivp DOP853",
                "DOP853, solve_ivp", false, 0, 0}};
  for (size_t i = 0; i < sizeof CASES / sizeof CASES[0]; i++) {
    scipy_case *s = bench_new(list, sizeof *s, NULL);
    bench_ride *ours = CASES[i].standard ? &c->standard : &c->equal;
    *s = (scipy_case){c, {.peer = list->python, .method = CASES[i].method}, ours};
    const char *name = CASES[i].standard ? "bike_ride, default" : "SUNDIALS, tuned";
    bench_add(list,
              &(bench_contest){.name = CASES[i].name,
                               .question = CASES[i].question,
                               .ours = {name, bench_rides, .context = ours},
                               .theirs = {CASES[i].says, .timed = scipy_rides, .context = &s->ride},
                               .asked = CASES[i].asked,
                               .possible = CASES[i].possible,
                               .prepare = prepare_scipy,
                               .context = s});
  }
}

//---------------------------------- MuJoCo's ------------------------------------------------------

// RK4 with the rolling callback, without contacts and sensors.
static void mujoco_ride(ride_cases *c, long steps) {
  mjModel *m = runner_model(c->twin.runner);
  mjData *d = runner_data(c->twin.runner);
  int flags = bench_twin_bare(&c->twin);
  mj_copyData(d, m, c->twin.start);
  m->opt.timestep = c->subject->ride_time / (double)steps;
  for (long i = 0; i < steps; i++) mj_step(m, d);
  bench_twin_restore(&c->twin, flags);
}

static void mujoco_rides(void *context, long repeats) {
  ride_cases *c = context;
  for (long i = 0; i < repeats; i++) mujoco_ride(c, c->steps);
}

static double mujoco_error(ride_cases *c, long steps) {
  mujoco_ride(c, steps);
  runner_instant at;
  mjcf_error error;
  if (runner_measure(&at, c->twin.runner, &error)) return INFINITY;
  const double states[] = {at.lean, at.steer, at.lean_rate, at.steer_rate, at.speed};
  return bench_ride_error(states, c->end);
}

// Steps of 100 ms and less, four settings to a factor of two.
static long steps_of(int k) {
  return lround(100 * exp2(k / 4.0));
}

static bool steps_are_good(void *context, int k) {
  return mujoco_error(context, steps_of(k)) <= END_ERROR;
}

static bool prepare_mujoco(void *context, bench_notes *notes) {
  ride_cases *c = context;
  if (!settle(c, notes)) return false;
  const bench_subject *s = c->subject;
  if (!c->twin.runner && !bench_twin_open(&c->twin, &s->bicycle, &s->ride_start))
    return bench_note_reason(notes, "the bicycle could not be set up in MuJoCo");
  int k = bench_loosest(steps_are_good, c, 0, 32); // 25600 steps of 0.4 ms
  if (k < 0) return bench_note_reason(notes, "MuJoCo does not reach an end error of %g", END_ERROR);
  c->steps = steps_of(k);
  bench_note_check(notes, "their error", mujoco_error(c, c->steps), END_ERROR);
  bench_note_value(notes, "their step", s->ride_time / (double)c->steps);
  note_own(notes, c, &c->equal);
  return true;
}

static void end(void *context) {
  ride_cases *c = context;
  bench_twin_close(&c->twin);
}

bool bench_ride_cases(bench_list *list) {
  ride_cases *c = bench_new(list, sizeof *c, end);
  c->subject = list->subject;
  c->python = list->python;
  add_scipy_cases(list, c);
  const bench_contest contests[] = {
      {.name = "ride-mujoco",
       .question = "ride, equal error: MuJoCo RK4 with rolling / ours",
       .ours = {"SUNDIALS, tuned", bench_rides, .context = &c->equal},
       .theirs = {"mj_step, callback", mujoco_rides, .context = c},
       .asked = 20,
       .possible = 40,
       .prepare = prepare_mujoco},
      {.name = "ride-overhead",
       .question = "SUNDIALS default ride / its right-hand sides",
       .ours = {"bike_ride, default", bench_rides, .context = &c->standard},
       .theirs = {"bike_rates_of", own_evaluations, .context = c},
       .sense = BENCH_AT_MOST,
       .asked = 3.5,
       .possible = 2.9,
       .prepare = prepare_own}};
  bench_add_all(list, contests, sizeof contests / sizeof contests[0], c);
  return true;
}
