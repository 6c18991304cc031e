// SPDX-License-Identifier: Apache-2.0
// Colours, light, ground and cameras of a generated model.
#include "bicycle_mjcf_internal.h"

static const char look[] = "  <visual>\n"
                           "    <global offwidth=\"1280\" offheight=\"800\"/>\n"
                           "    <quality shadowsize=\"4096\"/>\n"
                           "    <map znear=\"0.02\" zfar=\"60\"/>\n"
                           "  </visual>\n";

static const char shape_class[] =
    "  <statistic center=\"0.5 0 0.6\" extent=\"1.6\"/>\n"
    "  <default>\n"
    "    <default class=\"shape\">\n"
    "      <geom contype=\"0\" conaffinity=\"0\" mass=\"0\" group=\"1\"/>\n"
    "    </default>\n"
    "  </default>\n";

static const char asset[] = "  <asset>\n";

static const char surroundings[] =
    "    <texture name=\"sky\" type=\"skybox\" builtin=\"gradient\" rgb1=\"0.62 0.76 0.90\""
    " rgb2=\"0.95 0.97 1\" width=\"256\" height=\"256\"/>\n"
    "    <texture name=\"ground\" type=\"2d\" builtin=\"checker\" rgb1=\"0.56 0.58 0.57\""
    " rgb2=\"0.50 0.52 0.51\" width=\"256\" height=\"256\"/>\n"
    "    <material name=\"ground\" texture=\"ground\" texrepeat=\"1 1\" texuniform=\"true\"/>\n";

static const char materials[] =
    "    <material name=\"frame\" rgba=\"0.10 0.36 0.33 1\" specular=\"0.8\" shininess=\"0.8\"/>\n"
    "    <material name=\"fork\" rgba=\"0.10 0.36 0.33 1\" specular=\"0.8\" shininess=\"0.8\"/>\n"
    "    <material name=\"metal\" rgba=\"0.75 0.76 0.78 1\" specular=\"0.9\" shininess=\"0.9\"/>\n"
    "    <material name=\"rubber\" rgba=\"0.09 0.09 0.10 1\" specular=\"0.1\"/>\n"
    "    <material name=\"mark\" rgba=\"0.95 0.75 0.10 1\"/>\n"
    "    <material name=\"saddle\" rgba=\"0.42 0.25 0.13 1\"/>\n"
    "    <material name=\"shirt\" rgba=\"0.80 0.33 0.22 1\"/>\n"
    "    <material name=\"trousers\" rgba=\"0.20 0.25 0.38 1\"/>\n"
    "    <material name=\"skin\" rgba=\"0.87 0.68 0.56 1\"/>\n";

static const char end_asset[] = "  </asset>\n";

// Cameras follow the bicycle's centre of mass without turning with it, so that lean is seen.
static const char scenery[] =
    "    <light name=\"sun\" directional=\"true\" pos=\"0 -3 6\" dir=\"0.3 0.4 -0.9\""
    " diffuse=\"0.75 0.75 0.72\" specular=\"0.3 0.3 0.3\"/>\n"
    "    <light name=\"sky\" directional=\"true\" pos=\"0 0 6\" dir=\"-0.3 -0.3 -1\""
    " castshadow=\"false\" diffuse=\"0.35 0.37 0.40\"/>\n";

static const char cameras[] = "      <camera name=\"side\" mode=\"trackcom\" pos=\"0.5 -3.7 1.0\" "
                              "xyaxes=\"1 0 0 0 0.05 1\"/>\n"
                              "      <camera name=\"behind\" mode=\"trackcom\" pos=\"-3 -1.4 1.4\""
                              " xyaxes=\"0.42 -0.91 0 0.18 0.08 0.98\"/>\n";

static void put_all(FILE *out, const char *const *texts, int count) {
  for (int i = 0; i < count; i++) fputs(texts[i], out);
}

void mjcf_put_assets(FILE *out) {
  put_all(out, (const char *[]){look, shape_class, asset, surroundings, materials, end_asset}, 6);
}

void mjcf_put_materials(FILE *out) {
  put_all(out, (const char *[]){asset, materials, end_asset}, 3);
}

void mjcf_put_scene_assets(FILE *out) {
  put_all(out, (const char *[]){look, asset, surroundings, end_asset}, 4);
}

void mjcf_put_scenery(FILE *out) {
  fputs(scenery, out);
}

void mjcf_put_cameras(FILE *out) {
  fputs(cameras, out);
}
