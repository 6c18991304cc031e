// SPDX-License-Identifier: Apache-2.0
// The generated model holds the bicycle of the file: nothing lost between parts, text and mjModel.
#include "bicycle_mjcf.h"
#include "equations/bicycles.h"
#include "own_folder.h"
#include "runner.h"
#include "support/near.h"

#include <string.h>
#include <unistd.h>

// Numbers of 100 kg m^2 and less go through a 17-digit text, a rotation and a parallel axis: ten
// roundings, 1.4e-13.
static const double parameter_tolerance = 1e-12;

static mjModel *model_of(const bike_bicycle *bicycle, const mjcf_options *options) {
  mjcf_error error = {.text = ""};
  mjModel *m = mjcf_model(bicycle, options, NULL, &error);
  if (!m) fail_msg("%s", error.text);
  return m;
}

static int body_of(const mjModel *m, bike_assembly assembly) {
  static const char *const names[] = {"rear_frame", "rear_wheel", "front_frame", "front_wheel"};
  int id = mj_name2id(m, mjOBJ_BODY, names[assembly]);
  assert_true(id > 0);
  return id;
}

//---------------------------------- parameters ----------------------------------------------------

// Mass, first moment and tensor about the rear contact point: what adds up over parts.
typedef struct moments {
  double mass, first[3], second[6];
} moments;

static void add_moments(moments *sum, double mass, const double r[3], const double inertia[6]) {
  static const int rows[6] = {0, 1, 2, 0, 0, 1}, columns[6] = {0, 1, 2, 1, 2, 2};
  double r2 = mju_dot3(r, r);
  sum->mass += mass;
  mju_addToScl3(sum->first, r, mass);
  for (int k = 0; k < 6; k++)
    sum->second[k] += inertia[k] + mass * ((k < 3 ? r2 : 0) - r[rows[k]] * r[columns[k]]);
}

static moments moments_of_parts(const bike_bicycle *b, bike_assembly assembly) {
  moments sum = {0};
  for (int i = 0; i < b->part_count; i++)
    if (b->parts[i].assembly == assembly)
      add_moments(&sum, b->parts[i].mass, b->parts[i].position, b->parts[i].inertia);
  return sum;
}

// All body frames are parallel to the world's at qpos 0.
static moments moments_of_body(const mjModel *m, const mjData *d, int body) {
  moments sum = {0};
  double inertia[6];
  mjcf_body_inertia(inertia, m, body);
  add_moments(&sum, m->body_mass[body], d->xipos + 3 * body, inertia);
  return sum;
}

static void check_parameters(const bike_bicycle *b) {
  mjcf_options options = mjcf_default_options();
  mjModel *m = model_of(b, &options);
  mjData *d = mj_makeData(m);
  mj_kinematics(m, d);
  for (int i = BIKE_REAR_FRAME; i <= BIKE_FRONT_WHEEL; i++) {
    moments is = moments_of_body(m, d, body_of(m, i)), should = moments_of_parts(b, i);
    assert_near(is.mass, should.mass, parameter_tolerance);
    for (int k = 0; k < 3; k++)
      assert_near(is.first[k], should.first[k], 100 * parameter_tolerance);
    for (int k = 0; k < 6; k++)
      assert_near(is.second[k], should.second[k], 100 * parameter_tolerance);
  }
  bike_upright upright;
  assert_int_equal(bike_upright_position(&upright, &b->geometry), 0);
  const double *rear = d->xpos + 3 * body_of(m, BIKE_REAR_WHEEL);
  const double *front = d->xpos + 3 * body_of(m, BIKE_FRONT_WHEEL);
  const double *axis = d->xaxis + 3 * mj_name2id(m, mjOBJ_JOINT, "steer");
  const double *anchor = d->xanchor + 3 * mj_name2id(m, mjOBJ_JOINT, "steer");
  for (int k = 0; k < 3; k++) {
    assert_near(rear[k], upright.rear_hub[k], parameter_tolerance);
    assert_near(front[k], upright.front_hub[k], parameter_tolerance);
  }
  assert_near(front[0], upright.wheelbase, parameter_tolerance);
  assert_near(axis[0], -sin(upright.tilt), parameter_tolerance);
  assert_near(axis[1], 0, 0);
  assert_near(axis[2], cos(upright.tilt), parameter_tolerance);
  // The steering axis meets the ground `trail` before the front contact.
  double ground = anchor[0] - anchor[2] * axis[0] / axis[2];
  assert_near(ground - front[0], upright.trail, parameter_tolerance);
  int tuple = mj_name2id(m, mjOBJ_TUPLE, "rolling_discs");
  assert_near(m->tuple_objprm[m->tuple_adr[tuple]], b->geometry.R_r, 0);
  assert_near(m->tuple_objprm[m->tuple_adr[tuple] + 1], b->geometry.R_f, 0);
  assert_near(m->opt.gravity[2], -b->gravity, 0);
  int steer = m->jnt_dofadr[mj_name2id(m, mjOBJ_JOINT, "steer")];
  assert_near(m->dof_damping[steer], b->steer_damping, 0);
  mj_deleteData(d);
  mj_deleteModel(m);
}

