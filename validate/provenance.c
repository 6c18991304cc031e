// SPDX-License-Identifier: Apache-2.0
#include "provenance.h"

#include "files/memory_stream.h"

#include <ctype.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

// Characters a shell takes as they are.
static bool is_plain(const char *text) {
  for (const char *c = text; *c; c++)
    if (!isalnum((unsigned char)*c) && !strchr("-_./,:+@%=", *c)) return false;
  return *text != '\0';
}

static void print_quoted(FILE *stream, const char *text) {
  if (is_plain(text)) {
    fputs(text, stream);
    return;
  }
  fputc('\'', stream);
  for (; *text; text++) fputs(*text == '\'' ? "'\\''" : (const char[]){*text, '\0'}, stream);
  fputc('\'', stream);
}

static char *command_line(char *const *arguments, int count) {
  char *text = NULL;
  size_t size;
  FILE *stream = bike_memory_stream(&text, &size);
  if (!stream) return NULL;
  fputs("bicycle validate", stream);
  for (int i = 0; i < count; i++) {
    fputc(' ', stream);
    print_quoted(stream, arguments[i]);
  }
  if (fclose(stream) == 0) return text;
  free(text);
  return NULL;
}

// The first "model name" of /proc/cpuinfo. False when out of memory.
static bool read_cpu(char out[PROVENANCE_TEXT]) {
  static const char key[] = "model name";
  char line[PROVENANCE_TEXT];
  snprintf(out, PROVENANCE_TEXT, "unknown");
  FILE *stream = fopen("/proc/cpuinfo", "re");
  if (!stream) return errno != ENOMEM;
  while (fgets(line, sizeof line, stream)) {
    char *colon = strchr(line, ':');
    if (strncmp(line, key, strlen(key)) != 0 || !colon) continue;
    line[strcspn(line, "\n")] = '\0';
    snprintf(out, PROVENANCE_TEXT, "%s", colon + 1 + strspn(colon + 1, " "));
    break;
  }
  fclose(stream);
  return true;
}

bool provenance_begin(provenance *out, char *const *arguments, int count) {
  time_t now = time(NULL);
  struct tm utc;
  *out = (provenance){.command = command_line(arguments, count)};
  bool known = read_cpu(out->cpu);
  if (!gmtime_r(&now, &utc) ||
      strftime(out->created, sizeof out->created, "%Y-%m-%dT%H:%M:%SZ", &utc) == 0)
    strcpy(out->created, "unknown");
  return known && out->command != NULL;
}

void provenance_clear(provenance *out) {
  free(out->command);
  out->command = NULL;
}

const char *provenance_compiler(void) {
  return
#if defined __clang__
      "clang "
#elif defined __GNUC__
      "gcc "
#endif
      __VERSION__ ", " BICYCLE_BUILD_TYPE;
}

static void print_numbers(FILE *stream, const char *name, const double *values, int count) {
  fputs(name, stream);
  for (int i = 0; i < count; i++) fprintf(stream, " %.17g", values[i]);
  fputc('\n', stream);
}

bool provenance_bicycle_hash(char out[SHA256_HEX_SIZE], const bike_bicycle *b) {
  char *text = NULL;
  size_t size = 0;
  const bike_geometry *g = &b->geometry;
  out[0] = '\0';
  FILE *stream = bike_memory_stream(&text, &size);
  if (!stream) return false;
  print_numbers(stream, "geometry", (const double[]){g->L_r, g->L_f, g->L_s, g->R_r, g->R_f}, 5);
  print_numbers(stream, "gravity", &b->gravity, 1);
  print_numbers(stream, "steer_damping", &b->steer_damping, 1);
  for (int i = 0; i < b->part_count; i++) {
    const bike_part *part = &b->parts[i];
    fprintf(stream, "part %d %d\n", (int)part->assembly, part->rider);
    print_numbers(stream, "mass", &part->mass, 1);
    print_numbers(stream, "position", part->position, 3);
    print_numbers(stream, "inertia", part->inertia, 6);
  }
  bool whole = fclose(stream) == 0;
  if (whole) sha256_hex(out, text, size);
  free(text);
  return whole;
}
