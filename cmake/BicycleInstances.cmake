# SPDX-License-Identifier: Apache-2.0
# Sources that hold the kernel: their flags, and how they are compiled for several instruction sets.

# x86-64's levels; elsewhere there is the baseline alone. So it is with sanitizers: the others are
# the same source.
set(BICYCLE_LEVELS baseline)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64)$" AND NOT BICYCLE_SANITIZERS)
  list(APPEND BICYCLE_LEVELS v3 v4)
endif()

set(BICYCLE_KERNEL_FLAGS -ffp-contract=fast -fno-math-errno -fno-trapping-math
  # pairs found in straight-line code cost more shuffles than they save: 3 % of a right-hand side
  -fno-tree-slp-vectorize
  # complex products and quotients without the search for infinities, for the complex step
  $<$<C_COMPILER_ID:GNU>:-fcx-limited-range>
  # vectors pass between static functions only, where the ABI does not matter
  $<$<C_COMPILER_ID:GNU>:-Wno-psabi>)

# For straight code besides, whose results others judge: terms with a factor that is zero in the
# geometry drop out where 0 x is taken for 0, a twentieth of the time.
set(BICYCLE_STRAIGHT_FLAGS -ffinite-math-only -fno-signed-zeros)

# An object library of kernel code, part of the library `bicycle`.
function(bicycle_kernel_target target)
  target_include_directories(${target} PRIVATE
    ${PROJECT_SOURCE_DIR}/src ${PROJECT_SOURCE_DIR}/src/include)
  target_link_libraries(${target} PRIVATE bicycle_options)
  target_compile_options(${target} PRIVATE ${BICYCLE_KERNEL_FLAGS})
  if(BICYCLE_SANITIZERS) # they run as fast with -O1, and are built in half the time
    target_compile_options(${target} PRIVATE -O1)
  endif()
  if("v4" IN_LIST BICYCLE_LEVELS)
    target_compile_definitions(${target} PRIVATE BICYCLE_X86_64_LEVELS)
  endif()
  target_sources(bicycle PRIVATE $<TARGET_OBJECTS:${target}>)
endfunction()

# Compiles the sources once for each level, with INSTANCE(name) giving name_baseline, name_v3, name_v4.
function(bicycle_instances target)
  foreach(level IN LISTS BICYCLE_LEVELS)
    add_library(${target}_${level} OBJECT ${ARGN})
    bicycle_kernel_target(${target}_${level})
    target_compile_definitions(${target}_${level} PRIVATE
      BICYCLE_LEVEL=${level} BICYCLE_LEVEL_${level})
    if(NOT level STREQUAL "baseline")
      target_compile_options(${target}_${level} PRIVATE -march=x86-64-${level})
    endif()
  endforeach()
endfunction()
