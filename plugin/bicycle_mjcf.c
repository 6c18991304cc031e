// SPDX-License-Identifier: Apache-2.0
// The text of the model: what moves, what weighs, what rolls.
#include "bicycle_mjcf_internal.h"

#include "files/memory_stream.h"

#include <bicycle/error.h>
#include <stdlib.h>

void mjcf_put(FILE *out, const char *name, const double *values, int count) {
  fprintf(out, " %s=\"", name);
  for (int k = 0; k < count; k++) fprintf(out, "%s%.17g", k ? " " : "", values[k] + 0.0); // no "-0"
  fputc('"', out);
}

void mjcf_put_escaped(FILE *out, const char *text) {
  for (; *text; text++) {
    switch (*text) {
    case '&':
      fputs("&amp;", out);
      break;
    case '<':
      fputs("&lt;", out);
      break;
    case '>':
      fputs("&gt;", out);
      break;
    case '"':
      fputs("&quot;", out);
      break;
    default:
      fputc((unsigned char)*text < ' ' ? '?' : *text, out);
    }
  }
}

static void put_header(FILE *out, const mjcf_plan *plan) {
  bool any = false;
  fputs("<!-- A bicycle for MuJoCo 2.2, made by `bicycle mujoco mjcf`: SI units, radians.\n", out);
  fputs("     At qpos 0 it stands upright; roll right, steer left, yaw left, rolling forward are\n"
        "     positive; the speed of the rear contact is R_r (pitch' + rear_spin').\n",
        out);
  if (plan->options->rolling == MJCF_ROLLING_EXACT)
    fputs(
        "     The wheels roll where libmujoco_rolling.so is loaded; elsewhere they fall through.\n",
        out);
  if (plan->apart)
    fputs("     Ground, light and sky are those of scene.xml, which includes this.\n", out);
  for (int i = 0; i < plan->bodies; i++) {
    if (!plan->body[i].placeholder) continue;
    if (!any)
      fputs(
          "     PLACEHOLDERS: MJCF refuses the inertia of some bodies. Other programs see a legal\n"
          "     stand-in; `bicycle mujoco` puts in the exact tensor of the numeric of that name:\n"
          "    ",
          out);
    fprintf(out, " inertia:%s", plan->body[i].name);
    any = true;
  }
  fputs(any ? "\n-->\n" : "-->\n", out);
  fputs("<mujoco model=\"", out);
  mjcf_put_escaped(out, plan->bicycle->name);
  fputs("\">\n", out);
}

static void put_option(FILE *out, const mjcf_plan *plan) {
  static const char *const integrators[] = {"RK4", "Euler", "implicit"};
  bool exact = plan->options->rolling == MJCF_ROLLING_EXACT;
  const double gravity[3] = {0, 0, -plan->bicycle->gravity};
  fputs("  <compiler angle=\"radian\" inertiafromgeom=\"false\"/>\n", out);
  // Room for a user's own limits and contacts; MuJoCo's default of megabytes costs 3 ms a model.
  fprintf(out, "  <size njmax=\"100\" nconmax=\"25\" nstack=\"32768\"%s/>\n",
          plan->options->moving_rider ? " nuserdata=\"3\"" : "");
  fprintf(out, "  <option integrator=\"%s\"", integrators[plan->options->integrator]);
  mjcf_put(out, "timestep", &plan->options->timestep, 1);
  mjcf_put(out, "gravity", gravity, 3);
  // Contacts: the solver must not stop before the model's own softness is what limits it.
  if (!exact) fputs(" cone=\"elliptic\" solver=\"Newton\" tolerance=\"1e-14\"", out);
  fprintf(out, ">\n    <flag energy=\"enable\"%s/>\n  </option>\n",
          exact ? " contact=\"disable\"" : "");
}

