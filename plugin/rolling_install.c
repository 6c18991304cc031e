// SPDX-License-Identifier: Apache-2.0
// MuJoCo's callbacks, and the ones that were there before.
#include "rolling_internal.h"

// Set by roll_install alone, before threads start; read-only after.
static mjfGeneric previous_control;
static mjfSensor previous_sensor;
static mjfAct previous_act_dyn;

void roll_control(const mjModel *m, mjData *d) {
  mjfGeneric previous = previous_control;
  if (previous) previous(m, d);
  roll_make_roll(m, d);
}

void roll_sensor(const mjModel *m, mjData *d, int stage) {
  mjfSensor previous = previous_sensor;
  if (previous) previous(m, d, stage);
  if (stage == mjSTAGE_ACC) roll_sense(m, d);
}

mjtNum roll_act_dyn(const mjModel *m, const mjData *d, int id) {
  mjtNum power;
  // The data belongs to the caller, who is changing it; scratch memory is taken from its stack and
  // all else is left as it was.
  if (roll_work_rate(&power, m, (mjData *)d, id)) return power;
  return previous_act_dyn ? previous_act_dyn(m, d, id) : 0;
}

void roll_install(void) {
  if (mjcb_control != roll_control) {
    previous_control = mjcb_control;
    mjcb_control = roll_control;
  }
  if (mjcb_sensor != roll_sensor) {
    previous_sensor = mjcb_sensor;
    mjcb_sensor = roll_sensor;
  }
  if (mjcb_act_dyn != roll_act_dyn) {
    previous_act_dyn = mjcb_act_dyn;
    mjcb_act_dyn = roll_act_dyn;
  }
}

roll_error roll_uninstall(void) {
  if (mjcb_control != roll_control) return ROLL_NOT_INSTALLED;
  mjcb_control = previous_control;
  previous_control = NULL;
  if (mjcb_sensor == roll_sensor) {
    mjcb_sensor = previous_sensor;
    previous_sensor = NULL;
  }
  if (mjcb_act_dyn == roll_act_dyn) {
    mjcb_act_dyn = previous_act_dyn;
    previous_act_dyn = NULL;
  }
  return ROLL_OK;
}

int roll_is_installed(void) {
  return mjcb_control == roll_control;
}
