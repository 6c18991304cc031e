// SPDX-License-Identifier: Apache-2.0
// A result is finite, or the code is not 0: every public function, on bicycles and states of any
// magnitude. And what accelerations, rates, the mass matrix and the whole instant are asked of
// a state gives one code, as do the lanes.
//
// test_finite COUNT runs more cases than the suite does.
#include "bicycles.h"
#include "support/near.h"
#include "wild.h"
#include <bicycle/basin.h>
#include <bicycle/batch.h>
#include <bicycle/cycle.h>
#include <bicycle/effects.h>
#include <bicycle/ensemble.h>
#include <bicycle/error.h>
#include <bicycle/map.h>
#include <bicycle/modes.h>
#include <bicycle/turn.h>
#include <math.h>
#include <string.h>

static long cases = 1000, violations;

// What is costly is asked of one bicycle in so many.
enum { OFTEN = 5, SELDOM = 50, RARELY = 1000 };

enum { LANES = 8 };

typedef struct count {
  const char *what;
  long answered, refused, wrong;
} count;

static count counts[64];
static long case_now;

static count *count_of(const char *what) {
  int i = 0;
  while (counts[i].what && strcmp(counts[i].what, what) != 0) i++;
  counts[i].what = what;
  return &counts[i];
}

static void complain(const char *what, const char *why, int code) {
  count *c = count_of(what);
  if (c->wrong++ < 3)
    printf("case %ld: %s: %s (%s)\n", case_now, what, why, bike_error_string(code));
}

static bool all_finite(const void *numbers, size_t size) {
  const double *x = numbers;
  for (size_t i = 0; i < size / sizeof *x; i++)
    if (!isfinite(x[i])) return false;
  return true;
}

// `numbers` is made of doubles alone.
static void judge(const char *what, int code, const void *numbers, size_t size) {
  count *c = count_of(what);
  ++*(code ? &c->refused : &c->answered);
  if (!code && !all_finite(numbers, size)) complain(what, "not finite", code);
}

static void same_code(const char *what, int code, int expected) {
  if (code != expected) {
    complain(what, "another code than bike_evaluate", code);
    if (count_of(what)->wrong <= 3) printf("  expected: %s\n", bike_error_string(expected));
  }
}

//---------------------------------- one state -----------------------------------------------------

static void ask_instant(const bike_model *model, const bike_state *state, const bike_input *in) {
  bike_snapshot now;
  bike_acceleration a;
  bike_rates rates;
  bike_linear linear;
  bike_eigenvalues e;
  double M[9];
  int code = bike_evaluate(&now, model, state, in);
  judge("bike_evaluate", code, &now, sizeof now);
  int other = bike_accelerate(&a, model, state, in);
  judge("bike_accelerate", other, &a, sizeof a);
  same_code("bike_accelerate", other, code);
  other = bike_rates_of(&rates, model, state, in);
  judge("bike_rates_of", other, &rates, sizeof rates);
  same_code("bike_rates_of", other, code);
  judge("bike_mass_matrix", bike_mass_matrix(M, model, state, in->rider_offset), M, sizeof M);
  other = bike_linearize(&linear, model, state, in);
  judge("bike_linearize", other, &linear, sizeof linear);
  if (code) same_code("bike_linearize", other, code);
  if (other) return;
  judge("bike_eigenvalues_of", bike_eigenvalues_of(&e, linear.A), &e, sizeof e);
}

//---------------------------------- lanes ---------------------------------------------------------

