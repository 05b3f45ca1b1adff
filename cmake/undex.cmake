# The few rules that every target of the project shares. They hold in this build alone: what is installed does not name them.
add_library(undex_rules INTERFACE)
target_include_directories(undex_rules INTERFACE ${PROJECT_SOURCE_DIR})
target_compile_options(undex_rules INTERFACE -Wall -Wextra -Wpedantic $<$<CXX_COMPILER_ID:GNU>:-Wshadow=local>)
# Vectorisable arithmetic without giving up NaN checks: no errno from math functions, no floating-point traps.
target_compile_options(undex_rules INTERFACE -fno-math-errno -fno-trapping-math)
# Collecting garbage takes GCC a tenth of its time: it may leave half a gigabyte.
target_compile_options(undex_rules INTERFACE $<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-heapsize=524288>)
# A unity build includes sources as if they were headers, whose types in anonymous namespaces GCC warns of; and it inlines more, so that
# GCC 12 sees copies of strings that cannot be.
set(UNDEX_UNITY none CACHE STRING "Modules whose sources are compiled twelve at a time: none, cold (those that compute nothing), all")
if(NOT UNDEX_UNITY MATCHES "^(none|cold|all)$")
  message(FATAL_ERROR "UNDEX_UNITY=${UNDEX_UNITY}: say none, cold or all")
endif()
if(NOT UNDEX_UNITY STREQUAL "none")
  target_compile_options(undex_rules INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage;-Wno-array-bounds;-Wno-stringop-overflow>)
endif()
if(UNDEX_SANITIZE)
  target_compile_options(undex_rules INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(undex_rules INTERFACE -fsanitize=address,undefined)
endif()

if(UNDEX_FUZZ)
  set(sanitizers address,undefined,float-cast-overflow)
  target_compile_options(undex_rules INTERFACE -fsanitize=fuzzer-no-link,${sanitizers} -fno-sanitize-recover=all
    -fno-omit-frame-pointer)
  target_link_options(undex_rules INTERFACE -fsanitize=${sanitizers})
endif()

# gold, where binutils has it: deal.II brings 200 shared libraries, which ld.bfd reads in 15 s for every program and gold in 1.5.
include(CheckLinkerFlag)
check_linker_flag(CXX -fuse-ld=gold UNDEX_HAS_GOLD)
if(UNDEX_HAS_GOLD)
  target_link_options(undex_rules INTERFACE -fuse-ld=gold)
endif()

# Threads everywhere: precompiled headers serve only files that are compiled with the same options.
target_link_libraries(undex_rules INTERFACE OpenMP::OpenMP_CXX)

# What most files include is parsed once; for tests once more, with GoogleTest. (Every file names what it needs all the same: the
# preset "checked" builds without.)
add_library(undex_headers OBJECT ${CMAKE_CURRENT_LIST_DIR}/headers.cpp)
target_link_libraries(undex_headers PRIVATE undex_rules Eigen3::Eigen)
set(UNDEX_HEADERS <algorithm> <array> <atomic> <chrono> <cmath> <cstdint> <cstdio> <filesystem> <fstream> <functional> <limits>
  <map> <memory> <optional> <set> <span> <sstream> <stdexcept> <string> <string_view> <thread> <unordered_map> <variant> <vector>
  ${PROJECT_SOURCE_DIR}/core/vector.hpp)
target_precompile_headers(undex_headers PRIVATE ${UNDEX_HEADERS})

# The modules that work on scenes parse that record, and the settings of all solvers with it, once as well.
if(UNDEX_WITH_FEM)
  add_library(undex_scene_headers OBJECT ${CMAKE_CURRENT_LIST_DIR}/headers.cpp)
  target_link_libraries(undex_scene_headers PRIVATE undex_rules Eigen3::Eigen)
  set(UNDEX_SCENE_HEADERS ${UNDEX_HEADERS} ${PROJECT_SOURCE_DIR}/scene/scene.hpp)
  target_precompile_headers(undex_scene_headers PRIVATE ${UNDEX_SCENE_HEADERS})

  # Modules that compute nothing: what is quick to compile counts. Precompiled headers bring their optimisation with them.
  add_library(undex_cold_rules INTERFACE)
  target_compile_options(undex_cold_rules INTERFACE -O1)
  target_compile_options(undex_cold_rules INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-array-bounds;-Wno-stringop-overflow>)
  add_library(undex_cold_scene_headers OBJECT ${CMAKE_CURRENT_LIST_DIR}/headers.cpp)
  target_link_libraries(undex_cold_scene_headers PRIVATE undex_rules undex_cold_rules Eigen3::Eigen)
  target_precompile_headers(undex_cold_scene_headers PRIVATE ${UNDEX_SCENE_HEADERS})
endif()

# A whole build from nothing takes half the time so, and a change of one file three times as long.
function(undex_unity target cold)
  if(UNDEX_UNITY STREQUAL "all" OR (UNDEX_UNITY STREQUAL "cold" AND cold))
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 12)
  endif()
