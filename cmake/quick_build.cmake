# What spares the compiler work that it would do again in every file, for those who build once: the
# files of a folder, or of folders that use the same things, are compiled together, and headers that
# most files read and that never change are read once. In an ordinary file of this project reading
# std, fmt, json or Eigen and writing out their templates is two thirds of the compiler's work. Every
# file includes what it uses all the same, and compiles alone: the presets for debugging and
# sanitizers do without. ccache keeps nothing that was compiled with precompiled headers unless its
# sloppiness is set.
set(gearpod_quick ON)
if(CMAKE_CXX_COMPILER_LAUNCHER MATCHES "ccache")
  set(gearpod_quick OFF)
endif()
option(GEARPOD_QUICK "files of folders compiled together, with precompiled headers" ${gearpod_quick})

# The target's files, by folder, or by the folders that an argument names. No two of a group name
# something alike for themselves: move a folder to another group where they do. None of those with
# options of their own (kernels).
function(gearpod_unite target)
  get_target_property(folder ${target} SOURCE_DIR)
  string(REPLACE " " ";" named "${ARGN}")
  foreach(name ${named})
    if(NOT IS_DIRECTORY ${folder}/${name})
      message(FATAL_ERROR "gearpod_unite(${target}) names ${name}, which is no folder of ${folder}")
    endif()
  endforeach()
  get_target_property(files ${target} SOURCES)
  foreach(file ${files})
    file(RELATIVE_PATH name ${folder} ${file})
    get_filename_component(group ${name} DIRECTORY)
    foreach(together ${ARGN})
      string(FIND " ${together} " " ${group} " at)
      if(at GREATER -1)
        set(group ${together})
      endif()
    endforeach()
    string(MAKE_C_IDENTIFIER "in_${group}" group)
    set_source_files_properties(${file} TARGET_DIRECTORY ${target} PROPERTIES UNITY_GROUP "${group}")
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
endfunction()

if(GEARPOD_QUICK)
  set(headers <algorithm> <cmath> <complex> <functional> <map> <memory> <optional> <span> <string>
    <string_view> <vector> <fmt/format.h>)
  target_precompile_headers(gearpod_physics PRIVATE ${headers})
  # The flags for threads are part of what must agree.
  target_precompile_headers(gearpod_run_analysis PRIVATE ${headers} <filesystem>)
  foreach(library gearpod_analysis gearpod_run_mc gearpod_mc)
    target_precompile_headers(${library} REUSE_FROM gearpod_run_analysis)
  endforeach()
  gearpod_unite(gearpod_physics
    "features gears machine"
    "lockstep/excitation lockstep/integrators lockstep/plan lockstep/steps lockstep/tile"
    "signals signals/noise signals/path signals/sensor signals/spectra signals/windowing"
    "stiffness stiffness/contact stiffness/foundation stiffness/growth stiffness/teeth")
  gearpod_unite(gearpod_run_analysis) # folders together are no faster here
  gearpod_unite(gearpod_analysis)
  gearpod_unite(gearpod_run_mc
    "files random" "ensemble gearbox" "forecast input numerics run summary"
    "scene study study/keys study/reading study/schema")
  gearpod_unite(gearpod_mc
    "accuracy description files sweep" "calibration lives new_study recordings" "ensemble gearbox")
  foreach(part gearpod_run gearpod_command_line)
    set_target_properties(${part} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 0)
  endforeach()
endif()

# Files of kernels hold little else than one line for the templates that all of them read; those of a
# library with the options of another read that one's.
function(gearpod_precompile_kernels library)
  if(GEARPOD_QUICK AND ARGN)
    target_precompile_headers(${library} REUSE_FROM ${ARGN})
  elseif(GEARPOD_QUICK)
    target_precompile_headers(${library} PRIVATE <lockstep/integrators/all_integrators.hpp>
      <lockstep/kernels/steady_kernels.hpp> <lockstep/kernels/forced_kernels.hpp>
      <lockstep/kernels/variable_speed_kernels.hpp>)
  endif()
endfunction()
gearpod_precompile_kernels(gearpod_first_kernels)
gearpod_precompile_kernels(gearpod_kernels gearpod_first_kernels)

# Test programs read Catch2 once; what has a main() of its own sets Catch2 up before it reads it. One
# whose files mostly read some further headers reads those once too.
function(gearpod_precompile_tests program)
  if(NOT GEARPOD_QUICK)
    return()
  endif()
  set(headers <catch2/catch.hpp> <cmath> <numbers> <span>)
  if(ARGN)
    target_precompile_headers(${program} PRIVATE ${headers} ${ARGN})
    return()
  endif()
  if(NOT TARGET catch_headers)
    add_library(catch_headers OBJECT ${CMAKE_SOURCE_DIR}/tests/catch_headers.cpp)
    target_link_libraries(catch_headers PRIVATE gearpod_options Threads::Threads)
    target_precompile_headers(catch_headers PRIVATE ${headers})
  endif()
  target_precompile_headers(${program} REUSE_FROM catch_headers)
endfunction()

# Files of tests are compiled together by folder, each in a namespace of its own (unite_tests.cmake).
function(gearpod_unite_tests program)
  if(NOT GEARPOD_QUICK)
    return()
  endif()
  get_target_property(files ${program} SOURCES)
  list(FILTER files INCLUDE REGEX "/test_[^/]*\\.cpp$")
  set_source_files_properties(${files} PROPERTIES HEADER_FILE_ONLY ON)
  set(folders "")
  foreach(file ${files})
    cmake_path(GET file PARENT_PATH folder)
    list(APPEND folders ${folder})
    list(APPEND files_of_${folder} ${file})
  endforeach()
  list(REMOVE_DUPLICATES folders)
  set(script ${CMAKE_SOURCE_DIR}/cmake/unite_tests.cmake)
  foreach(folder ${folders})
    cmake_path(GET folder FILENAME name)
    set(united ${CMAKE_CURRENT_BINARY_DIR}/united/${program}_${name}.cpp)
    add_custom_command(OUTPUT ${united}
      COMMAND ${CMAKE_COMMAND} -DOUTPUT=${united} "-DFILES=${files_of_${folder}}" -P ${script}
      DEPENDS ${files_of_${folder}} ${script} VERBATIM)
    target_sources(${program} PRIVATE ${united})
  endforeach()
endfunction()
