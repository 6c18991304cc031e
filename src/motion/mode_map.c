// SPDX-License-Identifier: Apache-2.0
#include "motion/mode_map.h"

#include <bicycle/error.h>
#include <float.h>
#include <math.h>
#include <string.h>

#include "motion/mode_pairs.h"
#include "motion/upright_polynomial.h"

enum { SIZE = 4 };

typedef struct maker {
  const bike_model *model;
  double range; // m/s: up to here people ride such a bicycle
  mode_map *map;
  int zero_count; // speeds at which a real eigenvalue crosses zero
  double zeros[POLYNOMIAL_DEGREE];
  int weave_count; // speeds at which a pair passes the imaginary axis
  double weave[BIKE_MAX_CRITICAL];
  int segment_count;
  bool capsize_decays[MODE_COLLISIONS + 1]; // [segment], where it begins
  int end_segment[BIKE_MAX_NAME_ENDS];      // of the names that end
} maker;

static int upright_modes_at(bike_modes *out, const bike_model *model, double speed) {
  bike_linear linear;
  bike_state straight = {.speed = speed};
  int code = bike_linearize(&linear, model, &straight, NULL);
  return code ? code : bike_modes_of(out, linear.A);
}

static bool is_real(const bike_eigenvalues *e, int k) {
  return e->im[k] == 0;
}

static int count_real(const bike_eigenvalues *e) {
  int count = 0;
  for (int k = 0; k < SIZE; k++) count += is_real(e, k);
  return count;
}

// 27 times the discriminant of the quartic: 4 D0^3 - D1^2, D0 = c^2 - 3 b d + 12 a e,
// D1 = 2 c^3 - 9 b c d + 27 b^2 e + 27 a d^2 - 72 a c e, with a to e from the highest power down.
static polynomial discriminant(const polynomial p[5]) {
  const polynomial a = p[4], b = p[3], c = p[2], d = p[1], e = p[0];
  const polynomial cc = polynomial_product(c, c), bd = polynomial_product(b, d),
                   ae = polynomial_product(a, e), bb = polynomial_product(b, b),
                   dd = polynomial_product(d, d);
  polynomial d0 = {.degree = 4}, d1 = {.degree = 6}, out = {.degree = 12};
  polynomial_accumulate(&d0, cc, 1);
  polynomial_accumulate(&d0, bd, -3);
  polynomial_accumulate(&d0, ae, 12);
  polynomial_accumulate(&d1, polynomial_product(cc, c), 2);
  polynomial_accumulate(&d1, polynomial_product(bd, c), -9);
  polynomial_accumulate(&d1, polynomial_product(bb, e), 27);
  polynomial_accumulate(&d1, polynomial_product(dd, a), 27);
  polynomial_accumulate(&d1, polynomial_product(ae, c), -72);
  polynomial_accumulate(&out, polynomial_product(polynomial_product(d0, d0), d0), 4);
  polynomial_accumulate(&out, polynomial_product(d1, d1), -1);
  // unlike eigenvalues make the two differ little: only what long double cannot tell is nothing
  return polynomial_cleaned(out, LDBL_EPSILON);
}

// A speed within an interval: the middle, or well beyond the outermost collision.
static double inside(const maker *m, int i) {
  const mode_map *map = m->map;
  const int last = map->count - 1;
  if (map->count == 0) return m->range;
  if (i == 0) return map->at[0] - fmax(fabs(map->at[0]), m->range);
  if (i > last) return map->at[last] + fmax(fabs(map->at[last]), m->range);
  return 0.5 * (map->at[i - 1] + map->at[i]);
}

static int interval_of(const mode_map *map, double speed) {
  int i = 0;
  while (i < map->count && speed > map->at[i]) i++;
  return i;
}

// ---- collisions, and where eigenvalues are real between them ----

