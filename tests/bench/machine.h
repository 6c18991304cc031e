// SPDX-License-Identifier: Apache-2.0
// On what the figures were measured.
#ifndef BICYCLE_BENCH_MACHINE_H
#define BICYCLE_BENCH_MACHINE_H

#include <jansson.h>

// CPU, its vector units, the instructions in use and their lanes, number of cores, load, compiler,
// build type and flags, kernel.
json_t *bench_machine(void);

// The same for a person, in one line without its end.
void bench_machine_line(char *out, size_t size);

#endif
