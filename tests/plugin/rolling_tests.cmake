# SPDX-License-Identifier: Apache-2.0
set(rolling_folder ${PROJECT_SOURCE_DIR}/plugin/examples)
set(rolling_examples ROLL_EXAMPLES=${rolling_folder})
set(rolling_models ${rolling_examples} ROLL_MODELS=${CMAKE_CURRENT_LIST_DIR}/rolling_models)

foreach(name test_rolling_bicycle test_rolling_balance test_rolling_drive
    test_rolling_faults test_rolling_ground test_rolling_host test_rolling_sensor
    test_rolling_skate)
  bike_test(NAME ${name} SOURCES ${name}.c LIBS mujoco_rolling_static
    ENVIRONMENT ${rolling_models})
endforeach()

# The reduced disc is the comparator's.
bike_test(NAME test_rolling SOURCES test_rolling.c ${PROJECT_SOURCE_DIR}/validate/disc.c
  LIBS mujoco_rolling_static ENVIRONMENT ${rolling_models})
target_include_directories(test_rolling PRIVATE ${PROJECT_SOURCE_DIR}/validate)

bike_test(NAME test_rolling_rider SOURCES test_rolling_rider.c
  LIBS mujoco_rolling_static bicycle::bicycle ENVIRONMENT ${rolling_models})

bike_test(NAME test_rolling_library SOURCES test_rolling_library.c
  LIBS MuJoCo::MuJoCo ${CMAKE_DL_LIBS}
  ENVIRONMENT ${rolling_examples} ROLL_LIBRARY=$<TARGET_FILE:mujoco_rolling>)
add_dependencies(test_rolling_library mujoco_rolling)

#---------------------------------- threads --------------------------------------------------------

bike_test(NAME test_rolling_threads SOURCES test_rolling_threads.c
  LIBS mujoco_rolling_static ENVIRONMENT ${rolling_examples} TSAN_OPTIONS=halt_on_error=1)

#---------------------------------- programs of others ---------------------------------------------

# Programs that know nothing of the library, from libmujoco-samples: the spy steps them to 0.5 s.
add_library(rolling_spy MODULE rolling_spy.c)
target_link_libraries(rolling_spy PRIVATE mujoco_rolling bicycle_options ${CMAKE_DL_LIBS})

function(rolling_guest name)
  add_test(NAME ${name} COMMAND ${ARGN} WORKING_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR})
  set_property(TEST ${name} PROPERTY ENVIRONMENT ROLL_SPY_STEPS=500 ROLL_KEYFRAME=test
    LD_PRELOAD=$<TARGET_FILE:mujoco_rolling>:$<TARGET_FILE:rolling_spy>)
  set_property(TEST ${name} PROPERTY TIMEOUT 120)
endfunction()

find_program(MUJOCO_TESTSPEED mujoco-testspeed)
find_program(MUJOCO_SIMULATE mujoco-simulate)
find_program(XVFB_RUN xvfb-run)
if(MUJOCO_TESTSPEED AND NOT BICYCLE_SANITIZERS)
  rolling_guest(rolling_in_testspeed ${MUJOCO_TESTSPEED} ${rolling_folder}/bicycle.xml 1000 1)
endif()
if(MUJOCO_SIMULATE AND XVFB_RUN AND NOT BICYCLE_SANITIZERS)
  rolling_guest(rolling_in_simulate
    ${XVFB_RUN} -a ${MUJOCO_SIMULATE} ${rolling_folder}/bicycle.xml)
endif()

#---------------------------------- the installed package ------------------------------------------

if(NOT BICYCLE_SANITIZERS)
  add_test(NAME rolling_package COMMAND ${CMAKE_COMMAND} -DBUILD=${PROJECT_BINARY_DIR}
    -DSOURCE=${CMAKE_CURRENT_LIST_DIR}/rolling_package -DMODEL=${rolling_folder}/bicycle.xml
    -DWORK=${CMAKE_CURRENT_BINARY_DIR}/rolling_package
    -P ${CMAKE_CURRENT_LIST_DIR}/rolling_package/check.cmake)
endif()