endfunction()

# undex_module(name [ON_SCENES [COLD]] [PUBLIC libs...] [PRIVATE libs...] SOURCES files...): a library of the project. Private libraries
# of which no more is needed once they are compiled stand between $<BUILD_INTERFACE: and >.
function(undex_module name)
  cmake_parse_arguments(ARG "ON_SCENES;COLD" "" "PUBLIC;PRIVATE;SOURCES" ${ARGN})
  add_library(undex_${name} STATIC ${ARG_SOURCES})
  target_link_libraries(undex_${name} PUBLIC $<BUILD_INTERFACE:undex_rules> OpenMP::OpenMP_CXX ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE})
  undex_unity(undex_${name} "${ARG_ON_SCENES}")
  if(ARG_COLD)
    target_link_libraries(undex_${name} PRIVATE $<BUILD_INTERFACE:undex_cold_rules>)
    target_precompile_headers(undex_${name} REUSE_FROM undex_cold_scene_headers)
  elseif(ARG_ON_SCENES)
    target_precompile_headers(undex_${name} REUSE_FROM undex_scene_headers)
  else()
    target_precompile_headers(undex_${name} REUSE_FROM undex_headers)
  endif()
endfunction()

# undex_test(name [ON_SCENES] LIBS libs... SOURCES files... [SHARDS n]): one GoogleTest executable, one ctest entry per test case;
# or n entries that share the cases, for programs that load deal.II, which takes half a second. What takes long is begun first (COST), so
# that no core is left alone with it at the end.
function(undex_test name)
  cmake_parse_arguments(ARG "ON_SCENES" "SHARDS" "LIBS;SOURCES;LABELS" ${ARGN})
  add_executable(test_${name} ${ARG_SOURCES})
  target_link_libraries(test_${name} PRIVATE undex_test_rules ${ARG_LIBS} GTest::gtest_main)
  set_target_properties(test_${name} PROPERTIES BUILD_RPATH ${PROJECT_BINARY_DIR})  # where undex_meshes lies
  if(ARG_ON_SCENES)
    target_precompile_headers(test_${name} REUSE_FROM undex_scene_test_headers)
  else()
    target_precompile_headers(test_${name} REUSE_FROM undex_test_headers)
  endif()
  if(NOT ARG_SHARDS)
    gtest_discover_tests(test_${name} TEST_PREFIX "${name}." DISCOVERY_TIMEOUT 60
      PROPERTIES TIMEOUT 600 LABELS "${ARG_LABELS}")
    return()
  endif()
  math(EXPR last "${ARG_SHARDS} - 1")
  foreach(shard RANGE ${last})
    add_test(NAME ${name}.shard_${shard} COMMAND test_${name})
    set_tests_properties(${name}.shard_${shard} PROPERTIES TIMEOUT 900 COST 100 LABELS "${ARG_LABELS}"
      ENVIRONMENT "GTEST_TOTAL_SHARDS=${ARG_SHARDS};GTEST_SHARD_INDEX=${shard}")
  endforeach()
endfunction()

