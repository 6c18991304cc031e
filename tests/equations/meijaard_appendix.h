// SPDX-License-Identifier: Apache-2.0
// Oracle: the linear model of Meijaard, Papadopoulos, Ruina, Schwab (2007), appendix A.
#ifndef BICYCLE_TESTS_MEIJAARD_APPENDIX_H
#define BICYCLE_TESTS_MEIJAARD_APPENDIX_H

#include <bicycle/linear.h>

// M, C1, K0, K2 of a mirror-symmetric bicycle by the closed formulas of appendix A, in this
// project's signs (steer to the left, so off-diagonal entries change sign).
bike_upright_matrices meijaard_matrices(const bike_bicycle *bicycle);

#endif
