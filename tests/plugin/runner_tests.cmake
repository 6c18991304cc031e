# SPDX-License-Identifier: Apache-2.0
foreach(name test_bicycle_mjcf test_runner test_runner_ride test_runner_faults)
  bike_test(NAME ${name} SOURCES ${name}.c
    LIBS mujoco_runner bicycle_oracle bicycle_test_reference bicycle::bicycle TIMEOUT 120)
endforeach()
