#!/bin/sh
# SPDX-License-Identifier: GPL-2.0-or-later
# Stands in for lmp_bondlab: does what `-var act N` says. Every start and every good end is written to the file named by
# FAKE_LEDGER, with the run's key.
act=0 value=1
while [ $# -gt 0 ]; do
  case $1 in
    -var) eval "$2=\$3"; shift 2 ;;
    -log) log=$2; shift ;;
  esac
  shift
done
note() { if [ -n "$FAKE_LEDGER" ]; then echo "$1 $BONDLAB_RUN_KEY" >>"$FAKE_LEDGER"; fi; }
head() { printf '# bondlab-curve 1\n# names: step\ttime\taxial_stress\n# units: 1\ts\tPa\n0\t0\t0\n' >curve.tsv; }
rows() { printf '10\t1e-6\t%s\n20\t2e-6\t5\n' "$value" >>curve.tsv; }
loop() { printf '  300 bonds installed, 3.000 a particle\nLoop time of 0.6 on 1 procs for 2000 steps with 100 atoms\n' >>"$log"; }
good() { head; rows; loop; printf '# complete: stop_after_peak\n' >>curve.tsv; note end; }
note start
echo "LIGGGHTS (fake)" >"$log"
cat >input.txt
case $act in
  0) echo extra >extra.txt; echo kept >kept.txt; echo frame >particles_2000.txt; good ;;
  1) head; kill -SEGV $$ ;;
  2) trap '' TERM; head; sleep 100 ;;
  3) head; printf '10\t1e-6\tnan\n' >>curve.tsv; printf '# complete: end_of_run\n' >>curve.tsv ;;
  4) head; rows ;;
  5) : ;;
  6) exit 3 ;;
  7) printf 'units si\npair_style grain\nERROR: Unknown pair style (src/force.cpp:120)\n' >>"$log"; exit 1 ;;
  8) printf '# bondlab-curve 1\n# names: step\ttime\tforce\n# units: 1\ts\tN\n0\t0\t0\n# complete: end_of_run\n' >curve.tsv ;;
  9) head; echo 'ERROR: Lost atoms: original 100 current 99 (src/thermo.cpp:5)' >>"$log"; exit 1 ;;
  10) head; echo 'ERROR on proc 0: Bond atoms 3 4 missing at step 7 (src/x.cpp:1)'; exit 1 ;;
  11) echo 'ERROR on proc 1: Lost atoms: original 2 current 1 (src/thermo.cpp:5)'; sleep 100 ;;
  12) head; sleep 0.15; good ;;
  13) printf '# bondlab-curve 1\n# names: step\ttime\taxial_stress\n# units: 1\ts\tPa\n0\t0\tabc\n# complete: end_of_run\n' >curve.tsv ;;
  14) echo 'ERROR: Non-numeric positions (src/x.cpp:1)' >>"$log"; exit 1 ;;
  15) sleep 100 & sleep 100 ;;
  16) printf 'mpirun was unable to launch the specified application\n'; exit 134 ;;
  17) env | grep BONDLAB_ >kept.txt; good ;;
  18) head; echo 'ERROR on proc 0: atom 5 has flown to 0 9 0 m (src/x.cpp:1)'; exit 1 ;;
  *) value=$act; good ;;
esac