// Collisions, but those beyond any speed of meaning.
static int find_speeds(maker *m, const polynomial a[5]) {
  const double farthest = 1e4 * m->range;
  double roots[POLYNOMIAL_DEGREE];
  polynomial d = discriminant(a);
  int count, code = polynomial_real_roots(roots, &count, &d);
  for (int i = 0; i < count && !code; i++)
    if (fabs(roots[i]) <= farthest) m->map->at[m->map->count++] = roots[i];
  return code;
}

static int find_collisions(maker *m) {
  polynomial a[5];
  int code = upright_polynomial(a, m->model);
  if (code) return code;
  code = find_speeds(m, a);
  // where a0 vanishes at every speed, one eigenvalue is always zero and another passes it at a1 = 0
  if (!code)
    code = polynomial_real_roots(m->zeros, &m->zero_count, polynomial_vanishes(a) ? a + 1 : a);
  bike_critical_speeds critical = {0};
  if (!code) code = bike_upright_critical_speeds(&critical, m->model, 0, m->range);
  m->weave_count = critical.weave_count;
  memcpy(m->weave, critical.weave, sizeof m->weave);
  for (int i = 0; i <= m->map->count && !code; i++) {
    bike_eigenvalues e;
    code = bike_upright_eigenvalues(&e, m->model, inside(m, i));
    if (!code) m->map->between[i].real_count = count_real(&e);
  }
  return code;
}

// ---- the interval in which modes name themselves ----

// How much an interval with one oscillation looks like what is called weave.
typedef struct likeness {
  bool within;    // some of it lies where people ride
  bool passes;    // there it passes from growth to decay or back
  bool lags;      // and steer follows lean
  double fastest; // 1/s
} likeness;

static bool is_better(likeness a, likeness b) {
  if (a.within != b.within) return a.within;
  if (a.passes != b.passes) return a.passes;
  if (a.lags != b.lags) return a.lags;
  return a.fastest > b.fastest;
}

// At one speed. Steer to the side of the lean is negative.
static int look(likeness *out, const maker *m, double speed) {
  bike_modes modes;
  int code = upright_modes_at(&modes, m->model, speed);
  if (code) return code;
  *out = (likeness){.within = speed <= m->range};
  for (int k = 0; k < SIZE; k++) {
    if (!(modes.values.im[k] > out->fastest)) continue;
    const double *re = modes.vectors_re[k], *im = modes.vectors_im[k];
    out->fastest = modes.values.im[k];
    out->lags = re[1] * im[0] - im[1] * re[0] > 0; // of steer over lean, the imaginary part
  }
  return BIKE_OK;
}

// The best of some speeds in the part of the interval that lies where people ride, or beyond.
static int look_into(likeness *out, const maker *m, int i) {
  enum { LOOKS = 8 };
  const mode_map *map = m->map;
  double low = i > 0 ? fmax(0, map->at[i - 1]) : 0, high = i < map->count ? map->at[i] : INFINITY;
  high = low < m->range ? fmin(high, m->range) : fmin(high, 2 * low);
  *out = (likeness){0};
  for (int k = 0; k < LOOKS; k++) {
    likeness here;
    int code = look(&here, m, low + (high - low) * (k + 0.5) / LOOKS);
    if (code) return code;
    if (is_better(here, *out)) *out = here;
  }
  for (int k = 0; k < m->weave_count; k++) out->passes |= interval_of(map, m->weave[k]) == i;
  return BIKE_OK;
}

// -1: none.
static int find_anchor(int *out, const maker *m) {
  likeness best = {0};
  *out = -1;
  for (int i = 0; i <= m->map->count; i++) {
    likeness found;
    bool forwards = i == m->map->count || m->map->at[i] > 0;
    if (!forwards || m->map->between[i].real_count != 2) continue;
    int code = look_into(&found, m, i);
    if (code) return code;
    if (!is_better(found, best)) continue;
    best = found;
    *out = i;
  }
  return BIKE_OK;
}

// ---- intervals named from there on ----

