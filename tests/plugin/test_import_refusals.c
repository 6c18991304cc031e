// SPDX-License-Identifier: Apache-2.0
// What is no bicycle of the equations is refused by name; what changes nothing is not.
#include "support/near.h"

#include <bicycle_import.h>
#include <runner.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define MODELS BICYCLE_SOURCE_DIR "/tests/plugin/import_models/"
#define FORK_FIRST MODELS "fork_first.xml"
#define COMPANY MODELS "company_bike.xml"
#define BRAKE_DISC MODELS "brake_disc.xml"
#define ROADSTER BICYCLE_SOURCE_DIR "/model/roadster/roadster.xml"

typedef struct edit {
  const char *path, *from, *to;
  const char *says; // part of the refusal
} edit;

// The model with one piece of its text exchanged.
static mjModel *edited(const edit *e) {
  FILE *stream = fopen(e->path, "re");
  assert_non_null(stream);
  char text[32768];
  size_t size = fread(text, 1, sizeof text - 1, stream);
  fclose(stream);
  text[size] = '\0';
  char *at = strstr(text, e->from), *changed = NULL;
  mjcf_error error = {.text = ""};
  if (!at) fail_msg("'%s' is not in %s", e->from, e->path);
  assert_true(asprintf(&changed, "%.*s%s%s", (int)(at - text), text, e->to, at + strlen(e->from)) >
              0);
  mjModel *m = mjcf_compile(changed, &error);
  free(changed);
  if (!m) fail_msg("'%s' does not compile: %s", e->to, error.text);
  return m;
}

static void expect_refusal(const mjModel *m, const char *says) {
  bike_bicycle b;
  mjcf_error error = {.text = ""};
  if (import_bicycle(&b, NULL, m, &error)) fail_msg("nothing is said of '%s'", says);
  if (!strstr(error.text, says)) fail_msg("'%s' for '%s'", error.text, says);
  assert_null(strchr(error.text, '\n'));
}

static void expect_bicycle(const mjModel *m, const char *what) {
  bike_bicycle b;
  mjcf_error error = {.text = ""};
  if (!import_bicycle(&b, NULL, m, &error)) fail_msg("%s: %s", what, error.text);
}

static void refuse_all(const edit *edits, size_t count) {
  for (size_t i = 0; i < count; i++) {
    mjModel *m = edited(&edits[i]);
    expect_refusal(m, edits[i].says);
    mj_deleteModel(m);
  }
}

static void test_shapes(void **state) {
  (void)state;
  static const edit edits[] = {
      {FORK_FIRST, "<joint name=\"head\" type=\"hinge\"", "<joint name=\"head\" type=\"slide\"",
       "not joined by one hinge; found: slide 'east'"},
      {FORK_FIRST, "<joint name=\"rear axle\" type=\"hinge\" axis=\"0 1 0\"/>", "",
       "both wheels are on the same body"},
      {FORK_FIRST, "<joint name=\"list\" type=\"hinge\" axis=\"1 0 0\"/>", "",
       "the root has 5 freedoms"},
      {FORK_FIRST, "type=\"hinge\" axis=\"0 -1 0\"/>", "type=\"hinge\" axis=\"0.1 -1 0\"/>",
       "not parallel"},
      {FORK_FIRST, "mass=\"1e-14\" diaginertia", "mass=\"1\" diaginertia", "'gantry', between"},
      {FORK_FIRST, "<inertial pos=\"0 0 0\" mass=\"2.5\"",
       "<inertial pos=\"0.01 0 0\" mass=\"2.5\"", "0.01 m off its axle"},
      {FORK_FIRST, "diaginertia=\"0.1 0.2 0.1\"", "diaginertia=\"0.1 0.2 0.12\"",
       "not round about its axle"},
      {FORK_FIRST, "<body name=\"front\" pos=\"0.03 0 -0.27\">",
       "<body name=\"front\" pos=\"0.03 0.02 -0.27\">", "not in one plane"},
      {FORK_FIRST, "<inertial pos=\"0 0 0\" mass=\"60\"", "<inertial pos=\"0 0 -2\" mass=\"60\"",
       "rear_frame is 1.2 m below the ground"},
  };
  refuse_all(edits, sizeof edits / sizeof *edits);
}

