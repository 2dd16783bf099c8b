#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
#
# tools/bench on a packing of its own: the form of its output, that its figures can be right, and
# its errors.

. "$(dirname "$0")/harness.sh"

program=$build_dir/bin/lmp_bondlab
[ -x "$program" ] || skip "lmp_bondlab is not built"
bench() { "$source_dir/tools/bench" --program="$program" "$@"; }

# A brick of 8 x 8 x 16 touching spheres, bonded to their six neighbours.
export BONDLAB_PACKINGS=$scratch
awk 'BEGIN { for (k = 0; k < 16; k++) for (j = 0; j < 8; j++) for (i = 0; i < 8; i++)
  print 2e-4 * i, 2e-4 * j, 2e-4 * k + 1e-4, 1e-4 }' > "$scratch/brick.xyzr"
awk 'BEGIN { for (k = 0; k < 16; k++) for (j = 0; j < 8; j++) for (i = 0; i < 8; i++) {
  n = i + 8 * (j + 8 * k)
  if (i < 7) print n, n + 1
  if (j < 7) print n, n + 8
  if (k < 15) print n, n + 64 } }' > "$scratch/brick.bonds"

capture bench --json --case=brick --ranks=1,2 --repeats=1 --seconds=1
check "status 0: $err" test $status = 0
check "one line for each number of ranks: $out" test "$(wc -l <<< "$out")" = 2
form='^\{"case": "brick", "law": "parallel", "particles": 1024, "bonds": 2752, "ranks": [12], "ns_per_bond_step": [0-9]+\.[0-9]+, "bytes_per_bond": [0-9]+\}$'
check "form of the lines: $out" test "$(grep -cE "$form" <<< "$out")" = 2
# A bond holds two tags and some eight doubles at the very least, and is computed in no less than a
# nanosecond; a cut bond is stored twice.
values=$(sed -E 's/.*step": ([0-9.]+), "bytes_per_bond": ([0-9]+).*/\1 \2/' <<< "$out")
check "figures are possible: $values" \
  awk '$1 < 1 || $2 < 72 || $2 > 2000 { bad = 1 } END { exit bad }' <<< "$values"

first=$(sed -n 's/.*"ranks": 1,.*bytes_per_bond": //p' <<< "$out")

# Every law has its usual coefficients, and others can be given.
for law in parallel_alone beam/mohr/coulomb norton; do
  capture bench --json --case=brick --ranks=1 --repeats=1 --seconds=1 --law=$law
  check "law $law: $out $err" grep -q "\"law\": \"$law\".*ns_per_bond_step" <<< "$out"
done
capture bench --json --case=brick --ranks=1 --repeats=1 --seconds=1 --words="5e9 2 1e30 1e30 damping 0.1"
check "words of one's own: $err" test $status = 0

# The same as a specimen file with ids in another order: the same bonds, so the same memory.
awk 'BEGIN { print "# brick\n\n1024 atoms\n\nAtoms\n" }
  { printf "%d 1 2e-4 2500 %s %s %s\n", 2000 - NR, $1, $2, $3 }' "$scratch/brick.xyzr" > "$scratch/same.data"
{ echo "# pairs"; awk '{ print 1999 - $1, 1999 - $2 }' "$scratch/brick.bonds"; } > "$scratch/same.bonds"
capture bench --json --case=same --ranks=1 --repeats=1 --seconds=1
check "a specimen file gives the same: $out $err" grep -q \
  "\"particles\": 1024, \"bonds\": 2752, .*bytes_per_bond\": $first" <<< "$out"

expect_error 1 "no packing of 'nowhere'" "BONDLAB_PACKINGS" -- bench --case=nowhere
expect_error 1 "unknown argument '--fast'" -- bench --fast
expect_error 1 "'0' is not a whole number" -- bench --repeats=0
expect_error 1 "'two' is not a whole number" -- bench --ranks=1,two
expect_error 1 "$scratch/none is not there" -- bench --program="$scratch/none"
expect_error 1 "don't know the coefficients of 'no_such_law'" -- bench --law=no_such_law
capture bench --json --case=brick --ranks=1 --law=no_such_law --words="1e9 2 3 4"
check "an unknown law is an error: $err" grep -q "the engine failed: ERROR.*bond style" <<< "$err"
check "and prints no case: $out" test -z "$out"
echo "0 1024" >> "$scratch/brick.bonds"
capture bench --json --case=brick --ranks=1
check "a bond to no particle is an error: $out $err" test $status = 1

finish
