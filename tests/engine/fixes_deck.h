// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: the decks that tests of the fixes share: a few particles, or a small wall of bonded discs.
//
// Units: SI. Failure: none.
#ifndef BONDLAB_TESTS_FIXES_DECK_H
#define BONDLAB_TESTS_FIXES_DECK_H

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "engine_run.h"

namespace engine {

// As a deck reads it back to the same number.
inline std::string number(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", x);
  return text;
}

// Everything before the fixes of a run of free particles; particles.data must be in the folder.
inline std::string few_particles(int dimension, double timestep, double thickness = 0.01) {
  const std::string d = std::to_string(dimension);
  return "units si\ndimension " + d + "\nboundary f f " + (dimension == 2 ? "p" : "f") +
         "\nnewton off\natom_style bonded/sphere thickness " + number(thickness) +
         "\natom_modify map array\nread_data particles.data\nneighbor 0.001 bin\n"
         "pair_style grain\npair_coeff * * 1e9 2 0.5\ntimestep " +
         number(timestep) + "\n";
}

// Hexagonal rows of discs of slightly different radii, from y = 0 up. Reproducible.
inline std::vector<Particle> brick(int columns, int rows, double radius) {
  std::vector<Particle> discs;
  std::uint32_t state = 12345;
  const auto noise = [&state] {
    state = state * 1664525u + 1013904223u;
    return (state >> 8) / 16777216.0 - 0.5;
  };
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      Particle p;
      p.radius = radius * (1.0 + 0.02 * noise());
      p.x = 2.0 * radius * (i + 0.5 * (j % 2) - 0.5 * columns + 0.25) + 0.01 * radius * noise();
      p.y = radius * (1.0 + std::sqrt(3.0) * j) + 0.01 * radius * noise();
      discs.push_back(p);
    }
  return discs;
}

// Bonded discs between two platens with friction, damped: a small compression test. The settings
// that a restart file doesn't hold come first; `start` reads the data or the restart.
struct CompressionDeck {
  double sigma_c = 5e6;  // Pa
  std::string start = "read_data particles.data\n";
  std::string install = "bond_install all gap 2e-4\n";
  std::string append;  // keyword of the tables
  double speed = 0.5;  // m/s
  std::string run;

  std::string text() const {
    const std::string strength = std::to_string(sigma_c);
    const std::string header =
        start.compare(0, 9, "read_data") == 0  // else it is in the restart
            ? "units si\ndimension 2\nboundary f f p\nnewton off\n"
              "atom_style bonded/sphere thickness 0.01\natom_modify map array\n"
            : "newton off\n";
    return header + start +
           "neighbor 0.0005 bin\npair_style grain\npair_coeff * * 1e9 2 0.5\n"
           "bond_style parallel\nbond_coeff 1 1e9 2 " +
           strength + " " + strength + " scatter normal 0.2 0.2 seed 7\n" + install +
           "timestep 2e-7\n"
           "fix move all nve/bonded\n"
           "fix top all platen plane 0 0.1 0 0 -1 0 touch modulus 1e9 ratio 2 friction 0.3 "
           "velocity 0 -" +
           std::to_string(speed) +
           " 0 ramp 1e-4\n"
           "fix bottom all platen plane 0 -0.1 0 0 1 0 touch modulus 1e9 ratio 2 friction 0.3 "
           "at_rest\n"
           "fix damp all damp/local 0.7\n"
           "fix gauge all gauge axial y layers 0.25 0.75 thickness 4e-3 lateral x strip 3e-3\n"
           "fix broken all bond/log 100 broken_bonds.tsv " +
           append +
           "\n"
           "variable load equal f_top[2]\nvariable closing equal -f_top[8]\n"
           "fix curve all curve 50 curve.tsv force_top N v_load force_bottom N f_bottom[2] "
           "side_top N f_top[1] moment_top Nm f_top[6] closing m v_closing axial 1 f_gauge[1] "
           "lateral 1 f_gauge[2] energy J f_top[15] broken 1 f_broken[1] tension 1 f_broken[2] " +
           append + "\n" + "thermo 100000\n" + run;
  }
};

}  // namespace engine

#endif
