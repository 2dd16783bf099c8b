#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
#
# Every way tools/setup can fail for reasons outside: one line that says what to do, nothing left.

. "$(dirname "$0")/harness.sh"
. "$(dirname "$0")/fake_system.sh"

# ---- the system ----
os fedora 39 "Fedora Linux 39"
expect_error 1 "Fedora Linux 39" "Debian 12" "BONDLAB_LIGGGHTS_SOURCE" -- setup
os debian 11 "Debian GNU/Linux 11 (bullseye)"
expect_error 1 "Debian GNU/Linux 11" "Debian 12 or newer" -- setup
rm "$scratch/os-release"
expect_error 1 "an unknown system" -- setup
os debian 12 "Debian GNU/Linux 12 (bookworm)"

rm "$stubs/apt-get"
expect_error 1 "apt-get is not there" "tools/packages.txt" -- setup
nothing_left "system"

# ---- packages ----
stub dpkg-query <<< 'echo "cmake installed"; echo "ninja-build not-installed"'
stub apt-get <<< 'echo "E: unexpected apt-get $*"; exit 100'
stub id <<< 'if [ "${1:-}" = -u ]; then echo 1000; else echo somebody; fi'
expect_error 1 "as root run: apt-get install" "ninja-build" "libopenmpi-dev" -- setup
case $err in *" cmake "*) fail "asks for a package that is there: $err" ;; esac

stub sudo <<< '[ "$1" = -n ] && exit 1; exit 1'
expect_error 1 "as root run: apt-get install" -- setup
stub sudo << 'EOF'
if [ "$1" = -n ] || [ "$1" = -v ]; then exit 0; fi
echo "$*" >> "$(dirname "$0")/../sudo.log"
exec "$@"
EOF
stub apt-get <<< "echo \"Err:1 Could not resolve 'deb.debian.org'\"; exit 100"
expect_error 1 "no network" "as root run: apt-get install" "log:" -- setup
check "sudo was used" grep -q "apt-get.* install -y" "$scratch/sudo.log"
rm "$stubs/sudo"

stub id <<< 'if [ "${1:-}" = -u ]; then echo 0; else echo root; fi'
expect_error 1 "no network" -- setup
stub apt-get <<< 'echo "E: Unable to locate package ninja-build"; exit 100'
expect_error 1 "apt could not install" "Unable to locate package ninja-build" "log:" -- setup
stub apt-get <<< '[ "$2" = update ] || echo "write: No space left on device"; exit 100'
expect_error 1 "disk full" -- setup
nothing_left "packages"
all_installed
unstub id

# ---- the compiler ----
compiler=no-such-compiler
expect_error 1 "no compiler no-such-compiler" -- setup
compiler=
expect_error 1 "-march=z80" -- setup --arch=z80
expect_error 1 "unknown argument '--fast'" "--arch" -- setup --fast

# ---- the engine's source by apt ----
fetching() { stub apt-get; }
fetching << 'EOF'
case "$*" in *indextargets*) exit 0 ;; esac
echo "Err:1 http://deb.debian.org/debian bookworm InRelease"
echo "  Temporary failure resolving 'deb.debian.org'"
exit 100
EOF
expect_error 1 "no network" "http://deb.debian.org/debian" "BONDLAB_LIGGGHTS_SOURCE" -- setup
nothing_left "no network"

fetching << 'EOF'
case "$*" in
  *indextargets*) echo "bookworm main http://mirror.example/debian/" ;;
  *--tar-only*) echo "not the engine" > liggghts_3.8.0+repack1.orig.tar.xz ;;
esac
exit 0
EOF
expect_error 1 "http://mirror.example/debian/" "not the one we know" "sha256" -- setup
nothing_left "checksum"
check "no wrong tarball is kept" test -z "$(ls "$cache/sources")"

fetching <<< 'case "$*" in *--tar-only*) echo "E: Unable to find a source package for liggghts"; exit 100 ;; esac'
expect_error 1 "could not fetch" "Unable to find a source package" -- setup
rm "$stubs/apt-get"
expect_error 1 "apt-get is not there to fetch" "BONDLAB_LIGGGHTS_SOURCE" -- setup --no-packages

# ---- the user's own tree ----
tree=$scratch/nowhere
expect_error 1 "$scratch/nowhere" "no such directory" -- setup --no-packages
tree=$scratch/empty
mkdir "$tree"
expect_error 1 "not a LIGGGHTS tree" "src/lammps.cpp" -- setup --no-packages
fake_tree "$scratch/old"
echo 3.5.0 > "$scratch/old/src/version_liggghts.txt"
tree=$scratch/old
expect_error 1 "version '3.5.0'" "3.8 is needed" -- setup --no-packages
fake_tree "$scratch/broken"
echo "int atom( { return; }" > "$scratch/broken/src/atom.cpp"
tree=$scratch/broken
expect_error 1 "does not compile" "atom.cpp" "error" "log:" -- setup --no-packages
nothing_left "own tree"

# ---- disk and cache ----
fake_tree "$scratch/good"
tree=$scratch/good
stub df << 'EOF'
echo "Filesystem 1048576-blocks Used Available Capacity Mounted on"
echo "/dev/root 1000 990 10 99% /"
EOF
expect_error 1 "disk full" "10 MB free" "BONDLAB_CACHE" -- setup --no-packages
unstub df
stub ar <<< 'echo "ar: libliggghts.a: No space left on device" >&2; exit 1'
expect_error 1 "disk full" "run again" -- setup --no-packages
unstub ar
nothing_left "disk full"
touch "$scratch/file"
cache=$scratch/file/cache
expect_error 1 "cannot write $scratch/file/cache" "BONDLAB_CACHE" -- setup --no-packages

finish