static void test_shipped_parameters(void **state) {
  (void)state;
  for (int i = 0; i < SHIPPED_COUNT; i++) {
    bike_bicycle b = read_shipped(shipped_bicycles[i].name);
    check_parameters(&b);
  }
}

static void test_random_parameters(void **state) {
  (void)state;
  random_source source = random_begin("random_parameters", 41);
  for (int i = 0; i < 100; i++) {
    bike_bicycle b = random_bicycle(&source, i % 2);
    check_parameters(&b);
  }
}

static void test_rider_offset(void **state) {
  (void)state;
  bike_bicycle b = read_shipped("roadster");
  mjcf_options options = mjcf_default_options();
  options.rider_offset = 0.02;
  mjModel *m = model_of(&b, &options);
  // To the right is negative y: 70 of 82 kg by 2 cm.
  assert_near(m->body_ipos[3 * body_of(m, BIKE_REAR_FRAME) + 1], -0.02 * 70 / 82, 1e-15);
  mj_deleteModel(m);
  b = read_shipped("roadster_riderless");
  mjcf_error error = {.text = ""};
  assert_null(mjcf_model(&b, &options, NULL, &error));
  assert_non_null(strstr(error.text, "rider"));
}

// The models in model/ are what the command makes of the files beside them, and can be ridden.
static void test_shipped_models(void **state) {
  (void)state;
  for (int i = 0; i < SHIPPED_COUNT; i++) {
    char path[512];
    const char *name = shipped_bicycles[i].name;
    snprintf(path, sizeof path, "%s/model/%s/%s.xml", BICYCLE_SOURCE_DIR, name, name);
    runner_status status;
    mjcf_error error = {.text = ""};
    runner *r = runner_load(path, &status, &error);
    if (!r) fail_msg("%s: %s", path, error.text);
    if (runner_start_at_keyframe(r, &error) != RUNNER_OK) fail_msg("%s: %s", path, error.text);
    bike_bicycle b = read_shipped(name);
    mjcf_options options = mjcf_default_options();
    mjModel *made = model_of(&b, &options), *shipped = runner_model(r);
    assert_int_equal(made->nbody, shipped->nbody);
    for (int k = 0; k < 3 * made->nbody; k++) {
      assert_near(shipped->body_pos[k], made->body_pos[k], 1e-15);
      assert_near(shipped->body_ipos[k], made->body_ipos[k], 1e-15);
      assert_near(shipped->body_inertia[k], made->body_inertia[k], 1e-14);
    }
    for (int k = 0; k < made->nbody; k++) assert_near(shipped->body_mass[k], made->body_mass[k], 0);
    mj_deleteModel(made);
    runner_free(r);
  }
}

//---------------------------------- text ----------------------------------------------------------

static char *text_of(const bike_bicycle *b, const mjcf_options *options) {
  mjcf_error error = {.text = ""};
  char *text = mjcf_text(b, options, NULL, &error);
  if (!text) fail_msg("%s", error.text);
  return text;
}

// MuJoCo alone, as any other program would see the file.
static mjModel *load_plainly(const char *text) {
  char path[] = "mjcf_XXXXXX.xml", message[200];
  int file = mkstemps(path, 4);
  assert_true(file >= 0);
  assert_int_equal(write(file, text, strlen(text)), (int)strlen(text));
  close(file);
  mjModel *m = mj_loadXML(path, NULL, message, sizeof message);
  if (!m) fail_msg("%s", message);
  unlink(path);
  return m;
}

