// SPDX-License-Identifier: Apache-2.0
// What is wrong with a model, said before it is run: names, what is marked, and what is asked of
// it.
#include "rolling_internal.h"

// Of `count` elements of a type, whose names begin at `names`. Tuples alone may be markers.
static roll_error check_names_of(roll_object *where, const mjModel *m, int type, int count,
                                 const int *names) {
  for (int i = 0; i < count; i++) {
    roll_kind kind = roll_kind_of(m->names + names[i]);
    if (kind == ROLL_KIND_FOREIGN || (type == mjOBJ_TUPLE && kind != ROLL_KIND_UNKNOWN)) continue;
    *where = (roll_object){type, i};
    return ROLL_BAD_NAME;
  }
  return ROLL_OK;
}

roll_error roll_check_names(roll_object *where, const mjModel *m) {
  roll_error error = check_names_of(where, m, mjOBJ_TUPLE, m->ntuple, m->name_tupleadr);
  if (!error) error = check_names_of(where, m, mjOBJ_NUMERIC, m->nnumeric, m->name_numericadr);
  if (!error) error = check_names_of(where, m, mjOBJ_TEXT, m->ntext, m->name_textadr);
  return error;
}

static roll_error check_wheels(roll_object *where, const mjModel *m, roll_span span, int skate) {
  int ground = -1;
  for (int address = span.first; address < span.first + span.count; address++) {
    if (roll_is_ground(m, address)) {
      ground = m->tuple_objid[address];
      continue;
    }
    roll_wheel wheel;
    roll_error error = roll_read_wheel(&wheel, m, address, ground, skate);
    if (!error) continue;
    *where = roll_wheel_fault(error, m, address, ground);
    return error;
  }
  return ROLL_OK;
}

static roll_error check_drives(roll_object *where, const mjModel *m, roll_span span) {
  for (int address = span.first; address < span.first + span.count; address++) {
    roll_error error = roll_check_drive(m, address);
    if (!error) continue;
    *where = roll_element(m, address);
    return error;
  }
  return ROLL_OK;
}

static roll_error check_all(roll_object *where, const mjModel *m) {
  roll_error error = roll_check_names(where, m);
  if (error) return error;
  roll_marker marker = roll_find_marker(m);
  if (!roll_is_marked(&marker)) return ROLL_NO_MARKER;
  error = check_wheels(where, m, marker.discs, 0);
  if (!error) error = check_wheels(where, m, marker.skates, 1);
  if (!error) error = check_drives(where, m, marker.driven);
  if (!error) error = roll_check_motions(where, m);
  if (!error) error = roll_check_actuators(where, m);
  return error ? error : roll_check_sensors(where, m);
}

roll_error roll_check(roll_object *where, const mjModel *m) {
  roll_object first = {mjOBJ_UNKNOWN, -1};
  roll_error error = check_all(&first, m);
  if (where) *where = first;
  return error;
}
