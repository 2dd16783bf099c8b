# SPDX-License-Identifier: GPL-2.0-or-later
# shellcheck shell=bash
#
# What the tools share: one-line errors, notes, the cache directory, commands run quietly.
#
# Failure: die prints one line that says what to do and exits with status 1. Everything a command
# prints goes to $log; the line names it, since the reason is there.

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
tool=${tool:-$(basename "$0")}
# Tools call one another by full path but name themselves as one types them.
export LC_ALL=C

die() {
  echo "tools/$tool: $*" >&2
  exit 1
}

# A word on what takes long, for a person who watches; nothing in a log or a pipe.
note() {
  if [ -t 2 ]; then echo "tools/$tool: $*" >&2; fi
}

# Where downloads and the built engine live: outside the build tree, shared by all checkouts.
cache_dir() {
  if [ -n "${BONDLAB_CACHE:-}" ]; then
    echo "$BONDLAB_CACHE"
  elif [ -n "${XDG_CACHE_HOME:-}" ]; then
    echo "$XDG_CACHE_HOME/bondlab"
  elif [ -n "${HOME:-}" ]; then
    echo "$HOME/.cache/bondlab"
  else
    die "no HOME is set: set BONDLAB_CACHE to a directory for the engine (300 MB)"
  fi
}

# need_space DIR MB: stops before a long build rather than in the middle of it.
need_space() {
  local dir=$1 wanted=$2 free
  while [ ! -d "$dir" ]; do dir=$(dirname "$dir"); done
  free=$(df -Pm "$dir" 2>/dev/null | awk 'NR == 2 { print $4 }')
  if [ -n "$free" ] && [ "$free" -lt "$wanted" ]; then
    die "disk full: $dir has $free MB free, $wanted MB are needed; free some, or set $3"
  fi
}

# start_log NAME: a fresh log for this tool in the cache.
start_log() {
  local cache
  cache=$(cache_dir)
  mkdir -p "$cache/logs" 2>/dev/null ||
    die "cannot write $cache: set BONDLAB_CACHE to a directory of yours"
  log=$cache/logs/$1.log
  : > "$log" 2>/dev/null || die "cannot write $log: set BONDLAB_CACHE to a directory of yours"
}

# quietly COMMAND...: output to the log, no stdin (CI has none, and mpirun would read it).
quietly() {
  { echo "+ $*"; "$@"; } >> "$log" 2>&1 < /dev/null
}

# reason: the most telling line of the log, for the one-line error.
reason() {
  if grep -q "No space left on device" "$log"; then
    echo "disk full; free some space and run again"
    return
  fi
  local line
  line=$(grep -m 1 -E '(^|[^a-z_])([Ee]rror|fatal|CMake Error)[: ]|^E: ' "$log" || true)
  # CMake puts its sentence on the line after the place.
  case $line in
    'CMake Error'*)
      line="$line $(grep -m 1 -A 2 'CMake Error' "$log" | tail -n +2 | tr -s ' \n' ' ')" ;;
  esac
  if [ -z "$line" ]; then line=$(tail -n 1 "$log"); fi
  echo "$line" | cut -c 1-300
}

# How many compilers at once: every core, unless told otherwise.
jobs() {
  echo "${BONDLAB_JOBS:-$(nproc 2>/dev/null || echo 2)}"
}
