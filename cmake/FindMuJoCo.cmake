# SPDX-License-Identifier: Apache-2.0
# MuJoCo 2.2 as Debian packs it (libmujoco-dev): the package's own CMake files ask for folders and
# for OpenGL that a headless program does not need, so header and library are found plainly.
# Defines the imported target MuJoCo::MuJoCo.
find_path(MUJOCO_INCLUDE_DIR mujoco/mujoco.h)
find_library(MUJOCO_LIBRARY mujoco)
if(MUJOCO_INCLUDE_DIR)
  file(STRINGS ${MUJOCO_INCLUDE_DIR}/mujoco/mujoco.h mujoco_version_line
    REGEX "#define mjVERSION_HEADER ")
  string(REGEX MATCH "[0-9]+" MUJOCO_VERSION_NUMBER "${mujoco_version_line}")
endif()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(MuJoCo
  REQUIRED_VARS MUJOCO_LIBRARY MUJOCO_INCLUDE_DIR)
if(MuJoCo_FOUND AND NOT TARGET MuJoCo::MuJoCo)
  if(MUJOCO_VERSION_NUMBER LESS 220 OR MUJOCO_VERSION_NUMBER GREATER 229)
    message(FATAL_ERROR "MuJoCo 2.2 is needed, found mjVERSION_HEADER ${MUJOCO_VERSION_NUMBER}")
  endif()
  add_library(MuJoCo::MuJoCo UNKNOWN IMPORTED)
  set_target_properties(MuJoCo::MuJoCo PROPERTIES
    IMPORTED_LOCATION ${MUJOCO_LIBRARY}
    INTERFACE_SYSTEM_INCLUDE_DIRECTORIES ${MUJOCO_INCLUDE_DIR}
    INTERFACE_INCLUDE_DIRECTORIES ${MUJOCO_INCLUDE_DIR})
endif()
