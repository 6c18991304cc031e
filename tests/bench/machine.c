// SPDX-License-Identifier: Apache-2.0
#include "machine.h"

#include "terminal/json.h"

#include <bicycle/batch.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/utsname.h>
#include <unistd.h>

// The value behind "KEY : " on the first such line of /proc/cpuinfo; empty where there is none.
static void cpu_line(char *out, size_t size, const char *key) {
  out[0] = 0;
  FILE *file = fopen("/proc/cpuinfo", "r");
  char *line = NULL;
  size_t room = 0;
  while (file && getline(&line, &room, file) > 0) {
    char *colon = strchr(line, ':');
    if (!colon || strncmp(line, key, strlen(key)) != 0) continue;
    snprintf(out, size, "%s", colon + 1 + strspn(colon + 1, " "));
    out[strcspn(out, "\n")] = 0;
    break;
  }
  free(line);
  if (file) fclose(file);
}

// Of the flags, those that decide what arithmetic costs.
static json_t *vector_units(void) {
  static const char *const UNITS[] = {"sse2", "fma", "avx", "avx2", "avx512f", "avx512dq"};
  char flags[8192], padded[sizeof flags + 2];
  cpu_line(flags, sizeof flags, "flags");
  snprintf(padded, sizeof padded, " %s ", flags);
  json_t *list = json_array();
  for (size_t i = 0; i < sizeof UNITS / sizeof UNITS[0]; i++) {
    char word[32];
    snprintf(word, sizeof word, " %s ", UNITS[i]);
    if (strstr(padded, word)) json_array_append_new(list, json_string(UNITS[i]));
  }
  return list;
}

json_t *bench_machine(void) {
  char cpu[256];
  cpu_line(cpu, sizeof cpu, "model name");
  struct utsname system = {0};
  uname(&system);
  double load = NAN;
  if (getloadavg(&load, 1) != 1) load = NAN;
  return json_pack("{s:s, s:o, s:s, s:i, s:I, s:o, s:s, s:s, s:s, s:s, s:s}", "cpu",
                   cpu[0] ? cpu : "unknown", "vector_units", vector_units(), "instructions",
                   bike_instructions(), "lanes", bike_batch_width(), "cores",
                   (json_int_t)sysconf(_SC_NPROCESSORS_ONLN), "load", term_json_number(load),
                   "architecture", system.machine, "system", system.release, "compiler",
                   BENCH_COMPILER, "build", BENCH_BUILD, "native_flags", BENCH_NATIVE_FLAGS);
}

void bench_machine_line(char *out, size_t size) {
  char cpu[256];
  cpu_line(cpu, sizeof cpu, "model name");
  snprintf(out, size, "%s, instructions %s (%d lanes), %s, %s", cpu[0] ? cpu : "unknown processor",
           bike_instructions(), bike_batch_width(), BENCH_COMPILER, BENCH_BUILD);
}
