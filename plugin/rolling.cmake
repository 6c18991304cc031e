# SPDX-License-Identifier: Apache-2.0
# Exact rolling of thin discs for any MuJoCo model: it needs MuJoCo alone and knows no bicycle.
#   mujoco_rolling_static  to be linked; the host calls roll_install
#   mujoco_rolling         libmujoco_rolling.so, which installs itself when loaded
set(rolling_sources
  rolling.c
  rolling_cholesky.c
  rolling_contact.c
  rolling_error.c
  rolling_marker.c
  rolling_project.c
  rolling_report.c
  rolling_solver.c
  rolling_system.c)

add_library(mujoco_rolling_objects OBJECT ${rolling_sources})
set_target_properties(mujoco_rolling_objects PROPERTIES
  C_VISIBILITY_PRESET hidden POSITION_INDEPENDENT_CODE ON)
target_include_directories(mujoco_rolling_objects PUBLIC
  $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}>)
target_link_libraries(mujoco_rolling_objects PUBLIC MuJoCo::MuJoCo PRIVATE bicycle_options m)

add_library(mujoco_rolling_static STATIC $<TARGET_OBJECTS:mujoco_rolling_objects>)
add_library(mujoco_rolling SHARED register.c $<TARGET_OBJECTS:mujoco_rolling_objects>)
foreach(target mujoco_rolling_static mujoco_rolling)
  target_include_directories(${target} PUBLIC
    $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}>)
  target_link_libraries(${target} PUBLIC MuJoCo::MuJoCo m PRIVATE bicycle_options)
endforeach()
set_target_properties(mujoco_rolling PROPERTIES C_VISIBILITY_PRESET hidden)
