# SPDX-License-Identifier: Apache-2.0
foreach(name test_bicycle_mjcf test_import test_runner test_runner_ride test_runner_long test_runner_rider
             test_runner_faults)
  bike_test(NAME ${name} SOURCES ${name}.c
    LIBS mujoco_runner bicycle_oracle bicycle_test_reference bicycle::bicycle TIMEOUT 120)
endforeach()

bike_test(NAME test_commands SOURCES test_commands.c ${PROJECT_SOURCE_DIR}/tests/cli/run.c
  LIBS terminal TIMEOUT 120)
add_dependencies(test_commands bicycle-command bicycle-mujoco)
