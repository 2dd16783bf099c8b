// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: the decks of the engine tests of bonds: pieces of text, and the packing `small` (893 spheres,
// 2,963 bonds) that most of them run.
//
// A deck is a preamble (particles, styles, bonds), then what the test does, then dump_all(): all
// positions, velocities, spins, forces and torques with 17 digits, so that two files are the same
// text only if they are the same bits. Units: SI.
#ifndef BONDLAB_TESTS_ENGINE_BOND_DECK_H
#define BONDLAB_TESTS_ENGINE_BOND_DECK_H

#include <array>
#include <fstream>
#include <map>
#include <sstream>
#include <string>

#include "engine_run.h"

namespace engine::bonds {

inline std::string data_path(const std::string &name) {
  return std::string(BONDLAB_SOURCE_DIR) + "/tests/data/" + name;
}

// Everything up to the bonds. `before_bonds` goes between the coefficients and bond_install.
struct Preamble {
  int dimension = 3;
  std::string specimen;            // data file
  std::string install;             // arguments of bond_install
  std::string contact = "5e9 2.0 0.5";
  std::string bond_style = "parallel";
  std::string bond = "5e9 2.0 1e12 1e12";
  std::string newton = "off";
  std::string boundary;            // "" : f f f, in 2D f f p
  std::string atom_style = "bonded/sphere";
  std::string skin = "5e-5";
  std::string neighbour = "delay 0";
  std::string before_bonds;
  double safety = 0.8;             // 0: no timestep_bonded

  std::string text() const {
    std::ostringstream o;
    o << "units si\ndimension " << dimension << "\nnewton " << newton << "\nboundary "
      << (boundary.empty() ? (dimension == 2 ? "f f p" : "f f f") : boundary) << "\natom_style "
      << atom_style << "\ncommunicate single vel yes\nbond_style " << bond_style
      << "\npair_style grain\nread_data " << specimen << "\nneighbor " << skin << " bin\nneigh_modify " << neighbour
      << "\npair_coeff * * " << contact << "\nbond_coeff 1 " << bond << "\n"
      << before_bonds;
    if (!install.empty()) o << "bond_install all " << install << "\n";
    if (safety > 0.0) o << "timestep_bonded " << safety << "\n";
    o << "thermo 100000\nthermo_style custom step time ke\nthermo_modify lost error\n";
    return o.str();
  }
};

// A law with its coefficients.
struct Law {
  const char *style, *words;
};

// The packing `small`, bonded by its list.
inline Preamble small() {
  Preamble p;
  p.specimen = data_path("small.data");
  p.install = "file " + data_path("small.bonds");
  return p;
}

// Platens that press `small` along z, closing at `speed` (m/s); the motion starts within 2e-5 s.
inline std::string press_small(double speed) {
  std::ostringstream o;
  for (const int side : {0, 1})
    o << "fix " << (side ? "top" : "bottom") << " all platen plane 0 0 " << (side ? 0.012 : 0.0)
      << " 0 0 " << (side ? -1 : 1) << " touch modulus 5e9 ratio 2 friction 0.3 velocity 0 0 "
      << (side ? -0.5 : 0.5) * speed << " ramp 2e-5\n";
  return o.str();
}

inline std::string dump_all(const std::string &file) {
  std::string columns = "id x y z vx vy vz omegax omegay omegaz fx fy fz tqx tqy tqz";
  std::string format = "%d";
  for (int k = 0; k < 15; ++k) format += " %.17g";
  return "dump all_" + file + " all custom 1 " + file + " " + columns + "\ndump_modify all_" + file +
         " sort id format \"" + format + "\"\nrun 0\nundump all_" + file + "\n";
}

// Numbers of a dump, by id.
using Row = std::array<double, 15>;
inline std::map<int, Row> read_dump(const EngineFolder &folder, const std::string &file) {
  std::istringstream in(folder.read(file));
  std::map<int, Row> rows;
  std::string line;
  while (std::getline(in, line) && line.compare(0, 11, "ITEM: ATOMS") != 0) {
  }
  while (std::getline(in, line)) {
    std::istringstream fields(line);
    int id;
    Row row;
    fields >> id;
    for (double &value : row) fields >> value;
    rows[id] = row;
  }
  return rows;
}

inline int bonds_installed(const EngineResult &r) {
  const std::size_t at = r.screen.find(" bonds installed");
  if (at == std::string::npos) return -1;
  const std::size_t begin = r.screen.rfind('\n', at);
  return std::stoi(r.screen.substr(begin + 1));
}

}  // namespace engine::bonds

#endif
