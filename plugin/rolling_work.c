// SPDX-License-Identifier: Apache-2.0
// The work of a driven joint as the activation of an actuator "rolling:JOINT:work": MuJoCo
// integrates its rate, the power, with the motion and to the same order.
#include "rolling_internal.h"

#include <string.h>

// Index of the driven joint whose work the actuator holds; -1 for any other actuator.
static int find_worker(const mjModel *m, int actuator) {
  int length;
  const char *name = m->names + m->name_actuatoradr[actuator];
  const char *quantity = roll_split_name(&length, name);
  if (!quantity || strcmp(quantity, "work") != 0) return -1;
  return roll_find_drive(m, name + (quantity - name) - length - 1, length);
}

int roll_work_rate(mjtNum *power, const mjModel *m, mjData *d, int actuator) {
  int index = find_worker(m, actuator);
  if (index < 0) return 0;
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
