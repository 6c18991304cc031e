// SPDX-License-Identifier: Apache-2.0
// The swaying rider: MuJoCo's driven joint against the analytic model's moving rider.
#include "rolling_support.h"

#include <bicycle/file.h>
#include <bicycle/ride.h>

// Order of the joints in sway.xml.
enum { X, Y, Z, YAW, ROLL, PITCH, RIDER, REAR, STEER, FRONT };

static const double duration = 10, speed = 6, amplitude = 0.02, rate = 2;

//---------------------------------- the analytic ride ---------------------------------------------

static void sway(double time, bike_input *out, void *user) {
  (void)user;
  out->rider_offset = amplitude * sin(rate * time);
  out->rider_velocity = amplitude * rate * cos(rate * time);
  out->rider_acceleration = -amplitude * rate * rate * sin(rate * time);
}

enum { SAMPLES = 101 };

typedef struct trace {
  int count;
  bike_sample sample[SAMPLES];
  double work[SAMPLES]; // J
} trace;

static int keep(const bike_sample *sample, const bike_sample_more *more, void *user) {
  trace *t = user;
  if (t->count == SAMPLES) return 1;
  t->work[t->count] = more->work;
  t->sample[t->count++] = *sample;
  return 0;
}

static void ride_analytically(trace *t) {
  bike_file file;
  bike_file_error error;
  bike_model model;
  bike_ride_result result;
  assert_int_equal(bike_file_read(&file, BICYCLE_SOURCE_DIR "/model/roadster/roadster.yml", &error),
                   0);
  assert_int_equal(bike_model_init(&model, &file.bicycle), 0);
  bike_ride_def def = bike_default_ride_def();
  def.start.speed = speed;
  def.duration = duration;
  def.sample = duration / (SAMPLES - 1);
  def.input = sway;
  def.on_sample = keep;
  def.user = t;
  t->count = 0;
  assert_int_equal(bike_ride(&result, &model, &def), 0);
  assert_int_equal(t->count, SAMPLES);
}

//---------------------------------- MuJoCo's ------------------------------------------------------

static void set_inertia(mjModel *m, const char *body, mjtNum x, mjtNum y, mjtNum z) {
  mjtNum *inertia = m->body_inertia + 3 * mj_name2id(m, mjOBJ_BODY, body);
  inertia[0] = x, inertia[1] = y, inertia[2] = z;
}

// The roadster's own tensors of rank one, which MJCF refuses.
static mjModel *load_roadster(void) {
  mjModel *m = load("sway.xml");
  set_inertia(m, "rear_wheel", 0, 0.2, 0);
  set_inertia(m, "front_wheel", 0, 0.2, 0);
  set_inertia(m, "front_frame", 0, 0, 0.1);
  mjData *d = mj_makeData(m);
  mj_setConst(m, d);
  mj_deleteData(d);
  return m;
}

static void test_rider_agrees_with_the_analytic_model(void **unused) {
  (void)unused;
  static trace t;
  ride_analytically(&t);
  mjModel *m = load_roadster();
  mjData *d = start_from_key(m);
  assert_int_equal(roll_project(m, d), ROLL_OK);
  int steps = (int)lround(duration / (SAMPLES - 1) / m->opt.timestep);
  mjtNum lean = 0, steer = 0, work = 0, most_lean = 0, balance = 0, start = energy(d);
  for (int k = 0; k < SAMPLES; k++) {
    mj_forward(m, d);
    lean = fmax(lean, fabs(d->qpos[ROLL] - t.sample[k].lean));
    steer = fmax(steer, fabs(d->qpos[STEER] - t.sample[k].steer));
    work = fmax(work, fabs(d->act[0] - t.work[k]));
    balance = fmax(balance, fabs((energy(d) - start - d->act[0]) / start));
    most_lean = fmax(most_lean, fabs(d->qpos[ROLL]));
    for (int i = 0; i < steps; i++) mj_step(m, d);
  }
  print_message("swaying rider against the analytic model, 10 s, lean up to %.3f rad: lean %.1e "
                "rad, steer %.1e rad, work %.1e J; energy less work %.1e\n",
                most_lean, lean, steer, work, balance);
  assert_below(lean, 1e-10);
  assert_below(steer, 1e-10);
  assert_below(work, 1e-9);
  assert_below(balance, 1e-11);
  assert_true(most_lean > 0.01);
  mj_deleteData(d);
  mj_deleteModel(m);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_rider_agrees_with_the_analytic_model)};
  return cmocka_run_group_tests(tests, install_rolling, uninstall_rolling);
}