static void test_placeholders(void **state) {
  (void)state;
  mjcf_options options = mjcf_default_options();
  bike_bicycle roadster = read_shipped("roadster"), benchmark = read_shipped("benchmark");
  assert_int_equal(mjcf_placeholder_count(&roadster, &options), 4);
  assert_int_equal(mjcf_placeholder_count(&benchmark, &options), 0);
  // The rider is a body of his own where he moves.
  mjcf_options moving = options;
  moving.moving_rider = true;
  assert_int_equal(mjcf_placeholder_count(&roadster, &moving), 5);
  char *text = text_of(&roadster, &options);
  assert_non_null(strstr(strstr(text, "<!--"), "PLACEHOLDERS"));
  assert_non_null(strstr(text, "numeric name=\"inertia:front_wheel\""));
  mjModel *plain = load_plainly(text);
  // Other programs: legal; ours: the exact rank-1 tensor.
  const double *principal = plain->body_inertia + 3 * body_of(plain, BIKE_FRONT_WHEEL);
  assert_near(principal[0] + principal[2] - principal[1], 0, 1e-15);
  mjcf_error error = {.text = ""};
  assert_true(mjcf_apply_inertia(plain, &error));
  assert_near(principal[0], 0, 0);
  assert_near(principal[1], 0.2, 0);
  // What MuJoCo derives follows: the diagonal of M at qpos0.
  mjData *d = mj_makeData(plain);
  mj_forward(plain, d);
  for (int i = 0; i < plain->nv; i++)
    assert_near(plain->dof_M0[i], d->qM[plain->dof_Madr[i]], 1e-13);
  mj_deleteData(d);
  mj_deleteModel(plain);
  free(text);
  text = text_of(&benchmark, &options);
  assert_null(strstr(text, "PLACEHOLDERS"));
  free(text);
}

static void test_binary_is_exact(void **state) {
  (void)state;
  mjcf_options options = mjcf_default_options();
  bike_bicycle b = read_shipped("penny_farthing");
  mjModel *m = model_of(&b, &options);
  mj_saveModel(m, "exact.mjb", NULL, 0);
  mjModel *plain = mj_loadModel("exact.mjb", NULL);
  assert_non_null(plain);
  assert_memory_equal(plain->body_inertia, m->body_inertia, 3 * sizeof(double) * (size_t)m->nbody);
  assert_near(plain->body_inertia[3 * body_of(plain, BIKE_FRONT_WHEEL) + 1], 2, 0);
  mj_deleteModel(plain);
  mj_deleteModel(m);
  unlink("exact.mjb");
}

static void test_any_name(void **state) {
  (void)state;
  mjcf_options options = mjcf_default_options();
  bike_bicycle b = read_shipped("benchmark");
  snprintf(b.name, sizeof b.name, "a<b>&\"c\" --> \x01");
  mjModel *m = model_of(&b, &options);
  assert_string_equal(m->names, "a<b>&\"c\" --> ?");
  mj_deleteModel(m);
}

static void test_variants_compile(void **state) {
  (void)state;
  bike_bicycle b = read_shipped("recumbent_damped");
  for (int i = 0; i < 2 * 2 * 3 * 2; i++) {
    mjcf_options options = mjcf_default_options();
    options.root = i % 2 ? MJCF_ROOT_FREE : MJCF_ROOT_HINGE;
    options.rolling = i / 2 % 2 ? MJCF_ROLLING_CONTACT : MJCF_ROLLING_EXACT;
    options.integrator = (mjcf_integrator)(i / 4 % 3);
    options.visible = i / 12;
    options.timestep = 2e-3;
    static const int integrators[] = {mjINT_RK4, mjINT_EULER, mjINT_IMPLICIT};
    mjModel *m = model_of(&b, &options);
    assert_int_equal(m->nq, options.root == MJCF_ROOT_FREE ? 10 : 9);
    assert_int_equal(m->opt.integrator, integrators[options.integrator]);
    assert_near(m->opt.timestep, 2e-3, 0);
    // With contacts the constraint must not be there as well.
    bool exact = options.rolling == MJCF_ROLLING_EXACT;
    assert_int_equal(mj_name2id(m, mjOBJ_TUPLE, "rolling_discs") >= 0, exact);
    assert_int_equal((m->opt.disableflags & mjDSBL_CONTACT) != 0, exact);
    mj_deleteModel(m);
  }
}

