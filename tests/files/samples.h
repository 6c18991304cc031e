// SPDX-License-Identifier: Apache-2.0
// One good file of each form, small, with known line numbers.
#ifndef TESTS_FILES_SAMPLES_H
#define TESTS_FILES_SAMPLES_H

extern const char SAMPLE_VALUES[];     // parameterization: Meijaard2007
extern const char SAMPLE_FLAT[];       // the same numbers, flat
extern const char SAMPLE_TEXT[];       // the same numbers, name = value+/-uncertainty
extern const char SAMPLE_COMPONENTS[]; // parameterization: components, by wheelbase
extern const char SAMPLE_LENGTHS[];    // the same geometry by its five lengths

#endif
