// SPDX-License-Identifier: Apache-2.0
// Sensors: what the model asks of the discs, and what MuJoCo's own sensors miss of the ground.
//
// MuJoCo's mj_rnePostConstraint sums cfrc_ext (perturbations and contacts) and cfrc_int (between a
// body and its parent) without the ground's forces. A force F on body b adds F to cfrc_ext of b
// and takes it from cfrc_int of b and of all its ancestors.
#include "rolling_internal.h"

#include <stddef.h>
#include <string.h>

//---------------------------------- quantities ----------------------------------------------------

typedef struct quantity {
  const char *name;
  size_t offset; // in roll_disc or roll_drive
  int dim;
} quantity;

static const quantity of_disc[] = {
    {"force", offsetof(roll_disc, force), 3},
    {"point", offsetof(roll_disc, point), 3},
    {"slip", offsetof(roll_disc, slip), 3},
    {"normal", offsetof(roll_disc, normal_force), 1},
    {"height", offsetof(roll_disc, height), 1},
    {"height_rate", offsetof(roll_disc, height_rate), 1},
    {"lift", offsetof(roll_disc, lifts), 0}, // an int
};

static const quantity of_drive[] = {
    {"force", offsetof(roll_drive, force), 1},
    {"power", offsetof(roll_drive, power), 1},
    {"error", offsetof(roll_drive, off), 1},
};

// Of the whole model; offset in an array of numbers.
static const quantity of_model[] = {
    {"potential", 0, 1},
    {"kinetic", sizeof(mjtNum), 1},
    {"energy", 2 * sizeof(mjtNum), 1},
};

static const quantity *find_quantity(const quantity *table, size_t count, const char *name) {
  for (size_t i = 0; i < count; i++)
    if (strcmp(table[i].name, name) == 0) return table + i;
  return NULL;
}

// What one user sensor asks for.
typedef struct question {
  const quantity *quantity; // NULL: nothing known
  int wheel, drive;         // one is an index, the other -1; both -1: the model
} question;

// What bears the name is asked first: a disc may well be called "model".
static int is_model(const char *object, int length) {
  static const char name[] = "model";
  return length == sizeof name - 1 && strncmp(object, name, sizeof name - 1) == 0;
}

// 0 for a sensor that asks nothing of the discs.
static int read_question(question *q, const mjModel *m, int sensor) {
  int length;
  const char *object;
  if (m->sensor_type[sensor] != mjSENS_USER) return 0;
  const char *last = roll_split_name(&object, &length, m->names + m->name_sensoradr[sensor]);
  if (!last) return 0;
  q->wheel = roll_find_wheel(m, object, length);
  q->drive = q->wheel < 0 ? roll_find_drive(m, object, length) : -1;
  q->quantity = NULL;
  if (q->wheel >= 0) q->quantity = find_quantity(of_disc, sizeof of_disc / sizeof *of_disc, last);
  if (q->drive >= 0)
    q->quantity = find_quantity(of_drive, sizeof of_drive / sizeof *of_drive, last);
  if (q->wheel < 0 && q->drive < 0 && is_model(object, length))
    q->quantity = find_quantity(of_model, sizeof of_model / sizeof *of_model, last);
  int dim = q->quantity && q->quantity->dim > 1 ? q->quantity->dim : 1;
  if (m->sensor_dim[sensor] != dim || m->sensor_needstage[sensor] != mjSTAGE_ACC)
    q->quantity = NULL;
  return 1;
}

roll_error roll_check_sensors(roll_object *where, const mjModel *m) {
  question q;
  for (int i = 0; i < m->nsensor; i++) {
    if (!read_question(&q, m, i) || q.quantity) continue;
    *where = (roll_object){mjOBJ_SENSOR, i};
    return ROLL_BAD_SENSOR;
  }
  return ROLL_OK;
}

// MuJoCo computes energies only where a flag asks for them: here, of a model that says so.
static void answer_of_model(mjtNum *data, const question *q, const mjModel *m, mjData *d) {
  if (!(m->opt.enableflags & mjENBL_ENERGY)) {
    mjModel with_energy = *m;
    with_energy.opt.enableflags |= mjENBL_ENERGY;
    mj_energyPos(&with_energy, d);
    mj_energyVel(&with_energy, d);
  }
  const mjtNum energy[3] = {d->energy[0], d->energy[1], d->energy[0] + d->energy[1]};
  memcpy(data, (const char *)energy + q->quantity->offset, sizeof *data);
}

