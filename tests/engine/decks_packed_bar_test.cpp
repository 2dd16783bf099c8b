// SPDX-License-Identifier: GPL-2.0-or-later
//
// A packed round bar in 3D, held by its bonds alone (no grain contacts: linear both ways): direct
// tension against compression and against what its bonds can carry, the cantilever against
// Timoshenko's beam with the bar's own E and nu.
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <tuple>

#include "deck_tools.h"

namespace {

using namespace engine::decks;
using engine::EngineFolder;
using engine::Table;

const double pi = std::acos(-1.0);
const double kDiameter = 0.010, kGap = 2e-5;
const Values kBar{{"dim", "3"}, {"height", "0.040"}, {"gap", "2e-5"}, {"E_c", "0"}};
const Values kElastic{kStrong, kTough, {"max_strain", "0.001"}};

Table bar(const EngineFolder &folder, const std::string &test, const Values &values) {
  return curve_of(folder, test, with_specimen("bar_small_3d.data") + var(kBar + values), 1, 240);
}

struct Grain {
  double x, y, z, r;
};

// The grains as the deck wrote them before the first step: id type radius x y z.
std::vector<Grain> grains_at_start(const EngineFolder &folder) {
  std::istringstream in(folder.read("particles_start.txt"));
  std::vector<Grain> grains;
  bool atoms = false;
  for (std::string line; std::getline(in, line);) {
    std::istringstream fields(line);
    double id, type;
    Grain g;
    if (atoms && fields >> id >> type >> g.r >> g.x >> g.y >> g.z) grains.push_back(g);
    atoms = atoms || line.find("ITEM: ATOMS") == 0;
  }
  return grains;
}

// Over what the second half and more of a run shows: 0.3 of its largest strain and above.
double slope_of(const Table &t, const char *name) {
  const auto strain = t.column("strain_axial");
  return slope_where(strain, t.column(name),
                     [&](std::size_t k) { return strain[k] > 0.3 * strain.back(); });
}

// Most load that the bonds across one plane between the grips can carry, whatever the moments,
// which only weaken them: sigma_c A |n_z| + tau_c A sqrt(1 - n_z^2) each, A of the smaller grain's
// radius.
double load_of_weakest_plane(const std::vector<Grain> &grains, double sigma_c, double tau_c) {
  double weakest = 1e300;
  for (double plane = 0.005; plane <= 0.035; plane += 0.0005) {
    double load = 0;
    for (const Grain &a : grains)
      for (const Grain &b : grains) {
        if (!(a.z < plane && b.z >= plane)) continue;
        const double d = std::hypot(std::hypot(b.x - a.x, b.y - a.y), b.z - a.z);
        if (d - a.r - b.r >= kGap) continue;
        const double n = (b.z - a.z) / d, area = pi * std::pow(std::fmin(a.r, b.r), 2);
        load += area * (sigma_c * n + tau_c * std::sqrt(1 - n * n));
      }
    weakest = std::fmin(weakest, load);
  }
  return weakest;
}

// Load on the bar when the first bond breaks, and by how much it rises between two points of the
// curve.
std::pair<double, double> first_break(const Table &t) {
  const auto top = t.column("force_top"), bottom = t.column("force_bottom"),
             broken = t.column("broken_bonds");
  std::size_t k = 1;
  while (k + 1 < top.size() && broken[k] == 0) ++k;
  const auto load = [&](std::size_t i) { return 0.5 * (top[i] + bottom[i]); };
  return {load(k), load(k) - load(k - 1)};
}

TEST(PackedBar, is_as_stiff_in_tension_as_in_compression_and_pulls_at_both_ends_alike) {
  EngineFolder a, b;
  const Table pull = bar(a, "direct_tension", kElastic + Values{{"pull_speed", "0.05"}});
  const Table push = bar(b, "uniaxial_compression", kElastic);
  // glued ends against frictionless ones: what they do dies off as exp(-2.7 z/R), to 4 % where the
  // gauges begin, 6 mm from the grips; with nu below 0.25 clamping stiffens by less than 20 %. That
  // is 0.8 %.
  EXPECT_NEAR(slope_of(pull, "axial_stress") / slope_of(push, "axial_stress"), 1.0, 0.01);
  EXPECT_NEAR(slope_of(pull, "strain_lateral"), slope_of(push, "strain_lateral"), 0.02);
  const auto top = pull.column("force_top"), bottom = pull.column("force_bottom");
  std::size_t loaded = 0;
  for (std::size_t k = 0; k < top.size(); ++k)
    if (top[k] > 0.5 * top.back()) {
      ++loaded;
      EXPECT_NEAR(top[k] / bottom[k], 1.0, 0.01) << k;
    }
  EXPECT_GT(loaded, 20u);
}

TEST(PackedBar, is_no_stronger_than_the_bonds_across_its_weakest_plane) {
  double first[2], between[2];
  for (const int twice : {0, 1}) {
    EngineFolder folder;
    const char *strength = twice ? "40e6" : "20e6";
    const Table t =
        bar(folder, "direct_tension",
            {{"sigma_c", strength}, {"tau_c", strength}, {"pull_speed", "0.05"}, {"every", "10"}});
    EXPECT_EQ(t.completion, "stop_after_peak");
    const std::vector<Grain> grains = grains_at_start(folder);
    ASSERT_EQ(grains.size(), 1022u);
    const double bound = load_of_weakest_plane(grains, twice ? 40e6 : 20e6, twice ? 40e6 : 20e6);
    const double peak = 0.5 * (largest(t.column("force_top")) + largest(t.column("force_bottom")));
    EXPECT_LT(peak, bound);
    std::tie(first[twice], between[twice]) = first_break(t);
    EXPECT_LE(first[twice], peak);
    const Table broken = engine::read_table(folder.file("broken_bonds.tsv"));
    for (const double z : broken.column("z")) {
      EXPECT_GT(z, 0.1 * 0.040);  // not in the grips
      EXPECT_LT(z, 0.9 * 0.040);
    }
  }
  // until the first bond breaks all is linear: at twice the strength it breaks at twice the load,
  // to a point of each curve
  EXPECT_NEAR(first[1], 2 * first[0], between[1] + 2 * between[0]);
}

// A frictionless roller pushes towards its axis, and the grain it touches is not below it: the line
// of its force meets the middle line where the moment on the clamp says, at a from the clamp's
// face. Timoshenko at x >= a: w/F = a^2 (3 x - a)/(6 E I) + a/(kappa G A). The root lies within a
// mean radius of the clamp's face: 3 R/x of the compliance, the smaller the longer the arm.
TEST(PackedBar, as_a_cantilever_is_timoshenkos_beam_to_a_grain_at_its_root) {
  EngineFolder of_pull;
  const Table pull = bar(of_pull, "direct_tension", kElastic + Values{{"pull_speed", "0.05"}});
  const double E = slope_of(pull, "axial_stress"), nu = slope_of(pull, "strain_lateral");
  const double G = E / (2 * (1 + nu)), kappa = 6 * (1 + nu) / (7 + 6 * nu);
  const double I = pi * std::pow(kDiameter, 4) / 64, A = pi * kDiameter * kDiameter / 4;
  for (const double x : {0.0125, 0.025}) {
    EngineFolder folder;
    const Table t = bar(folder, "cantilever",
                        {kStrong,
                         kTough,
                         {"clamped", "0.010"},
                         {"arm", std::to_string(x)},
                         {"max_strain", "0.002"},
                         {"platen_speed", "0.05"}});
    double R = 0, centre = 0, held = 0;
    const std::vector<Grain> grains = grains_at_start(folder);
    ASSERT_EQ(grains.size(), 1022u);
    for (const Grain &g : grains) {
      R += g.r / static_cast<double>(grains.size());
      if (g.z < 0.010) centre += g.z, ++held;
    }
    centre /= held;
    const auto top = t.column("force_top"), bottom = t.column("force_bottom"),
               moment = t.column("clamp_moment"), deflection = t.column("deflection");
    double F = 0, M = 0, w = 0;  // sums: the beam swings by a per cent about its static deflection
    for (std::size_t k = top.size() / 3; k < top.size(); ++k)
      F += 0.5 * (top[k] + bottom[k]), M += std::fabs(moment[k]), w += deflection[k];
    const double a = M / F - (0.010 - centre);
    EXPECT_NEAR(a, x, 0.004) << "more than the roller's radius";
    const double beam = a * a * (3 * x - a) / (6 * E * I) + a / (kappa * G * A);
    EXPECT_NEAR(w / F / beam, 1.0, 3 * R / x) << "arm " << x;
  }
}

}  // namespace
