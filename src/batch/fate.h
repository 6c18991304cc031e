// SPDX-License-Identifier: Apache-2.0
// How fates are told from rides of an ensemble.
#ifndef BICYCLE_BATCH_FATE_H
#define BICYCLE_BATCH_FATE_H

#include <bicycle/basin.h>

bike_ensemble_def fate_ensemble(const bike_basin_def *def);
bike_fate fate_of_result(const bike_member_result *result);

// Errors that say that there is no such state.
bool fate_is_no_start(int code);

#endif