#define FORK_OPTION(says, ...)                                                                     \
  { FORK_FIRST, "<compiler angle=\"radian\"/>", "<compiler angle=\"radian\"/>" __VA_ARGS__, says }
#define FORK_MORE(says, ...)                                                                       \
  { FORK_FIRST, "</worldbody>", "</worldbody>" __VA_ARGS__, says }
#define SPIN "type=\"hinge\" axis=\"0 -1 0\"/>"
#define HEAD "pos=\"0.5 0 -0.2\"/>"
#define MOTOR "<motor name=\"steer_motor\" joint=\"hb\" gear=\"1\"/>"
#define TENDON(attributes)                                                                         \
  "</worldbody><tendon><fixed name=\"cable\" " attributes                                          \
  "><joint joint=\"head\" coef=\"1\"/></fixed></tendon>"

static void test_forces(void **state) {
  (void)state;
  static const edit edits[] = {
      FORK_OPTION("gravity (0, 1, -9)", "<option gravity=\"0 1 -9\"/>"),
      FORK_OPTION("gravity (0, 0, 0)", "<option gravity=\"0 0 0\"/>"),
      FORK_OPTION("gravity (0, 0, 9.81)", "<option gravity=\"0 0 9.81\"/>"),
      FORK_OPTION("flag gravity", "<option><flag gravity=\"disable\"/></option>"),
      FORK_OPTION("density 1.2", "<option density=\"1.2\"/>"),
      FORK_OPTION("viscosity 1.8e-05", "<option viscosity=\"1.8e-5\"/>"),
      FORK_OPTION("wind (0, 3, 0)", "<option wind=\"0 3 0\"/>"),
      {FORK_FIRST, SPIN, "type=\"hinge\" axis=\"0 -1 0\" armature=\"0.1\"/>",
       "'front axle' has armature"},
      {FORK_FIRST, SPIN, "type=\"hinge\" axis=\"0 -1 0\" damping=\"0.1\"/>",
       "'front axle' has damping"},
      {FORK_FIRST, HEAD, "pos=\"0.5 0 -0.2\" frictionloss=\"0.1\"/>", "'head' has frictionloss"},
      {FORK_FIRST, HEAD, "pos=\"0.5 0 -0.2\" stiffness=\"9\" springref=\"0.2\"/>",
       "'head' has stiffness"},
      FORK_MORE("1 equality constraint",
                "<equality><joint joint1=\"east\" joint2=\"north\"/></equality>"),
      {FORK_FIRST, "</worldbody>", TENDON("stiffness=\"5\" springlength=\"0.1\""),
       "tendon 'cable' has stiffness"},
      {FORK_FIRST, "</worldbody>", TENDON("damping=\"5\""), "tendon 'cable' has damping"},
      {FORK_FIRST, "</worldbody>", TENDON("frictionloss=\"5\""), "tendon 'cable' has frictionloss"},
      {COMPANY, "<freejoint name=\"float\"/>",
       "<joint name=\"float\" type=\"free\" damping=\"1\"/>", "'float' has damping"},
      // Actuators that act while their control is zero.
      {COMPANY, MOTOR, "<position name=\"servo\" joint=\"hb\" kp=\"10\"/>",
       "actuator 'servo' acts while its control is zero: it has biasprm"},
      {COMPANY, MOTOR, "<velocity joint=\"rspin\" kv=\"10\"/>", "actuator number 0 acts"},
      {COMPANY, MOTOR, "<general joint=\"hb\" biastype=\"affine\" biasprm=\"3 0 0\"/>", "biasprm"},
      {COMPANY, MOTOR, "<cylinder joint=\"hb\" timeconst=\"1\" area=\"1\" bias=\"3 0 0\"/>",
       "biasprm"},
      {COMPANY, MOTOR, "<muscle joint=\"hb\" lengthrange=\"-1 1\"/>", "a muscle's passive force"},
      {COMPANY, MOTOR, "<general joint=\"hb\" biastype=\"user\"/>", "bias of the program's"},
      {COMPANY, MOTOR, "<general joint=\"hb\" dyntype=\"user\"/>", "activation of the program's"},
      {COMPANY, MOTOR, "<motor joint=\"hb\" ctrllimited=\"true\" ctrlrange=\"1 2\"/>",
       "a ctrlrange without zero"},
      {COMPANY, MOTOR, "<motor joint=\"hb\" forcelimited=\"true\" forcerange=\"-2 -1\"/>",
       "a forcerange without zero"},
      {COMPANY, MOTOR,
       "<general joint=\"hb\" dyntype=\"integrator\" actlimited=\"true\" actrange=\"1 2\"/>",
       "an actrange without zero"},
      // Stops where the bicycle cannot do without.
      {COMPANY, "name=\"rspin\" type=\"hinge\"",
       "name=\"rspin\" type=\"hinge\" limited=\"true\" range=\"-90 90\"",
       "hinge 'rspin' of a wheel"},
      {COMPANY, "damping=\"0.4\"/>", "damping=\"0.4\" limited=\"true\" range=\"5 40\"/>",
       "straight ahead the steer, joint 'hb', is at a stop"},
  };
  refuse_all(edits, sizeof edits / sizeof *edits);
}

