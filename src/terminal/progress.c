// SPDX-License-Identifier: Apache-2.0
#include "terminal/progress.h"

#include "terminal/color.h"

#include <stdio.h>

enum { BAR_WIDTH = 30 };

void term_progress_show(term_progress *progress, const char *label, double done) {
  if (!progress->decided) {
    progress->shown = term_is_interactive(stderr);
    progress->decided = true;
  }
  if (!progress->shown) return;
  double share = done > 0 ? (done < 1 ? done : 1) : 0; // also of a NaN
  int percent = (int)(100 * share);
  if (progress->drawn == percent + 1) return;
  progress->drawn = percent + 1;
  int filled = percent * BAR_WIDTH / 100;
  fprintf(stderr, "\r\033[K%s [", label);
  for (int i = 0; i < BAR_WIDTH; i++) fputc(i < filled ? '#' : '.', stderr);
  fprintf(stderr, "] %3d %%", percent);
  fflush(stderr);
}

void term_progress_clear(term_progress *progress) {
  if (progress->drawn) fputs("\r\033[K", stderr);
  progress->drawn = 0;
}
