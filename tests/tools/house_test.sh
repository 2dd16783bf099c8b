#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
#
# House rules that a script can see: licence lines, length of files, no paths of one machine, no
# unfinished corners, and no room that includes one above it.

. "$(dirname "$0")/harness.sh"
cd "${3:-$source_dir}" || exit 1

files() {
  if git rev-parse --is-inside-work-tree > /dev/null 2>&1; then
    git ls-files
  else
    find . -type f ! -path './build*' ! -path './bondlab-results*' | sed 's|^\./||'
  fi
}

# Text that people write: no pictures, no data, not the licence itself.
files | grep -vE '^(LICENSE|tests/data/.*|inputs/data/.*|.*/testdata/.*|.*\.(png|svg|html|csv|tsv|data))$' |
  while read -r file; do [ -f "$file" ] && echo "$file"; done > "$scratch/files"
grep -vE '\.json$' "$scratch/files" > "$scratch/commented"

# none WHAT < LIST: the list is empty.
none() {
  local list
  list=$(cat)
  checks=$((checks + 1))
  [ -z "$list" ] || fail "$1:
$list"
}

none "no licence line at the top" < <(
  xargs awk 'FNR <= 3 && /SPDX-License-Identifier: GPL-2\.0-or-later/ { print FILENAME }' \
    < "$scratch/commented" | sort -u | comm -13 - <(sort "$scratch/commented"))

none "longer than 800 lines" < <(
  xargs wc -l < "$scratch/files" | awk '$1 > 800 && $2 != "total" { print $2 ": " $1 }')

# Built from pieces, so that this file does not find itself.
places="(^|[\"' =(])/(work|root|home|tmp)/"
unfinished='\b(TO''DO|FIX''ME|X''XX)\b'
none "paths of one machine" < <(xargs grep -nE "$places" < "$scratch/files" | cut -c 1-160)
none "unfinished corners" < <(xargs grep -nE "$unfinished" < "$scratch/files" | cut -c 1-160)
none "fast-math would remove the checks for not-a-number" < <(
  xargs grep -nE 'ffast''-math' < "$scratch/files" | grep -vE ':[0-9]+: *(#|//|\*)|\.md:|never')

# Arrows point one way: a room includes only rooms below it; laws and optimiser never meet.
none "a room includes one above it" < <(
  below=specimen
  for room in base study forward response misfit design surrogate search refine rheology diagnose report view app; do
    below="$below|$room"
    [ -d "optimizer/$room" ] || continue
    grep -rnE '^#include "[a-z]+/' "optimizer/$room" | grep -vE "#include \"($below)/"
  done)
none "the optimiser includes the engine package" < <(
  grep -rnE '^#include ".*(bond_styles|fix_styles|laws)/' optimizer 2> /dev/null)
none "the engine package includes the optimiser" < <(
  grep -rnE '^#include ".*optimizer/' bond_styles fix_styles 2> /dev/null)

finish
