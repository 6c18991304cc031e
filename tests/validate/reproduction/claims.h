// SPDX-License-Identifier: Apache-2.0
// What the rows of validate/REPRODUCTION.md are computed from: one function per row.
#ifndef BICYCLE_TESTS_REPRODUCTION_CLAIMS_H
#define BICYCLE_TESTS_REPRODUCTION_CLAIMS_H

enum { MAX_FIGURES = 24 };

// The figures of a row in the order in which they stand there. NaN is "none".
typedef struct figures {
  int count;
  double values[MAX_FIGURES];
} figures;

typedef struct claim {
  const char *key; // of the row
  void (*compute)(figures *out);
} claim;

// Each list ends with a key of NULL.
extern const claim claims_motion[];     // sections 1 and 4: coordinates, energy, far starts
extern const claim claims_turns[];      // section 4: stationary motion, figure 2
extern const claim claims_modes[];      // section 4: eigenvalues and modes, bifurcations
extern const claim claims_effects[];    // section 4: figures 3 and 4, the list of effects
extern const claim claims_conclusion[]; // section 5, and the equations themselves

#endif
