#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
#
# The generator of style lists: every form is read, mistakes are named, nothing is rewritten idly;
# and in the built program it is our force.cpp and atom.cpp that were linked.

. "$(dirname "$0")/harness.sh"

engine=$scratch/engine
ours=$scratch/ours
generated=$scratch/out
mkdir -p "$engine" "$ours"
echo '#include "bond_harmonic.h"' > "$engine/style_bond.h"
echo '#include "atom_vec_sphere.h"' > "$engine/style_atom.h"
echo 'int force;' > "$engine/force.cpp"
echo 'int atom;' > "$engine/atom.cpp"
printf '#ifdef BOND_CLASS\nBondStyle(wood,BondWood)\nBondStyle( wood/wet , BondWetWood )\n#else\nclass X;\n#endif\n' > "$ours/bond_wood.h"
printf '#ifdef ATOM_CLASS\nAtomStyle(knot/sphere,AtomVecKnot)\n#else\n#endif\n' > "$ours/atom_vec_knot.h"
printf '#ifdef FIX_CLASS\n  FixStyle(vice,FixVice)\n#else\n#endif\n' > "$ours/fix_vice.h"
printf '#ifdef PAIR_CLASS\nPairStyle(grain/wood,PairWood)\n#else\n#endif\n' > "$ours/pair_wood.h"
printf '#ifdef COMPUTE_CLASS\nComputeStyle(rings,ComputeRings)\n#else\n#endif\n' > "$ours/compute_rings.h"
printf '#ifdef COMMAND_CLASS\nCommandStyle(saw,Saw)\n#else\n#endif\n' > "$ours/command_saw.h"
printf '// a helper without a style\n' > "$ours/fix_helper.h"

generate() {
  local headers
  headers=$(find "$ours" -name '*.h' | sort | tr '\n' ';')
  cmake "-DENGINE_SRC=$engine" "-DOUT=$generated" "-DHEADERS=${headers%;}" \
    -P "$source_dir/tools/cmake/generate_styles.cmake"
}

# expect_stop PART...: the generator stops and names each PART.
expect_stop() {
  checks=$((checks + 1))
  capture generate
  [ $status != 0 ] || fail "no error where '$1' was expected"
  local part
  for part in "$@"; do
    # CMake wraps its messages.
    case $(tr -s ' \n' ' ' <<< "$err") in
      *"$part"*) ;;
      *) fail "no '$part' in: $err" ;;
    esac
  done
}

expect_quiet generate
bond=$generated/rebuilt/style_bond.h
check "the engine's own bonds stay" grep -q '^#include "bond_harmonic.h"' "$bond"
check "the engine's own atoms stay" grep -q 'atom_vec_sphere.h' "$generated/rebuilt/style_atom.h"
check "a bond with a slash and blanks" grep -q '"wood/wet") == 0.*bondlab_create_BondWetWood' "$bond"
check "an atom style" grep -q '"knot/sphere"' "$generated/rebuilt/style_atom.h"
check "our headers stay out of the C++98 files" test -z "$(grep -l bond_wood.h "$generated"/rebuilt/*)"
for line in 'FixMap()))\["vice"\].*new FixVice(l, n, a)' 'pair_map)\["grain/wood"\].*new PairWood(l)' \
  'ComputeMap()))\["rings"\].*new ComputeRings(l, i, n, a)' 'CommandMap()))\["saw"\].*Saw(l).command(n, a)' \
  'bondlab_create_BondWood(LAMMPS \*lmp) { return new BondWood(lmp)' \
  'bondlab_create_AtomVecKnot(LAMMPS \*lmp) { register_styles(lmp); return new'; do
  check "registration: $line" grep -q "$line" "$generated/bondlab_styles.cpp"
done
check "seven styles are listed" test "$(wc -l < "$generated/styles.txt")" = 7
check "a helper is not included" test -z "$(grep fix_helper "$generated/bondlab_styles.cpp")"
check "the sources are copied" cmp -s "$engine/force.cpp" "$generated/rebuilt/force.cpp"

touch -d '2001-01-01' "$generated/bondlab_styles.cpp" "$bond"
expect_quiet generate
check "unchanged files are not rewritten" test ! "$bond" -nt "$engine/force.cpp"

printf '#ifdef FIX_CLASS\nFixStyle(vice,FixZeta)\n#else\n#endif\n' > "$ours/fix_zeta.h"
expect_stop "fix_zeta.h" "Fix style 'vice' is declared twice"
printf '#ifdef FIX_CLASS\nFixStyle(vice)\n#else\n#endif\n' > "$ours/fix_zeta.h"
expect_stop "fix_zeta.h" "expected FixStyle(key,Class)"
printf '#ifdef FIX_CLASS\nFixSytle(other,FixZeta)\n#else\n#endif\n' > "$ours/fix_zeta.h"
expect_stop "fix_zeta.h" "declares no style"
rm "$ours/fix_zeta.h"
rm "$engine/style_bond.h"
expect_stop "the engine has no" "style_bond.h" "run tools/setup again"

# ---- the program as built ----
lmp=$build_dir/bin/lmp_bondlab
if [ -x "$lmp" ]; then
  export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
  # As bondlab starts it: no daemon beside the run, no search for network devices.
  export OMPI_MCA_ess_singleton_isolated=1 OMPI_MCA_pml=ob1 OMPI_MCA_btl=self
  cd "$scratch" || exit 1
  # `clear` gives the engine new, empty maps: our fixes must be known again after it.
  cat > in.styles << 'EOF'
units si
atom_style bonded/sphere
clear
units si
atom_style bonded/sphere
boundary f f f
region box block 0 1 0 1 0 1 units box
create_box 1 box
bond_style parallel
print "bond known"
fix no_such all nve/no_such
EOF
  capture "$lmp" -in in.styles
  case $out in
    *"bond known"*) ;;
    *) fail "atom_style or bond_style of ours is unknown: $out" ;;
  esac
  case $out in
    *"Invalid fix style"*) ;;
    *) fail "the deck's mistake was not told: $out" ;;
  esac
  check "a deck error gives a status" test $status != 0
  sed -i 's/^fix .*/bond_style no_such/' in.styles
  capture "$lmp" -in in.styles
  case $out in
    *"Invalid bond style"*) ;;
    *) fail "an unknown bond style was taken: $out" ;;
  esac
  # Every fix of ours is known by name: without arguments it complains of them, not of the name.
  for fix in $(awk '$1 == "fix" { print $2 }' "$build_dir/engine/styles.txt"); do
    sed -i '$d' in.styles
    echo "fix x all $fix" >> in.styles
    checks=$((checks + 1))
    capture timeout 60 "$lmp" -in in.styles
    case $out in
      *"Invalid fix style"*) fail "fix $fix is unknown" ;;
    esac
  done
  printf 'print "all well"\n' > in.well
  capture "$lmp" -in in.well
  check "a deck that ends has status 0 (it is $status)" test $status = 0
fi

finish
