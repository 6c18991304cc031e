// SPDX-License-Identifier: Apache-2.0
// Colour and light for models whose makers did not think of pictures: grey on grey otherwise.
#include "picture_internal.h"

#include <string.h>

// MuJoCo's default colour, which is nobody's choice.
static bool is_unpainted(const mjModel *m, int geom) {
  static const float grey[4] = {0.5F, 0.5F, 0.5F, 1};
  return m->geom_matid[geom] < 0 && memcmp(m->geom_rgba + 4 * geom, grey, sizeof grey) == 0;
}

// What stands still is stone; bodies that move differ from their neighbours.
static void paint(mjModel *m) {
  static const float stone[4] = {0.66F, 0.68F, 0.66F, 1};
  static const float paints[4][4] = {{0.10F, 0.42F, 0.40F, 1},
                                     {0.80F, 0.33F, 0.22F, 1},
                                     {0.90F, 0.68F, 0.20F, 1},
                                     {0.25F, 0.35F, 0.60F, 1}};
  for (int i = 0; i < m->ngeom; i++) {
    int body = m->geom_bodyid[i];
    bool moves = m->body_weldid[body] != 0;
    const float *colour = moves ? paints[(body - 1) % 4] : stone;
    if (is_unpainted(m, i)) memcpy(m->geom_rgba + 4 * i, colour, sizeof stone);
  }
}

void picture_prepare_look(mjModel *m) {
  m->vis.quality.numslices = 96;
  m->vis.quality.numstacks = 48;
  paint(m);
  if (m->nlight > 0) return;
  for (int k = 0; k < 3; k++) {
    m->vis.headlight.ambient[k] = 0.35F;
    m->vis.headlight.diffuse[k] = 0.25F;
  }
}

static void add_sun(mjvScene *scene) {
  if (scene->nlight >= mjMAXLIGHT) return;
  scene->lights[scene->nlight++] = (mjvLight){.dir = {0.30F, 0.40F, -0.87F},
                                              .attenuation = {1, 0, 0},
                                              .diffuse = {0.55F, 0.55F, 0.53F},
                                              .specular = {0.3F, 0.3F, 0.3F},
                                              .directional = 1,
                                              .castshadow = 1};
}

void picture_light(mjvScene *scene, const mjModel *m, const double centre[3]) {
  if (m->nlight == 0) add_sun(scene);
  for (int i = 0; i < scene->nlight; i++) {
    mjvLight *light = &scene->lights[i];
    if (!light->directional || light->headlight) continue;
    for (int k = 0; k < 3; k++)
      light->pos[k] = (float)(centre[k] - m->stat.extent * (double)light->dir[k]);
  }
}