static void end_names(maker *m, double speed, int segment, bike_mode a, bike_mode b) {
  if (m->map->end_count == BIKE_MAX_NAME_ENDS) return;
  m->end_segment[m->map->end_count] = segment;
  m->map->ends[m->map->end_count++] = (bike_name_end){speed, {a, b}};
}

// What two modes are called where they become one pair. `tells`: the two others tell which pair is
// weave.
static bike_mode joined(maker *m, double speed, int segment, bike_mode a, bike_mode b, bool tells) {
  if (a == b) return a;
  bool slow_and_fast = (a == BIKE_MODE_CAPSIZE && b == BIKE_MODE_CASTERING) ||
                       (a == BIKE_MODE_CASTERING && b == BIKE_MODE_CAPSIZE);
  if (slow_and_fast && tells) return BIKE_MODE_JOINED;
  end_names(m, speed, segment, a, b);
  return BIKE_MODE_UNNAMED;
}

// Weave is two modes: what is left of one of them is none.
static void end_weave(mode_interval *interval) {
  for (int k = 0; k < SIZE; k++)
    if (interval->real[k] == BIKE_MODE_WEAVE) interval->real[k] = BIKE_MODE_UNNAMED;
}

// Real eigenvalues that are above the collision and no part of it.
static int count_above(const mode_cluster *c) {
  int count = 0;
  for (int k = 0; k < 2; k++)
    count += cimag(c->others[k]) == 0 && creal(c->others[k]) > creal(c->centre);
  return count;
}

// Two real eigenvalues of `from` become a pair of `to`.
static void join(maker *m, mode_interval *to, const mode_interval *from, const mode_cluster *c,
                 double speed) {
  int first = count_above(c), count = 0;
  for (int k = 0; k < from->real_count; k++)
    if (k != first && k != first + 1) to->real[count++] = from->real[k];
  // two real modes that decay beside one oscillation look like capsize and castering
  bool decay = to->real_count == 2 && creal(c->others[0]) < 0 && creal(c->others[1]) < 0;
  to->pair[0] = joined(m, speed, from->segment, from->real[first], from->real[first + 1],
                       speed < 0 || !decay);
  to->pair[1] = from->pair[0];
  to->entry = speed;
  if (to->pair[0] == BIKE_MODE_UNNAMED) end_weave(to);
}

// Names two real eigenvalues, given by their places among those of an interval, until it is known
// which passes zero: castering is the lower one; of two that grow capsize is the slower one.
static int begin_segment(maker *m, int i, int first, int second) {
  mode_interval *interval = &m->map->between[i];
  bike_eigenvalues e;
  int code = bike_upright_eigenvalues(&e, m->model, inside(m, i)), count = 0;
  double real[SIZE] = {0};
  if (code) return code;
  for (int k = 0; k < SIZE; k++)
    if (is_real(&e, k)) real[count++] = e.re[k];
  bool both_grow = real[second] > 0;
  interval->real[first] = both_grow ? BIKE_MODE_CASTERING : BIKE_MODE_CAPSIZE;
  interval->real[second] = both_grow ? BIKE_MODE_CAPSIZE : BIKE_MODE_CASTERING;
  m->capsize_decays[m->segment_count] = real[both_grow ? second : first] < 0;
  interval->segment = m->segment_count++;
  return BIKE_OK;
}

// A pair of `from` becomes two real eigenvalues of interval i.
static int part(maker *m, int i, const mode_interval *from, const mode_cluster *c, double speed) {
  mode_interval *to = &m->map->between[i];
  int first = count_above(c), count = 0, parting = 0;
  if (from->real_count == 0) {
    double complex followed;
    int code = mode_pair_follow(&followed, m->model, from->entry, speed);
    if (code == BIKE_ERROR_NO_CONVERGENCE) {
      // not told apart: neither goes on
      end_names(m, speed, from->segment, from->pair[0], from->pair[1]);
      memset(to->real, 0, sizeof to->real);
      to->pair[0] = BIKE_MODE_UNNAMED;
      return BIKE_OK;
    }
    if (code) return code;
    parting = cabs(followed - c->centre) < cabs(followed - c->others[0]) ? 0 : 1;
  }
  for (int k = 0; k < to->real_count; k++) {
    bool new = k == first || k == first + 1;
    to->real[k] = new ? from->pair[parting] : from->real[count++];
  }
  to->pair[0] = from->pair[1 - parting];
  return from->pair[parting] == BIKE_MODE_JOINED ? begin_segment(m, i, first, first + 1) : BIKE_OK;
}

