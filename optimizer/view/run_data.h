// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: what a finished run left, put together for pictures: particles at the start and the end,
//   every bond with its state, fragments, curve, and the bonds' forces where they were dumped.
// Method: the folder may be one of the store's or one where a deck was run by hand; all but the
//   particles at the end may be missing, and each missing thing is said in `missing`. The bonds are
//   the pairs of particles whose surfaces were nearer than the bond gap at the start (what
//   bond_install does) less those in the log of broken bonds. The start is particles_start.txt, or
//   else the specimen file that the manifest or the log names; the gap stands in the log. Fragments
//   are the connected parts of what is left.
// Units: SI.
// Failure: UserError when the folder, particles_end.txt or a file that is there can't be read.
// Limits: bonds installed by another rule than one gap for all particles are not known here.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "forward/curve.h"
#include "view/local_dump.h"

namespace bondlab {

using Vector3 = std::array<double, 3>;

struct ViewParticle {
  int id = 0, type = 1;
  double r = 0;
  Vector3 start{}, end{};
  int broken = 0;     // bonds it lost
  int fragment = -1;  // 0 is the heaviest; -1: not known
  std::array<double, 6> stress{};  // Pa, tension positive; xx yy zz xy xz yz
};

enum class BondState { intact, tension, shear };

struct ViewBond {
  int a = 0, b = 0;  // indices of particles, a < b
  BondState state = BondState::intact;
  double time = -1;  // s, of breaking; -1: never
  long step = -1;    // of breaking
  Vector3 place{};   // m, of breaking
};

struct BondForce {
  int a = 0, b = 0;
  double normal = 0;  // N, tension positive
  double shear = 0;   // N, its size
};

struct Fragment {
  int particles = 0;
  double share = 0;  // of the mass (volume; area in 2D)
};

struct RunView {
  std::filesystem::path folder;
  int dimension = 2;
  std::vector<ViewParticle> particles;
  bool has_start = false, has_bonds = false, has_log = false;
  bool has_stress = false;
  double gap = 0;  // m; 0: not known
  std::vector<ViewBond> bonds;
  std::vector<Fragment> fragments;  // heaviest first
  std::vector<BondForce> forces;
  bool has_forces = false;
  long force_step = 0;
  std::vector<Vector3> force_places;        // of the particles at that step; empty: as at the end
  Curve curve;                              // without rows when there is none
  std::string moment;                       // "step 4,000, 1.2 ms" of a frame; "": the end
  std::string test;                         // "uniaxial_compression"; "" when not known
  std::map<std::string, double> variables;  // deck variables in SI, of a run of the store
  std::vector<std::string> missing;         // sentences
  std::size_t broken(BondState state) const;
};

struct ViewOptions {
  double gap = 0;                    // m; 0: from the run
  std::filesystem::path bond_file;   // empty: the newest bonds_*.txt of the folder
  std::vector<std::string> columns;  // of the bond file
};

RunView read_run(const std::filesystem::path &folder, const ViewOptions &options = {});

// The steps that read_run() takes when particles and log are read; `columns` as in ViewOptions.
void find_bonds(RunView &run, const std::vector<BrokenBond> &events);
void find_fragments(RunView &run);
void read_forces(RunView &run, const std::filesystem::path &file,
                 const std::vector<std::string> &columns);

}  // namespace bondlab
