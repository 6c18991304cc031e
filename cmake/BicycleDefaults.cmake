# SPDX-License-Identifier: Apache-2.0
# What every target of the project shares: language, warnings, where programs land.
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()

set(CMAKE_C_STANDARD 17)
set(CMAKE_C_STANDARD_REQUIRED ON)
set(CMAKE_C_EXTENSIONS ON) # GCC vector types and POSIX
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON) # for clang-tidy
set(CMAKE_C_VISIBILITY_PRESET hidden)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
set(CMAKE_LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/lib)
set(CMAKE_ARCHIVE_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/lib)

option(BICYCLE_SANITIZE "Address and undefined-behaviour sanitizers, errors fatal" OFF)
option(BICYCLE_SANITIZE_THREAD "Thread sanitizer, which the others exclude" OFF)
option(BICYCLE_FUZZ "Fuzz targets as programs of libFuzzer; needs clang, see tests/fuzz.sh" OFF)

add_library(bicycle_options INTERFACE)
target_compile_options(bicycle_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Wvla -Wstrict-prototypes
  -Wmissing-prototypes)
target_compile_definitions(bicycle_options INTERFACE _GNU_SOURCE)
set(BICYCLE_SANITIZERS)
if(BICYCLE_SANITIZE)
  set(BICYCLE_SANITIZERS -fsanitize=address,undefined)
  target_compile_options(bicycle_options INTERFACE -fno-sanitize-recover=all -fno-omit-frame-pointer)
elseif(BICYCLE_SANITIZE_THREAD)
  set(BICYCLE_SANITIZERS -fsanitize=thread)
endif()
if(BICYCLE_SANITIZERS)
  target_compile_options(bicycle_options INTERFACE ${BICYCLE_SANITIZERS})
  target_link_options(bicycle_options INTERFACE ${BICYCLE_SANITIZERS})
endif()
if(BICYCLE_FUZZ)
  target_compile_options(bicycle_options INTERFACE -fsanitize=fuzzer-no-link)
endif()
