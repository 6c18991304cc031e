// SPDX-License-Identifier: Apache-2.0
// What a bicycle looks like. Nothing here weighs, touches or takes part in any equation: it is
// drawn around the lengths that do, so that any geometry is recognisable.
#include "bicycle_mjcf_internal.h"

#include <math.h>

// Where geoms of one body go. All points below are those of the upright bicycle (forward of the
// rear contact, left, up); the body's origin is taken off on the way out.
typedef struct pen {
  FILE *out;
  const mjcf_plan *plan;
  int body;
  int decimals; // of places, m
} pen;

// A tenth of a millimetre is enough for a bicycle to sit on; of a smaller one the 32 pieces of a
// tyre must still have two ends each.
static int find_decimals(const bike_geometry *g) {
  const double usual = 0.05; // m
  double radius = fmin(g->R_r, g->R_f);
  return radius >= usual ? 4 : 4 + (int)ceil(log10(usual / radius));
}

typedef struct point {
  double f, l, u;
} point;

static point on(double forward, double left, double up) {
  return (point){forward, left, up};
}

static point aside(point p, double left) {
  p.l += left;
  return p;
}

static point between(point a, point b, double share) {
  return (point){a.f + share * (b.f - a.f), a.l + share * (b.l - a.l), a.u + share * (b.u - a.u)};
}

static point at(const double position[3]) {
  return (point){position[0], position[1], position[2]};
}

// Point of the steering axis, `height` above the foot of the perpendicular from the front hub.
static point on_axis(const mjcf_plan *plan, double height) {
  const double *foot = plan->body[BIKE_FRONT_FRAME].origin, *axis = plan->axis;
  return on(foot[0] + height * axis[0], 0, foot[2] + height * axis[2]);
}

static void put_geom(const pen *p, const char *type, const char *material, double size0,
                     double size1) {
  mjcf_indent(p->out, p->body, 1);
  fprintf(p->out, "<geom class=\"%s\" type=\"%s\" material=\"%s\" size=\"%.4g",
          p->plan->apart ? "visual" : "shape", type, material, size0);
  if (size1 > 0) fprintf(p->out, " %.4g", size1);
  fputc('"', p->out);
}

static void put_segment(const pen *p, const char *type, point a, point b, double radius,
                        const char *material) {
  const double *o = p->plan->body[p->body].origin;
  put_geom(p, type, material, radius, 0);
  int n = p->decimals;
  fprintf(p->out, " fromto=\"%.*f %.*f %.*f %.*f %.*f %.*f\"/>\n", n, a.f - o[0], n, a.l - o[1], n,
          a.u - o[2], n, b.f - o[0], n, b.l - o[1], n, b.u - o[2]);
}

static void tube(const pen *p, point a, point b, double radius, const char *material) {
  put_segment(p, "capsule", a, b, radius, material);
}

// Two tubes side by side, `apart` at a and `apart_at_b` at b.
static void tube_pair(const pen *p, point a, point b, double apart, double apart_at_b,
                      double radius, const char *material) {
  tube(p, aside(a, apart / 2), aside(b, apart_at_b / 2), radius, material);
  tube(p, aside(a, -apart / 2), aside(b, -apart_at_b / 2), radius, material);
}

static void ball(const pen *p, point c, double radius, const char *material) {
  const double *o = p->plan->body[p->body].origin;
  put_geom(p, "sphere", material, radius, 0);
  int n = p->decimals;
  fprintf(p->out, " pos=\"%.*f %.*f %.*f\"/>\n", n, c.f - o[0], n, c.l - o[1], n, c.u - o[2]);
}

//---------------------------------- wheels --------------------------------------------------------

static point on_circle(point centre, double radius, double angle) {
  return on(centre.f + radius * cos(angle), centre.l, centre.u + radius * sin(angle));
}

