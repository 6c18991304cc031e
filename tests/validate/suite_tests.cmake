# SPDX-License-Identifier: Apache-2.0
# Suites on threads. What has state of its process, or could have (the comparator, the MuJoCo
# bicycle, the rolling library), is compiled into the test for the thread sanitizer; the rest, and
# what is generated, comes from the libraries. The address sanitizer excludes the other.
set(suite_sources)
foreach(library validate_core mujoco_runner mujoco_rolling_objects)
  get_target_property(folder ${library} SOURCE_DIR)
  get_target_property(files ${library} SOURCES)
  list(FILTER files EXCLUDE REGEX "^/")
  list(TRANSFORM files PREPEND ${folder}/)
  list(APPEND suite_sources ${files})
endforeach()
if(BICYCLE_THREAD_SANITIZER)
  bike_test(NAME test_suite SOURCES test_suite.c ${suite_sources} LIBS validate_support
    SUNDIALS::arkode SUNDIALS::cvode TIMEOUT 240 ENVIRONMENT TSAN_OPTIONS=halt_on_error=1)
  get_target_property(definitions validate_core COMPILE_DEFINITIONS)
  target_compile_definitions(test_suite PRIVATE ${definitions})
  target_compile_options(test_suite PRIVATE -fsanitize=thread -g)
  target_link_options(test_suite PRIVATE -fsanitize=thread)
else()
  bike_test(NAME test_suite SOURCES test_suite.c LIBS validate_support TIMEOUT 240)
endif()
