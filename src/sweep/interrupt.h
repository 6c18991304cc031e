// SPDX-License-Identifier: Apache-2.0
// SIGINT and SIGTERM ask a sweep to stop; a second one ends it as usual.
#ifndef SWEEP_INTERRUPT_H
#define SWEEP_INTERRUPT_H

void sweep_listen_to_signals(void);

// The signal that asked, or 0.
int sweep_interrupted(void);

#endif