// Tyre as a ring of capsules whose outside is the rolling radius, spokes in two planes, a hub.
static void draw_wheel(const pen *p, double radius) {
  enum { SEGMENTS = 32, SPOKES = 12 };
  const double turn = 2 * acos(-1.0), tyre = fmin(0.016, radius / 12);
  point hub = at(p->plan->body[p->body].origin);
  // The middle of each straight segment lies inside the circle by the factor cos(half its angle).
  double ring = (radius - tyre) / cos(turn / SEGMENTS / 2);
  for (int i = 0; i < SEGMENTS; i++)
    tube(p, on_circle(hub, ring, turn * i / SEGMENTS),
         on_circle(hub, ring, turn * (i + 1) / SEGMENTS), tyre, i == 0 ? "mark" : "rubber");
  for (int i = 0; i < SPOKES; i++) {
    double angle = turn * i / SPOKES, side = i % 2 ? 0.03 : -0.03;
    tube(p, aside(on_circle(hub, 0.025, angle), side), on_circle(hub, radius - 2 * tyre, angle),
         0.002, "metal");
  }
  put_segment(p, "cylinder", aside(hub, 0.05), aside(hub, -0.05), 0.022, "metal");
}

//---------------------------------- frames --------------------------------------------------------

// Points that every style of frame shares, all in the plane of symmetry.
typedef struct skeleton {
  double wheelbase;
  double R_r, R_f;
  point rear_hub, front_hub;
  point crown;     // on the steering axis, just clear of the front wheel
  point head;      // top of the head tube
  point bar;       // where the handlebar crosses
  point seat;      // top of the saddle
  point crank;     // bottom bracket
  bool high_wheel; // penny-farthing: cranks on the front hub, a backbone around the wheel
  bool recumbent;  // the rider lies low, feet forward
} skeleton;

static const bike_part *find_rider(const bike_bicycle *bicycle) {
  for (int i = 0; i < bicycle->part_count; i++)
    if (bicycle->parts[i].rider) return &bicycle->parts[i];
  return NULL;
}

static skeleton find_skeleton(const mjcf_plan *plan) {
  const bike_geometry *g = &plan->bicycle->geometry;
  const bike_part *rider = find_rider(plan->bicycle);
  skeleton s = {.wheelbase = plan->upright.wheelbase, .R_r = g->R_r, .R_f = g->R_f};
  s.rear_hub = at(plan->body[BIKE_REAR_WHEEL].origin);
  s.front_hub = at(plan->body[BIKE_FRONT_WHEEL].origin);
  s.high_wheel = g->R_f > 1.5 * g->R_r;
  s.recumbent = !s.high_wheel && s.wheelbase > 1.4;
  double clear = sqrt(fmax(0, g->R_f * g->R_f - g->L_f * g->L_f)) + 0.045;
  s.crown = on_axis(plan, clear);
  s.head = on_axis(plan, clear + (s.high_wheel ? 0.06 : 0.15));
  s.bar = on_axis(plan, clear + (s.high_wheel ? 0.10 : s.recumbent ? 0.42 : 0.24));
  if (s.high_wheel) {
    s.crank = s.front_hub;
    s.seat = on(s.head.f - 0.24, 0, s.head.u + 0.02);
  } else if (s.recumbent) {
    s.crank = on(s.front_hub.f - s.R_f - 0.20, 0, s.R_f + 0.17);
    s.seat = on(fmax(s.R_r + 0.12, 0.40 * s.wheelbase - 0.06), 0, 0.50);
  } else {
    s.crank = on(fmin(s.R_r + 0.10, 0.45 * s.wheelbase), 0, 0.28);
    s.seat = on(s.crank.f - 0.19, 0, 0.90);
  }
  // The centre of mass of somebody who sits is a hand's breadth before and above the saddle.
  if (rider && !s.high_wheel && !s.recumbent) {
    s.seat.f = rider->position[0] - 0.10;
    s.seat.u = rider->position[2] - 0.22;
  }
  return s;
}

static void draw_saddle(const pen *p, point seat) {
  tube(p, aside(on(seat.f - 0.09, 0, seat.u), 0.05), on(seat.f + 0.13, 0, seat.u), 0.022, "saddle");
  tube(p, aside(on(seat.f - 0.09, 0, seat.u), -0.05), on(seat.f + 0.13, 0, seat.u), 0.022,
       "saddle");
}