static void answer(mjtNum *data, const question *q, const roll_system *s, const mjModel *m,
                   mjData *d) {
  if (q->wheel < 0 && q->drive < 0) {
    answer_of_model(data, q, m, d);
    return;
  }
  roll_disc disc;
  roll_drive drive;
  if (q->wheel >= 0) roll_describe_disc(&disc, s, q->wheel, m);
  if (q->drive >= 0) roll_describe_drive(&drive, s, q->drive, m, d);
  const char *from = q->wheel >= 0 ? (const char *)&disc : (const char *)&drive;
  if (q->quantity->dim == 0)
    data[0] = disc.lifts;
  else
    memcpy(data, from + q->quantity->offset, sizeof(mjtNum) * (size_t)q->quantity->dim);
}

// `s` is NULL of a model without anything that rolls, which may ask for its energy.
static void answer_all(const roll_system *s, const mjModel *m, mjData *d) {
  question q;
  for (int i = 0; i < m->nsensor; i++) {
    if (!read_question(&q, m, i)) continue;
    if (q.quantity)
      answer(d->sensordata + m->sensor_adr[i], &q, s, m, d);
    else
      roll_warn_of(ROLL_SAY_SENSOR, ROLL_BAD_SENSOR, (roll_object){mjOBJ_SENSOR, i}, m, d);
  }
}

//---------------------------------- MuJoCo's own --------------------------------------------------

// A force at a point as torque and force about another, as cfrc_* have them.
static void spatial_force(mjtNum out[6], const mjtNum force[3], const mjtNum at[3],
                          const mjtNum about[3]) {
  mjtNum arm[3];
  mju_sub3(arm, at, about);
  mju_cross(out, arm, force);
  mju_copy3(out + 3, force);
}

static void add_ground_force(const roll_disc *disc, const mjModel *m, mjData *d) {
  mjtNum force[6];
  spatial_force(force, disc->force, disc->point, d->subtree_com + 3 * m->body_rootid[disc->body]);
  mju_addTo(d->cfrc_ext + 6 * disc->body, force, 6);
  for (int body = disc->body; body > 0; body = m->body_parentid[body])
    mju_subFrom(d->cfrc_int + 6 * body, force, 6);
  mju_subFrom(d->cfrc_int, force, 6); // the world's
}

// Force or torque between a site's body and its parent, in the site's frame.
static void sense_joint(mjtNum out[3], int type, int site, const mjModel *m, const mjData *d) {
  int body = m->site_bodyid[site];
  const mjtNum *force = d->cfrc_int + 6 * body, *com = d->subtree_com + 3 * m->body_rootid[body];
  mjtNum at_site[6], arm[3], moment[3];
  // about the site:  T_s = T_com - (s - com) x F
  mju_sub3(arm, d->site_xpos + 3 * site, com);
  mju_cross(moment, arm, force + 3);
  mju_sub3(at_site, force, moment);
  mju_copy3(at_site + 3, force + 3);
  mju_rotVecMatT(out, type == mjSENS_FORCE ? at_site + 3 : at_site, d->site_xmat + 9 * site);
}

static void repair(const roll_system *s, const mjModel *m, mjData *d) {
  for (int i = 0; i < s->contacts; i++) {
    roll_disc disc;
    roll_describe_disc(&disc, s, i, m);
    if (!disc.error) add_ground_force(&disc, m, d);
  }
  for (int i = 0; i < m->nsensor; i++) {
    int type = m->sensor_type[i];
    if (type == mjSENS_FORCE || type == mjSENS_TORQUE)
      sense_joint(d->sensordata + m->sensor_adr[i], type, m->sensor_objid[i], m, d);
  }
}

void roll_sense(const mjModel *m, mjData *d) {
  roll_marker marker = roll_find_marker(m);
  if (!roll_is_marked(&marker)) {
    answer_all(NULL, m, d);
    return;
  }
  mjMARKSTACK;
  roll_system system;
  if (roll_survey(&system, m, d) != ROLL_NO_STACK) {
    repair(&system, m, d);
    answer_all(&system, m, d);
  }
  mjFREESTACK;
  roll_restore(m, d);
}
