// SPDX-License-Identifier: Apache-2.0
// Whether a text obeys the JUnit format that Jenkins reads (junit-10.xsd of its xUnit plugin), and
// its counts are those of its tests.
#ifndef TESTS_VALIDATE_JUNIT_CHECK_H
#define TESTS_VALIDATE_JUNIT_CHECK_H

// The test fails where it does not.
void junit_check(const char *text);

#endif
