# SPDX-License-Identifier: GPL-2.0-or-later
# shellcheck shell=bash
#
# Fetches LIGGGHTS-PUBLIC 3.8 and builds it once, as a static library, into the cache.
#
# Source: Debian's source package through apt (checked by apt, and here against a fixed sha256), or
#   the tree named by BONDLAB_LIGGGHTS_SOURCE, which is copied and never changed.
# Entry: CACHE/engine-KEY/{src/*.h, src/force.cpp, src/atom.cpp, libliggghts.a, manifest}. KEY covers
#   source, compiler, MPI and the flags as the compiler resolves them, so that -march=native of
#   another processor is another key.
# Failure: an entry appears by one rename of a finished directory; whatever interrupts the build
#   leaves nothing under the final name. A lock keeps two builds apart.

engine_tar=liggghts_3.8.0+repack1.orig.tar.xz
engine_sha256=c18721d9a870c5170f03b91e4f1ffe13335c66ed1f0ff2c64ebd3be91c37867a
engine_recipe=2  # raise when the steps below change what comes out
cxx=${CXX:-g++}

engine_flags() {
  echo "-std=gnu++98 -fpermissive -w -O3${arch:+ -march=$arch}"
}

# mpi_cxx ARGS...: the MPI compiler wrapper round the chosen compiler (OpenMPI's, MPICH's name).
mpi_cxx() {
  OMPI_CXX=$cxx MPICH_CXX=$cxx mpicxx "$@"
}

# The src directory of the user's own tree, checked; empty if none is named.
own_source() {
  local given=${BONDLAB_LIGGGHTS_SOURCE:-} dir version
  if [ -z "$given" ]; then return; fi
  [ -d "$given" ] || die "BONDLAB_LIGGGHTS_SOURCE=$given: no such directory; name the root of a" \
    "LIGGGHTS-PUBLIC 3.8 tree"
  dir=$(cd "$given" && pwd)
  if [ -d "$dir/src" ]; then dir=$dir/src; fi
  if [ ! -f "$dir/lammps.cpp" ] || [ ! -f "$dir/version_liggghts.txt" ]; then
    die "BONDLAB_LIGGGHTS_SOURCE=$given: not a LIGGGHTS tree (no src/lammps.cpp and" \
      "src/version_liggghts.txt); name the root of a LIGGGHTS-PUBLIC 3.8 tree"
  fi
  version=$(head -n 1 "$dir/version_liggghts.txt")
  case $version in
    3.8 | 3.8.*) ;;
    *) die "BONDLAB_LIGGGHTS_SOURCE=$given: is version '$version', 3.8 is needed" ;;
  esac
  echo "$dir"
}

# source_files DIR: what is compiled, without the lists that Make.sh writes and the parts that no
# machine without VTK can compile (dump_mesh_vtk forgets its guard).
source_files() {
  (cd "$1" && find . -maxdepth 1 -type f \( -name '*.cpp' -o -name '*.h' -o -name 'Make.sh' \
    -o -name '*.whitelist' -o -name 'version_liggghts*.txt' \) \
    ! -name 'style_*.h' ! -name version_liggghts.h ! -name 'dump_mesh_vtk.*' ! -name main.cpp |
    sed 's|^\./||' | sort)
}

# What decides whether a built engine may be used, in words; its hash is the key.
engine_identity() {
  local own source
  own=$(own_source)
  if [ -n "$own" ]; then
    source="tree $(cd "$own" && source_files . | xargs sha256sum | sha256sum | cut -c 1-64)"
  else
    source="debian $engine_sha256"
  fi
  echo "recipe $engine_recipe"
  echo "source $source"
  # Without the first word: g++ and c++ are one compiler under two names.
  echo "compiler $("$cxx" --version | head -n 1 | cut -d ' ' -f 2-) $("$cxx" -dumpmachine)"
  echo "mpi $(mpi_cxx -show 2>/dev/null | cut -d ' ' -f 2-) $(mpirun --version 2>/dev/null | head -n 1)"
  echo "flags $(engine_flags)"
  # shellcheck disable=SC2046  # a list of flags
  echo "resolved $("$cxx" $(engine_flags) -### -S -o - -x c++ /dev/null 2>&1 |
    grep -E '(cc1plus|-cc1)' | sed 's/^ *[^ ]* //')"
}