// The name of the real eigenvalue that passes zero at a speed.
static int passing(bike_mode *out, const maker *m, const mode_interval *interval, double speed) {
  bike_eigenvalues e;
  double least = INFINITY;
  int code = bike_upright_eigenvalues(&e, m->model, speed), place = 0;
  for (int k = 0; k < SIZE && !code; k++) {
    if (!is_real(&e, k)) continue;
    if (fabs(e.re[k]) < least) *out = interval->real[place];
    least = fmin(least, fabs(e.re[k]));
    place++;
  }
  return code;
}

// What passes zero forwards is no part of weave: its name ends at the collision before.
static int check_weave(maker *m, int i, double speed) {
  mode_interval *interval = &m->map->between[i];
  for (int z = 0; z < m->zero_count; z++) {
    bike_mode mode = BIKE_MODE_UNNAMED;
    if (m->zeros[z] < 0 || interval_of(m->map, m->zeros[z]) != i) continue;
    int code = passing(&mode, m, interval, m->zeros[z]);
    if (code) return code;
    if (mode != BIKE_MODE_WEAVE) continue;
    end_names(m, speed, interval->segment, BIKE_MODE_WEAVE, BIKE_MODE_WEAVE);
    end_weave(interval);
  }
  return BIKE_OK;
}

// Names interval `to` from its neighbour.
static int carry(maker *m, int from, int to) {
  const double speed = m->map->at[from < to ? from : to];
  const mode_interval *old = &m->map->between[from];
  mode_interval *new = &m->map->between[to];
  bike_eigenvalues e;
  int code = bike_upright_eigenvalues(&e, m->model, speed);
  if (code) return code;
  mode_cluster c = mode_cluster_of(&e);
  new->segment = old->segment;
  if (new->real_count == old->real_count)
    *new = *old; // a double root that changes nothing
  else if (new->real_count < old->real_count)
    join(m, new, old, &c, speed);
  else
    code = part(m, to, old, &c, speed);
  return code ? code : check_weave(m, to, speed);
}

// Gives capsize and castering of a segment other names.
static void rename_in(maker *m, int segment, bike_mode capsize, bike_mode castering) {
  const bike_mode names[] = {[BIKE_MODE_UNNAMED] = BIKE_MODE_UNNAMED,
                             [BIKE_MODE_WEAVE] = BIKE_MODE_WEAVE,
                             [BIKE_MODE_CAPSIZE] = capsize,
                             [BIKE_MODE_CASTERING] = castering,
                             [BIKE_MODE_JOINED] = BIKE_MODE_JOINED};
  mode_map *map = m->map;
  for (int i = 0; i <= map->count; i++)
    for (int k = 0; k < SIZE; k++)
      if (map->between[i].segment == segment)
        map->between[i].real[k] = names[map->between[i].real[k]];
  for (int i = 0; i < map->end_count; i++)
    for (int k = 0; k < 2; k++)
      if (m->end_segment[i] == segment) map->ends[i].modes[k] = names[map->ends[i].modes[k]];
}

