# Generates the kernel files: one for each line of integrators.def, kind of kernel in it, mesh law
# of mesh_laws.def and instruction set. This keeps the compile time of each file short.
include(CheckCXXSourceRuns)
set(GEARPOD_LOCKSTEP_DIR ${CMAKE_CURRENT_LIST_DIR}/..)

# Instruction set of this processor, from the features that machine/instruction_sets.cpp checks.
function(gearpod_find_native_set out)
  set(${out} baseline PARENT_SCOPE)
  if(NOT CMAKE_SYSTEM_PROCESSOR STREQUAL "x86_64" OR CMAKE_CROSSCOMPILING)
    return()
  endif()
  set(has_v3 "__builtin_cpu_supports(\"avx2\") && __builtin_cpu_supports(\"fma\") &&
    __builtin_cpu_supports(\"bmi\") && __builtin_cpu_supports(\"bmi2\")")
  set(has_v4 "${has_v3} && __builtin_cpu_supports(\"avx512f\") && __builtin_cpu_supports(\"avx512bw\") &&
    __builtin_cpu_supports(\"avx512cd\") && __builtin_cpu_supports(\"avx512dq\") &&
    __builtin_cpu_supports(\"avx512vl\")")
  check_cxx_source_runs("int main() { return ${has_v4} ? 0 : 1; }" GEARPOD_HAS_X86_64_V4)
  check_cxx_source_runs("int main() { return ${has_v3} ? 0 : 1; }" GEARPOD_HAS_X86_64_V3)
  if(GEARPOD_HAS_X86_64_V4)
    set(${out} x86_64_v4 PARENT_SCOPE)
  elseif(GEARPOD_HAS_X86_64_V3)
    set(${out} x86_64_v3 PARENT_SCOPE)
  endif()
endfunction()

# Reads the lines MACRO(a, b, ...) of a file into a list of "a|b|...".
function(gearpod_read_table file macro out)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
  file(STRINGS ${file} lines REGEX "^${macro}\\(")
  list(TRANSFORM lines REPLACE "^${macro}\\((.*)\\)$" "\\1")
  list(TRANSFORM lines REPLACE ", *" "|")
  set(${out} ${lines} PARENT_SCOPE)
endfunction()

set(GEARPOD_GENERATED_DIR ${CMAKE_BINARY_DIR}/generated)
gearpod_read_table(${GEARPOD_LOCKSTEP_DIR}/plan/integrators.def GEARPOD_INTEGRATOR gearpod_integrators)
gearpod_read_table(${GEARPOD_LOCKSTEP_DIR}/../dynamics/effects/mesh_laws.def GEARPOD_MESH_LAW gearpod_mesh_laws)

# Generated header that includes the headers of all integrators.
set(includes "#pragma once\n")
foreach(row ${gearpod_integrators})
  string(REPLACE "|" ";" row "${row}")
  list(GET row 2 header)
  string(APPEND includes "#include \"lockstep/integrators/${header}.hpp\"\n")
endforeach()
file(CONFIGURE OUTPUT ${GEARPOD_GENERATED_DIR}/lockstep/integrators/all_integrators.hpp
  CONTENT "${includes}" @ONLY)

# Kernels are compiled with -O3. With sanitizers or full debug information, each would take minutes
# per instruction set. Such builds have one instruction set with little or no optimisation, which
# gives the same bits. Kernels with sanitizers integrate some twenty times as slowly, so that all tests
# would take many hours.
option(GEARPOD_SANITIZE_KERNELS "sanitizers in the kernels, too" ON)
set(gearpod_kernel_options -O3)
if(GEARPOD_SANITIZE OR CMAKE_BUILD_TYPE STREQUAL "Debug")
  set(gearpod_one_set ON)
  if(NOT GEARPOD_SANITIZE)
    set(gearpod_kernel_options -O0)
  elseif(GEARPOD_SANITIZE_KERNELS)
    set(gearpod_kernel_options -O1)
  else()
    list(APPEND gearpod_kernel_options -fno-sanitize=all)
  endif()
  list(APPEND gearpod_kernel_options -DGEARPOD_KERNEL_SET=baseline)
  if(CMAKE_SYSTEM_PROCESSOR STREQUAL "x86_64")
    list(APPEND gearpod_kernel_options -march=x86-64-v3)
  endif()
endif()
list(APPEND gearpod_kernel_options -fno-trapping-math -fno-math-errno)

# Instruction sets of this build, `gearpod_sets`, and the numbers of lanes of each.
option(GEARPOD_PORTABLE "build kernels of all instruction sets and widths, not just this processor's" OFF)
if(gearpod_one_set OR NOT CMAKE_SYSTEM_PROCESSOR STREQUAL "x86_64")
  set(gearpod_sets baseline)
elseif(GEARPOD_PORTABLE)
  set(gearpod_sets baseline x86_64_v3 x86_64_v4)
else()
  gearpod_find_native_set(gearpod_sets)
endif()
function(gearpod_lanes set pair out)
  set(lanes 8 4 1)
  if(pair MATCHES "singles")
    set(lanes 16 8 4 1)
  endif()
  # Narrow kernels gain nothing from wider registers.
  if(NOT GEARPOD_PORTABLE OR set STREQUAL "x86_64_v4")
    list(GET lanes 0 lanes)
  endif()
  list(JOIN lanes "+" lanes)
  set(${out} ${lanes} PARENT_SCOPE)
endfunction()

# Generates a file of kernels, compiled with `options`, with one kernel for each row
# INTEGRATOR:KIND:LAW:SET:LANES, such as rk4:doubles:linear:x86_64_v4:8+1. Appends its path to the
# list `files` and its function's name to `adders`.
function(gearpod_make_kernels name options)
  set(includes "")
  set(calls "")
  foreach(row ${ARGN})
    string(REPLACE ":" ";" row ${row})
    list(GET row 0 integrator)
    list(GET row 1 kind)
    list(GET row 2 law)
    list(GET row 3 set)
    list(GET row 4 lanes)
    set(integrator_line ${gearpod_integrators})
    list(FILTER integrator_line INCLUDE REGEX "^${integrator}\\|")
    set(law_line ${gearpod_mesh_laws})
    list(FILTER law_line INCLUDE REGEX "^${law}\\|")
    string(REPLACE "|" ";" integrator_line "${integrator_line}")
    string(REPLACE "|" ";" law_line "${law_line}")
    list(GET integrator_line 1 method)
    list(GET integrator_line 2 header)
    list(GET law_line 1 mesh)
    list(GET law_line 2 law_header)
    list(APPEND includes dynamics/effects/${law_header} lockstep/integrators/${header}
      lockstep/kernels/integration_kernels)
    string(REPLACE "+" ", " lanes ${lanes})
    string(APPEND calls "
    add_${kind}<machine::InstructionSet::${set}, ${method}, dynamics::${mesh}, ${lanes}>(
        table, {.integrator = Integrator::${integrator}, .law = dynamics::MeshLaw::${law}});")
  endforeach()
  list(REMOVE_DUPLICATES includes)
  list(SORT includes)
  list(TRANSFORM includes REPLACE "(.+)" "#include \"\\1.hpp\"")
  list(JOIN includes "\n" includes)
  set(file ${GEARPOD_GENERATED_DIR}/lockstep/kernels/${name}.cpp)
  file(CONFIGURE OUTPUT ${file} @ONLY CONTENT
"// Made by CMake (src/lockstep/kernels/kernels.cmake).
${includes}

namespace gearpod::lockstep {

void add_${name}(KernelTable& table);
void add_${name}(KernelTable& table) {${calls}
}

}  // namespace gearpod::lockstep
")
  set_source_files_properties(${file} PROPERTIES COMPILE_OPTIONS "${options}")
  set(files ${files} ${file} PARENT_SCOPE)
  set(adders ${adders} add_${name} PARENT_SCOPE)
endfunction()

# Defines a library of such files. Sources compiled with a precompiled header inherit its
# optimisation, so the whole library has the same options. The object code of each file is checked by itself.
function(gearpod_kernel_library name options)
  add_library(${name} OBJECT ${ARGN})
  set_target_properties(${name} PROPERTIES UNITY_BUILD OFF)
  if(TARGET gearpod_kernels AND NOT name STREQUAL gearpod_kernels AND options STREQUAL gearpod_kernel_options)
    target_precompile_headers(${name} REUSE_FROM gearpod_kernels)
  else()
    target_precompile_headers(${name} PRIVATE <lockstep/integrators/all_integrators.hpp>
      <lockstep/kernels/integration_kernels.hpp>)
  endif()
  target_link_libraries(${name} PRIVATE gearpod_options Eigen3::Eigen fmt::fmt Boost::headers)
  target_include_directories(${name} PRIVATE ${GEARPOD_GENERATED_DIR})
  target_compile_options(${name} PRIVATE ${options})
endfunction()

# All pairs INTEGRATOR:KIND of the table.
set(gearpod_kernel_kinds "")
foreach(line ${gearpod_integrators})
  string(REGEX REPLACE "\\|.*" "" integrator "${line}")
  string(REGEX REPLACE ".*\\|" "" kinds "${line}")
  string(REPLACE " " ";" kinds "${kinds}")
  foreach(kind ${kinds})
    list(APPEND gearpod_kernel_kinds ${integrator}:${kind})
  endforeach()
endforeach()
# Names of the mesh laws.
list(TRANSFORM gearpod_mesh_laws REPLACE "\\|.*" "" OUTPUT_VARIABLE gearpod_law_names)

# Generates all kernels of those pairs in this build; appends to `files` and `adders`.
macro(gearpod_make_kernels_of)
  foreach(pair ${ARGN})
    foreach(law ${gearpod_law_names})
      foreach(set ${gearpod_sets})
        gearpod_lanes(${set} ${pair} lanes)
        string(REPLACE ":" "_" name ${pair}_${law}_${set})
        gearpod_make_kernels(${name} "${gearpod_kernel_options}" ${pair}:${law}:${set}:${lanes})
      endforeach()
    endforeach()
  endforeach()
endmacro()

# Generates the source that defines kernel_adders(), with all given functions.
function(gearpod_list_kernels file)
  list(TRANSFORM ARGN REPLACE "(.+)" "void \\1(KernelTable&)" OUTPUT_VARIABLE declarations)
  list(JOIN declarations ";\n" declarations)
  list(JOIN ARGN ",\n    " names)
  file(CONFIGURE OUTPUT ${file} @ONLY CONTENT
"// Made by CMake (src/lockstep/kernels/kernels.cmake).
#include \"lockstep/kernels/kernel_table.hpp\"

namespace gearpod::lockstep {

${declarations};

std::span<const KernelAdder> kernel_adders() {
    static constexpr KernelAdder all[] = {
    ${names}};
    return all;
}

}  // namespace gearpod::lockstep
")
endfunction()
