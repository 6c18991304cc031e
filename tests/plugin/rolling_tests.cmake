# SPDX-License-Identifier: Apache-2.0
set(rolling_models ROLL_MODELS=${CMAKE_CURRENT_LIST_DIR}/rolling_models)

foreach(name test_rolling test_rolling_bicycle test_rolling_host test_rolling_faults)
  bike_test(NAME ${name} SOURCES ${name}.c LIBS mujoco_rolling_static
    ENVIRONMENT ${rolling_models})
endforeach()

bike_test(NAME test_rolling_library SOURCES test_rolling_library.c
  LIBS MuJoCo::MuJoCo ${CMAKE_DL_LIBS}
  ENVIRONMENT ${rolling_models} ROLL_LIBRARY=$<TARGET_FILE:mujoco_rolling>)
add_dependencies(test_rolling_library mujoco_rolling)
