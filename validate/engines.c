// SPDX-License-Identifier: Apache-2.0
#include "engine.h"

#include <string.h>
#include <time.h>

static const engine *const engines[] = {&engine_analytic, &engine_mujoco, &engine_linear,
                                        &engine_file,     &engine_disc,   &engine_mujoco_disc};

enum { ENGINE_COUNT = sizeof engines / sizeof engines[0] };

const engine *engine_at(int index) {
  return index >= 0 && index < ENGINE_COUNT ? engines[index] : NULL;
}

const engine *engine_find(const char *name) {
  for (int i = 0; i < ENGINE_COUNT; i++)
    if (strcmp(engines[i]->name, name) == 0) return engines[i];
  return NULL;
}

engine_choice engine_default_choice(const engine *e) {
  engine_choice choice = {.engine = e};
  for (int i = 0; i < e->option_count; i++) choice.option[i] = e->options[i].value;
  return choice;
}

double engine_order(const engine_choice *choice) {
  return choice->engine->order ? choice->engine->order(choice) : 0;
}

int engine_option_index(const engine *e, const char *name) {
  for (int i = 0; name && i < e->option_count; i++)
    if (strcmp(e->options[i].name, name) == 0) return i;
  return -1;
}

static double read_clock(clockid_t id) {
  struct timespec now;
  clock_gettime(id, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

double engine_clock(void) {
  return read_clock(CLOCK_MONOTONIC);
}

double engine_processor_clock(void) {
  return read_clock(CLOCK_THREAD_CPUTIME_ID);
}
