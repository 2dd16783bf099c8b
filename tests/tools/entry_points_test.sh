#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
#
# tools/quickstart and tools/test: what they print, and one clear line for each way to fail. Run in
# a checkout whose setup, project and study are stubs, so that it takes seconds.

. "$(dirname "$0")/harness.sh"

home=$scratch/bondlab
mkdir -p "$home/inputs/studies" "$scratch/cache"
cp -r "$source_dir/tools" "$home/tools"
export BONDLAB_CACHE=$scratch/cache
unset BONDLAB_LIGGGHTS_SOURCE BONDLAB_JOBS CI
cd "$home" || exit 1

printf '#!/bin/sh\nexit 0\n' > tools/setup
cat > CMakePresets.json << 'EOF'
{ "version": 3,
  "configurePresets": [ { "name": "release", "generator": "Ninja", "binaryDir": "${sourceDir}/build" } ],
  "buildPresets": [ { "name": "release", "configurePreset": "release" } ] }
EOF
# project PROGRAM...: a project that "builds" shell scripts of these names.
project() {
  {
    echo 'cmake_minimum_required(VERSION 3.22)'
    echo 'project(stub NONE)'
    echo 'enable_testing()'
    echo 'add_custom_target(bondlab)'
    echo 'add_custom_target(lmp_bondlab)'
    echo 'add_custom_target(the_tests ALL ${CMAKE_COMMAND} -E touch tests_were_built)'
    local program
    for program in "$@"; do
      echo "file(COPY \${CMAKE_SOURCE_DIR}/$program DESTINATION \${CMAKE_BINARY_DIR}/bin"
      echo '  FILE_PERMISSIONS OWNER_READ OWNER_EXECUTE OWNER_WRITE)'
    done
    echo 'add_test(NAME good COMMAND ${CMAKE_COMMAND} -E true)'
    echo 'include(more.cmake OPTIONAL)'
  } > CMakeLists.txt
}
cat > bondlab << 'EOF'
#!/bin/sh
echo "progress"
[ "$1 $2 $3" = "fit inputs/studies/granite.toml --out" ] || exit 1
[ ! -f fails ] || exit 2
mkdir -p "$4"
[ -f silent ] || echo report > "$4/report.html"
EOF
printf '#!/bin/sh\n' > lmp_bondlab
project bondlab lmp_bondlab

# ---- quickstart ----
expect_error 1 "inputs/studies/granite.toml" "checkout complete" -- tools/quickstart
touch inputs/studies/granite.toml
expect_error 1 "takes no arguments" "bondlab fit STUDY" -- tools/quickstart other.toml
capture tools/quickstart
check "quickstart succeeds: $err" test $status = 0
check "its last line is the report: $out" \
  test "$(tail -n 1 <<< "$out")" = "report: bondlab-results/granite/report.html"
check "it prints nothing of its own before: $out" test "$(wc -l <<< "$out")" = 2
check "it does not wait for the tests to be built" test ! -f build/tests_were_built
cd / || exit 1
capture "$home/tools/quickstart"
check "from elsewhere the path is whole: $out" \
  test "$(tail -n 1 <<< "$out")" = "report: $home/bondlab-results/granite/report.html"
cd "$home" || exit 1
rm -r bondlab-results
touch silent
capture tools/quickstart
check "no report is an error: $err" grep -q "wrote no bondlab-results/granite/report.html" <<< "$err"
check "and has a status" test $status = 1
rm silent
touch fails
capture tools/quickstart
check "a failed fit is an error: $err" grep -q "the fit ended with status 2" <<< "$err"
check "and has a status" test $status = 1
rm fails
printf '#!/bin/sh\necho "tools/setup: no network" >&2\nexit 1\n' > tools/setup
expect_error 1 "tools/setup: no network" -- tools/quickstart
expect_error 1 "tools/setup: no network" -- tools/test
printf '#!/bin/sh\nexit 0\n' > tools/setup

# ---- the build ----
project bondlab
rm -r build
expect_error 1 "build/bin/lmp_bondlab was not built" -- tools/quickstart
project bondlab lmp_bondlab
echo 'message(FATAL_ERROR "Ceres is not there")' > more.cmake
expect_error 1 "could not configure" "Ceres is not there" "log:" -- tools/test
echo "law.h:3:5: error: no such law" > message
echo 'add_custom_target(broken ALL sh -c "cat ../message; exit 1")' > more.cmake
expect_error 1 "the build failed" "law.h:3:5: error: no such law" "log:" -- tools/test

# ---- the tests ----
rm more.cmake
capture tools/test
check "tests pass: $out $err" test $status = 0
check "everything was built" test -f build/tests_were_built
check "the first line is ctest's summary: $out" \
  grep -q "^100% tests passed, 0 tests failed out of 1" <(head -n 1 <<< "$out")
check "nothing on stderr: $err" test -z "$err"
cat > more.cmake << 'EOF'
add_test(NAME bad COMMAND sh -c "echo the reason; exit 1")
EOF
capture tools/test
check "a failed test has a status" test $status = 1
check "its output is shown: $out" grep -q "the reason" <<< "$out"
check "ctest's summary too: $out" grep -q "50% tests passed, 1 tests failed out of 2" <<< "$out"
check "passed ones are not: $out" test -z "$(grep good <<< "$out")"
check "one line at the end: $err" grep -q "^tools/test: tests failed" <<< "$err"
capture tools/test -R good
check "ctest's arguments are passed on: $out" test $status = 0
capture tools/test -R no_such_test
check "no test at all is a failure" test $status != 0

finish
