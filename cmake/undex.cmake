# The few rules that every target of the project shares.
add_library(undex_rules INTERFACE)
target_include_directories(undex_rules INTERFACE ${PROJECT_SOURCE_DIR})
target_compile_options(undex_rules INTERFACE -Wall -Wextra -Wpedantic -Wshadow=local)
# Vectorisable arithmetic without giving up NaN checks: no errno from math functions, no floating-point traps.
target_compile_options(undex_rules INTERFACE -fno-math-errno -fno-trapping-math)
if(UNDEX_SANITIZE)
  target_compile_options(undex_rules INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(undex_rules INTERFACE -fsanitize=address,undefined)
endif()

# undex_module(name [PUBLIC libs...] [PRIVATE libs...] SOURCES files...): a library of the project.
function(undex_module name)
  cmake_parse_arguments(ARG "" "" "PUBLIC;PRIVATE;SOURCES" ${ARGN})
  add_library(undex_${name} STATIC ${ARG_SOURCES})
  target_link_libraries(undex_${name} PUBLIC undex_rules ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE})
endfunction()

# undex_test(name LIBS libs... SOURCES files...): one GoogleTest executable, one ctest entry per test case.
function(undex_test name)
  cmake_parse_arguments(ARG "" "" "LIBS;SOURCES;LABELS" ${ARGN})
  add_executable(test_${name} ${ARG_SOURCES})
  target_link_libraries(test_${name} PRIVATE undex_rules ${ARG_LIBS} GTest::gtest_main)
  gtest_discover_tests(test_${name} TEST_PREFIX "${name}." DISCOVERY_TIMEOUT 60
    PROPERTIES TIMEOUT 600 LABELS "${ARG_LABELS}")
endfunction()
