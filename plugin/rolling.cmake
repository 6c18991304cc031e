# SPDX-License-Identifier: Apache-2.0
# Exact rolling of thin discs for any MuJoCo model: it needs MuJoCo alone and knows no bicycle.
#   mujoco_rolling_static  to be linked; the host calls roll_install
#   mujoco_rolling         libmujoco_rolling.so, which installs itself when loaded
set(rolling_sources
  rolling.c
  rolling_check.c
  rolling_cholesky.c
  rolling_contact.c
  rolling_drive.c
  rolling_dynamics.c
  rolling_error.c
  rolling_install.c
  rolling_marker.c
  rolling_name.c
  rolling_project.c
  rolling_report.c
  rolling_sensor.c
  rolling_solver.c
  rolling_system.c
  rolling_work.c)

add_library(mujoco_rolling_objects OBJECT ${rolling_sources})
set_target_properties(mujoco_rolling_objects PROPERTIES
  C_VISIBILITY_PRESET hidden POSITION_INDEPENDENT_CODE ON)
target_include_directories(mujoco_rolling_objects PUBLIC
  $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}>)
target_link_libraries(mujoco_rolling_objects PUBLIC MuJoCo::MuJoCo PRIVATE bicycle_options m)

add_library(mujoco_rolling_static STATIC $<TARGET_OBJECTS:mujoco_rolling_objects>)
add_library(mujoco_rolling SHARED register.c $<TARGET_OBJECTS:mujoco_rolling_objects>)
add_library(mujoco::rolling ALIAS mujoco_rolling)
foreach(target mujoco_rolling_static mujoco_rolling)
  target_include_directories(${target} PUBLIC
    $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/mujoco_rolling>)
  target_link_libraries(${target} PUBLIC MuJoCo::MuJoCo m PRIVATE bicycle_options)
endforeach()
set_target_properties(mujoco_rolling PROPERTIES
  C_VISIBILITY_PRESET hidden EXPORT_NAME rolling
  VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR})

# find_package(mujoco_rolling) gives mujoco::rolling; include <rolling.h>.
set(rolling_package ${CMAKE_INSTALL_LIBDIR}/cmake/mujoco_rolling)
include(CMakePackageConfigHelpers)
write_basic_package_version_file(mujoco_rollingConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(TARGETS mujoco_rolling EXPORT mujoco_rolling COMPONENT mujoco_rolling
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT mujoco_rolling)
install(FILES rolling.h
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/mujoco_rolling COMPONENT mujoco_rolling)
install(EXPORT mujoco_rolling NAMESPACE mujoco:: FILE mujoco_rollingTargets.cmake
  DESTINATION ${rolling_package} COMPONENT mujoco_rolling)
install(FILES rolling_config.cmake
  DESTINATION ${rolling_package} RENAME mujoco_rollingConfig.cmake COMPONENT mujoco_rolling)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/mujoco_rollingConfigVersion.cmake
  ${PROJECT_SOURCE_DIR}/cmake/FindMuJoCo.cmake
  DESTINATION ${rolling_package} COMPONENT mujoco_rolling)
install(DIRECTORY examples DESTINATION ${CMAKE_INSTALL_DATADIR}/mujoco_rolling
  COMPONENT mujoco_rolling)