static void ask_lanes(const bike_model *model, random_source *source) {
  bike_state states[LANES];
  bike_input inputs[LANES] = {0};
  double in[5][LANES], out[3][LANES];
  int codes[LANES];
  for (int i = 0; i < LANES; i++) {
    states[i] = wild_state(source);
    in[0][i] = states[i].lean, in[1][i] = states[i].steer, in[2][i] = states[i].lean_rate;
    in[3][i] = states[i].steer_rate, in[4][i] = states[i].speed;
  }
  bike_batch *batch;
  assert_int_equal(bike_batch_create(&batch, model, 1), 0);
  const bike_batch_states from = {in[0], in[1], in[2], in[3], in[4]};
  bike_batch_accelerations to = {out[0], out[1], out[2], codes};
  assert_int_equal(bike_batch_accelerate(&to, batch, &from, LANES), 0);
  bike_batch_free(batch);
  for (int i = 0; i < LANES; i++) {
    const double a[3] = {out[0][i], out[1][i], out[2][i]};
    bike_snapshot now;
    judge("bike_batch_accelerate", codes[i], a, sizeof a);
    same_code("bike_batch_accelerate", codes[i], bike_evaluate(&now, model, &states[i], NULL));
  }
  for (int i = 0; i < LANES; i++) inputs[i] = wild_input(source, model->rider_mass > 0);
  bike_linear linears[LANES];
  bike_eigenvalues e[LANES];
  assert_int_equal(bike_batch_linearize(linears, codes, model, states, inputs, LANES), 0);
  for (int i = 0; i < LANES; i++) {
    bike_linear alone;
    judge("bike_batch_linearize", codes[i], &linears[i], sizeof linears[i]);
    same_code("bike_batch_linearize", codes[i],
              bike_linearize(&alone, model, &states[i], &inputs[i]));
    if (!codes[i]) continue;
    linears[i] = (bike_linear){.A = {[2] = 1, [7] = 1}};
    for (int k = 8; k < 16; k++) linears[i].A[k] = wild_number(source);
  }
  assert_int_equal(bike_batch_eigenvalues(e, codes, linears, LANES), 0);
  for (int i = 0; i < LANES; i++) {
    bike_eigenvalues alone;
    judge("bike_batch_eigenvalues", codes[i], &e[i], sizeof e[i]);
    same_code("bike_batch_eigenvalues", codes[i], bike_eigenvalues_of(&alone, linears[i].A));
  }
}

//---------------------------------- one bicycle ---------------------------------------------------

static void ask_upright(const bike_model *model, random_source *source) {
  bike_upright_matrices m;
  bike_eigenvalues e;
  bike_weave_mode mode;
  double ratio, speed = wild_number(source);
  judge("bike_linearize_upright", bike_linearize_upright(&m, model), &m, sizeof m);
  judge("bike_upright_eigenvalues", bike_upright_eigenvalues(&e, model, speed), &e, sizeof e);
  judge("bike_weave_mode_at", bike_weave_mode_at(&mode, model, speed), &mode, sizeof mode);
  bike_state state = wild_state(source);
  judge("bike_speed_of_equal_energy", bike_speed_of_equal_energy(&ratio, model, &state, speed),
        &ratio, sizeof ratio);
  int code = bike_lean_per_offset(&ratio, model, speed);
  bool at_capsize = !code && isinf(ratio);
  if (!at_capsize) judge("bike_lean_per_offset", code, &ratio, sizeof ratio);
}

static void ask_variations(const bike_bicycle *bicycle, random_source *source) {
  for (int v = 0; v < BIKE_VARIATIONS; v++) {
    bike_bicycle changed;
    bike_model model;
    double value = wild_number(source), back = NAN;
    int code = bike_variation_value(&back, bicycle, v);
    judge("bike_variation_value", code, &back, sizeof back);
    if (code) continue;
    if (random_bits(source) % 2) value = back * random_between(source, 0.5, 1.5);
    code = bike_vary(&changed, bicycle, v, value, random_bits(source) % 2);
    judge("bike_vary", code, NULL, 0);
    if (code) continue;
    code = bike_model_init(&model, &changed);
    judge("bike_model_init (varied)", code, &model, sizeof model);
    if (code) complain("bike_vary", "no model can be made of what comes out", code);
    if (v != BIKE_VARY_TRAIL && v != BIKE_VARY_HEAD_ANGLE) continue;
    // lengths are known to a rounding of the longest, over a slope of the axis of 1e-9 at least
    double size = v == BIKE_VARY_TRAIL ? model.reach + fabs(value) : 1;
    if (bike_variation_value(&back, &changed, v) || !(fabs(back - value) <= 1e-6 * size))
      complain("bike_vary", "the property is not what it was set to", code);
  }
}

