# SPDX-License-Identifier: MIT
#
# Installs the headers, a CMake package and a pkg-config file. Nothing here depends on the architecture.
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)

set(package_dir "${CMAKE_INSTALL_DATADIR}/cmake/shadowmath")

install(TARGETS shadowmath EXPORT shadowmath FILE_SET HEADERS DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
install(DIRECTORY include/shadowmath DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" FILES_MATCHING PATTERN "*.glsl")
install(EXPORT shadowmath NAMESPACE shadowmath:: FILE shadowmathTargets.cmake DESTINATION "${package_dir}")

# While the major version is 0, a minor version may break a user.
write_basic_package_version_file("${PROJECT_BINARY_DIR}/shadowmathConfigVersion.cmake"
                                 COMPATIBILITY SameMinorVersion ARCH_INDEPENDENT)
install(FILES "${PROJECT_BINARY_DIR}/shadowmathConfigVersion.cmake" cmake/shadowmathConfig.cmake
        DESTINATION "${package_dir}")

# The prefix is relative to the .pc file, so that the installed tree can be moved.
string(REGEX REPLACE "[^/]+" ".." up_to_prefix "${CMAKE_INSTALL_DATADIR}/pkgconfig")
configure_file(cmake/shadowmath.pc.in "${PROJECT_BINARY_DIR}/shadowmath.pc" @ONLY)
install(FILES "${PROJECT_BINARY_DIR}/shadowmath.pc" DESTINATION "${CMAKE_INSTALL_DATADIR}/pkgconfig")
