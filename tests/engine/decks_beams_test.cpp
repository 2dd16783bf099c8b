// SPDX-License-Identifier: GPL-2.0-or-later
//
// The decks of three-point bending and of the cantilever: statics, notch, closed form of a chain.
#include <gtest/gtest.h>

#include <cmath>

#include "bond_styles/laws/reference_table.h"
#include "deck_tools.h"
#include "fixes_deck.h"
#include "warm_bonds.h"

namespace {

using namespace engine::decks;
using engine::EngineFolder;
using engine::Table;

const double pi = std::acos(-1.0);

Table beam(const EngineFolder &folder, const std::string &test,
           const Values &values, int ranks = 1) {
  return curve_of(folder, test, with_specimen("beam_small_2d.data") + var(values), ranks, 240);
}

std::vector<double> mean_load(const Table &t) {
  std::vector<double> mean = t.column("force_top");
  const auto bottom = t.column("force_bottom");
  for (std::size_t k = 0; k < mean.size(); ++k) mean[k] = 0.5 * (mean[k] + bottom[k]);
  return mean;
}

TEST(BendingDeck, breaks_in_the_middle_of_the_tension_side) {
  EngineFolder folder;
  const Table t = beam(folder, "three_point_bending", {{"platen_speed", "0.05"}});
  EXPECT_EQ(t.completion, "stop_after_peak");
  const Table broken = engine::read_table(folder.file("broken_bonds.tsv"));
  ASSERT_GT(broken.rows.size(), 2u);
  // the moment is at least 2/3 of its largest within a sixth of the span from the middle
  EXPECT_LT(std::fabs(broken.column("x").front()), 0.010);
  EXPECT_LT(broken.column("y").front(), 0.005);
  EXPECT_EQ(broken.rows.front()[8], "tension");
  const double peak = largest(mean_load(t));
  // outer fibre stress 3 F S/(2 d^2) against the bonds' 35 MPa: of its order
  const double strength = 1.5 * peak * 0.060 / (0.020 * 0.020);
  EXPECT_GT(strength, 0.5 * 35e6);
  EXPECT_LT(strength, 2.0 * 35e6);
}

TEST(BendingDeck, reaction_equals_load_and_energy_equals_work) {
  EngineFolder folder;
  const Table t = beam(folder, "three_point_bending",
                       {kStrong, kTough, {"max_strain", "0.003"}, {"platen_speed", "0.05"}});
  const auto top = t.column("force_top"), bottom = t.column("force_bottom"),
             way = t.column("displacement"), strain = t.column("strain_energy");
  double in = 0, out = 0, work = 0;
  for (std::size_t k = 1; k < top.size(); ++k) {
    work += 0.5 * (top[k] + top[k - 1]) * (way[k] - way[k - 1]);
    if (way[k] > 0.5 * way.back()) in += top[k], out += bottom[k];
  }
  EXPECT_NEAR(out / in, 1.0, 0.02);
  // what is not in the beam is in the rollers' contacts and was damped: less than half
  EXPECT_LT(strain.back(), work);
  EXPECT_GT(strain.back(), 0.5 * work);
}

TEST(BendingDeck, warm_bonds_have_the_modulus_strength_and_creep_of_their_temperature) {
  const auto largest_load = [](const Values &values) {
    EngineFolder folder;
    return largest(mean_load(beam(folder, "three_point_bending", values)));
  };
  expect_bonds_of_their_temperature(largest_load, {{"platen_speed", "0.05"}},
                                    {kStrong, kTough, {"max_strain", "0.002"}});
}

TEST(BendingDeck, a_notch_weakens_opens_and_carries_the_crack) {
  EngineFolder a, b;
  const Table plain = beam(a, "three_point_bending", {{"platen_speed", "0.05"}, {"span", "0.076"}});
  const Table notched =
      beam(b, "three_point_bending", {{"platen_speed", "0.05"}, {"span", "0.076"}, {"notch_depth", "0.009"}});
  const double p = largest(mean_load(plain)), q = largest(mean_load(notched));
  // at the same strength of the fibre above the notch the load is (1 - a/d)^2; a notch is worse
  EXPECT_LT(q, std::pow(1 - 0.45, 2) * p);
  EXPECT_GT(q, 0.05 * p);
  const Table broken = engine::read_table(b.file("broken_bonds.tsv"));
  EXPECT_NEAR(broken.column("x").front(), 0.0, 0.003);
  EXPECT_NEAR(broken.column("y").front(), 0.009, 0.003);
  const auto opening = notched.column("opening"), deflection = notched.column("deflection");
  // two stiff halves about the tip's hinge: opening/deflection = 4 (d - a)/S and above
  const auto load = mean_load(notched);
  const double ratio = slope_where(deflection, opening, [&](std::size_t k) { return load[k] > 0.3 * q; });
  EXPECT_GT(ratio, 0.2);
  EXPECT_LT(ratio, 2.0);
}

TEST(BendingDeck, runs_a_notched_round_bar) {
  EngineFolder folder;
  const Table t = curve_of(
      folder, "three_point_bending",
      with_specimen("bar_small_3d.data") +
          var({{"dim", "3"}, {"height", "0.040"}, {"span", "0.0333"}, {"gap", "2e-5"},
               {"sigma_c", "20e6"}, {"notch_depth", "0.003"}, {"platen_speed", "0.1"}}),
      1, 240);
  EXPECT_EQ(t.completion, "stop_after_peak");
  EXPECT_GT(largest(t.column("opening")), 0.0);
}

const Values kPrism = {{"dim", "3"}, {"width", "0.008"}, {"height", "0.010"}, {"length", "0.040"},
                       {"span", "0.0333"}, {"gap", "2e-5"}, {"sigma_c", "20e6"}};

// dF/dw of an unbroken beam of spheres.
double bending_stiffness(const char *specimen, const Values &values) {
  EngineFolder folder;
  const Table t = curve_of(folder, "three_point_bending",
                           with_specimen(specimen) +
                               var(values + Values{kStrong, kTough, {"max_strain", "0.003"}, {"platen_speed", "0.05"}}),
                           1, 240);
  const auto deflection = t.column("deflection");
  return slope_where(deflection, mean_load(t),
                     [&](std::size_t k) { return deflection[k] > 0.3 * deflection.back(); });
}

TEST(BendingDeck, a_prism_is_as_stiff_as_a_round_bar_of_its_grains) {
  // Timoshenko: w/F = S^3/(48 E I) + S/(4 kappa G A), with Cowper's kappa
  const double S = 0.0333, d = 0.010, nu = 0.25;
  const auto E = [&](double stiffness, double I, double A, double kappa) {
    return stiffness * (S * S * S / (48 * I) + S / 4 * 2 * (1 + nu) / (kappa * A));
  };
  const Values bar = {{"dim", "3"}, {"height", "0.040"}, {"span", "0.0333"}, {"gap", "2e-5"}};
  Values prism = kPrism;
  prism.pop_back();
  const double of_prism = E(bending_stiffness("prism_small_3d.data", prism), 0.008 * d * d * d / 12,
                            0.008 * d, 10 * (1 + nu) / (12 + 11 * nu));
  const double of_bar = E(bending_stiffness("bar_small_3d.data", bar), pi * d * d * d * d / 64,
                          pi * d * d / 4, 6 * (1 + nu) / (7 + 6 * nu));
  // half a mean grain of the depth may be missing at both faces: (1 + 0.74/10)^3 - 1
  EXPECT_NEAR(of_prism / of_bar, 1.0, 0.24);
}

TEST(BendingDeck, runs_a_prism_whole_and_notched) {
  EngineFolder a, b;
  const auto run = [](const EngineFolder &folder, const Values &more) {
    return curve_of(folder, "three_point_bending", with_specimen("prism_small_3d.data") + var(kPrism + more), 1, 240);
  };
  const Table plain = run(a, {{"platen_speed", "0.05"}});
  EXPECT_EQ(plain.completion, "stop_after_peak");
  Table broken = engine::read_table(a.file("broken_bonds.tsv"));
  EXPECT_LT(broken.column("y").front(), 0.0) << "the tension side";
  EXPECT_NEAR(broken.column("z").front(), 0.020, 0.0333 / 6);  // the moment is above 2/3 of its largest
  EXPECT_EQ(broken.rows.front()[8], "tension");
  const Table notched = run(b, {{"platen_speed", "0.05"}, {"notch_depth", "0.003"}});
  EXPECT_EQ(notched.completion, "stop_after_peak");
  broken = engine::read_table(b.file("broken_bonds.tsv"));
  // at the notch's tip, y = -5 + 3 mm, to a mean grain's diameter
  EXPECT_NEAR(broken.column("y").front(), -0.002, 0.0015);
  EXPECT_NEAR(broken.column("z").front(), 0.020, 0.0015);
  EXPECT_LT(largest(mean_load(notched)), 0.7 * 0.7 * largest(mean_load(plain)));
  EXPECT_GT(largest(notched.column("opening")), 0.0);
}

TEST(BendingDeck, is_the_same_on_1_2_and_4_ranks) {
  expect_same_on_ranks("three_point_bending",
                       with_specimen("beam_small_2d.data") +
                           var({{"platen_speed", "0.1"}, {"stop_least", "0.08"},
                                {"notch_depth", "0.009"}, {"span", "0.076"}}),
                       0);
}

// ---- cantilever ----

// A row of touching spheres: the discrete chain of PHYSICS 2.5, n = 10 bonds. kn/ks = E/G = 2.6 is
// ks = G A/l; no grain contact, no damping of what is static.
TEST(CantileverDeck, a_chain_deflects_as_its_closed_form) {
  std::vector<engine::Particle> chain;
  for (int k = 0; k <= 10; ++k) chain.push_back({0, 0, 1e-3 + 2e-3 * k, 1e-3, 2500});
  EngineFolder folder;
  folder.write("chain.data", engine::data_file(chain, 3, 0.05));
  const Table t = curve_of(
      folder, "cantilever",
      std::vector<std::string>{"-var", "specimen", "chain.data"} +
          var({{"dim", "3"}, {"diameter", "0.002"}, {"height", "0.022"}, {"clamped", "0.002"},
               {"arm", "0.019"}, {"density", "2500"}, {"E_c", "0"}, {"E_b", "1e9"},
               {"kb_ratio", "2.6"}, {"gap", "1e-5"}, kStrong, kTough, {"max_strain", "2e-3"},
               {"platen_speed", "0.005"}, {"platen_ramp", "2e-3"}, {"platen_modulus", "1e9"},
               {"roller_radius", "0.001"}, {"gauge_size", "0.4"}}),
      1, 240);
  const bondlab::laws::testbench::ReferenceTable reference;
  const double per_newton =
      reference("cantilever_tip_load",
                "E=1e9 nu=.3 R_b=R=1mm l=2mm rho=2500; ks=GA/l; n=10 bonds; F=1e-3 N",
                "tip deflection") /
      1e-3;
  const auto load = t.column("force_top"), deflection = t.column("deflection");
  double f = 0, d = 0;  // the beam swings by a per cent about its static deflection
  for (std::size_t k = load.size() / 3; k < load.size(); ++k) f += load[k], d += deflection[k];
  EXPECT_NEAR(d / f / per_newton, 1.0, 0.01);
  // moment on the clamp: load times the arm, 10 bonds of 2 mm, from the clamped sphere
  EXPECT_NEAR(std::fabs(t.last("clamp_moment")) / (t.last("force_bottom") * 0.020), 1.0, 0.02);
}

// Seed 002, section 4.3.1, bounds the bonds' diameter by a cantilever: 0.5, 1.0 and 1.5 mm between beads
// of 1.69 mm, unbreakable. A row of such beads is Timoshenko's beam with the bonds' section when
// k_n/k_s = E/(kappa G); ten bonds of it bend less than the beam by 1/(4 n^2) = 0.25 %. Roller and clamp
// feel the damping of the moving beam with opposite sign. Thin bonds make a slow beam: a roller as slow.
TEST(CantileverDeck, follows_timoshenko_over_the_bond_diameters_of_seed_002) {
  const double R = 0.845e-3, nu = 0.3, E = 1e9, L = 10 * 2 * R;
  const double kappa = 6 * (1 + nu) / (7 + 6 * nu), G = E / (2 * (1 + nu));
  std::vector<engine::Particle> chain;
  for (int k = 0; k <= 10; ++k) chain.push_back({0, 0, R + 2 * R * k, R, 2500});
  const struct {
    double diameter;
    const char *speed, *ramp;
  } cases[] = {{0.5e-3, "2e-5", "2e-2"}, {1.0e-3, "1e-4", "5e-3"}, {1.5e-3, "2e-4", "2e-3"}};
  for (const auto &one : cases) {
    EngineFolder folder;
    folder.write("chain.data", engine::data_file(chain, 3, 0.05));
    const Table t = curve_of(
        folder, "cantilever",
        std::vector<std::string>{"-var", "specimen", "chain.data"} +
            var({{"dim", "3"}, {"diameter", "0.00169"}, {"height", "0.01859"}, {"clamped", "0.00169"},
                 {"arm", "0.016055"}, {"density", "2500"}, {"E_c", "0"}, {"E_b", "1e9"},
                 {"kb_ratio", std::to_string(E / (kappa * G))},
                 {"lambda", std::to_string(one.diameter / (2 * R))}, {"gap", "1e-5"}, kStrong, kTough,
                 {"max_strain", "2e-3"}, {"platen_speed", one.speed}, {"platen_ramp", one.ramp},
                 {"platen_modulus", "1e6"}, {"roller_radius", "0.000845"}, {"gauge_size", "0.4"}, {"every", "100"}}),
        1, 240);
    const auto load = mean_load(t), deflection = t.column("deflection");
    double f = 0, d = 0;
    for (std::size_t k = load.size() / 3; k < load.size(); ++k) f += load[k], d += deflection[k];
    const double I = pi * std::pow(one.diameter / 2, 4) / 4, A = pi * one.diameter * one.diameter / 4;
    const double timoshenko = L * L * L / (3 * E * I) + L / (kappa * G * A);
    EXPECT_NEAR(d / f / timoshenko, 1.0, 0.01) << one.diameter;  // what it swings about rest, as above
  }
}

TEST(CantileverDeck, a_packed_beam_breaks_at_its_root) {
  EngineFolder folder;
  const Table t = beam(folder, "cantilever", {{"platen_speed", "0.1"}});
  EXPECT_EQ(t.completion, "stop_after_peak");
  const Table broken = engine::read_table(folder.file("broken_bonds.tsv"));
  ASSERT_GT(broken.rows.size(), 1u);
  // the face is at x = -25 mm, the tension side above
  EXPECT_NEAR(broken.column("x").front(), -0.025, 0.008);
  EXPECT_GT(broken.column("y").front(), 0.010);
}

TEST(CantileverDeck, is_the_same_on_1_2_and_4_ranks) {
  expect_same_on_ranks("cantilever",
                       with_specimen("beam_small_2d.data") + var({{"platen_speed", "0.1"}}), 0);
}

}  // namespace
