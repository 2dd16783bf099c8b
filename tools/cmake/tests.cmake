# SPDX-License-Identifier: GPL-2.0-or-later
#
# The test programs and how ctest runs them. Included by CMakeLists.txt.
#
# Labels: physics (laws, engine-free), unit (optimiser and tools), engine (start lmp_bondlab),
# study (whole studies), papers (published tables, reduced). Studies start several runs, as many as
# there are cores: nothing goes beside them. Engine tests go side by side; those of several ranks
# see to it themselves that no other of them runs meanwhile (tests/engine/engine_run.h).

file(GLOB law_tests CONFIGURE_DEPENDS bond_styles/laws/*_test.cpp fix_styles/*_test.cpp)
file(GLOB_RECURSE unit_tests CONFIGURE_DEPENDS optimizer/*_test.cpp)
file(GLOB engine_tests CONFIGURE_DEPENDS tests/engine/*.cpp)
file(GLOB study_tests CONFIGURE_DEPENDS tests/study/*.cpp)
file(GLOB papers_tests CONFIGURE_DEPENDS tests/papers/*.cpp)
file(GLOB tool_tests CONFIGURE_DEPENDS tests/tools/*_test.sh)

set(test_definitions
  BONDLAB_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
  BONDLAB_BIN="$<IF:$<TARGET_EXISTS:bondlab>,${CMAKE_RUNTIME_OUTPUT_DIRECTORY}/bondlab,>"
  BONDLAB_LMP="${CMAKE_RUNTIME_OUTPUT_DIRECTORY}/lmp_bondlab"
  BONDLAB_MPIRUN="${MPIEXEC_EXECUTABLE}"
  BONDLAB_VERSION="${PROJECT_VERSION}")

# add_tests(NAME exe LABEL label TIMEOUT s [SERIAL] SOURCES ... LIBRARIES ...)
function(add_tests)
  cmake_parse_arguments(T "SERIAL" "NAME;LABEL;TIMEOUT" "SOURCES;LIBRARIES" ${ARGN})
  add_executable(${T_NAME} ${T_SOURCES})
  target_compile_definitions(${T_NAME} PRIVATE ${test_definitions})
  # What is tested is compiled as in the program; the tests' own code need not be fast.
  target_compile_options(${T_NAME} PRIVATE -O1 ${warnings} ${sanitize})
  target_link_options(${T_NAME} PRIVATE ${sanitize})
  target_link_libraries(${T_NAME} PRIVATE ${T_LIBRARIES} GTest::gtest GTest::gtest_main)
  precompile(${T_NAME} <gtest/gtest.h>)
  set(properties LABELS ${T_LABEL} TIMEOUT ${T_TIMEOUT})
  if(T_SERIAL)
    list(APPEND properties PROCESSORS 2 RUN_SERIAL TRUE)
  endif()
  gtest_discover_tests(${T_NAME} DISCOVERY_MODE PRE_TEST DISCOVERY_TIMEOUT 60
    WORKING_DIRECTORY ${PROJECT_BINARY_DIR} PROPERTIES ${properties})
endfunction()

if(law_tests)
  add_tests(NAME law_tests LABEL physics TIMEOUT 300 SOURCES ${law_tests} LIBRARIES bondlab_laws)
  target_include_directories(law_tests PRIVATE
    ${PROJECT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/bond_styles ${PROJECT_SOURCE_DIR}/fix_styles)
  # Laws are headers: here they are compiled with the tests, so as in the program.
  target_compile_options(law_tests PRIVATE -O3 ${arch_flags} ${kernel_flags})
endif()

if(unit_tests AND TARGET bondlab_core)
  add_tests(NAME unit_tests LABEL unit TIMEOUT 300 SOURCES ${unit_tests}
    LIBRARIES $<TARGET_NAME_IF_EXISTS:bondlab_app> bondlab_core)
endif()

if(engine_tests AND have_engine)
  add_tests(NAME engine_tests LABEL engine TIMEOUT 600 SOURCES ${engine_tests}
    LIBRARIES bondlab_laws)
  target_include_directories(engine_tests PRIVATE ${PROJECT_SOURCE_DIR}
    ${PROJECT_SOURCE_DIR}/bond_styles ${PROJECT_SOURCE_DIR}/fix_styles
    ${PROJECT_SOURCE_DIR}/optimizer)
  add_dependencies(engine_tests lmp_bondlab)
endif()

if(study_tests AND have_engine AND TARGET bondlab)
  add_tests(NAME study_tests LABEL study TIMEOUT 1200 SERIAL SOURCES ${study_tests}
    LIBRARIES bondlab_core)
  add_dependencies(study_tests lmp_bondlab bondlab)
endif()

if(papers_tests AND have_engine AND TARGET bondlab)
  add_tests(NAME papers_tests LABEL papers TIMEOUT 1200 SERIAL SOURCES ${papers_tests}
    LIBRARIES bondlab_core)
  add_dependencies(papers_tests lmp_bondlab bondlab)
endif()

# Tests of the tools are shell scripts: exit status 0 means passed, output is shown on failure.
foreach(script ${tool_tests})
  get_filename_component(name ${script} NAME_WE)
  add_test(NAME tools.${name} COMMAND ${script} ${PROJECT_SOURCE_DIR} ${PROJECT_BINARY_DIR})
  if(name STREQUAL "readme_test")
    # The README's commands run studies.
    set_tests_properties(tools.${name} PROPERTIES LABELS study TIMEOUT 1200 RUN_SERIAL TRUE)
  elseif(name STREQUAL "bench_test")
    set_tests_properties(tools.${name} PROPERTIES LABELS engine TIMEOUT 300)
  else()
    set_tests_properties(tools.${name} PROPERTIES LABELS unit TIMEOUT 300)
  endif()
  set_tests_properties(tools.${name} PROPERTIES SKIP_RETURN_CODE 77)
endforeach()