static void judge_turn(const char *what, int code, const bike_turn *t) {
  const double numbers[] = {t->lean,
                            t->steer,
                            t->speed,
                            t->rider_offset,
                            t->steer_torque,
                            t->yaw_rate,
                            t->eps_max,
                            t->rear_normal,
                            t->front_normal,
                            t->residual,
                            isnan(t->radius),
                            isnan(t->rear_friction),
                            isnan(t->front_friction)};
  judge(what, code, numbers, sizeof numbers);
  judge(what, code, &t->eigenvalues, sizeof t->eigenvalues);
  if (!code && (isnan(t->radius) || isnan(t->rear_friction) || isnan(t->front_friction)))
    complain(what, "NaN", code);
}

static void ask_turns(const bike_model *model, random_source *source, bool search) {
  static bike_turns turns;
  bike_state state = wild_state(source);
  bike_turn_def def = bike_default_turn_def();
  bike_turn from = {.lean = state.lean, .steer = state.steer, .speed = fabs(state.speed)}, near;
  int first = (int)(random_bits(source) % BIKE_TURN_VARIABLES);
  int second = (int)(random_bits(source) % BIKE_TURN_VARIABLES);
  const double value[] = {fabs(state.speed), state.lean, state.steer, wild_number(source)};
  if (!search) first = BIKE_TURN_LEAN, second = BIKE_TURN_STEER;
  def.given[first] = def.given[second] = true;
  memcpy(def.value, value, sizeof value);
  if (random_bits(source) % 4 == 0) def.steer_torque = wild_number(source);
  int code = bike_turns_find(&turns, model, &def);
  judge("bike_turns_find", code, NULL, 0);
  for (int i = 0; i < turns.count && !code; i++) judge_turn("bike_turns_find", 0, &turns.turns[i]);
  for (int i = 0; i < turns.mark_count && !code; i++)
    judge_turn("bike_turns_find", 0, &turns.marks[i]);
  if (first == second) return;
  code = bike_turn_near(&near, model, &def, &from);
  judge("bike_turn_near", code, NULL, 0);
  if (!code) judge_turn("bike_turn_near", 0, &near);
}

static void ask_critical(const bike_bicycle *bicycle, const bike_model *model,
                         random_source *source) {
  static bike_effects effects;
  bike_critical_speeds found;
  bike_modes modes;
  double low = random_between(source, 0, 2), high = low + fabs(wild_number(source));
  if (random_bits(source) % 2) high = low + 10;
  int code = bike_upright_critical_speeds(&found, model, low, high);
  judge("bike_upright_critical_speeds", code, NULL, 0);
  if (!code) {
    judge("critical speeds", 0, found.weave, (size_t)found.weave_count * sizeof(double));
    judge("critical speeds", 0, found.capsize, (size_t)found.capsize_count * sizeof(double));
    judge("critical speeds", 0, found.ranges, (size_t)found.range_count * 2 * sizeof(double));
  }
  code = bike_upright_modes(&modes, model, (double[]){fabs(wild_number(source))}, 1);
  judge("bike_upright_modes", code, &modes, offsetof(bike_modes, mode));
  code = bike_effects_find(&effects, bicycle, NULL, low, high);
  judge("bike_effects_find", code, NULL, 0);
  for (int i = 0; i < effects.count && !code; i++) {
    const bike_parameter *p = &effects.parameters[i];
    if (!isnan(effects.weave)) judge("effects", 0, &p->weave, sizeof p->weave);
    if (!isnan(effects.capsize)) judge("effects", 0, &p->capsize, sizeof p->capsize);
  }
  if (code) return;
  if (!isnan(effects.weave)) judge("effects", 0, &effects.weave_sigma, sizeof(double));
  for (int v = 0; v < BIKE_VARIATIONS; v++) {
    double slope[2];
    code = bike_variation_slope(&slope[0], &slope[1], bicycle, v, v % 2, effects.weave,
                                effects.capsize);
    if (isnan(effects.weave)) slope[0] = 0;
    if (isnan(effects.capsize)) slope[1] = 0;
    judge("bike_variation_slope", code, slope, sizeof slope);
  }
}