// The marker of plugin/rolling.h. With contacts instead it has another name, under which only our
// programs read the radii.
static void put_custom(FILE *out, const mjcf_plan *plan) {
  const bike_geometry *g = &plan->bicycle->geometry;
  bool exact = plan->options->rolling == MJCF_ROLLING_EXACT;
  fprintf(out, "  <custom>\n    <tuple name=\"%s\">\n", exact ? "rolling_discs" : "contact_discs");
  fputs("      <element objtype=\"body\" objname=\"rear_wheel\"", out);
  mjcf_put(out, "prm", &g->R_r, 1);
  fputs("/>\n      <element objtype=\"body\" objname=\"front_wheel\"", out);
  mjcf_put(out, "prm", &g->R_f, 1);
  fputs("/>\n    </tuple>\n", out);
  if (plan->options->moving_rider)
    fputs("    <tuple name=\"rolling_driven\">\n"
          "      <element objtype=\"joint\" objname=\"rider\" prm=\"0\"/>\n"
          "    </tuple>\n",
          out);
  for (int i = 0; i < plan->bodies; i++) {
    if (!plan->body[i].placeholder) continue;
    fprintf(out, "    <numeric name=\"inertia:%s\" size=\"6\"", plan->body[i].name);
    mjcf_put(out, "data", plan->body[i].inertia, 6);
    fputs("/>\n", out);
  }
  fputs("  </custom>\n", out);
}

void mjcf_indent(FILE *out, int body, int deeper) {
  static const int depth[MJCF_BODIES] = {[BIKE_REAR_FRAME] = 2,
                                         [BIKE_REAR_WHEEL] = 3,
                                         [BIKE_FRONT_FRAME] = 3,
                                         [BIKE_FRONT_WHEEL] = 4,
                                         [MJCF_RIDER] = 3};
  fprintf(out, "%*s", 2 * (depth[body] + deeper), "");
}

// Opens <body> with its place in the parent, and says what it weighs.
static void open_body(FILE *out, const mjcf_plan *plan, int assembly,
                      const double parent_origin[3]) {
  const mjcf_body *body = &plan->body[assembly];
  double place[3];
  for (int k = 0; k < 3; k++) place[k] = body->origin[k] - parent_origin[k];
  mjcf_indent(out, assembly, 0);
  fprintf(out, "<body name=\"%s\"", body->name);
  if (plan->apart && assembly == BIKE_REAR_FRAME) fputs(" childclass=\"bicycle\"", out);
  mjcf_put(out, "pos", place, 3);
  fputs(">\n", out);
  mjcf_indent(out, assembly, 1);
  fputs("<inertial", out);
  mjcf_put(out, "mass", &body->mass, 1);
  mjcf_put(out, "pos", body->centre, 3);
  mjcf_put(out, "quat", body->quat, 4);
  mjcf_put(out, "diaginertia", body->principal, 3);
  fputs("/>\n", out);
}

static void close_body(FILE *out, int assembly) {
  mjcf_indent(out, assembly, 0);
  fputs("</body>\n", out);
}

static void put_root_joints(FILE *out, mjcf_root root) {
  static const char *const hinges = "      <joint name=\"x\" type=\"slide\" axis=\"1 0 0\"/>\n"
                                    "      <joint name=\"y\" type=\"slide\" axis=\"0 1 0\"/>\n"
                                    "      <joint name=\"z\" type=\"slide\" axis=\"0 0 1\"/>\n"
                                    "      <joint name=\"yaw\" type=\"hinge\" axis=\"0 0 1\"/>\n"
                                    "      <joint name=\"roll\" type=\"hinge\" axis=\"1 0 0\"/>\n"
                                    "      <joint name=\"pitch\" type=\"hinge\" axis=\"0 1 0\"/>\n";
  fputs(root == MJCF_ROOT_FREE ? "      <freejoint name=\"root\"/>\n" : hinges, out);
}

