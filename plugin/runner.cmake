# SPDX-License-Identifier: Apache-2.0
# The MuJoCo bicycle, its headless rides, and the program bicycle-mujoco.
add_library(mujoco_runner STATIC
  bicycle_import.c
  bicycle_import_geometry.c
  bicycle_import_joints.c
  bicycle_import_load.c
  bicycle_import_mass.c
  bicycle_import_physics.c
  bicycle_import_tyre.c
  bicycle_import_wheels.c
  bicycle_mjcf.c
  bicycle_mjcf_apart.c
  bicycle_mjcf_compile.c
  bicycle_mjcf_inertia.c
  bicycle_mjcf_plan.c
  bicycle_mjcf_readme.c
  bicycle_mjcf_scenery.c
  bicycle_mjcf_shape.c
  runner.c
  runner_any.c
  runner_any_ride.c
  runner_check.c
  runner_control.c
  runner_cvode.c
  runner_foreign.c
  runner_guard.c
  runner_map.c
  runner_mass.c
  runner_measure.c
  runner_posture.c
  runner_ride.c
  runner_solve.c
  runner_start.c
  runner_times.c
  ${PROJECT_SOURCE_DIR}/src/motion/vector.c)
target_include_directories(mujoco_runner PUBLIC ${CMAKE_CURRENT_SOURCE_DIR})
target_link_libraries(mujoco_runner
  PUBLIC bicycle::bicycle mujoco_rolling_static MuJoCo::MuJoCo
  PRIVATE bicycle_document SUNDIALS::cvode ${CMAKE_DL_LIBS} bicycle_options m)

# Pictures: in a target of its own, so that nothing else needs libpng, and nothing at all loads a GL
# before the first picture.
find_path(OSMESA_INCLUDE_DIR GL/osmesa.h REQUIRED)
add_library(mujoco_picture STATIC
  picture.c
  picture_gl.c
  picture_look.c
  picture_pixels.c
  picture_view.c)
target_include_directories(mujoco_picture PUBLIC ${CMAKE_CURRENT_SOURCE_DIR})
target_include_directories(mujoco_picture SYSTEM PRIVATE ${OSMESA_INCLUDE_DIR})
target_link_libraries(mujoco_picture
  PUBLIC mujoco_runner PRIVATE PNG::PNG ${CMAKE_DL_LIBS} bicycle_options m)

add_executable(bicycle-mujoco
  main.c
  cmd_columns.c
  cmd_import.c
  cmd_mjcf.c
  cmd_mjcf_set.c
  cmd_model.c
  cmd_picture.c
  cmd_ride.c
  cmd_ride_any.c
  cmd_tally.c)
target_link_libraries(bicycle-mujoco PRIVATE mujoco_picture mujoco_runner terminal bicycle::bicycle bicycle_options)
set_target_properties(bicycle-mujoco PROPERTIES
  INSTALL_RPATH "$ORIGIN/../${CMAKE_INSTALL_LIBDIR}")
install(TARGETS bicycle-mujoco RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
