// SPDX-License-Identifier: Apache-2.0
// Where to look from.
#include "picture_internal.h"

#include <math.h>

static const double degree = mjPI / 180;

// Groups 0 to 2 are those that MuJoCo shows.
static bool is_shown(const mjModel *m, int geom) {
  bool moves = m->body_weldid[m->geom_bodyid[geom]] != 0;
  return moves && m->geom_group[geom] < 3 && m->geom_rbound[geom] > 0;
}

bool picture_has_shapes(const mjModel *m) {
  for (int i = 0; i < m->ngeom; i++)
    if (is_shown(m, i)) return true;
  return false;
}

// A ball that something fits in.
typedef struct ball {
  double centre[3], radius;
} ball;

// That of a geom, or of a body's box of inertia; false for one that is not to be seen.
static bool find_ball(ball *out, const mjModel *m, const mjData *d, int index, bool shapes) {
  if (shapes) {
    mju_copy3(out->centre, d->geom_xpos + 3 * index);
    out->radius = m->geom_rbound[index];
    return is_shown(m, index);
  }
  const double *moments = m->body_inertia + 3 * index;
  mju_copy3(out->centre, d->xipos + 3 * index);
  // r^2 = 3 (A + B + C)/(2 m) for the half diagonal of a box
  out->radius =
      sqrt(1.5 * (moments[0] + moments[1] + moments[2]) / fmax(m->body_mass[index], 1e-9));
  return m->body_weldid[index] != 0;
}

// The view's axes: to the right, up, and away from who looks, in the world.
typedef struct axes {
  double right[3], up[3], away[3];
} axes;

static axes find_axes(const mjvCamera *camera) {
  double a = camera->azimuth * degree, e = camera->elevation * degree;
  return (axes){{sin(a), -cos(a), 0},
                {-sin(e) * cos(a), -sin(e) * sin(a), cos(e)},
                {cos(e) * cos(a), cos(e) * sin(a), sin(e)}};
}

// Extents of all that is seen along the two axes of the picture and the third.
typedef struct extents {
  double low[3], high[3];
} extents;

static extents measure(const mjModel *m, const mjData *d, const axes *view) {
  const double *const axis[3] = {view->right, view->up, view->away};
  extents e = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
  bool shapes = picture_has_shapes(m);
  int count = shapes ? m->ngeom : m->nbody;
  ball b;
  for (int i = 0; i < count; i++) {
    if (!find_ball(&b, m, d, i, shapes)) continue;
    for (int k = 0; k < 3; k++) {
      double place = mju_dot3(axis[k], b.centre);
      e.low[k] = fmin(e.low[k], place - b.radius);
      e.high[k] = fmax(e.high[k], place + b.radius);
    }
  }
  return e;
}

// Direction of the x axis of the first body that moves: forward, in most models.
static double find_heading(const mjModel *m, const mjData *d) {
  for (int i = 1; i < m->nbody; i++)
    if (m->body_weldid[i]) return atan2(d->xmat[9 * i + 3], d->xmat[9 * i]) / degree;
  return 0;
}

void picture_frame(mjvCamera *camera, const mjModel *m, const mjData *d, picture_size size) {
  mjv_defaultCamera(camera);
  camera->type = mjCAMERA_FREE;
  camera->azimuth = find_heading(m, d) + 120;
  camera->elevation = -12;
  axes view = find_axes(camera);
  extents e = measure(m, d, &view);
  if (!(e.high[0] > e.low[0])) return; // nothing moves: MuJoCo's own view
  double middle[3], half[3];
  for (int k = 0; k < 3; k++)
    middle[k] = (e.low[k] + e.high[k]) / 2, half[k] = (e.high[k] - e.low[k]) / 2;
  mju_scl3(camera->lookat, view.right, middle[0]);
  mju_addToScl3(camera->lookat, view.up, middle[1]);
  mju_addToScl3(camera->lookat, view.away, middle[2]);
  // The near side must fit the angle of view, with a tenth to spare. Depth mostly leaves room that
  // is not needed at the corners: half of it is taken.
  double slope = tan(m->vis.global.fovy * degree / 2);
  double wide = half[0] * size.height / size.width;
  camera->distance = 1.1 * fmax(wide, half[1]) / slope + half[2] / 2;
}
