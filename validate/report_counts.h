// SPDX-License-Identifier: Apache-2.0
// What the first line of every view counts.
//
// A gate is a limit on a number; many numbers repeat each other. An independent measurement is a
// quantity that two computations gave, counted once:
//  - by layer and signal (with its engine: "mujoco.energy"), whatever number of metrics and parts
//  of
//    the ride are judged;
//  - not where every value is exactly zero: both sides hold the same bits. Such a number was copied
//    (most of Lp), or is zero by symmetry, or nothing happened;
//  - not where an earlier scenario with the same bicycle has the same value (the first that is not
//    zero), to the last bit: the same computation was done again (Lp and L0 of one bicycle).
// What could not be measured but has a limit (NaN) counts, and fails.
#ifndef VALIDATE_REPORT_COUNTS_H
#define VALIDATE_REPORT_COUNTS_H

#include <jansson.h>

// Of the scenarios of a document: {agree, differ, fail, invalid} scenarios by verdict, {gates} in
// all, {measurements} that are independent, and of these {failed}. NULL when out of memory.
json_t *report_counts(const json_t *scenarios);

#endif