static void draw_cranks(const pen *p, point c) {
  put_segment(p, "cylinder", aside(c, -0.045), aside(c, -0.055), 0.09, "metal");
  tube(p, aside(c, 0.06), aside(c, -0.06), 0.018, "metal");
  tube(p, aside(c, -0.075), on(c.f + 0.16, -0.075, c.u - 0.05), 0.010, "metal");
  tube(p, aside(c, 0.075), on(c.f - 0.16, 0.075, c.u + 0.05), 0.010, "metal");
  tube(p, on(c.f + 0.16, -0.08, c.u - 0.05), on(c.f + 0.16, -0.16, c.u - 0.05), 0.013, "rubber");
  tube(p, on(c.f - 0.16, 0.08, c.u + 0.05), on(c.f - 0.16, 0.16, c.u + 0.05), 0.013, "rubber");
}

static void draw_diamond(const pen *p, const skeleton *s) {
  point low = between(s->crown, s->head, 0.15), high = between(s->crown, s->head, 0.85);
  point post = between(s->crank, s->seat, 0.80);
  tube(p, s->crown, s->head, 0.022, "frame");
  tube(p, post, high, 0.015, "frame");
  tube(p, s->crank, low, 0.019, "frame");
  tube(p, s->crank, post, 0.016, "frame");
  tube(p, post, s->seat, 0.013, "metal");
  tube_pair(p, s->rear_hub, s->crank, 0.10, 0.05, 0.009, "frame");
  tube_pair(p, s->rear_hub, post, 0.10, 0.03, 0.008, "frame");
  draw_cranks(p, s->crank);
}

// A long tube from the rear wheel under the seat to the head; the back rest behind it.
static void draw_recumbent(const pen *p, const skeleton *s) {
  point under = on(s->seat.f + 0.10, 0, s->seat.u - 0.12);
  point back = on(s->seat.f - 0.30, 0, s->seat.u + 0.48);
  tube(p, s->crown, s->head, 0.022, "frame");
  tube(p, under, between(s->crown, s->head, 0.3), 0.024, "frame");
  tube(p, between(under, s->crown, 0.5), s->crank, 0.018, "frame");
  tube_pair(p, s->rear_hub, under, 0.10, 0.03, 0.012, "frame");
  tube_pair(p, s->rear_hub, between(s->seat, back, 0.7), 0.10, 0.10, 0.009, "frame");
  for (int i = -1; i <= 1; i++) {
    tube(p, on(s->seat.f + 0.26, 0.1 * i, s->seat.u + 0.03), on(s->seat.f, 0.1 * i, s->seat.u),
         0.035, "saddle");
    tube(p, on(s->seat.f, 0.1 * i, s->seat.u), aside(back, 0.1 * i), 0.035, "saddle");
  }
  draw_cranks(p, s->crank);
}

// A backbone that follows the high wheel from the head to the small one.
static void draw_backbone(const pen *p, const skeleton *s) {
  enum { SEGMENTS = 10 };
  double first = atan2(s->head.u - s->front_hub.u, s->head.f - s->front_hub.f);
  double last = atan2(s->rear_hub.u + 0.04 - s->front_hub.u, s->rear_hub.f - s->front_hub.f);
  if (last < first) last += 2 * acos(-1.0);
  double start = hypot(s->head.u - s->front_hub.u, s->head.f - s->front_hub.f);
  double near = s->R_f + 0.06;
  // Round the wheel as far as the small wheel's rim, then straight to its hub.
  double leave = first + 0.62 * (last - first);
  point from = s->head;
  for (int i = 1; i <= SEGMENTS; i++) {
    double share = (double)i / SEGMENTS;
    double radius = near + (start - near) * (1 - share) * (1 - share);
    point to = on_circle(s->front_hub, radius, first + share * (leave - first));
    tube(p, from, to, 0.020 - 0.006 * share, "frame");
    from = to;
  }
  point fork = between(from, s->rear_hub, 0.25);
  tube(p, from, fork, 0.014, "frame");
  tube_pair(p, fork, s->rear_hub, 0.02, 0.07, 0.010, "frame");
  tube(p, s->crown, s->head, 0.024, "frame");
  tube(p, s->head, s->seat, 0.010, "metal");
}

//---------------------------------- rider ---------------------------------------------------------