need_compiler() {
  command -v "$cxx" > /dev/null || die "no compiler $cxx: run tools/setup, or set CXX"
  command -v mpicxx > /dev/null || die "no mpicxx: run tools/setup, or install an MPI library"
  local message
  # shellcheck disable=SC2046
  if ! message=$("$cxx" $(engine_flags) -S -o /dev/null -x c++ /dev/null 2>&1); then
    die "$cxx does not take these flags: $(engine_flags): $(head -n 1 <<< "$message")"
  fi
}

# Sets engine_dir and $identity.
find_engine() {
  need_compiler
  identity=$(engine_identity)
  engine_dir=$(cache_dir)/engine-$(sha256sum <<< "$identity" | cut -c 1-16)
}

checksum_ok() {
  [ -f "$1" ] && [ "$(sha256sum < "$1" | cut -c 1-64)" = "$engine_sha256" ]
}

# The mirror this system already uses for its own release.
debian_mirror() {
  local codename
  codename=$(os_value VERSION_CODENAME)
  apt-get indextargets --format '$(CODENAME) $(COMPONENT) $(REPO_URI)' 'Created-By: Packages' \
    2>/dev/null | awk -v release="${codename:-bookworm}" \
    '$1 == release && $2 == "main" { print $3, release; found = 1; exit }
     END { if (!found) print "http://deb.debian.org/debian", release }'
}

# Brings the tarball into the cache. apt gets a private state, so that /etc stays as it is and no
# rights are needed.
fetch_engine() {
  local sources tarball private mirror release keyring
  sources=$(cache_dir)/sources
  tarball=$sources/$engine_tar
  if checksum_ok "$tarball"; then return; fi
  command -v apt-get > /dev/null || die "apt-get is not there to fetch the engine: set" \
    "BONDLAB_LIGGGHTS_SOURCE to a LIGGGHTS-PUBLIC 3.8 tree"

  private=$work/apt
  mkdir -p "$private"/{lists/partial,state,cache/archives/partial,download} "$sources"
  read -r mirror release <<< "$(debian_mirror)"
  keyring=/usr/share/keyrings/debian-archive-keyring.gpg
  if [ -f "$keyring" ]; then keyring="[signed-by=$keyring] "; else keyring=; fi
  echo "deb-src $keyring$mirror $release main" > "$private/sources.list"
  local apt=(apt-get -q -o "Dir::Etc::sourcelist=$private/sources.list"
    -o Dir::Etc::sourceparts=/dev/null -o "Dir::State=$private/state"
    -o "Dir::State::lists=$private/lists" -o "Dir::Cache=$private/cache"
    -o "APT::Sandbox::User=$(id -un)" -o Acquire::Retries=2 -o APT::Update::Error-Mode=any)

  note "fetching the engine's source (6.5 MB)"
  if ! quietly "${apt[@]}" update ||
    ! (cd "$private/download" &&
      quietly "${apt[@]}" source --download-only --tar-only liggghts); then
    if network_trouble; then
      die "no network: $mirror cannot be reached for the engine's source; connect, or set" \
        "BONDLAB_LIGGGHTS_SOURCE to a LIGGGHTS-PUBLIC 3.8 tree (log: $log)"
    fi
    die "apt could not fetch the engine's source: $(reason) (log: $log)"
  fi
  if ! checksum_ok "$private/download/$engine_tar"; then
    die "the engine's source from $mirror is not the one we know (sha256 of $engine_tar differs):" \
      "try again, or set BONDLAB_LIGGGHTS_SOURCE to a LIGGGHTS-PUBLIC 3.8 tree"
  fi
  mv "$private/download/$engine_tar" "$tarball"
}

