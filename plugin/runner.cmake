# SPDX-License-Identifier: Apache-2.0
# The MuJoCo bicycle, its headless rides, and the program bicycle-mujoco.
add_library(mujoco_runner STATIC
  bicycle_mjcf.c
  bicycle_mjcf_compile.c
  bicycle_mjcf_inertia.c
  bicycle_mjcf_plan.c
  bicycle_mjcf_scenery.c
  bicycle_mjcf_shape.c
  runner.c
  runner_check.c
  runner_control.c
  runner_guard.c
  runner_map.c
  runner_measure.c
  runner_posture.c
  runner_ride.c
  runner_start.c)
target_include_directories(mujoco_runner PUBLIC ${CMAKE_CURRENT_SOURCE_DIR})
target_link_libraries(mujoco_runner
  PUBLIC bicycle::bicycle mujoco_rolling_static MuJoCo::MuJoCo PRIVATE bicycle_options m)
