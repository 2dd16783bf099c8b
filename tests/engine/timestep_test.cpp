// SPDX-License-Identifier: GPL-2.0-or-later
//
// timestep_bonded sets a step below the true limit 2/omega_max of the network, by less than 1 %.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bond_deck.h"
#include "laws/chain_modes.h"

using namespace engine;
using namespace engine::bonds;
namespace bench = bondlab::laws::testbench;

namespace {

struct Case {
  const char *name;
  double distance, ratio, contact;  // m, k_n/k_s, Pa
  bool flat;
  int grains;
};

double step_set(const EngineResult &r) {
  const std::size_t at = r.screen.find("time step ");
  return at == std::string::npos ? 0.0 : std::stod(r.screen.substr(at + 10));
}

}  // namespace

class TimeStep : public testing::TestWithParam<Case> {};

TEST_P(TimeStep, step_lies_below_the_true_limit_but_not_by_much) {
  const Case c = GetParam();
  bench::Bench b(c.flat, 0.003);
  std::vector<Particle> particles;
  for (int k = 0; k < c.grains; ++k) {
    const double radius = 1e-3 * (k % 2 ? 0.8 : 1.0);
    b.add({k * c.distance, 0, 0}, radius, 2500);
    particles.push_back({k * c.distance, 0, 0, radius, 2500});
  }
  bondlab::laws::ParallelParameters p;
  p.modulus = 3e9;
  p.ratio = c.ratio;
  std::string list;
  for (int k = 0; k + 1 < c.grains; ++k) {
    b.bond(k, k + 1, p, {c.contact, c.ratio, 1e9});
    // pressed a little, so that the contact acts as it does in the bound
    b.pairs.back().reference *= 1.001;
    list += std::to_string(k + 1) + " " + std::to_string(k + 2) + "\n";
  }
  const bench::Modes m = bench::modes(bench::dynamic_matrix(
      b, bench::freedoms_of(b, c.flat ? std::vector<int>{0, 1, 5} : std::vector<int>{0, 1, 2, 3, 4, 5})));
  const double limit = 2.0 / m.omega.back();

  EngineFolder folder;
  folder.write("grains.data", data_file(particles, c.flat ? 2 : 3, 0.05));
  folder.write("pairs", list);
  Preamble deck;
  deck.dimension = c.flat ? 2 : 3;
  if (c.flat) deck.atom_style = "bonded/sphere thickness 0.003";
  deck.specimen = "grains.data";
  deck.install = "file pairs";
  deck.bond = "3e9 " + std::to_string(c.ratio) + " 1e15 1e15";
  deck.contact = std::to_string(c.contact) + " " + std::to_string(c.ratio) + " 0.5";
  deck.safety = 1.0;
  const EngineResult r = run_deck(folder, deck.text() + "fix integrate all nve/bonded\nrun 0\n");
  ASSERT_TRUE(r.ok()) << r.screen;
  const double step = step_set(r);
  EXPECT_LE(step, limit * (1.0 + 1e-5));  // printed with six digits
  EXPECT_GE(step, 0.99 * limit);
}

INSTANTIATE_TEST_SUITE_P(
    Networks, TimeStep,
    testing::Values(Case{"soft_shear", 1.8e-3, 10.0, 0.0, false, 12}, Case{"usual", 1.8e-3, 2.5, 3e9, false, 12},
                    Case{"stiff_shear", 1.8e-3, 0.5, 0.0, false, 12}, Case{"stiff_shear_gap", 2.7e-3, 0.5, 0.0, false, 12},
                    Case{"overlapping", 1.5e-3, 1.0, 3e9, false, 12}, Case{"plane", 1.8e-3, 2.5, 3e9, true, 12},
                    Case{"plane_gap", 2.4e-3, 0.7, 0.0, true, 12}, Case{"two_grains", 1.8e-3, 1.0, 0.0, false, 2}, Case{"two_grains_gap", 3.2e-3, 0.3, 0.0, false, 2}),
    [](const auto &info) { return info.param.name; });

// The packing vibrates freely, without damping: below the limit its energy swings by no more than
// (omega dt)^2/4 of each mode, above it the highest mode grows without bounds.
TEST(TimeStepOfPacking, is_stable_below_the_limit_and_not_above) {
  for (const double safety : {0.5, 0.98, 1.05}) {
    EngineFolder folder;
    Preamble p = small();
    p.safety = 1.0;
    p.contact = "0 2.0 0.5";
    const EngineResult r = run_deck(folder, p.text() +
        "variable step equal " + std::to_string(safety) + "*dt\nvariable fixed equal ${step}\ntimestep ${fixed}\n"
        "velocity all ramp vz -0.1 0.1 z 0 0.012\nfix integrate all nve/bonded\n"
        "compute energy all energy/bonded\nvariable e equal c_energy[1]+c_energy[2]+c_energy[3]+c_energy[4]\n"
        "fix curve all curve 100 curve.tsv e J v_e\nrun 4000\n");
    const std::vector<double> e = read_table(folder.file("curve.tsv")).column("e");
    ASSERT_GT(e.front(), 0.0);
    const auto [least, most] = std::minmax_element(e.begin(), e.end());
    if (safety > 1.0) {
      EXPECT_TRUE(!r.ok() || *most > 10.0 * e.front());
    } else {
      ASSERT_TRUE(r.ok()) << r.screen;
      EXPECT_LT(*most / e.front(), 1.01);  // the ramp excites long waves most
      EXPECT_GT(*least / e.front(), 0.99);
    }
  }
}