//---------------------------------- errors --------------------------------------------------------

static void test_refused_bicycles(void **state) {
  (void)state;
  mjcf_options options = mjcf_default_options();
  mjcf_error error = {.text = ""};
  bike_bicycle b = read_shipped("benchmark");
  for (int i = 0; i < b.part_count; i++)
    if (b.parts[i].assembly == BIKE_FRONT_WHEEL) memset(b.parts[i].inertia, 0, sizeof(double[6]));
  assert_null(mjcf_text(&b, &options, NULL, &error));
  assert_non_null(strstr(error.text, "front_wheel"));
  b = read_shipped("benchmark");
  b.parts[1].mass = -1;
  assert_null(mjcf_text(&b, &options, NULL, &error));
  assert_non_null(strstr(error.text, b.parts[1].name));
  assert_non_null(strstr(error.text, "mass"));
  b = read_shipped("benchmark");
  const double bad_steps[] = {0, -1, NAN, INFINITY};
  for (int i = 0; i < 4; i++) {
    options.timestep = bad_steps[i];
    assert_null(mjcf_text(&b, &options, NULL, &error));
    assert_non_null(strstr(error.text, "timestep"));
  }
}

static void test_refused_numerics(void **state) {
  (void)state;
  static const char *const numerics[][2] = {
      {"<numeric name=\"inertia:wheel\" data=\"1 1 1 0 0 0\"/>", "no such body"},
      {"<numeric name=\"inertia:b\" data=\"1 1 1\"/>", "six numbers"},
      {"<numeric name=\"inertia:b\" data=\"1 1 -1 0 0 0\"/>", "semidefinite"},
      {"<numeric name=\"inertia:b\" data=\"1 1 1 0 2 0\"/>", "semidefinite"}};
  for (int i = 0; i < 4; i++) {
    char text[500];
    mjcf_error error = {.text = ""};
    snprintf(text, sizeof text,
             "<mujoco><custom>%s</custom><worldbody><body name=\"b\"><freejoint/>"
             "<geom size=\"1\"/></body></worldbody></mujoco>",
             numerics[i][0]);
    assert_null(mjcf_compile(text, &error));
    if (!strstr(error.text, numerics[i][1])) fail_msg("%s", error.text);
  }
}

static void test_refused_files(void **state) {
  (void)state;
  static const char *const texts[] = {"", "<", "<mujoco>", "<mujoco><nonsense/></mujoco>",
                                      "\x80\xff"};
  mjcf_error error;
  for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
    error.text[0] = '\0';
    assert_null(mjcf_compile(texts[i], &error));
    assert_true(strlen(error.text) > 0);
    assert_null(strchr(error.text, '\n'));
  }
  FILE *garbage = fopen("garbage.mjb", "wb");
  for (int i = 0; i < 1000; i++) fputc(i * 37, garbage);
  fclose(garbage);
  static const char *const paths[] = {"garbage.mjb", "no such file.xml", ".", "no such file.mjb"};
  for (size_t i = 0; i < sizeof paths / sizeof paths[0]; i++) {
    error.text[0] = '\0';
    assert_null(mjcf_load(paths[i], &error));
    assert_true(strlen(error.text) > 0);
  }
  unlink("garbage.mjb");
  assert_int_not_equal(access("MUJOCO_LOG.TXT", F_OK), 0);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_shipped_parameters), cmocka_unit_test(test_random_parameters),
      cmocka_unit_test(test_rider_offset),       cmocka_unit_test(test_shipped_models),
      cmocka_unit_test(test_placeholders),       cmocka_unit_test(test_binary_is_exact),
      cmocka_unit_test(test_any_name),           cmocka_unit_test(test_variants_compile),
      cmocka_unit_test(test_refused_bicycles),   cmocka_unit_test(test_refused_numerics),
      cmocka_unit_test(test_refused_files)};
  own_folder folder = enter_own_folder();
  int failed = cmocka_run_group_tests(tests, NULL, NULL);
  leave_own_folder(&folder);
  return failed;
}
