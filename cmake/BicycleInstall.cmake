# SPDX-License-Identifier: Apache-2.0
# How other projects find the library: CMake package bicycle::bicycle and pkg-config's bicycle.pc.
include(CMakePackageConfigHelpers)

install(TARGETS bicycle EXPORT bicycle-targets
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY src/include/bicycle DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT bicycle-targets NAMESPACE bicycle::
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/bicycle FILE bicycle-config.cmake)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/bicycle-config-version.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/bicycle-config-version.cmake
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/bicycle)

# From the folder of bicycle.pc back to the prefix, which may be a multiarch library folder away.
file(RELATIVE_PATH bicycle_pc_to_prefix /p/${CMAKE_INSTALL_LIBDIR}/pkgconfig /p)
configure_file(cmake/bicycle.pc.in ${PROJECT_BINARY_DIR}/bicycle.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/bicycle.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
