# SPDX-License-Identifier: Apache-2.0
# Installed as mujoco_rollingConfig.cmake: defines mujoco::rolling.
include(CMakeFindDependencyMacro)
list(PREPEND CMAKE_MODULE_PATH ${CMAKE_CURRENT_LIST_DIR})
find_dependency(MuJoCo MODULE)
list(POP_FRONT CMAKE_MODULE_PATH)
include(${CMAKE_CURRENT_LIST_DIR}/mujoco_rollingTargets.cmake)