// Capsize is what passes zero forwards: the two names are exchanged where that leaves castering
// decaying, and where it does not, castering is none.
static int settle(maker *m) {
  double passes[MODE_COLLISIONS + 1][BIKE_MODE_JOINED + 1] = {{0}}; // at which speed, 0: none
  for (int z = 0; z < m->zero_count; z++) {
    const mode_interval *interval = &m->map->between[interval_of(m->map, m->zeros[z])];
    bike_mode mode = BIKE_MODE_UNNAMED;
    if (m->zeros[z] < 0) continue;
    int code = passing(&mode, m, interval, m->zeros[z]);
    if (code) return code;
    passes[interval->segment][mode] = m->zeros[z];
  }
  for (int s = 0; s < m->segment_count; s++) {
    if (passes[s][BIKE_MODE_CASTERING] == 0) continue;
    if (passes[s][BIKE_MODE_CAPSIZE] == 0 && m->capsize_decays[s]) {
      rename_in(m, s, BIKE_MODE_CASTERING, BIKE_MODE_CAPSIZE);
    } else {
      rename_in(m, s, BIKE_MODE_CAPSIZE, BIKE_MODE_UNNAMED);
      end_names(m, passes[s][BIKE_MODE_CASTERING], s, BIKE_MODE_CASTERING, BIKE_MODE_CASTERING);
    }
  }
  return BIKE_OK;
}

static int name_intervals(maker *m) {
  int anchor;
  int code = find_anchor(&anchor, m);
  if (code || anchor < 0) return code;
  m->map->between[anchor].pair[0] = BIKE_MODE_WEAVE;
  code = begin_segment(m, anchor, 0, 1);
  for (int i = anchor; i < m->map->count && !code; i++) code = carry(m, i, i + 1);
  for (int i = anchor; i > 0 && !code; i--) code = carry(m, i, i - 1);
  return code ? code : settle(m);
}

int mode_map_init(mode_map *out, const bike_model *model) {
  *out = (mode_map){0};
  maker m = {.model = model, .range = bike_search_end(model), .map = out};
  int code = find_collisions(&m);
  return code ? code : name_intervals(&m);
}

// ---- names at a speed ----

// The interval of a speed, or beside a collision, where rounding tells real eigenvalues from pairs,
// its neighbour; -1 where neither has that many real ones.
static int interval_with(const mode_map *map, double speed, int real_count) {
  const int i = interval_of(map, speed);
  if (map->between[i].real_count == real_count) return i;
  bool below = i > 0 && map->between[i - 1].real_count == real_count;
  bool above = i < map->count && map->between[i + 1].real_count == real_count;
  if (below && above) return speed - map->at[i - 1] < map->at[i] - speed ? i - 1 : i + 1;
  return below ? i - 1 : above ? i + 1 : -1;
}

static double complex upper(const bike_eigenvalues *e, int k) {
  return e->re[k] + I * fabs(e->im[k]);
}

// Of two pairs the one nearest to an eigenvalue is the first.
static int pair_of(const bike_eigenvalues *e, int k, double complex first) {
  for (int n = 0; n < SIZE; n++)
    if (cabs(upper(e, n) - first) < cabs(upper(e, k) - first)) return 1;
  return 0;
}

int mode_map_name(bike_modes *at, const mode_map *map, const bike_model *model, double speed) {
  const bike_eigenvalues *e = &at->values;
  const int i = interval_with(map, speed, count_real(e));
  for (int k = 0; k < SIZE; k++) at->mode[k] = BIKE_MODE_UNNAMED;
  if (i < 0) return BIKE_OK;
  const mode_interval *names = &map->between[i];
  double complex first = 0;
  int code = BIKE_OK, place = 0;
  if (names->real_count == 0) code = mode_pair_follow(&first, model, names->entry, speed);
  if (code) return code == BIKE_ERROR_NO_CONVERGENCE ? BIKE_OK : code; // not told apart: unnamed
  for (int k = 0; k < SIZE; k++) {
    if (is_real(e, k))
      at->mode[k] = names->real[place++];
    else
      at->mode[k] = names->pair[names->real_count == 0 ? pair_of(e, k, first) : 0];
  }
  return BIKE_OK;
}
