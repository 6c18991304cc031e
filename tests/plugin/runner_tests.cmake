# SPDX-License-Identifier: Apache-2.0
foreach(name test_bicycle_mjcf test_bicycle_mjcf_apart test_import test_import_refusals test_runner
             test_runner_any test_runner_ends test_runner_faults test_runner_long test_runner_ride test_runner_rider)
  bike_test(NAME ${name} SOURCES ${name}.c
    LIBS mujoco_runner bicycle_oracle bicycle_test_reference bicycle::bicycle TIMEOUT 120)
endforeach()

# What OSMesa keeps is not ours to free.
set(osmesa_leaks
  LSAN_OPTIONS=suppressions=${CMAKE_CURRENT_LIST_DIR}/lsan.supp:print_suppressions=0)
foreach(name test_commands test_commands_any test_commands_set)
  bike_test(NAME ${name} SOURCES ${name}.c ${PROJECT_SOURCE_DIR}/tests/cli/run.c
    LIBS terminal ENVIRONMENT ${osmesa_leaks} TIMEOUT 180)
  add_dependencies(${name} bicycle-command bicycle-mujoco)
endforeach()

# A machine without OSMesa; a sanitizer's own library must come before anything preloaded.
if(NOT BICYCLE_SANITIZERS)
  add_library(no_osmesa MODULE no_osmesa.c)
  target_link_libraries(no_osmesa PRIVATE bicycle_options ${CMAKE_DL_LIBS})
  add_dependencies(test_commands_any no_osmesa)
  set_property(TEST test_commands_any APPEND PROPERTY ENVIRONMENT NO_OSMESA=$<TARGET_FILE:no_osmesa>)
endif()

bike_test(NAME test_picture SOURCES test_picture.c LIBS mujoco_picture PNG::PNG
  ENVIRONMENT ${osmesa_leaks} TIMEOUT 120)
target_link_options(test_picture PRIVATE -Wl,--wrap=dlopen)
