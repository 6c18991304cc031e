// SPDX-License-Identifier: Apache-2.0
// The work of a driven joint as the activation of an actuator "rolling:JOINT:work": MuJoCo
// integrates its rate, the power, with the motion and to the same order.
#include "rolling_internal.h"

#include <string.h>

// Whether an actuator asks for work, and of which driven joint: its index, -1 of none.
static int asks_for_work(int *drive, const mjModel *m, int actuator) {
  int length;
  const char *object;
  const char *quantity =
      roll_split_name(&object, &length, m->names + m->name_actuatoradr[actuator]);
  if (!quantity) return 0;
  *drive = strcmp(quantity, "work") == 0 ? roll_find_drive(m, object, length) : -1;
  return 1;
}

roll_error roll_check_actuators(roll_object *where, const mjModel *m) {
  for (int i = 0; i < m->nu; i++) {
    int drive;
    if (!asks_for_work(&drive, m, i)) continue;
    if (drive >= 0 && m->actuator_dyntype[i] == mjDYN_USER) continue;
    *where = (roll_object){mjOBJ_ACTUATOR, i};
    return ROLL_BAD_ACTUATOR;
  }
  return ROLL_OK;
}

int roll_work_rate(mjtNum *power, const mjModel *m, mjData *d, int actuator) {
  int index;
  if (!asks_for_work(&index, m, actuator) || index < 0) return 0;
  // The solver's forces, and with them the drive's answer, come after the activations.
  if (d->nefc)
    roll_warn(ROLL_SAY_WORK,
              "rolling_driven: where MuJoCo has constraints of its own (limits, contacts, friction "
              "loss), the work of a driven joint is not exact",
              m, d);
  mjMARKSTACK;
  roll_system system;
  roll_drive drive = {.power = 0};
  if (roll_survey(&system, m, d) != ROLL_NO_STACK)
    roll_describe_drive(&drive, &system, index, m, d);
  mjFREESTACK;
  roll_restore(m, d);
  *power = drive.power;
  return 1;
}
