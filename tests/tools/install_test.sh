#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
#
# `cmake --install` gives a tree that works by itself: programs side by side, decks and studies in
# share/bondlab/inputs, found from there whatever the directory.

. "$(dirname "$0")/harness.sh"

[ -x "$build_dir/bin/bondlab" ] && [ -x "$build_dir/bin/lmp_bondlab" ] || skip "not built"
prefix=$scratch/prefix
capture cmake --install "$build_dir" --prefix "$prefix"
check "it installs: $err" test $status = 0
for file in bin/bondlab bin/lmp_bondlab share/doc/bondlab/LICENSE \
  share/bondlab/inputs/uniaxial_compression/in.uniaxial_compression \
  share/bondlab/inputs/brazilian/test.toml share/bondlab/inputs/studies/granite.toml; do
  check "$file is installed" test -s "$prefix/$file"
done

# A study elsewhere names its tests; a mark in the installed deck shows that it is the one used.
mkdir "$scratch/elsewhere"
cd "$scratch/elsewhere" || exit 1
cp "$prefix/share/bondlab/inputs/studies/granite_small.toml" mine.toml
capture "$prefix/bin/bondlab" check mine.toml
check "the installed program checks a study elsewhere: $out $err" test $status = 0
echo "nonsense = [" >> "$prefix/share/bondlab/inputs/uniaxial_compression/test.toml"
capture "$prefix/bin/bondlab" check mine.toml
check "the installed test.toml is the one that counts: $out" test $status = 1
check "and is named: $err" grep -q "$prefix/share/bondlab/inputs/uniaxial_compression/test.toml" <<< "$err"
check "nothing is written by a check" test "$(ls)" = mine.toml

finish
