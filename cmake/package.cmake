# The libraries for other programs: headers, archives and a CMake package (gearpod-config.cmake.in).
# The headers' own includes ("stiffness/...", "analysis/...") are relative to include/gearpod.
include(CMakePackageConfigHelpers)
set(package ${CMAKE_INSTALL_LIBDIR}/cmake/gearpod)
install(TARGETS gearpod_physics gearpod_analysis gearpod_mc ARCHIVE COMPONENT development)
# A program that links the archives keeps its own sin(), exp(), ...: the archives call __wrap_sin and so on.
list(TRANSFORM gearpod_wrapped_functions REPLACE "(.+)" "\\1 __wrap_\\1" OUTPUT_VARIABLE renames)
list(JOIN renames "\n" renames)
file(WRITE ${CMAKE_BINARY_DIR}/package/wrapped_functions "${renames}\n")
install(CODE "foreach(library physics analysis mc)
  execute_process(COMMAND ${CMAKE_OBJCOPY} --redefine-syms=${CMAKE_BINARY_DIR}/package/wrapped_functions
    \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_LIBDIR}/libgearpod_\${library}.a\"
    COMMAND_ERROR_IS_FATAL ANY)
endforeach()" COMPONENT development)
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
