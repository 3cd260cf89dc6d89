# The libraries for other programs: headers, archives and a CMake package (gearpod-config.cmake.in).
# The headers' own includes ("stiffness/...", "analysis/...") are relative to include/gearpod.
include(CMakePackageConfigHelpers)
set(package ${CMAKE_INSTALL_LIBDIR}/cmake/gearpod)
install(TARGETS gearpod_physics gearpod_analysis gearpod_mc ARCHIVE COMPONENT development)
foreach(part src/ analysis mc)
  install(DIRECTORY ${part} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/gearpod COMPONENT development
    FILES_MATCHING PATTERN "*.hpp" PATTERN "*.def" PATTERN "python" EXCLUDE)
endforeach()
configure_package_config_file(cmake/gearpod-config.cmake.in ${CMAKE_BINARY_DIR}/package/gearpod-config.cmake
  INSTALL_DESTINATION ${package} PATH_VARS CMAKE_INSTALL_LIBDIR CMAKE_INSTALL_INCLUDEDIR)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/package/gearpod-config-version.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/package/gearpod-config.cmake
  ${CMAKE_BINARY_DIR}/package/gearpod-config-version.cmake
  DESTINATION ${package} COMPONENT development)
