# fjord_library(base SOURCES a.cpp DEPS ...): one target a folder, so that the arrows of
# docs/architecture.md are real: a header is reachable only through a declared dependency.
function(fjord_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPS" ${ARGN})
  add_library(fjord_${name} STATIC ${ARG_SOURCES})
  add_library(fjord::${name} ALIAS fjord_${name})
  target_include_directories(fjord_${name} PUBLIC ${PROJECT_SOURCE_DIR})
  target_link_libraries(fjord_${name} PUBLIC ${ARG_DEPS})
  target_compile_options(fjord_${name} PRIVATE ${FJORD_WARNINGS})
endfunction()

# fjord_test(scene SOURCES a_test.cpp DEPS fjord::scene): a gtest program; every TEST in it becomes
# a ctest test of its own, run in a scratch folder.
function(fjord_test name)
  cmake_parse_arguments(ARG "" "TIMEOUT" "SOURCES;DEPS" ${ARGN})
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 120)
  endif()
  if(FJORD_SANITIZE)  # ten times slower at worst
    math(EXPR ARG_TIMEOUT "10 * ${ARG_TIMEOUT}")
  endif()
  add_executable(fjord_${name}_test ${ARG_SOURCES})
  target_link_libraries(fjord_${name}_test PRIVATE ${ARG_DEPS} fjord::testing GTest::gmock GTest::gtest_main)
  # Optimising the tests themselves is two thirds of their compile time; what they call is optimised.
  target_compile_options(fjord_${name}_test PRIVATE ${FJORD_WARNINGS} $<$<CONFIG:Release>:-O1>)
  target_compile_definitions(fjord_${name}_test PRIVATE FJORD_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  gtest_discover_tests(fjord_${name}_test TEST_PREFIX "${name}." DISCOVERY_TIMEOUT 60
                       PROPERTIES TIMEOUT ${ARG_TIMEOUT})
endfunction()
