# SPDX-License-Identifier: BSD-2-Clause
# What `cmake --install` puts in place: the command with all it needs to bake, the library,
# its public headers, and a package that an outside CMake project finds:
#   find_package(gearmap)   targets gearmap::gm (the library), gearmap::core (C99, libm)
include(CMakePackageConfigHelpers)

set(gm_share "${CMAKE_INSTALL_DATADIR}/gearmap")
set(gm_package "${CMAKE_INSTALL_LIBDIR}/cmake/gearmap")

set_target_properties(gm PROPERTIES EXPORT_NAME gm)
set_target_properties(gm_core PROPERTIES EXPORT_NAME core)
install(TARGETS gm_cli RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(TARGETS gm gm_core EXPORT gearmap-targets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})

# Public headers are those with the prefix; the room is part of the include path.
foreach(room core base model map plant solve sweep bake)
  file(GLOB headers CONFIGURE_DEPENDS
    "${PROJECT_SOURCE_DIR}/src/${room}/gm_*.h" "${PROJECT_SOURCE_DIR}/src/${room}/gm_*.def")
  install(FILES ${headers} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/gearmap/${room})
endforeach()

# The sources that a bake ships are installed by fmu/CMakeLists.txt.
install(DIRECTORY examples/ DESTINATION ${gm_share}/examples
  FILES_MATCHING PATTERN "*.yaml" PATTERN "*.py" PATTERN "*.c" PATTERN "*.md")

# A static library is linked with what it uses; the package finds that again.
get_target_property(gm_uses gm LINK_LIBRARIES)
set(GM_PACKAGE_DEPENDENCIES "")
foreach(package SUNDIALS SQLite3 Threads)
  string(REGEX REPLACE "[0-9]+$" "" namespace ${package})
  if("${gm_uses}" MATCHES "${namespace}::")
    string(APPEND GM_PACKAGE_DEPENDENCIES "find_dependency(${package})\n")
  endif()
endforeach()

install(EXPORT gearmap-targets NAMESPACE gearmap:: DESTINATION ${gm_package})
configure_package_config_file(cmake/gearmap-config.cmake.in gearmap-config.cmake
  INSTALL_DESTINATION ${gm_package})
write_basic_package_version_file(gearmap-config-version.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/gearmap-config.cmake"
  "${PROJECT_BINARY_DIR}/gearmap-config-version.cmake" DESTINATION ${gm_package})