# Compiles $1/src into $1/libliggghts.a.
compile_engine() {
  local dir=$1 ninja=$1/build.ninja objects="" file flags
  (
    cd "$dir/src"
    # Ordered comparison of a pointer with zero, refused by g++ 12 whatever the flags.
    sed -i 's/lists\[m\]->numneigh > 0/lists[m]->numneigh != NULL/' finish.cpp
    sh Make.sh style && sh Make.sh models
    # Make.sh writes user and date into the version; two builds of one source should be equal. And
    # if the version says PUBLIC, one error in five gets a joke printed from freed memory.
    echo "#define LIGGGHTS_VERSION \"LIGGGHTS $(head -n 1 version_liggghts.txt)," \
      "built for BondLab\"" > version_liggghts.h
  ) >> "$log" 2>&1 < /dev/null || return 1
  flags="$(engine_flags) $(mpi_cxx --showme:compile 2>/dev/null || mpi_cxx -compile_info |
    tr ' ' '\n' | grep -E '^-[ID]' | tr '\n' ' ')"
  {
    echo "rule cxx"
    echo "  command = $cxx $flags -c \$in -o \$out"
    echo "rule ar"
    echo "  command = rm -f \$out && ar rcsD \$out \$in"
    for file in "$dir"/src/*.cpp; do
      file=$(basename "$file" .cpp)
      echo "build obj/$file.o: cxx src/$file.cpp"
      objects="$objects obj/$file.o"
    done
    echo "build libliggghts.a: ar$objects"
  } > "$ninja"
  quietly ninja -C "$dir" -j "$(jobs)" libliggghts.a
}

# Builds the entry $engine_dir if it is not there. Sets work, removed on exit.
build_engine() {
  local cache own
  cache=$(cache_dir)
  if [ -f "$engine_dir/manifest" ]; then return; fi
  need_space "$cache" 400 "BONDLAB_CACHE to a directory elsewhere"
  own=$(own_source)

  exec 9> "$cache/lock" || die "cannot write $cache/lock: set BONDLAB_CACHE to a directory of yours"
  if ! flock -n 9; then
    note "waiting for another tools/setup"
    flock 9
    if [ -f "$engine_dir/manifest" ]; then return; fi
  fi
  # We hold the lock: whatever lies here was interrupted.
  rm -rf "$cache"/work.*
  work=$(mktemp -d "$cache/work.XXXXXX") || die "cannot write $cache: set BONDLAB_CACHE elsewhere"
  trap 'rm -rf "$work"' EXIT
  trap 'exit 130' INT
  trap 'exit 143' TERM HUP

  mkdir -p "$work/tree/src"
  if [ -n "$own" ]; then
    source_files "$own" | (cd "$own" && xargs cp -t "$work/tree/src") ||
      die "cannot copy $own: $(reason)"
  else
    fetch_engine
    mkdir "$work/unpacked"
    quietly tar -xJf "$cache/sources/$engine_tar" -C "$work/unpacked" --strip-components=1 ||
      die "cannot unpack $engine_tar: $(reason) (log: $log)"
    source_files "$work/unpacked/src" |
      (cd "$work/unpacked/src" && xargs cp -t "$work/tree/src")
  fi

  note "building the engine, once (about 10 minutes of one core)"
  if ! compile_engine "$work/tree"; then
    die "the engine does not compile: $(reason) (log: $log)"
  fi

  local entry=$work/entry
  mkdir -p "$entry/src"
  if ! { cp "$work/tree/src"/*.h "$work/tree/src"/{force,atom}.cpp "$entry/src/" &&
    mv "$work/tree/libliggghts.a" "$entry/" &&
    echo "$identity" > "$entry/manifest" && sync -f "$entry/manifest"; } 2>> "$log"; then
    die "cannot write $entry: $(reason) (log: $log)"
  fi
  # Without a manifest under the final name there is no finished entry, only debris.
  rm -rf "$engine_dir"
  mv "$entry" "$engine_dir"
}