# undex_script_tests(script prefix labels): one ctest entry per run of a Python script that lists its runs with --names and takes
# the program, the folder of scenes and a name.
# Debian's own Python has the h5py that opens the field files; another one may not.
function(undex_script_tests script prefix labels)
  find_program(UNDEX_PYTHON python3 PATHS /usr/bin NO_DEFAULT_PATH)
  find_program(UNDEX_PYTHON python3 REQUIRED)
  set(script ${CMAKE_CURRENT_SOURCE_DIR}/${script})
  execute_process(COMMAND ${CMAKE_COMMAND} -E env PYTHONDONTWRITEBYTECODE=1 ${UNDEX_PYTHON} ${script} --names
    OUTPUT_VARIABLE names OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${script})
  string(REPLACE "\n" ";" names "${names}")
  foreach(name IN LISTS names)
    add_test(NAME ${prefix}.${name} COMMAND ${UNDEX_PYTHON} ${script} $<TARGET_FILE:undex> ${PROJECT_SOURCE_DIR}/cases ${name})
    set_tests_properties(${prefix}.${name} PROPERTIES LABELS "${labels}" TIMEOUT 600 COST 10 ENVIRONMENT "PYTHONDONTWRITEBYTECODE=1")
  endforeach()
endfunction()

# The instruction sets that pair loops are compiled for. "native" takes a third of the time, and serves this kind of machine only.
set(UNDEX_CPU_LEVELS all CACHE STRING "Instruction sets of the pair loops: all, native, or a list of v2, v3, v4")
set(levels "${UNDEX_CPU_LEVELS}")
if(levels STREQUAL "all")
  set(levels v4 v3 v2)
elseif(levels STREQUAL "native")
  try_run(ran compiled ${PROJECT_BINARY_DIR}/machine_level ${PROJECT_SOURCE_DIR}/cmake/machine_level.cpp
    CMAKE_FLAGS -DINCLUDE_DIRECTORIES=${PROJECT_SOURCE_DIR} RUN_OUTPUT_VARIABLE levels)
  if(NOT compiled OR NOT levels MATCHES "^v[234]$")
    message(FATAL_ERROR "UNDEX_CPU_LEVELS=native: what this machine can do was not found out (${levels}); name v2, v3 or v4")
  endif()
endif()
set(UNDEX_COMPILED_CPU_LEVELS "")
foreach(level v4 v3 v2)  # the highest first
  if(level IN_LIST levels)
    list(APPEND UNDEX_COMPILED_CPU_LEVELS ${level})
    target_compile_definitions(undex_rules INTERFACE UNDEX_HAS_LEVEL_${level})
  endif()
  list(REMOVE_ITEM levels ${level})
endforeach()
if(levels OR NOT UNDEX_COMPILED_CPU_LEVELS)
  message(FATAL_ERROR "UNDEX_CPU_LEVELS=${UNDEX_CPU_LEVELS}: say all, native, or a list of v2, v3 and v4")
endif()

# undex_pair_loops(name SOURCES files...): files with loops over pairs, compiled once per instruction set (sph_fluid/pairs/simd.hpp);
# the objects are in <name>_pair_loops.
function(undex_pair_loops name)
  cmake_parse_arguments(ARG "" "" "SOURCES" ${ARGN})
  foreach(level IN LISTS UNDEX_COMPILED_CPU_LEVELS)
    set(target undex_${name}_loops_${level})
    add_library(${target} OBJECT ${ARG_SOURCES})
    target_link_libraries(${target} PRIVATE undex_rules)
    undex_unity(${target} FALSE)
    target_compile_options(${target} PRIVATE -march=x86-64-${level} -ffinite-math-only -fno-signed-zeros -fno-trapping-math
      -Wno-psabi -Wno-maybe-uninitialized -Wno-uninitialized)
    if(level STREQUAL v4)
      target_compile_options(${target} PRIVATE -mprefer-vector-width=512)
    endif()
    list(APPEND objects $<TARGET_OBJECTS:${target}>)
  endforeach()
  set(${name}_pair_loops ${objects} PARENT_SCOPE)
endfunction()