// They are there and do nothing while nobody acts.
static void test_what_changes_nothing(void **state) {
  (void)state;
  static const edit edits[] = {
      {COMPANY, MOTOR, MOTOR, ""},
      {COMPANY, MOTOR, "<motor joint=\"hb\" ctrllimited=\"true\" ctrlrange=\"-1 1\"/>", ""},
      {COMPANY, MOTOR, "<damper joint=\"hb\" kv=\"1\" ctrlrange=\"0 1\"/>", ""},
      {COMPANY, MOTOR, "<general joint=\"hb\" dyntype=\"filter\" dynprm=\"0.1\"/>", ""},
      {COMPANY, MOTOR, "<general joint=\"hb\" biastype=\"affine\" dyntype=\"integrator\"/>", ""},
      {COMPANY, MOTOR, "<general joint=\"hb\" dyntype=\"user\" gainprm=\"0\"/>", ""},
      {COMPANY, "damping=\"0.4\"/>", "damping=\"0.4\" springref=\"20\" ref=\"0\"/>", ""},
      {COMPANY, "damping=\"0.4\"/>", "damping=\"0.4\" limited=\"true\" range=\"-40 40\"/>", ""},
      {FORK_FIRST, "</worldbody>", TENDON("springlength=\"0.1\""), ""},
      {FORK_FIRST, "axis=\"1 0 0\"/>\n          <joint",
       "axis=\"1 0 0\" limited=\"true\" "
       "range=\"-1 1\"/>\n          <joint",
       ""},
  };
  for (size_t i = 0; i < sizeof edits / sizeof *edits; i++) {
    mjModel *m = edited(&edits[i]);
    expect_bicycle(m, edits[i].to);
    mj_deleteModel(m);
  }
}

// Every flag that MuJoCo has, in a model without and with a marker.
static void test_flags(void **state) {
  (void)state;
  static const char *const disabled[mjNDISABLE] = {
      [0] = "flag constraint", [4] = "flag contact", [5] = "flag passive", [6] = "flag gravity"};
  static const char *const paths[] = {COMPANY, ROADSTER};
  for (int marked = 0; marked < 2; marked++) {
    mjcf_error error = {.text = ""};
    mjModel *m = mjcf_load(paths[marked], &error);
    assert_non_null(m);
    for (int i = 0; i < mjNDISABLE; i++) {
      int flag = 1 << i;
      bool needed = disabled[i] && !(marked && (flag & (mjDSBL_CONSTRAINT | mjDSBL_CONTACT)));
      m->opt.disableflags = flag;
      if (needed)
        expect_refusal(m, disabled[i]);
      else
        expect_bicycle(m, "a flag");
    }
    m->opt.disableflags = 0;
    m->opt.enableflags = (1 << mjNENABLE) - 1;
    expect_bicycle(m, "all that can be enabled");
    mj_deleteModel(m);
  }
}

