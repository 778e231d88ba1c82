# Tests of unit binaries, one for each suite: a process takes 0.03 s to start, and what a suite shares (SetUpTestSuite) is
# made once. A single case: bin/unit_core --gtest_filter=Suite.Case; what ran of a suite stands in its output.
#
# gambeson_suites(TARGET PROPERTIES ...) has ctest ask the binary for its suites when it runs, as gtest_discover_tests
# does by PRE_TEST.
function(gambeson_suites target)
  cmake_parse_arguments(ARG "" "" "PROPERTIES" ${ARGN})
  set(script ${CMAKE_CURRENT_BINARY_DIR}/${target}_suites.cmake)
  list(JOIN ARG_PROPERTIES " " properties)
  # "$<...>" is the binary; what stands with @ is the configuration's.
  file(CONFIGURE OUTPUT ${script}.in @ONLY CONTENT [==[
set(binary "$<TARGET_FILE:@target@>")
if(NOT EXISTS "${binary}")
  add_test(@target@_NOT_BUILT "${binary}")
  return()
endif()
execute_process(COMMAND "${binary}" --gtest_list_tests OUTPUT_VARIABLE listed RESULT_VARIABLE result)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "${binary} does not list its tests: ${result}")
endif()
# Suites begin a line, their cases are indented; behind "#" stands what a case is about.
string(REGEX REPLACE "[][;]" "_" listed "${listed}")
string(REGEX MATCHALL "(^|\n)[A-Za-z_0-9/]+[.]" suites "${listed}")
foreach(suite IN LISTS suites)
  string(REGEX REPLACE "[\n.]" "" suite "${suite}")
  add_test("${suite}" "${binary}" "--gtest_filter=${suite}.*")
  # Skipped where all its cases were, which the last lines say.
  set_tests_properties("${suite}" PROPERTIES SKIP_REGULAR_EXPRESSION
    "\\[  PASSED  \\] 0 tests[.]\n\\[  SKIPPED \\] [0-9]+ tests?, listed below:\n(\\[  SKIPPED \\] [^\n]*\n)+$" @properties@)
endforeach()
]==])
  file(GENERATE OUTPUT ${script} INPUT ${script}.in)
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${script})
endfunction()
