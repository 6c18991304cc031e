// SPDX-License-Identifier: Apache-2.0
// Section 4: stationary circular motion and figure 2, on the roadster.
#include "shared.h"
#include <bicycle/effects.h>
#include <bicycle/error.h>
#include <math.h>

static void lean_steer(figures *out, const bike_turns *found) {
  for (int i = 0; i < main_count(found); i++) {
    put(out, found->turns[i].lean / DEGREE);
    put(out, found->turns[i].steer / DEGREE);
  }
}

// Several fixed points for one speed and offset.
static void several(figures *out) {
  bike_model model = shipped_model("roadster");
  const bike_turns *found = turns_at(&model, 5.5, 0.01);
  put(out, main_count(found));
  lean_steer(out, found);
  put(out, found->count);
}

static void three_or_one(figures *out) {
  bike_model model = shipped_model("roadster");
  const double cases[][2] = {{5.5, 0.01}, {6.5, 0.002}, {6.5, 0.003}, {7.5, 0.001}, {7.5, 0.01}};
  for (int i = 0; i < 5; i++) put(out, main_count(turns_at(&model, cases[i][0], cases[i][1])));
}

// w_max of a speed: the fold of the main family; NaN where there is none.
static bike_turn largest_offset(const bike_model *model, double speed) {
  const bike_turns *found = turns_at(model, speed, 0);
  for (int i = 0; i < found->mark_count; i++) {
    const bike_turn *m = &found->marks[i];
    if (m->main_family && m->mark == BIKE_TURN_LARGEST && m->fold == BIKE_TURN_OFFSET &&
        m->lean > 0)
      return *m;
  }
  return (bike_turn){.rider_offset = NAN, .lean = NAN};
}

static void fold(figures *out) {
  bike_model model = shipped_model("roadster");
  double largest = largest_offset(&model, 6.5).rider_offset;
  put(out, 1e3 * largest);
  put(out, main_count(turns_at(&model, 6.5, largest * (1 - 1e-6))));
  put(out, main_count(turns_at(&model, 6.5, largest * (1 + 1e-6))));
}

// The offset of the fold vanishes at the capsize speed.
static void limit_speed(figures *out) {
  bike_bicycle roadster = bicycle_of("roadster");
  bike_model model = model_of(&roadster);
  put(out, limits_of(&roadster, 40).capsize);
  put(out, 1e3 * largest_offset(&model, 6.9).rider_offset);
  put(out, 1e3 * largest_offset(&model, 7.1).rider_offset);
}

static void offset_size(figures *out) {
  bike_model model = shipped_model("roadster");
  for (int speed = 3; speed <= 6; speed++)
    put(out, 1e2 * largest_offset(&model, speed).rider_offset);
}

static void sensitive(figures *out) {
  bike_model model = shipped_model("roadster");
  const double speeds[] = {5, 5.5, 6, 6.5};
  for (int i = 0; i < 4; i++) {
    double slope;
    must(bike_lean_per_offset(&slope, &model, speeds[i]), "lean per offset");
    put(out, slope / DEGREE / 1e3);
  }
  put(out, 1e3 * largest_offset(&model, 5.5).rider_offset);
  put(out, 1e3 * largest_offset(&model, 6.5).rider_offset);
}

// The fixed points are circles: lean after 10 s of riding from the stable one, rider moved for
// good.
static void circles(figures *out) {
  bike_bicycle roadster = bicycle_of("roadster"), moved = roadster;
  bike_model model = model_of(&roadster);
  bike_turn turn = turns_at(&model, 5.5, 0.01)->turns[1];
  for (int i = 0; i < moved.part_count; i++)
    if (moved.parts[i].rider) moved.parts[i].position[1] -= turn.rider_offset;
  model = model_of(&moved);
  bike_state start = {.lean = turn.lean, .steer = turn.steer, .speed = turn.speed};
  bike_sample end;
  ride_of(&model, &start, 10, 0.1, keep_sample, &end);
  put(out, turn.radius);
  put(out, (end.lean - turn.lean) / DEGREE);
}

// Lean at which eps_max of the main family changes sign at a speed, by bisection between upright,
// which is stable, and the first lean (in steps of 1 deg) that is not; NaN where none is.
static double stable_lean(const bike_model *model, double speed) {
  bike_turn_def def = bike_default_turn_def();
  def.given[BIKE_TURN_SPEED] = def.given[BIKE_TURN_LEAN] = true;
  def.value[BIKE_TURN_SPEED] = speed;
  bike_turn low = {.speed = speed}, next;
  double step = DEGREE;
  for (double lean = step; lean < 45 * DEGREE && step > 1e-10; lean += step) {
    def.value[BIKE_TURN_LEAN] = lean;
    must(bike_turn_near(&next, model, &def, &low), "turn");
    if (next.eps_max < 0) {
      low = next;
    } else {
      lean -= step;
      step /= 2;
    }
  }
  return step < 1e-10 ? low.lean : NAN;
}

static void stable_region(figures *out) {
  bike_bicycle roadster = bicycle_of("roadster");
  bike_model model = model_of(&roadster);
  limits l = limits_of(&roadster, 40);
  put(out, l.low);
  put(out, l.high);
  put(out, stable_lean(&model, 5.5) / DEGREE);
  put(out, stable_lean(&model, 6.5) / DEGREE);
}

static void geometries(figures *out) {
  static const char *const names[] = {"penny_farthing", "recumbent"};
  for (int i = 0; i < 2; i++) {
    bike_bicycle b = bicycle_of(names[i]);
    limits l = limits_of(&b, 40);
    put(out, l.low);
    put(out, l.high);
  }
}

// Stable ranges of all shipped bicycles, and the lean to which the region reaches in the middle of
// the range, of those with a rider who can be moved.
static void typical(figures *out) {
  static const char *const names[] = {"roadster",       "roadster_riderless", "benchmark",
                                      "penny_farthing", "recumbent",          "recumbent_damped"};
  for (int i = 0; i < 6; i++) {
    bike_bicycle b = bicycle_of(names[i]);
    bike_model model = model_of(&b);
    limits l = limits_of(&b, 40);
    put(out, l.low);
    put(out, l.high);
    if (model.rider_mass > 0) put(out, stable_lean(&model, 0.5 * (l.low + l.high)) / DEGREE);
  }
}

// For a speed and a lean there is one w.
static void lean_as_variable(figures *out) {
  bike_model model = shipped_model("roadster");
  static bike_turns found;
  bike_turn_def def = bike_default_turn_def();
  def.given[BIKE_TURN_SPEED] = def.given[BIKE_TURN_LEAN] = true;
  def.value[BIKE_TURN_SPEED] = 5.5;
  for (int lean = 10; lean <= 40; lean += 10) {
    def.value[BIKE_TURN_LEAN] = lean * DEGREE;
    must(bike_turns_find(&found, &model, &def), "turns");
    put(out, main_count(&found));
  }
}

const claim claims_turns[] = {{"ranges-predicted", stable_region},
                              {"any-geometry", geometries},
                              {"circles", circles},
                              {"offset-size", offset_size},
                              {"several-fixed-points", several},
                              {"three-or-one", three_or_one},
                              {"fold", fold},
                              {"limit-speed", limit_speed},
                              {"sensitive", sensitive},
                              {"lean-as-variable", lean_as_variable},
                              {"typical", typical},
                              {0}};
