// SPDX-License-Identifier: Apache-2.0
// Model and scene apart, in the manner of google-deepmind/mujoco_menagerie: what the model has
// more than mjcf_text's, and the scene.
#include "bicycle_mjcf_internal.h"

#include "files/memory_stream.h"

#include <bicycle/error.h>
#include <stdlib.h>

// With exact rolling the treads touch nothing: who wants contacts with other things turns the class
// on, and MuJoCo's contacts with <flag contact>.
void mjcf_put_classes(FILE *out, const mjcf_plan *plan) {
  fputs("  <default>\n    <default class=\"bicycle\">\n"
        "      <default class=\"visual\">\n"
        "        <geom contype=\"0\" conaffinity=\"0\" mass=\"0\" group=\"2\"/>\n"
        "      </default>\n"
        "      <default class=\"collision\">\n"
        "        <geom type=\"ellipsoid\" mass=\"0\" group=\"3\" rgba=\"0.2 0.4 0.9 0.3\"",
        out);
  if (plan->options->rolling == MJCF_ROLLING_CONTACT)
    mjcf_put_contact(out, plan->options);
  else
    fputs(" contype=\"0\" conaffinity=\"0\"", out);
  fputs("/>\n      </default>\n"
        "      <default class=\"wheel\">\n"
        "        <joint type=\"hinge\" axis=\"0 1 0\"/>\n"
        "      </default>\n"
        "    </default>\n  </default>\n",
        out);
}

static bool has_hinge_root(const mjcf_plan *plan) {
  return plan->options->root == MJCF_ROOT_HINGE;
}

// Of a free root: where its hub's velocity is measured.
void mjcf_put_hub_site(FILE *out, const mjcf_plan *plan) {
  if (has_hinge_root(plan)) return;
  mjcf_indent(out, BIKE_REAR_FRAME, 1);
  fputs("<site name=\"rear_hub\" size=\"0.01\" group=\"4\"/>\n", out);
}

// v = R_r (pitch' + rear_spin') is the velocity of a fixed tendon, in any program.
void mjcf_put_tendon(FILE *out, const mjcf_plan *plan) {
  const double *radius = &plan->bicycle->geometry.R_r;
  if (!has_hinge_root(plan)) return;
  fputs("  <tendon>\n    <fixed name=\"track\">\n      <joint joint=\"pitch\"", out);
  mjcf_put(out, "coef", radius, 1);
  fputs("/>\n      <joint joint=\"rear_spin\"", out);
  mjcf_put(out, "coef", radius, 1);
  fputs("/>\n    </fixed>\n  </tendon>\n", out);
}

// MuJoCo 2.2 has no sensor of energy: libmujoco_rolling.so answers that of the user.
void mjcf_put_sensors(FILE *out, const mjcf_plan *plan) {
  static const char of_hinges[] = "    <jointpos name=\"lean\" joint=\"roll\"/>\n"
                                  "    <jointvel name=\"lean_rate\" joint=\"roll\"/>\n"
                                  "    <tendonvel name=\"speed\" tendon=\"track\"/>\n";
  static const char of_free_joint[] =
      "    <frameyaxis name=\"left_axis\" objtype=\"xbody\" objname=\"rear_frame\"/>\n"
      "    <velocimeter name=\"hub_velocity\" site=\"rear_hub\"/>\n";
  fputs("  <sensor>\n"
        "    <jointpos name=\"steer\" joint=\"steer\"/>\n"
        "    <jointvel name=\"steer_rate\" joint=\"steer\"/>\n",
        out);
  fputs(has_hinge_root(plan) ? of_hinges : of_free_joint, out);
  fputs("    <user name=\"rolling:model:energy\" objtype=\"body\" objname=\"rear_frame\""
        " datatype=\"real\" dim=\"1\" needstage=\"acc\"/>\n"
        "  </sensor>\n",
        out);
}

//---------------------------------- scene ---------------------------------------------------------

// Where a viewer looks at first: around the middle of the bicycle.
static void put_statistic(FILE *out, double wheelbase) {
  fprintf(out, "  <statistic center=\"%.4g 0 %.4g\" extent=\"%.4g\"/>\n", wheelbase / 2,
          wheelbase / 2, 1.5 * wheelbase);
}

// A camera that stands still and turns after the bicycle, beside those that ride along.
static void put_camera(FILE *out, double wheelbase) {
  fprintf(out,
          "    <camera name=\"roadside\" mode=\"targetbody\" target=\"rear_frame\""
          " pos=\"%.4g %.4g %.4g\"/>\n",
          3 * wheelbase, -3 * wheelbase, 1.3 * wheelbase);
}

static void put_scene(FILE *out, const bike_bicycle *bicycle, double wheelbase,
                      const char *model_file) {
  fputs("<!-- Ground, light, sky and a camera for the bicycle of the file included. -->\n"
        "<mujoco model=\"",
        out);
  mjcf_put_escaped(out, bicycle->name);
  fputs(" scene\">\n  <include file=\"", out);
  mjcf_put_escaped(out, model_file);
  fputs("\"/>\n", out);
  put_statistic(out, wheelbase);
  mjcf_put_scene_assets(out);
  fputs("  <worldbody>\n", out);
  mjcf_put_scenery(out);
  mjcf_put_ground(out, true);
  put_camera(out, wheelbase);
  fputs("  </worldbody>\n</mujoco>\n", out);
}

char *mjcf_scene_text(const bike_bicycle *bicycle, const char *model_file, mjcf_error *error) {
  bike_upright upright;
  int code = bike_upright_position(&upright, &bicycle->geometry);
  if (code != BIKE_OK) return mjcf_fail(error, "%s", bike_error_string(code)), NULL;
  char *text = NULL;
  size_t size = 0;
  FILE *out = bike_memory_stream(&text, &size);
  if (!out) return mjcf_fail_memory(error), NULL;
  put_scene(out, bicycle, upright.wheelbase, model_file);
  return mjcf_end_text(out, &text, error);
}