// As stiff as MuJoCo allows (refsafe: two timesteps) unless asked otherwise, critically damped.
// Friction 1: dry tarmac.
void mjcf_put_contact(FILE *out, const mjcf_options *options) {
  const double solref[2] = {
      options->contact_time > 0 ? options->contact_time : 2 * options->timestep, 1};
  const double solimp[3] = {0.99, 0.999, 1e-4}, friction[1] = {1};
  fputs(" contype=\"1\" conaffinity=\"1\" condim=\"3\" priority=\"1\"", out);
  mjcf_put(out, "friction", friction, 1);
  mjcf_put(out, "solref", solref, 2);
  mjcf_put(out, "solimp", solimp, 3);
}

// MuJoCo's own contact of the wheel: an ellipsoid 1 mm thick, the nearest it has to a thin disc.
static void put_tread(FILE *out, const mjcf_plan *plan, bike_assembly wheel, double radius) {
  if (plan->options->rolling == MJCF_ROLLING_EXACT && !plan->apart) return;
  const double size[3] = {radius, 0.001, radius};
  mjcf_indent(out, wheel, 1);
  fprintf(out, "<geom name=\"%s\"", wheel == BIKE_REAR_WHEEL ? "rear_tread" : "front_tread");
  fputs(plan->apart ? " class=\"collision\"" : " type=\"ellipsoid\" mass=\"0\" group=\"3\"", out);
  mjcf_put(out, "size", size, 3);
  if (!plan->apart) mjcf_put_contact(out, plan->options);
  fputs("/>\n", out);
}

static void put_shape(FILE *out, const mjcf_plan *plan, int assembly) {
  if (plan->options->visible) mjcf_put_shape(out, plan, assembly);
}

static void put_wheel(FILE *out, const mjcf_plan *plan, bike_assembly wheel) {
  bool rear = wheel == BIKE_REAR_WHEEL;
  const bike_geometry *g = &plan->bicycle->geometry;
  open_body(out, plan, wheel, plan->body[rear ? BIKE_REAR_FRAME : BIKE_FRONT_FRAME].origin);
  mjcf_indent(out, wheel, 1);
  fprintf(out, "<joint name=\"%s\" %s/>\n", rear ? "rear_spin" : "front_spin",
          plan->apart ? "class=\"wheel\"" : "type=\"hinge\" axis=\"0 1 0\"");
  put_tread(out, plan, wheel, rear ? g->R_r : g->R_f);
  put_shape(out, plan, wheel);
  close_body(out, wheel);
}

static void put_front(FILE *out, const mjcf_plan *plan) {
  open_body(out, plan, BIKE_FRONT_FRAME, plan->body[BIKE_REAR_FRAME].origin);
  mjcf_indent(out, BIKE_FRONT_FRAME, 1);
  fputs("<joint name=\"steer\" type=\"hinge\"", out);
  mjcf_put(out, "axis", plan->axis, 3);
  mjcf_put(out, "damping", &plan->bicycle->steer_damping, 1);
  fputs("/>\n", out);
  put_shape(out, plan, BIKE_FRONT_FRAME);
  put_wheel(out, plan, BIKE_FRONT_WHEEL);
  close_body(out, BIKE_FRONT_FRAME);
}

// To the right is -y; the place in the file, or rider_offset beside it, is qpos 0.
static void put_rider(FILE *out, const mjcf_plan *plan) {
  if (!plan->options->moving_rider) return;
  open_body(out, plan, MJCF_RIDER, plan->body[BIKE_REAR_FRAME].origin);
  mjcf_indent(out, MJCF_RIDER, 1);
  fputs("<joint name=\"rider\" type=\"slide\" axis=\"0 -1 0\"/>\n", out);
  put_shape(out, plan, MJCF_RIDER);
  close_body(out, MJCF_RIDER);
}

