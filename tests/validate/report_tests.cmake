# SPDX-License-Identifier: Apache-2.0
bike_test(NAME test_report_schema SOURCES test_report_schema.c json_schema.c LIBS validate_support
  TIMEOUT 240)
bike_test(NAME test_baseline SOURCES test_baseline.c LIBS validate_support TIMEOUT 240)
add_dependencies(test_report_schema bicycle-validate)
add_dependencies(test_baseline bicycle-validate)

if(BICYCLE_SANITIZERS)
  return()
endif()

# report.html in a headless Chromium: Debian's package chromium, which only tests need. Found when
# the build is configured; without it the test says that it is skipped.
find_program(CHROMIUM_PROGRAM NAMES chromium DOC "Chromium, for the test of report.html")
bike_test(NAME test_page SOURCES browser/test_page.c browser/devtools.c LIBS validate_support
  TIMEOUT 240)
if(NOT CHROMIUM_PROGRAM)
  set(CHROMIUM_PROGRAM "")
endif()
target_compile_definitions(test_page PRIVATE BICYCLE_CHROMIUM="${CHROMIUM_PROGRAM}"
  BICYCLE_PICTURES="${PROJECT_BINARY_DIR}/screenshots")
set_property(TEST test_page PROPERTY SKIP_RETURN_CODE 77)
add_dependencies(test_page bicycle-validate)
