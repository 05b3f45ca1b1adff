# The program from outside, one ctest entry per test of command_line.py.
find_program(UNDEX_PYTHON python3 PATHS /usr/bin NO_DEFAULT_PATH)
find_program(UNDEX_PYTHON python3 REQUIRED)
execute_process(COMMAND ${CMAKE_COMMAND} -E env PYTHONDONTWRITEBYTECODE=1
    ${UNDEX_PYTHON} ${CMAKE_CURRENT_LIST_DIR}/command_line.py --names
  OUTPUT_VARIABLE names OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/command_line.py)
string(REPLACE "\n" ";" names "${names}")
foreach(name IN LISTS names)
  add_test(NAME command_line.${name} COMMAND ${UNDEX_PYTHON} ${CMAKE_CURRENT_LIST_DIR}/command_line.py
    $<TARGET_FILE:undex> ${PROJECT_SOURCE_DIR}/cases ${name})
  set_tests_properties(command_line.${name} PROPERTIES LABELS robustness TIMEOUT 600
    ENVIRONMENT "PYTHONDONTWRITEBYTECODE=1;UNDEX_SANITIZE=${UNDEX_SANITIZE}")
endforeach()
