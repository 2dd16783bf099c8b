#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
#
# The test of the README's commands can itself fail: broken, missing and stale commands are seen.

. "$(dirname "$0")/harness.sh"

# A checkout and a build directory of almost nothing.
mkdir -p "$scratch/checkout/inputs" "$scratch/built/bin"
echo "content" > "$scratch/checkout/inputs/file"
cat > "$scratch/built/CTestTestfile.cmake" <<< 'add_test(tools.known "true")'

readme() { cat > "$scratch/checkout/README.md"; }
table() { cat > "$scratch/covered"; }
run() {
  capture "$(dirname "$0")/readme_test.sh" "$scratch/checkout" "$scratch/built" \
    "$scratch/checkout/README.md" "$scratch/covered"
}
# expect STATUS PART
expect() {
  checks=$((checks + 1))
  run
  case "$status $out" in
    "$1 "*"$2"*) ;;
    *) fail "status $1 and '$2' expected, got $status: $out $err" ;;
  esac
}

table < /dev/null
readme << 'EOF'
```text
no-such-command in text
```
```sh
# a comment
$ test -f inputs/file
name=inputs/file && \
  grep -q content "$name"
cd inputs
```
  ```sh
  test -f file      # the directory lasts
  ```
EOF
expect 0 "5 checks, 0 failed"

readme <<< $'```sh\ntrue\nno-such-command --here\ntrue\n```'
expect 1 "does not work: no-such-command --here"
readme <<< $'```sh\ntest -f file-that-is-gone\n```'
expect 1 "does not work: test -f file-that-is-gone"
readme <<< 'no commands at all'
expect 1 "the README shows commands"
rm "$scratch/checkout/README.md"
expect 1 "there is no"

readme <<< $'```sh\nlong-command\n```'
table <<< $'tools.known\tlong-command'
expect 0 "0 failed"
table <<< $'tools.unknown\tlong-command'
expect 1 "there is no test 'tools.unknown'"
table <<< $'tools.known\tother-command'
expect 1 "'other-command' is not in the README"

finish
