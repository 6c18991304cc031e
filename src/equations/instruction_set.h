// SPDX-License-Identifier: Apache-2.0
// Which of the x86-64 instruction set levels the machine has: the kernels are compiled for each,
// because fused multiply-adds and wide registers are worth a third of the time.
//
// v3 and v4 give the same bits of an acceleration, baseline others. BICYCLE_INSTRUCTIONS=baseline
// (or v3, v4) in the environment asks for one that all machines of a comparison have; one that the
// machine lacks, or another word, is not heeded.
#ifndef BICYCLE_EQUATIONS_INSTRUCTION_SET_H
#define BICYCLE_EQUATIONS_INSTRUCTION_SET_H

typedef enum instruction_set {
  INSTRUCTIONS_BASELINE, // what every machine of the kind has; x86-64: SSE2
  INSTRUCTIONS_V3,       // x86-64-v3: AVX2, FMA
  INSTRUCTIONS_V4        // x86-64-v4: AVX-512
} instruction_set;

// Decided at the first call.
instruction_set instruction_set_in_use(void);

// The highest that the machine has and the build holds.
instruction_set instruction_set_best(void);

// "baseline", "v3", "v4".
const char *instruction_set_string(instruction_set set);

// In a file that is compiled for each set: NAME_baseline, NAME_v3 or NAME_v4.
#ifdef BICYCLE_LEVEL
#define INSTANCE_JOINED(name, level) name##_##level
#define INSTANCE_OF(name, level) INSTANCE_JOINED(name, level)
#define INSTANCE(name) INSTANCE_OF(name, BICYCLE_LEVEL)
#endif

#endif