// MuJoCo integrates the work of the rider's drive as an activation (rolling.h).
static void put_actuator(FILE *out, const mjcf_plan *plan) {
  if (!plan->options->moving_rider && !plan->apart) return;
  fputs("  <actuator>\n", out);
  if (plan->apart) fputs("    <motor name=\"steer_torque\" joint=\"steer\"/>\n", out);
  if (plan->options->moving_rider)
    fputs("    <general name=\"rolling:rider:work\" joint=\"rider\" dyntype=\"user\" "
          "gainprm=\"0\"/>\n",
          out);
  fputs("  </actuator>\n", out);
}

void mjcf_put_ground(FILE *out, bool visible) {
  fprintf(out, "    <geom name=\"ground\" type=\"plane\" size=\"0 0 0.1\" condim=\"3\"%s/>\n",
          visible ? " material=\"ground\"" : "");
}

static void put_world(FILE *out, const mjcf_plan *plan) {
  static const double ground[3] = {0, 0, 0};
  fputs("  <worldbody>\n", out);
  if (!plan->apart) {
    mjcf_put_ground(out, plan->options->visible);
    if (plan->options->visible) mjcf_put_scenery(out);
  }
  open_body(out, plan, BIKE_REAR_FRAME, ground);
  put_root_joints(out, plan->options->root);
  if (plan->options->visible) mjcf_put_cameras(out);
  if (plan->apart) mjcf_put_hub_site(out, plan);
  put_shape(out, plan, BIKE_REAR_FRAME);
  put_wheel(out, plan, BIKE_REAR_WHEEL);
  put_front(out, plan);
  put_rider(out, plan);
  close_body(out, BIKE_REAR_FRAME);
  fputs("  </worldbody>\n", out);
}

static void put_key(FILE *out, const mjcf_plan *plan, const mjcf_key *key) {
  if (!key) return;
  int rider = plan->options->moving_rider;
  int nq = (plan->options->root == MJCF_ROOT_FREE ? 10 : 9) + rider;
  fputs("  <keyframe>\n    <key name=\"test\"", out);
  mjcf_put(out, "qpos", key->qpos, nq);
  mjcf_put(out, "qvel", key->qvel, 9 + rider);
  fputs("/>\n  </keyframe>\n", out);
}

static void put_model(FILE *out, const mjcf_plan *plan, const mjcf_key *key) {
  bool visible = plan->options->visible;
  put_header(out, plan);
  put_option(out, plan);
  if (plan->apart) {
    mjcf_put_classes(out, plan);
    if (visible) mjcf_put_materials(out);
  } else if (visible) {
    mjcf_put_assets(out);
  }
  put_custom(out, plan);
  put_world(out, plan);
  if (plan->apart) mjcf_put_tendon(out, plan);
  put_actuator(out, plan);
  if (plan->apart) mjcf_put_sensors(out, plan);
  put_key(out, plan, key);
  fputs("</mujoco>\n", out);
}

char *mjcf_end_text(FILE *out, char **text, mjcf_error *error) {
  bool whole = !ferror(out);
  if (fclose(out) == 0 && whole) return *text;
  free(*text);
  return mjcf_fail_memory(error), NULL;
}

static char *make_text(mjcf_plan *plan, const mjcf_key *key, mjcf_error *error) {
  char *text = NULL;
  size_t size = 0;
  FILE *out = bike_memory_stream(&text, &size);
  if (!out) return mjcf_fail_memory(error), NULL;
  put_model(out, plan, key);
  return mjcf_end_text(out, &text, error);
}

char *mjcf_text(const bike_bicycle *bicycle, const mjcf_options *options, const mjcf_key *key,
                mjcf_error *error) {
  mjcf_plan plan;
  if (!mjcf_plan_init(&plan, bicycle, options, error)) return NULL;
  return make_text(&plan, key, error);
}

char *mjcf_model_text(const bike_bicycle *bicycle, const mjcf_options *options, const mjcf_key *key,
                      mjcf_error *error) {
  mjcf_plan plan;
  if (!mjcf_plan_init(&plan, bicycle, options, error)) return NULL;
  plan.apart = true;
  return make_text(&plan, key, error);
}