static void ask_rides(const bike_model *model, random_source *source) {
  bike_member members[LANES];
  bike_member_result results[LANES];
  bike_ensemble_def def = bike_default_ensemble_def();
  def.duration = 0.02;
  for (int i = 0; i < LANES; i++)
    members[i] = (bike_member){.model = model, .start = wild_state(source)};
  assert_int_equal(bike_ensemble_ride(results, members, LANES, &def), 0);
  for (int i = 0; i < LANES; i++) {
    bike_snapshot now;
    const double end[] = {results[i].time, results[i].end.lean, results[i].end.steer,
                          results[i].end.speed};
    judge("bike_ensemble_ride", results[i].error, end, sizeof end);
    int code = bike_evaluate(&now, model, &members[i].start, NULL);
    if (code) same_code("bike_ensemble_ride", results[i].error, code);
  }
}

static void ask_map(const bike_model *model, random_source *source) {
  const double speeds[3] = {0.5, 3, 3 + fabs(wild_number(source))};
  const double leans[3] = {0, 0.1, 0.2 + random_between(source, 0, 2)};
  bike_map_node nodes[9];
  bike_map_def def = {.speeds = speeds, .leans = leans, .speed_count = 3, .lean_count = 3};
  def.threads = 1;
  int code = bike_map_turns(nodes, model, &def);
  judge("bike_map_turns", code, NULL, 0);
  for (int i = 0; i < 9 && !code; i++)
    judge("nodes of a map", nodes[i].error, &nodes[i], offsetof(bike_map_node, error));
}

static void ask_bicycle(random_source *source) {
  bike_bicycle bicycle = wild_bicycle(source);
  bike_upright upright;
  bike_model model;
  int code = bike_upright_position(&upright, &bicycle.geometry);
  judge("bike_upright_position", code, &upright, sizeof upright);
  code = bike_model_init(&model, &bicycle);
  judge("bike_model_init", code, &model, sizeof model);
  same_code("bike_model_init", code, bike_check(&bicycle, NULL, NULL));
  if (code) return;
  bike_state state = wild_state(source);
  bike_input in = wild_input(source, model.rider_mass > 0);
  ask_instant(&model, &state, &in);
  if (case_now % OFTEN == 0 && wild_edge(&state, &model)) ask_instant(&model, &state, &in);
  ask_lanes(&model, source);
  ask_upright(&model, source);
  ask_variations(&bicycle, source);
  if (case_now % OFTEN == 1) ask_turns(&model, source, false);
  if (case_now % SELDOM == 0) ask_critical(&bicycle, &model, source);
  if (case_now % RARELY == 4) ask_rides(&model, source);
  if (case_now % SELDOM == 2) ask_map(&model, source);
  if (case_now % RARELY == 3) ask_turns(&model, source, true);
}

static void finite_or_an_error(void **unused) {
  (void)unused;
  random_source seeds = random_begin("finite_or_an_error", 20261201);
  for (case_now = 0; case_now < cases; case_now++) {
    random_source source = {random_bits(&seeds)};
    ask_bicycle(&source);
  }
  for (const count *c = counts; c->what; c++) {
    printf("%-30s %9ld answered %9ld refused %6ld wrong\n", c->what, c->answered, c->refused,
           c->wrong);
    violations += c->wrong;
  }
  assert_int_equal(violations, 0);
}

int main(int argc, char **argv) {
  if (argc > 1) cases = strtol(argv[1], NULL, 10);
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(finite_or_an_error),
  };
  int failed = cmocka_run_group_tests(tests, NULL, NULL);
  printf("%ld bicycles, %ld violations\n", cases, violations);
  return failed;
}