// A leg from the hip over a knee, which is bent forwards, to the foot.
static void draw_leg(const pen *p, point hip, point foot, double bend_f, double bend_u) {
  point knee = between(hip, foot, 0.5);
  knee.f += bend_f, knee.u += bend_u;
  tube(p, hip, knee, 0.065, "trousers");
  tube(p, knee, foot, 0.045, "trousers");
  tube(p, foot, on(foot.f + 0.14, foot.l, foot.u + 0.01), 0.035, "rubber");
}

static void draw_rider(const pen *p, const skeleton *s, double left) {
  point hip = on(s->seat.f + (s->recumbent ? 0.08 : 0), left, s->seat.u + 0.10);
  double back_f = s->recumbent ? -0.24 : s->high_wheel ? 0.10 : 0.26;
  point shoulder = on(hip.f + back_f, left, hip.u + (s->recumbent ? 0.42 : 0.47));
  point head = on(shoulder.f + (s->recumbent ? 0.02 : 0.07), left, shoulder.u + 0.23);
  point c = s->crank;
  tube(p, hip, shoulder, 0.12, "shirt");
  tube(p, aside(shoulder, 0.14), aside(shoulder, -0.14), 0.06, "shirt");
  ball(p, head, 0.10, "skin");
  for (int side = -1; side <= 1; side += 2) {
    point hand = on(s->bar.f - 0.10, 0.24 * side, s->bar.u + 0.05);
    point arm = aside(shoulder, 0.18 * side);
    point elbow = between(arm, hand, 0.5);
    elbow.u -= 0.07;
    tube(p, arm, elbow, 0.040, "shirt");
    tube(p, elbow, hand, 0.032, "skin");
    point foot = on(c.f - 0.16 * side, 0.12 * side, c.u + 0.05 * side + 0.05);
    draw_leg(p, aside(hip, 0.09 * side), foot, s->recumbent ? 0.02 : 0.16,
             s->recumbent ? 0.16 : 0.08);
  }
}

static void draw_rider_of(const pen *p, const skeleton *s) {
  const bike_part *rider = find_rider(p->plan->bicycle);
  draw_rider(p, s, rider->position[1] - p->plan->options->rider_offset);
}

static void draw_rear_frame(const pen *p, const skeleton *s) {
  const bike_part *rider = find_rider(p->plan->bicycle);
  if (s->high_wheel)
    draw_backbone(p, s);
  else if (s->recumbent)
    draw_recumbent(p, s);
  else
    draw_diamond(p, s);
  if (!s->recumbent) draw_saddle(p, s->seat);
  if (rider && !p->plan->options->moving_rider) draw_rider_of(p, s);
}

// Fork, stem and a handlebar that reaches back to the rider's hands.
static void draw_front_frame(const pen *p, const skeleton *s) {
  double half = 0.26, axle = s->high_wheel ? 0.14 : 0.11;
  tube_pair(p, s->front_hub, s->crown, axle, axle, s->high_wheel ? 0.014 : 0.011, "fork");
  tube(p, aside(s->crown, axle / 2), aside(s->crown, -axle / 2), 0.016, "fork");
  tube(p, s->crown, s->bar, 0.014, "metal");
  tube(p, aside(s->bar, half), aside(s->bar, -half), 0.012, "metal");
  for (int side = -1; side <= 1; side += 2)
    tube(p, aside(s->bar, half * side), on(s->bar.f - 0.12, (half + 0.02) * side, s->bar.u + 0.01),
         0.016, "rubber");
  if (s->high_wheel) draw_cranks(p, s->front_hub);
}

void mjcf_put_shape(FILE *out, const mjcf_plan *plan, int body) {
  const pen p = {out, plan, body, find_decimals(&plan->bicycle->geometry)};
  skeleton s = find_skeleton(plan);
  switch (body) {
  case BIKE_REAR_FRAME:
    draw_rear_frame(&p, &s);
    break;
  case BIKE_FRONT_FRAME:
    draw_front_frame(&p, &s);
    break;
  case BIKE_REAR_WHEEL:
    draw_wheel(&p, s.R_r);
    break;
  case BIKE_FRONT_WHEEL:
    draw_wheel(&p, s.R_f);
    break;
  case MJCF_RIDER:
    draw_rider_of(&p, &s);
    break;
  }
}
