// SPDX-License-Identifier: Apache-2.0
// The library against published numbers: Basu-Mandal et al. (2007), table 1, and Meijaard et al.
// (2007); and the benchmark's file against the parameters it was copied from.
#include "bicycles.h"
#include "reference/reference.h"
#include "support/near.h"
#include <bicycle/file.h>
#include <bicycle/linear.h>
#include <string.h>

static double number(const json_t *document, const char *prefix, const char *name) {
  char path[128];
  snprintf(path, sizeof path, "%s.%s", prefix, name);
  return reference_number(document, path);
}

static double table1(const json_t *document, const char *row, const char *name) {
  char prefix[64];
  snprintf(prefix, sizeof prefix, "basu_mandal2007_table1.%s", row);
  return number(document, prefix, name);
}

static bike_model benchmark_model(void) {
  const bike_bicycle bicycle = read_shipped("benchmark");
  bike_model model;
  assert_int_equal(bike_model_init(&model, &bicycle), 0);
  return model;
}

// Table 1 in this project's variables. There x, y, z is the rear hub with z up; theta the yaw to
// the left of a bicycle that heads for -x at theta = 0; psi = pi/2 - lean; phi = pi + pitch; psi_f
// the steer to the left; beta_r, beta_f the hinge angles of the wheels, rolling forward positive.
static bike_state table1_state(const json_t *document, double R_r) {
  const double right_angle = 1.5707963267948966;
  bike_state s;
  s.lean = right_angle - table1(document, "q", "psi");
  s.steer = table1(document, "q", "psi_f");
  s.lean_rate = -table1(document, "qd", "psi");
  s.steer_rate = table1(document, "qd", "psi_f");
  s.speed = R_r * (table1(document, "qd", "phi") + table1(document, "qd", "beta_r"));
  return s;
}

// Velocity and acceleration of the rear hub along (-e_R, right, up), which are x, y, z of table 1.
typedef struct hub_motion {
  double velocity[3], acceleration[3];
} hub_motion;

static hub_motion hub_motion_of(const bike_state *s, const bike_snapshot *is, double R) {
  // hub = contact + R (sin kappa right + cos kappa up); e_R' = -Omega right, right' = Omega e_R
  const double sine = sin(s->lean), cosine = cos(s->lean), k = s->lean_rate, W = is->yaw_rate;
  const double side = R * cosine * k,
               side_rate = R * (cosine * is->acceleration.lean - sine * k * k);
  const double rise = -R * sine * k,
               rise_rate = -R * (sine * is->acceleration.lean + cosine * k * k);
  const double ahead = s->speed + R * sine * W;
  const double ahead_rate =
      is->acceleration.speed + R * (cosine * k * W + sine * is->yaw_acceleration);
  return (hub_motion){{-ahead, side, rise},
                      {-(ahead_rate + side * W), side_rate - ahead * W, rise_rate}};
}

typedef struct row {
  const char *name;
  double rate, acceleration;
} row;

// How far table 1's own rounding, half a unit in the 13th decimal of each number of the state, can
// move an acceleration: printed so that the tolerance can be judged.
static double rounding_of_state(const bike_model *model, const bike_state *state) {
  const bike_input none = {0};
  bike_acceleration a, b;
  assert_int_equal(bike_accelerate(&a, model, state, &none), 0);
  double sum = 0;
  for (int i = 0; i < 5; i++) {
    bike_state moved = *state;
    double *const member[5] = {&moved.lean, &moved.steer, &moved.lean_rate, &moved.steer_rate,
                               &moved.speed};
    const double step = 1e-6, unit = 5e-14;
    *member[i] += step;
    assert_int_equal(bike_accelerate(&b, model, &moved, &none), 0);
    sum += fabs(b.steer - a.steer) / step * unit;
  }
  return sum / fabs(a.steer);
}

