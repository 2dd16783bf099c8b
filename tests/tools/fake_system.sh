# SPDX-License-Identifier: GPL-2.0-or-later
# shellcheck shell=bash
#
# A system made of stubs for the tests of tools/setup: its own PATH, os-release, cache and a
# LIGGGHTS tree small enough to compile in a second.
#
# Source after harness.sh. The real programs are linked into $stubs one by one, so that a test can
# leave one out or put a stub in its place.

stubs=$scratch/bin
cache=$scratch/cache
mkdir -p "$stubs" "$scratch/home"

link_tools() {
  local tool path
  for tool in bash sh env sed awk gawk mawk grep tr head tail cut sort xargs find cp mv rm mkdir \
    mktemp cat df dirname basename id flock sha256sum sync tar xz nproc wc ls whoami date diff \
    test uniq expr touch ninja g++ gcc as ld ar mpicxx mpirun dpkg-query sleep chmod kill; do
    path=$(command -v "$tool") || continue
    case $path in
      /*) ln -sf "$path" "$stubs/$tool" ;;
    esac
  done
}

# stub NAME < SCRIPT: replaces a program.
stub() {
  rm -f "$stubs/$1"
  {
    echo '#!/bin/bash'
    cat
  } > "$stubs/$1"
  chmod +x "$stubs/$1"
}

unstub() {
  rm -f "$stubs/$1"
  ln -s "$(PATH=/usr/bin:/bin command -v "$1")" "$stubs/$1"
}

# os ID VERSION NAME
os() {
  printf 'ID=%s\nVERSION_ID="%s"\nPRETTY_NAME="%s"\nVERSION_CODENAME=bookworm\n' \
    "$1" "$2" "$3" > "$scratch/os-release"
}

# All packages are there unless a test says otherwise.
all_installed() {
  stub dpkg-query << EOF2
sed -e 's/#.*//' -e 's/ *\$//' -e '/^\$/d' -e 's/\$/ installed/' "$source_dir/tools/packages.txt"
EOF2
}

# A tree that looks like LIGGGHTS to tools/setup.
fake_tree() {
  local src=$1/src name
  mkdir -p "$src"
  echo 3.8.0 > "$src/version_liggghts.txt"
  for name in lammps force atom; do
    echo "int $name() { return 0; }" > "$src/$name.cpp"
  done
  echo "bool finish(int **lists, int m) { return m == 0 && lists != 0; }" > "$src/finish.cpp"
  echo "broken main, which is never compiled" > "$src/main.cpp"
  echo "broken without VTK" > "$src/dump_mesh_vtk.cpp"
  echo "class Atom;" > "$src/atom.h"
  cat > "$src/Make.sh" << 'EOF2'
echo "// list" > style_atom.h
echo "// list" > style_bond.h
EOF2
}

# setup ARGS...: tools/setup in this system.
setup() {
  env -i PATH="$stubs" HOME="$scratch/home" BONDLAB_CACHE="$cache" \
    BONDLAB_OS_RELEASE="$scratch/os-release" ${tree:+BONDLAB_LIGGGHTS_SOURCE="$tree"} \
    ${compiler:+CXX="$compiler"} "$source_dir/tools/setup" "$@"
}

# Nothing that looks finished, nothing half done.
nothing_left() {
  checks=$((checks + 1))
  local left
  left=$(find "$cache" -maxdepth 1 \( -name 'engine-*' -o -name 'work.*' \) 2> /dev/null)
  [ -z "$left" ] || fail "$1: left behind: $left"
}

link_tools
all_installed
os debian 12 "Debian GNU/Linux 12 (bookworm)"
stub apt-get <<< 'echo "E: unexpected apt-get $*"; exit 100'
tree=
compiler=
