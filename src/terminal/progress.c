// SPDX-License-Identifier: Apache-2.0
#include "terminal/progress.h"

#include "terminal/color.h"

#include <math.h>
#include <stdio.h>
#include <time.h>

enum { BAR_WIDTH = 30, LEFT_SIZE = 64 };

static bool is_shown(term_progress *progress) {
  if (!progress->decided) {
    progress->shown = term_is_interactive(stderr);
    progress->decided = true;
  }
  return progress->shown;
}

static double limited(double done) {
  return done > 0 ? (done < 1 ? done : 1) : 0; // also of a NaN
}

static void draw(term_progress *progress, const char *label, int percent, const char *tail) {
  progress->drawn = percent + 1;
  int filled = percent * BAR_WIDTH / 100;
  fprintf(stderr, "\r\033[K%s [", label);
  for (int i = 0; i < BAR_WIDTH; i++) fputc(i < filled ? '#' : '.', stderr);
  fprintf(stderr, "] %3d %%%s", percent, tail);
  fflush(stderr);
}

void term_progress_show(term_progress *progress, const char *label, double done) {
  if (!is_shown(progress)) return;
  int percent = (int)(100 * limited(done));
  if (progress->drawn != percent + 1) draw(progress, label, percent, "");
}

static double now(void) {
  struct timespec time;
  clock_gettime(CLOCK_MONOTONIC, &time);
  return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

// ", 3 h 20 min left": two units at most, as much as an estimate is worth.
static void print_left(char out[LEFT_SIZE], double seconds) {
  if (!(seconds < 1e8)) // three years, or nothing known
    out[0] = '\0';
  else if (seconds >= 36000)
    snprintf(out, LEFT_SIZE, ", %.0f h left", seconds / 3600);
  else if (seconds >= 3600)
    snprintf(out, LEFT_SIZE, ", %d h %d min left", (int)seconds / 3600, (int)seconds / 60 % 60);
  else if (seconds >= 100)
    snprintf(out, LEFT_SIZE, ", %.0f min left", seconds / 60);
  else
    snprintf(out, LEFT_SIZE, ", %.0f s left", seconds);
}

void term_progress_show_left(term_progress *progress, const char *label, double done) {
  if (!is_shown(progress)) return;
  double share = limited(done), time = now();
  if (progress->begun == 0) {
    progress->begun = time;
    progress->done_before = share;
  }
  double passed = time - progress->begun, gained = share - progress->done_before;
  long second = (long)passed + 1;
  int percent = (int)(100 * share);
  if (progress->drawn == percent + 1 && progress->second == second) return;
  char left[LEFT_SIZE];
  print_left(left, gained > 0 ? passed * (1 - share) / gained : INFINITY);
  progress->second = second;
  draw(progress, label, percent, left);
}

void term_progress_clear(term_progress *progress) {
  if (progress->drawn) fputs("\r\033[K", stderr);
  progress->drawn = 0;
}