static void basu_mandal_table_1(void **unused) {
  (void)unused;
  json_t *document = reference_open();
  const bike_model model = benchmark_model();
  const double R = model.geometry.R_r;
  const bike_state state = table1_state(document, R);
  const bike_input none = {0};
  bike_snapshot is;
  assert_int_equal(bike_evaluate(&is, &model, &state, &none), 0);
  const hub_motion hub = hub_motion_of(&state, &is, R);
  const row rows[] = {
      {"x", hub.velocity[0], hub.acceleration[0]},
      {"y", hub.velocity[1], hub.acceleration[1]},
      {"z", hub.velocity[2], hub.acceleration[2]},
      {"theta", is.yaw_rate, is.yaw_acceleration},
      {"psi", -state.lean_rate, -is.acceleration.lean},
      {"phi", is.pitch_rate, is.pitch_acceleration},
      {"psi_f", state.steer_rate, is.acceleration.steer},
      {"beta_r", is.rear_wheel_rate, is.rear_wheel_acceleration},
      {"beta_f", is.front_wheel_rate, is.front_wheel_acceleration},
  };
  const double tolerance = reference_number(document, "tolerances.basu_mandal2007_table1.value");
  for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
    double rate = table1(document, "qd", rows[i].name);
    double expected = table1(document, "qdd", rows[i].name);
    printf("%-6s'' %18.13f, printed %18.13f: relative %.1e\n", rows[i].name, rows[i].acceleration,
           expected, fabs(rows[i].acceleration / expected - 1));
    assert_near(rows[i].rate, rate, 1e-13 * fmax(1, fabs(rate))); // its 13 decimals
    assert_relative(rows[i].acceleration, expected, tolerance);
  }
  const double pi = 3.141592653589793;
  assert_near(is.pitch, table1(document, "q", "phi") - pi, 1e-13);
  assert_near(R * cos(state.lean), table1(document, "q", "z"), 1e-13);
  printf("the state's 13 decimals alone allow %.1e in psi_f''\n",
         rounding_of_state(&model, &state));
  json_decref(document);
}

static void check_matrix(const json_t *document, const char *name, const double actual[4]) {
  const double sign[4] = {1, -1, -1, 1}; // steer is to the left here, to the right there
  const double tolerance = reference_number(document, "tolerances.meijaard2007_matrices.value");
  double expected[4], size = 0, worst = 0;
  for (int i = 0; i < 4; i++) {
    char path[64];
    snprintf(path, sizeof path, "meijaard2007.%s.%d.%d", name, i / 2, i % 2);
    expected[i] = sign[i] * reference_number(document, path);
    size = fmax(size, fabs(expected[i]));
  }
  for (int i = 0; i < 4; i++) {
    assert_near(actual[i], expected[i], tolerance * size);
    // Entry by entry too, where the entry is not zero.
    if (expected[i] != 0) assert_relative(actual[i], expected[i], tolerance);
    worst = fmax(worst, fabs(actual[i] - expected[i]) / size);
  }
  printf("%s: worst %.1e of its largest entry\n", name, worst);
}

static void meijaard_matrices_of_benchmark(void **unused) {
  (void)unused;
  json_t *document = reference_open();
  const bike_model model = benchmark_model();
  bike_upright_matrices m;
  assert_int_equal(bike_linearize_upright(&m, &model), 0);
  check_matrix(document, "M", m.M);
  check_matrix(document, "C1", m.C1);
  check_matrix(document, "K0", m.K0);
  check_matrix(document, "K2", m.K2);
  json_decref(document);
}

static void static_normal_forces(void **unused) {
  (void)unused;
  json_t *document = reference_open();
  const bike_model model = benchmark_model();
  const bike_state rest = {0};
  const bike_input none = {0};
  bike_snapshot is;
  assert_int_equal(bike_evaluate(&is, &model, &rest, &none), 0);
  const double tolerance = reference_number(document, "tolerances.static_normal_forces.value");
  const char *prefix = "meijaard2007.static_normal_forces";
  assert_relative(is.rear_force[2], number(document, prefix, "rear"), tolerance);
  assert_relative(is.front_force[2], number(document, prefix, "front"), tolerance);
  for (int i = 0; i < 2; i++) {
    assert_near(is.rear_force[i], 0, 1e-12);
    assert_near(is.front_force[i], 0, 1e-12);
  }
  json_decref(document);
}

static void benchmark_file_holds_published_parameters(void **unused) {
  (void)unused;
  json_t *document = reference_open();
  bike_file file;
  bike_file_error error;
  const char *path = BICYCLE_SOURCE_DIR "/model/benchmark/benchmark.yml";
  if (bike_file_read(&file, path, &error) != 0) fail_msg("%s", error.text);
  assert_true(file.has_meijaard);
  for (int i = 0; i < BIKE_MEIJAARD_COUNT; i++) {
    const char *symbol = bike_meijaard_symbols()[i];
    // The tilt is published as pi/10; wheels' IRzz = IRxx are not among the symbols.
    double expected = strcmp(symbol, "lam") == 0
                          ? 0.3141592653589793
                          : number(document, "meijaard2007.parameters", symbol);
    assert_near(file.meijaard.value[i], expected, 1e-15 * fabs(expected));
  }
  json_decref(document);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(basu_mandal_table_1),
      cmocka_unit_test(meijaard_matrices_of_benchmark),
      cmocka_unit_test(static_normal_forces),
      cmocka_unit_test(benchmark_file_holds_published_parameters),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
