# Headers that most files read and that never change, read once: std and fmt are half of what the
# compiler does in a file of this project. Every file includes what it uses all the same, which the
# preset `developer` shows. Larger sets (json, Eigen) were slower to load than to read where needed.
# ccache keeps nothing that was compiled with them unless its sloppiness is set.
set(gearpod_pch ON)
if(CMAKE_CXX_COMPILER_LAUNCHER MATCHES "ccache")
  set(gearpod_pch OFF)
endif()
option(GEARPOD_PCH "precompiled headers" ${gearpod_pch})
if(GEARPOD_PCH)
  set(headers <algorithm> <cmath> <complex> <functional> <map> <memory> <optional> <span> <string>
    <string_view> <vector> <fmt/format.h>)
  target_precompile_headers(gearpod_physics PRIVATE ${headers})
  # The flags for threads are part of what must agree.
  target_precompile_headers(gearpod_analysis PRIVATE ${headers} <filesystem>)
  target_precompile_headers(gearpod_mc REUSE_FROM gearpod_analysis)
endif()

# Test programs read Catch2 once; what has a main() of its own sets Catch2 up before it reads it.
function(gearpod_precompile_tests program)
  if(NOT GEARPOD_PCH)
    return()
  endif()
  if(NOT TARGET catch_headers)
    add_library(catch_headers OBJECT ${CMAKE_SOURCE_DIR}/tests/catch_headers.cpp)
    target_link_libraries(catch_headers PRIVATE gearpod_options Threads::Threads)
    target_precompile_headers(catch_headers PRIVATE <catch2/catch.hpp> <cmath> <numbers> <span>)
  endif()
  target_precompile_headers(${program} REUSE_FROM catch_headers)
endfunction()
