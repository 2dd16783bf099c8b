#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
#
# Runs every command of the README's ```sh blocks, as a reader would, in a copy of the checkout.
#
# A command that another test runs already (the quickstart, hours of fitting) stands in
# readme_covered.txt with the name of that test; the name must exist, and so must the command in
# the README. Lines that end in a backslash go on; comments and a leading "$ " are skipped. Blocks
# share one shell: `cd` and variables last. Blocks of other kinds (```text, ```toml) are not run.

. "$(dirname "$0")/harness.sh"

readme=${3:-$source_dir/README.md}
covered=${4:-$source_dir/tests/tools/readme_covered.txt}
[ -f "$readme" ] || { fail "there is no $readme"; finish; }

# commands: one whole command a line.
commands() {
  awk '
    /^ *```/ { inside = !inside && $0 ~ /^ *```sh[ \t]*$/; if (inside) rest = ""; next }
    !inside { next }
    { sub(/^[ \t]*(\$ )?/, "") }
    rest == "" && (/^#/ || /^$/) { next }
    /\\$/ { sub(/[ \t]*\\$/, " "); rest = rest $0; next }
    { print rest $0; rest = "" }' "$readme"
}

commands > "$scratch/commands"
check "the README shows commands" test -s "$scratch/commands"

# ---- the table of commands that other tests run ----
if [ -f "$covered" ]; then
  tests=$(ctest --test-dir "$build_dir" -N 2> /dev/null | sed -n 's/^ *Test *#[0-9]*: //p')
  while IFS=$'\t' read -r test command; do
    case $test in '' | '#'*) continue ;; esac
    check "readme_covered.txt: '$command' is not in the README" \
      grep -qxF -- "$command" "$scratch/commands"
    check "readme_covered.txt: there is no test '$test'" grep -qxF -- "$test" <<< "$tests"
    grep -vxF -- "$command" "$scratch/commands" > "$scratch/left"
    mv "$scratch/left" "$scratch/commands"
  done < "$covered"
fi

# ---- the others are run ----
home=$scratch/bondlab
mkdir "$home"
for entry in "$source_dir"/*; do
  case ${entry##*/} in
    build* | bondlab-results) ;;
    *) cp -r "$entry" "$home/" ;;
  esac
done
ln -s "$build_dir" "$home/build"
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
{
  echo "cd '$home'"
  while read -r command; do
    # The number tells which command was reached.
    printf '%s\n' "echo x >> '$scratch/reached'" "$command" || exit 1
  done < "$scratch/commands"
} > "$scratch/script"
total=$(wc -l < "$scratch/commands")
checks=$((checks + total))
if [ "$total" -gt 0 ] &&
  ! bash -e "$scratch/script" > "$scratch/output" 2>&1 < /dev/null; then
  reached=$(wc -l < "$scratch/reached")
  fail "the README's command does not work: $(sed -n "${reached}p" "$scratch/commands")"
  tail -n 20 "$scratch/output"
fi

finish
