// SPDX-License-Identifier: Apache-2.0
// On what the figures were measured.
#ifndef BICYCLE_BENCH_MACHINE_H
#define BICYCLE_BENCH_MACHINE_H

#include <jansson.h>

// CPU, its vector units, number of cores, load, compiler, build type and flags, kernel.
json_t *bench_machine(void);

#endif
