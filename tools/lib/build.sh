# SPDX-License-Identifier: GPL-2.0-or-later
# shellcheck shell=bash
#
# Sets the machine up and builds the release preset into build/: what is named, or everything.
#
# Failure: one line with the first error of the compiler or of CMake and the name of the log.

build_release() {
  local targets=("$@")
  # Said before the engine is built for minutes.
  need_space "$root" 500 "a checkout elsewhere"
  "$root/tools/setup"
  start_log "$tool-build"
  note "building"
  cd "$root" || die "cannot enter $root"
  if ! quietly cmake --preset release; then
    die "CMake could not configure: $(reason) (log: $log)"
  fi
  if ! quietly cmake --build --preset release -j "$(jobs)" \
    ${targets[0]:+--target "${targets[@]}"}; then
    die "the build failed: $(reason) (log: $log)"
  fi
  local program
  for program in bondlab lmp_bondlab; do
    [ -x "build/bin/$program" ] ||
      die "build/bin/$program was not built: is the checkout complete? (log: $log)"
  done
}