// What a flag switches off does not act.
static void test_switched_off(void **state) {
  (void)state;
  static const struct {
    edit edit;
    int flag;
  } cases[] = {
      {FORK_MORE("", "<equality><joint joint1=\"east\" joint2=\"north\"/></equality>"),
       mjDSBL_EQUALITY},
      {{FORK_FIRST, HEAD, "pos=\"0.5 0 -0.2\" frictionloss=\"0.1\"/>", ""}, mjDSBL_FRICTIONLOSS},
      {{COMPANY, MOTOR, "<position joint=\"hb\" kp=\"10\"/>", ""}, mjDSBL_ACTUATION},
      {{COMPANY, MOTOR, "<motor joint=\"hb\" ctrllimited=\"true\" ctrlrange=\"1 2\"/>", ""},
       mjDSBL_CLAMPCTRL},
      {{COMPANY, "damping=\"0.4\"/>", "damping=\"0.4\" limited=\"true\" range=\"5 40\"/>", ""},
       mjDSBL_LIMIT}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    mjModel *m = edited(&cases[i].edit);
    m->opt.disableflags |= cases[i].flag;
    expect_bicycle(m, cases[i].edit.to);
    mj_deleteModel(m);
  }
}

//---------------------------------- radii ---------------------------------------------------------

#define TYRE "<geom name=\"ftyre\" class=\"tyre\" size=\"0.34 0.012\" mass=\"1.6\"/>"
#define RING(angle, x, y)                                                                          \
  "<geom type=\"capsule\" size=\"0.015 0.03\" pos=\"" x " " y " 0\" contype=\"0\" "                \
  "conaffinity=\"0\" euler=\"90 0 " angle "\" mass=\"0.4\"/>"

static void test_radii(void **state) {
  (void)state;
  static const edit edits[] = {
      {BRAKE_DISC, "pos=\"0.12 0 -0.3\"", "pos=\"0.12 0 -0.3\"",
       "wheel 'front': radius 0.08 m from geom number 5, but geom number 4 of that wheel reaches "
       "0.3 m"},
      {BRAKE_DISC, "pos=\"0.12 0 -0.3\"", "pos=\"0.12 0 -0.3\"",
       "<custom><tuple name=\"rolling_discs\"><element objtype=\"body\" objname=\"rear\""},
      // A brake disc that touches things and a tyre that is only looked at.
      {COMPANY, TYRE,
       "<geom class=\"tyre\" size=\"0.34 0.012\" mass=\"1.6\" contype=\"0\" conaffinity=\"0\"/>"
       "<geom name=\"rotor\" type=\"cylinder\" size=\"0.08 0.001\" mass=\"0.1\"/>",
       "geom 'rotor', but geom number"},
      // A hub shell within a ring of capsules.
      {COMPANY, TYRE,
       "<geom name=\"shell\" type=\"cylinder\" size=\"0.03 0.03\" mass=\"0.3\"/>" RING("0", "0.32",
                                                                                       "0")
           RING("0", "-0.32", "0") RING("90", "0", "0.32") RING("90", "0", "-0.32"),
       "radius 0.03 m from geom 'shell'"},
      // Nothing but the shell: inertia says that there is a rim.
      {COMPANY, TYRE,
       "<inertial pos=\"0 0 0\" mass=\"1.6\" diaginertia=\"0.08 0.08 0.16\"/>"
       "<geom name=\"shell\" type=\"cylinder\" size=\"0.03 0.03\"/>",
       "radius of gyration is 0.3162 m"},
      // A rim, or a tyre typed wrong: the hub stands too high for it.
      {COMPANY, TYRE, "<geom name=\"rim\" class=\"tyre\" size=\"0.25 0.012\" mass=\"1.6\"/>",
       "its hub is 0.3575 m above the ground where the other wheel touches it"},
      // Nothing of the wheel comes near the ground: its hub's height is no radius.
      {FORK_FIRST, "<geom type=\"sphere\" size=\"0.33\"/>",
       "<geom type=\"box\" size=\"0.1 0.01 0.1\"/>", "reaches farthest, 0.1 m from the axle"},
      {ROADSTER, "objtype=\"body\" objname=\"front_wheel\"",
       "objtype=\"body\" objname=\"front_frame\"",
       "rolling_discs does not name wheel 'front_wheel'"},
  };
  refuse_all(edits, sizeof edits / sizeof *edits);
}

