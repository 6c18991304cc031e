// SPDX-License-Identifier: Apache-2.0
// libmujoco_rolling.so: loading it (linked, dlopen, LD_PRELOAD) installs the callback.
#include "rolling.h"

__attribute__((constructor)) static void install(void) {
  roll_install();
}

__attribute__((destructor)) static void uninstall(void) {
  (void)roll_uninstall(); // a host that has taken mjcb_control keeps it
}
