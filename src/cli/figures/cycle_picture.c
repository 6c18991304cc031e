// SPDX-License-Identifier: Apache-2.0
#include "cycle_picture.h"

#include "plot_file.h"
#include "terminal/data.h"

#include <bicycle/error.h>
#include <math.h>

static const double DEGREES = 180 / M_PI;

// Distance below the weave speed.
static double below(const cycle_branch *b, int i) {
  return i < 0 ? 0 : b->hopf->speed - b->cycles[i].speed;
}

static double lean(const cycle_branch *b, int i) {
  return i < 0 ? 0 : b->cycles[i].lean;
}

static bool is_stable(const cycle_branch *b, int i) {
  return b->cycles[i].multiplier < 1;
}

// From cycle i - 1, or straight riding, to cycle i. Speed is nearly linear in the square of the
// amplitude, and so it is drawn.
static void draw_step(plot *p, const cycle_branch *b, int i) {
  enum { PARTS = 24 };
  plot_point points[PARTS + 1];
  double from = lean(b, i - 1), to = lean(b, i);
  for (int k = 0; k <= PARTS; k++) {
    double at = from + (to - from) * k / PARTS;
    double part = (at * at - from * from) / (to * to - from * from);
    points[k] =
        (plot_point){below(b, i - 1) + part * (below(b, i) - below(b, i - 1)), at * DEGREES};
  }
  plot_line(p, is_stable(b, i) ? PLOT_HEAVY : PLOT_HEAVY_DASHED, points, PARTS + 1);
}

// Small cycles, as the bifurcation alone tells: speed - weave speed = curvature lean^2.
static void draw_birth(plot *p, const cycle_branch *b, double largest) {
  enum { PARTS = 96 };
  plot_point points[PARTS + 1];
  for (int k = 0; k <= PARTS; k++) {
    double at = largest * k / PARTS;
    points[k] = (plot_point){-b->hopf->curvature * at * at, at * DEGREES};
  }
  plot_line(p, PLOT_DOTTED, points, PARTS + 1);
}

static void add_key(plot *p, const cycle_branch *b) {
  plot_entry key[3];
  int count = 0;
  bool stable = false, unstable = false;
  for (int i = 0; i < b->count; i++) {
    stable |= is_stable(b, i);
    unstable |= !is_stable(b, i);
  }
  if (stable) key[count++] = (plot_entry){.style = PLOT_HEAVY, .text = "stable cycles"};
  if (unstable) key[count++] = (plot_entry){.style = PLOT_HEAVY_DASHED, .text = "unstable cycles"};
  key[count++] = (plot_entry){.style = PLOT_DOTTED, .text = "square root law of the bifurcation"};
  plot_key(p, key, count);
}

// All of the branch, the birth, and a margin of a twentieth.
static bool open_plot(plot *p, const cycle_branch *b) {
  double low = 0, high = 0, largest = lean(b, b->count - 1);
  for (int i = 0; i < b->count; i++) {
    low = fmin(low, below(b, i));
    high = fmax(high, below(b, i));
  }
  double margin = 0.05 * fmax(high - low, 1e-9);
  plot_axis x = {low - margin, high + margin, {"distance below the weave speed", "", "", "m/s"}};
  plot_axis y = {0, 1.05 * largest * DEGREES, {"amplitude of the lean", "\u03ba", "", "deg"}};
  return plot_open(p, &x, &y);
}

static bool draw(plot *p, const cycle_branch *b) {
  if (!open_plot(p, b)) return false;
  const plot_point birth[] = {{0, p->y.low}, {0, p->y.high}};
  plot_line(p, PLOT_THIN, birth, 2);
  draw_birth(p, b, lean(b, b->count - 1));
  for (int i = 0; i < b->count; i++) {
    draw_step(p, b, i);
    plot_dot(p, (plot_point){below(b, i), lean(b, i) * DEGREES});
  }
  add_key(p, b);
  return true;
}

static void write_table(FILE *csv, const void *user) {
  const cycle_branch *b = user;
  fputs("lean,steer,speed,distance,period,steer_per_lean,multiplier,stable\n", csv);
  for (int i = 0; i < b->count; i++) {
    const bike_cycle *c = &b->cycles[i];
    fprintf(csv, "%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%d\n", c->lean, c->steer, c->speed,
            c->speed - b->hopf->speed, c->period, c->ratio, c->multiplier, is_stable(b, i));
  }
}

term_exit cycle_write(const cycle_branch *branch, const bike_bicycle *bicycle,
                      bike_convention convention, const char *svg) {
  plot p;
  char title[160], caption[640];
  const bike_hopf *h = branch->hopf;
  snprintf(title, sizeof title, "%s: limit cycles born at the weave speed", bicycle->name);
  snprintf(caption, sizeof caption,
           "%s: limit cycles born at the weave speed %.6g m/s in a %scritical Hopf bifurcation "
           "(riding straight weaves %s it), hands off. Speed is that of riding straight with the "
           "same energy; the period at birth is %.3g s. Dots: calculated, between them drawn as "
           "speed against the square of the amplitude. Convention %s.",
           bicycle->name, h->speed, h->supercritical ? "super" : "sub",
           h->unstable_side < 0 ? "below" : "above", 2 * M_PI / h->mode.frequency,
           term_convention_name(convention));
  term_exit code = draw(&p, branch)
                       ? plot_save(&p, "cycle", title, caption, svg, write_table, branch)
                       : term_fail_bike(BIKE_ERROR_MEMORY, svg);
  plot_close(&p);
  return code;
}
