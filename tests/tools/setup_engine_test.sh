#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
#
# The engine's cache: built once, keyed by source, compiler and resolved flags, never half there.

. "$(dirname "$0")/harness.sh"
. "$(dirname "$0")/fake_system.sh"

fake_tree "$scratch/good"
tree=$scratch/good
sums() { (cd "$1" && find . -type f -exec sha256sum {} + | sort); }
before=$(sums "$tree")

# A compiler that counts its calls and can be made slow.
stub counting-g++ << EOF
case " \$* " in *" -c "*)
  echo call >> "$scratch/calls"
  [ ! -f "$scratch/slow" ] || sleep 2 ;;
esac
exec "$stubs/g++" "\$@"
EOF
compiler=counting-g++
calls() { if [ -f "$scratch/calls" ]; then wc -l < "$scratch/calls"; else echo 0; fi; }

# ---- an interrupted build leaves nothing ----
touch "$scratch/slow"
set -m  # a process group of its own, ended as a whole like from a terminal
setup --no-packages > "$scratch/interrupted" 2>&1 &
pid=$!
set +m
while [ "$(calls)" = 0 ]; do sleep 0.1; done
kill -TERM -- "-$pid"
wait $pid
status=$?
while kill -0 -- "-$pid" 2> /dev/null; do sleep 0.1; done
check "an interrupted setup has a status (it is $status)" test $status -ne 0
nothing_left "interrupted"

# kill -9 gives no chance to clean up: the next one does.
set -m
setup --no-packages > /dev/null 2>&1 &
pid=$!
set +m
rm -f "$scratch/calls"
while [ "$(calls)" = 0 ]; do sleep 0.1; done
kill -KILL -- "-$pid"
wait $pid 2> /dev/null
left=$(find "$cache" -maxdepth 1 -name 'engine-*')
check "a killed setup leaves nothing that looks finished" test -z "$left"
rm -f "$scratch/slow" "$scratch/calls"

# ---- built once, quietly ----
expect_quiet setup --no-packages
dir=$(setup --print-engine-dir)
check "four sources are compiled, main and the VTK dump are not (calls: $(calls))" \
  test "$(calls)" = 4
for file in libliggghts.a manifest src/atom.h src/force.cpp src/atom.cpp src/style_bond.h; do
  check "entry has $file" test -s "$dir/$file"
done
check "the version names neither user nor date" \
  grep -q '"LIGGGHTS 3.8.0, built for BondLab"' "$dir/src/version_liggghts.h"
check "the remains of the killed build are gone" test -z "$(find "$cache" -name 'work.*')"
check "the user's tree is untouched" test "$before" = "$(sums "$tree")"
expect_quiet setup --no-packages
check "the second time compiles nothing" test "$(calls)" = 4

# ---- two at once: one builds, both succeed ----
rm -rf "$dir" "$scratch/calls"
touch "$scratch/slow"
setup --no-packages &
first=$!
setup --no-packages &
second=$!
wait $first
check "the first of two succeeds" test $? = 0
wait $second
check "the second of two succeeds" test $? = 0
check "one of two built (calls: $(calls))" test "$(calls)" = 4
rm "$scratch/slow"

# ---- what belongs to the key ----
another() {
  checks=$((checks + 1))
  local now
  now=$(setup "${@:2}" --print-engine-dir)
  if [ -z "$now" ] || [ "$now" = "$dir" ]; then fail "$1 gives the same engine: $now"; fi
}
another "another processor" --arch=x86-64-v2
another "the compiler's default processor" --arch=
echo "// changed" >> "$tree/src/atom.h"
another "a changed source"
sed -i '$d' "$tree/src/atom.h"
touch "$tree/src/style_fix.h" "$tree/src/version_liggghts.h"
check "lists that Make.sh writes do not count" test "$(setup --print-engine-dir)" = "$dir"
tree=
another "Debian's source"
tree=$scratch/good
# The same flag -march=native means other instructions on another processor.
stub counting-g++ << EOF
case " \$* " in *" -### "*) echo " /usr/lib/cc1plus -march=another -mno-avx"; exit 0 ;; esac
exec "$stubs/g++" "\$@"
EOF
another "-march=native on another processor"
stub counting-g++ << EOF
case " \$* " in *" --version "*) echo "g++ (Debian 13.1.0-1) 13.1.0"; exit 0 ;; esac
exec "$stubs/g++" "\$@"
EOF
another "another compiler version"

# ---- apt's tarball: fetched once, checked again when it is used ----
tree=
compiler=
mkdir -p "$scratch/pack/liggghts"
fake_tree "$scratch/pack/liggghts"
tar -C "$scratch/pack" -cJf "$scratch/engine.tar.xz" liggghts
known=$(sha256sum < "$scratch/engine.tar.xz" | cut -c 1-64)
copy=$scratch/checkout
mkdir -p "$copy"
cp -r "$source_dir/tools" "$copy/"
sed -i "s/^engine_sha256=.*/engine_sha256=$known/" "$copy/tools/lib/engine.sh"
source_dir=$copy
all_installed
stub apt-get << EOF
case "\$*" in
  *indextargets*) echo "bookworm main http://mirror.example/debian/" ;;
  *--tar-only*) echo fetch >> "$scratch/fetches"
    cp "$scratch/engine.tar.xz" liggghts_3.8.0+repack1.orig.tar.xz ;;
esac
EOF
expect_quiet setup
check "built from the tarball" test -f "$(setup --print-engine-dir)/libliggghts.a"
rm -rf "$(setup --print-engine-dir)"
expect_quiet setup
check "fetched once" test "$(wc -l < "$scratch/fetches")" = 1
rm -rf "$(setup --print-engine-dir)"
echo damage >> "$cache/sources/liggghts_3.8.0+repack1.orig.tar.xz"
expect_quiet setup
check "a damaged copy is fetched again" test "$(wc -l < "$scratch/fetches")" = 2

finish
