// SPDX-License-Identifier: Apache-2.0
#include "batch/lanes_block.h"
#include "batch/lanes_instance.h"

const lanes_functions INSTANCE(lanes) = {.width = LANES,
                                         .block_size = sizeof(lanes_models),
                                         .pack = INSTANCE(lanes_pack),
                                         .accelerate = INSTANCE(lanes_accelerate),
                                         .turn = INSTANCE(lanes_turn),
                                         .eigenvalues = INSTANCE(lanes_eigenvalues),
                                         .ride = INSTANCE(lanes_ride)};