// The bicycle that hangs in front is one, and its map says how it was understood.
static void test_company_bike(void **state) {
  (void)state;
  bike_bicycle b;
  import_map map;
  mjcf_error error = {.text = ""};
  mjModel *m = mjcf_load(COMPANY, &error);
  if (!m || !import_bicycle(&b, &map, m, &error)) fail_msg("%s", error.text);
  assert_near(map.travel[0], 0, 1e-9);
  assert_near(atan2(map.travel[2], -map.travel[1]), asin(map.clearance[IMPORT_FRONT] / 1.068),
              1e-4);
  assert_int_equal(map.steer_sign, -1);
  for (int i = 0; i < IMPORT_WHEELS; i++) {
    assert_int_equal(map.source[i], IMPORT_GEOM);
    assert_near(map.radius[i], 0.34, 0);
  }
  assert_string_equal(m->names + m->name_geomadr[map.geom[IMPORT_FRONT]], "ftyre");
  assert_near(map.clearance[IMPORT_REAR], 0, 1e-12);
  assert_near(map.clearance[IMPORT_FRONT], 0.01755, 1e-5);
  mj_deleteModel(m);
}

// A wheel with no shape at all stands on the ground, wherever the ground's plane is; and a box that
// somebody took for a wheel does not speak against it.
static void test_radius_from_height(void **state) {
  (void)state;
#define ROTOR "<geom type=\"cylinder\" euler=\"90 0 0\" size=\".08 .002\" mass=\".2\"/>"
  static const edit edits[] = {
      {BRAKE_DISC, ROTOR, "", ""},
      {BRAKE_DISC, "<geom type=\"box\" size=\".3 .02 .3\" mass=\"2\"/>" ROTOR,
       "<inertial pos=\"0 0 0\" mass=\"2\" diaginertia=\".06 .12 .06\"/>", ""}};
  for (int i = 0; i < 2; i++) {
    bike_bicycle b;
    import_map map;
    mjcf_error error = {.text = ""};
    mjModel *m = edited(&edits[i]);
    for (int g = 0; g < m->ngeom; g++)
      if (i == 1 && m->geom_type[g] == mjGEOM_PLANE) {
        m->geom_pos[3 * g + 2] = 0.02;
        m->geom_sameframe[g] = 0;
      }
    if (!import_bicycle(&b, &map, m, &error)) fail_msg("%s", error.text);
    assert_int_equal(map.source[IMPORT_FRONT], IMPORT_HEIGHT);
    assert_near(map.radius[IMPORT_FRONT], i ? 0.28 : 0.3, 1e-12);
    mj_deleteModel(m);
  }
}

//---------------------------------- models with our names -----------------------------------------

// A model that was written here and then changed is no longer the bicycle whose rows it would have.
static void test_own_names(void **state) {
  (void)state;
  static const edit edits[] = {
      {ROADSTER, "<option ", "<option density=\"1.2\" ", "density 1.2"},
      {ROADSTER, "</worldbody>",
       "</worldbody><tendon><fixed stiffness=\"5\"><joint joint=\"steer\" coef=\"1\"/></fixed>"
       "</tendon>",
       "tendon number 0 has stiffness"},
      {ROADSTER, "</worldbody>",
       "</worldbody><actuator><position name=\"servo\" joint=\"steer\"/></actuator>",
       "actuator 'servo' acts"},
  };
  char path[] = "/tmp/bicycle-import-XXXXXX.mjb";
  int handle = mkstemps(path, 4);
  assert_true(handle >= 0);
  for (size_t i = 0; i < sizeof edits / sizeof *edits; i++) {
    runner_status status;
    mjcf_error error = {.text = ""};
    mjModel *m = edited(&edits[i]);
    mj_saveModel(m, path, NULL, 0);
    mj_deleteModel(m);
    assert_null(runner_load(path, &status, &error));
    assert_int_equal(status, RUNNER_MODEL);
    if (!strstr(error.text, edits[i].says)) fail_msg("'%s' for '%s'", error.text, edits[i].says);
  }
  remove(path);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_shapes),
      cmocka_unit_test(test_forces),
      cmocka_unit_test(test_what_changes_nothing),
      cmocka_unit_test(test_flags),
      cmocka_unit_test(test_switched_off),
      cmocka_unit_test(test_radii),
      cmocka_unit_test(test_company_bike),
      cmocka_unit_test(test_radius_from_height),
      cmocka_unit_test(test_own_names),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
