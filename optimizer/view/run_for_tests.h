// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: a small run as a folder of files, for the tests of this folder; for tests only.
// Method: a square lattice of 6 x 6 discs of radius 1 mm that touch; the last column has lost its
//   bonds to the others in tension and the corner particle its last one in shear; the column has
//   moved by 0.4 mm to the right, the corner by 0.8.
// Units: SI. Failure: none.
#pragma once

#include <string>

#include "base/test_folder.h"

namespace bondlab {

constexpr int lattice_side = 6;

inline std::string lattice_dump(bool end) {
  std::string text =
      "ITEM: TIMESTEP\n" + std::string(end ? "500" : "0") +
      "\nITEM: NUMBER OF ATOMS\n36\nITEM: BOX BOUNDS ff ff ff\n-1 1\n-1 1\n-1 1\nITEM: ATOMS id "
      "type radius x y z \n";
  for (int j = 0; j < lattice_side; ++j)
    for (int i = 0; i < lattice_side; ++i) {
      double x = 0.002 * i;
      if (end && i == lattice_side - 1) x += j == lattice_side - 1 ? 0.0008 : 0.0004;
      text += std::to_string(j * lattice_side + i + 1) + " 1 0.001 " + std::to_string(x) + " " +
              std::to_string(0.002 * j) + " 0\n";
    }
  return text;
}

inline std::string lattice_log() {
  return "dimension 2\nvariable gap index 1e-5\nbond_install    all gap ${gap}\n"
         "bond_install    all gap 1e-05\ncompute b all bonded/local id2 id1 fs fn\n";
}

inline std::string lattice_events() {
  std::string text =
      "# bondlab-broken-bonds 1\n# names: "
      "step\ttime\tid1\tid2\ttype\tx\ty\tz\tmode\tsigma\ttau\tsigma_c\ttau_c\n"
      "# units: 1\ts\t1\t1\t1\tm\tm\tm\t1\tPa\tPa\tPa\tPa\n";
  for (int j = 0; j < lattice_side; ++j)
    text += std::to_string(100 + j) + "\t" + std::to_string(0.001 * (j + 1)) + "\t" +
            std::to_string(j * lattice_side + 5) + "\t" + std::to_string(j * lattice_side + 6) +
            "\t1\t0.009\t" + std::to_string(0.002 * j) + "\t0\ttension\t2e6\t0\t1e6\t1e6\n";
  return text + "200\t0.01\t30\t36\t1\t0.01\t0.009\t0\tshear\t0\t2e6\t1e6\t1e6\n";
}

// All files of a run by hand but the curve.
inline void write_lattice_run(const TestFolder &folder) {
  folder.write("particles_start.txt", lattice_dump(false));
  folder.write("particles_end.txt", lattice_dump(true));
  folder.write("broken_bonds.tsv", lattice_events());
  folder.write("log.liggghts", lattice_log());
}

// Two bonds of the lattice, in the columns of the log's compute.
inline std::string lattice_forces() {
  return "ITEM: TIMESTEP\n400\nITEM: NUMBER OF ENTRIES\n2\nITEM: BOX BOUNDS ff ff ff\n-1 1\n-1 "
         "1\n-1 "
         "1\nITEM: ENTRIES c_b[1] c_b[2] c_b[3] c_b[4] \n2 1 5 -100\n7 1 0 40\n";
}

}  // namespace bondlab
