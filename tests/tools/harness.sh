# SPDX-License-Identifier: GPL-2.0-or-later
# shellcheck shell=bash
#
# What the shell tests of the tools share: a scratch directory, checks that print what they saw.
#
# A test script is called as SCRIPT SOURCE_DIR BUILD_DIR and ends with `finish`. Status 0: passed,
# 1: some check failed, 77: skipped (said why).

set -u
source_dir=${1:?usage: SCRIPT SOURCE_DIR BUILD_DIR}
build_dir=${2:?usage: SCRIPT SOURCE_DIR BUILD_DIR}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
export LC_ALL=C
failures=0
checks=0

fail() {
  echo "FAILED: $*"
  failures=$((failures + 1))
}

# check WHAT COMMAND...: the command succeeds.
check() {
  local what=$1
  shift
  checks=$((checks + 1))
  "$@" || fail "$what"
}

# capture COMMAND...: sets status, out and err.
capture() {
  status=0
  "$@" > "$scratch/stdout" 2> "$scratch/stderr" < /dev/null || status=$?
  out=$(cat "$scratch/stdout")
  err=$(cat "$scratch/stderr")
}

# expect_error STATUS PART... -- COMMAND...: the command ends with STATUS, prints nothing but one
# line on stderr, and this line holds every PART.
expect_error() {
  local wanted=$1 parts=() part
  shift
  while [ "$1" != -- ]; do
    parts+=("$1")
    shift
  done
  shift
  checks=$((checks + 1))
  capture "$@"
  local before=$failures
  [ $status = "$wanted" ] || fail "status $status, expected $wanted"
  [ -z "$out" ] || fail "something on stdout"
  [ "$(wc -l < "$scratch/stderr")" = 1 ] || fail "not exactly one line on stderr"
  for part in "${parts[@]}"; do
    case $err in
      *"$part"*) ;;
      *) fail "no '$part' in the message" ;;
    esac
  done
  if [ $failures != "$before" ]; then
    echo "  command: $*"
    echo "  stdout:  $out"
    echo "  stderr:  $err"
  fi
}

# expect_quiet COMMAND...: the command succeeds and prints nothing.
expect_quiet() {
  checks=$((checks + 1))
  capture "$@"
  if [ $status != 0 ] || [ -n "$out$err" ]; then
    fail "not quiet success: $* (status $status)"
    echo "  stdout:  $out"
    echo "  stderr:  $err"
  fi
}

skip() {
  echo "skipped: $*"
  exit 77
}

finish() {
  echo "$checks checks, $failures failed"
  [ $failures = 0 ]
  exit
}
