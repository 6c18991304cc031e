// SPDX-License-Identifier: Apache-2.0
// Accelerations of many states: one by one, and in the lanes of vector registers.
#include "floor/floor.h"
#include "list.h"

#include <bicycle/batch.h>
#include <math.h>
#include <stdlib.h>

// What one call treats: many times the lanes, and still within the nearest cache.
enum { STATES = 256 };

typedef struct batch_states {
  double lean[STATES], steer[STATES], lean_rate[STATES], steer_rate[STATES], speed[STATES];
} batch_states;

// One bicycle, or as many as states.
typedef struct batch_case {
  bench_subject *subject;
  bool many;
  bike_model models[STATES];
  bike_batch *batch;
  bike_state states[STATES]; // for the scalar path, and the same for the lanes:
  batch_states columns;
  bike_acceleration scalar[STATES];
  batch_states rates; // of the lanes
  int codes[STATES];
  bench_count count;
} batch_case;

static const bike_model *model_of(const batch_case *c, int i) {
  return &c->models[c->many ? i : 0];
}

static void scalar(void *context, long repeats) {
  batch_case *c = context;
  for (long k = 0; k < repeats; k++)
    for (int i = 0; i < STATES; i++)
      bike_accelerate(&c->scalar[i], model_of(c, i), &c->states[i], NULL);
}

static int lanes_once(batch_case *c) {
  const batch_states *s = &c->columns;
  bike_batch_states states = {.lean = s->lean,
                              .steer = s->steer,
                              .lean_rate = s->lean_rate,
                              .steer_rate = s->steer_rate,
                              .speed = s->speed};
  bike_batch_accelerations out = {.lean = c->rates.lean_rate,
                                  .steer = c->rates.steer_rate,
                                  .speed = c->rates.speed,
                                  .codes = c->codes};
  return bike_batch_accelerate(&out, c->batch, &states, STATES);
}

static void lanes(void *context, long repeats) {
  for (long k = 0; k < repeats; k++) lanes_once(context);
}

static void vector_instructions(void *context, long repeats) {
  const batch_case *c = context;
  int width = bike_batch_width();
  bench_fma_vector_chains((double)repeats * c->count.instructions * STATES / width, width);
}

//---------------------------------- states and bicycles -------------------------------------------

static double within(unsigned short seed[3], double low, double high) {
  return low + (high - low) * erand48(seed);
}

// Riding, far from upright, well inside the model.
static void fill_states(batch_case *c) {
  unsigned short seed[3] = {6, 2, 1990};
  for (int i = 0; i < STATES; i++) {
    bike_state *s = &c->states[i];
    c->columns.lean[i] = s->lean = within(seed, -0.4, 0.4);
    c->columns.steer[i] = s->steer = within(seed, -0.3, 0.3);
    c->columns.lean_rate[i] = s->lean_rate = within(seed, -1, 1);
    c->columns.steer_rate[i] = s->steer_rate = within(seed, -1, 1);
    c->columns.speed[i] = s->speed = within(seed, 2, 8);
  }
}

// The same bicycle with frames of growing mass.
static bool fill_models(batch_case *c) {
  for (int i = 0; i < (c->many ? STATES : 1); i++) {
    bike_bicycle bicycle = c->subject->bicycle;
    if (bicycle.part_count > 0) bicycle.parts[0].mass *= 1 + 0.1 * i / STATES;
    if (bike_model_init(&c->models[i], &bicycle)) return false;
  }
  return true;
}

//---------------------------------- agreement -----------------------------------------------------

// Of each number and relative to it or to 1. On x86-64 they are the same bits.
static const double LANES_AGREE = 1e-13;

static double off(double actual, double expected) {
  double error = fabs(actual - expected) / fmax(1, fabs(expected));
  return isnan(error) ? INFINITY : error;
}

static bool prepare(void *context, bench_notes *notes) {
  batch_case *c = context;
  fill_states(c);
  if (!fill_models(c)) return bench_note_reason(notes, "bicycles of other mass are not possible");
  if (!c->batch && bike_batch_create(&c->batch, c->models, c->many ? STATES : 1))
    return bench_note_reason(notes, "out of memory");
  scalar(c, 1);
  if (lanes_once(c)) return bench_note_reason(notes, "the lanes refuse the states");
  double worst = 0;
  int unsolved = 0;
  for (int i = 0; i < STATES; i++) {
    const bike_acceleration *a = &c->scalar[i];
    unsolved += c->codes[i] != 0;
    worst = fmax(worst, off(c->rates.lean_rate[i], a->lean));
    worst = fmax(worst, off(c->rates.steer_rate[i], a->steer));
    worst = fmax(worst, off(c->rates.speed[i], a->speed));
  }
  bench_note_value(notes, "lanes", bike_batch_width());
  bench_note_check(notes, "states without an answer", unsolved, 0);
  bench_note_check(notes, "disagreement", worst, LANES_AGREE);
  return true;
}

static bool prepare_floor(void *context, bench_notes *notes) {
  batch_case *c = context;
  if (!bench_fma_known() || !bench_count_kernel(&c->count))
    return bench_note_reason(notes, "the kernel's machine code could not be counted");
  bench_note_value(notes, "instructions", c->count.instructions);
  return prepare(c, notes);
}

static void end(void *context) {
  batch_case *c = context;
  bike_batch_free(c->batch);
}

static batch_case *add(bench_list *list, const char *name, const char *question, bool many) {
  batch_case *c = bench_new(list, sizeof *c, end);
  c->subject = list->subject;
  c->many = many;
  int width = bike_batch_width();
  bench_add(list, &(bench_contest){
                      .name = name,
                      .question = question,
                      .ours = {"bike_batch_accelerate", lanes, .context = c, .units = STATES},
                      .theirs = {"bike_accelerate", scalar, .context = c, .units = STATES},
                      .asked = width == 8   ? 6
                               : width == 4 ? 3.5
                                            : 0,
                      .possible = width == 8   ? 7.7
                                  : width == 4 ? 4.2
                                               : 0,
                      .prepare = prepare,
                      .context = c});
  return c;
}

bool bench_batch_cases(bench_list *list) {
  batch_case *one = add(list, "batch-one", "accelerations of one bicycle: scalar / lanes", false);
  bench_add(list,
            &(bench_contest){
                .name = "batch-floor",
                .question = "accelerations in lanes / their fused instructions as vector FMAs",
                .ours = {"bike_batch_accelerate", lanes, .context = one, .units = STATES},
                .theirs = {"FMA, 12 chains", vector_instructions, .context = one, .units = STATES},
                .sense = BENCH_AT_MOST,
                .prepare = prepare_floor,
                .context = one});
  add(list, "batch-many", "accelerations of many bicycles: scalar / lanes", true);
  return true;
}
