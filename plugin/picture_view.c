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

// How far all that is seen reaches in the picture, as shares of half its height.
typedef struct reach {
  double low[2], high[2]; // to the right, up
} reach;

static reach project(const mjModel *m, const mjData *d, const mjvCamera *camera, double slope) {
  axes view = find_axes(camera);
  const double *const axis[2] = {view.right, view.up};
  reach out = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
  bool shapes = picture_has_shapes(m);
  int count = shapes ? m->ngeom : m->nbody;
  ball b;
  for (int i = 0; i < count; i++) {
    if (!find_ball(&b, m, d, i, shapes)) continue;
    double from[3];
    mju_sub3(from, b.centre, camera->lookat);
    // What comes too near to be seen whole is seen from further away in the next turn.
    double depth = fmax(camera->distance + mju_dot3(view.away, from), 2 * b.radius) * slope;
    // Rays at the edge touch a ball somewhat before its centre.
    double radius = b.radius * hypot(1, slope);
    for (int k = 0; k < 2; k++) {
      double place = mju_dot3(axis[k], from);
      out.low[k] = fmin(out.low[k], (place - radius) / depth);
      out.high[k] = fmax(out.high[k], (place + radius) / depth);
    }
  }
  return out;
}

// One turn: to the middle of what is seen, and so far away that it fills nine tenths.
static void improve(mjvCamera *camera, const reach *r, double slope, double aspect) {
  static const double filled = 0.9;
  axes view = find_axes(camera);
  const double *const axis[2] = {view.right, view.up};
  for (int k = 0; k < 2; k++)
    mju_addToScl3(camera->lookat, axis[k], (r->low[k] + r->high[k]) / 2 * slope * camera->distance);
  double wide = (r->high[0] - r->low[0]) / 2 / aspect, high = (r->high[1] - r->low[1]) / 2;
  camera->distance *= fmax(wide, high) / filled;
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
  mju_copy3(camera->lookat, d->subtree_com);
  camera->distance = 3 * m->stat.extent;
  double slope = tan(m->vis.global.fovy * degree / 2), aspect = (double)size.width / size.height;
  enum { TURNS = 20 }; // each leaves less than half of what was wrong
  for (int i = 0; i < TURNS; i++) {
    reach r = project(m, d, camera, slope);
    if (!(r.high[0] > r.low[0])) return; // nothing moves: MuJoCo's own view
    improve(camera, &r, slope, aspect);
  }
}
