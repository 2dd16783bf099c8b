// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: the decks of the virtual laboratory run as a user starts them, in 2D and 3D, stop by
// themselves, and write the same bytes on 1, 2 and 4 ranks.
//
// Method: small specimens, no parameter but those of the deck; what is looked at is the curve file,
// the list of broken bonds and the final particles. Units: SI. Failure: the folder is left.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "deck_tools.h"

namespace {

using namespace engine::decks;

const std::vector<std::string> kCylinder{"-var", "dim", "3", "-var", "diameter", "0.010", "-var",
                                         "height", "0.020", "-var", "sigma_c", "20e6", "-var",
                                         "gap", "2e-5", "-var", "platen_speed", "0.2"};
const std::vector<std::string> kShortCylinder{
    "-var", "dim", "3", "-var", "diameter", "0.010", "-var", "thickness", "0.005",
    "-var", "sigma_c", "20e6", "-var", "gap", "2e-5", "-var", "platen_speed", "0.2"};

TEST(UniaxialDeck, is_the_same_on_1_2_and_4_ranks_in_2d) {
  expect_same_on_ranks("uniaxial_compression", with_specimen("rectangle_small_2d.data"));
}

TEST(UniaxialDeck, is_the_same_on_1_2_and_4_ranks_in_3d) {
  expect_same_on_ranks("uniaxial_compression", with_specimen("cylinder_small_3d.data", kCylinder));
}

TEST(BrazilianDeck, is_the_same_on_1_2_and_4_ranks) {
  expect_same_on_ranks("brazilian", with_specimen("disc_small_2d.data", {"-var", "jaw_radius", "1.5"}));
}

TEST(UniaxialDeck, stops_after_the_peak_with_complete_files) {
  engine::EngineFolder folder;
  const auto run = engine::run_deck(folder, deck("uniaxial_compression"), 1,
                                    with_specimen("rectangle_small_2d.data"));
  ASSERT_TRUE(run.ok()) << run.screen;
  const engine::Table curve = engine::read_table(folder.file("curve.tsv"));
  EXPECT_EQ(curve.completion, "stop_after_peak");
  EXPECT_FALSE(engine::read_table(folder.file("broken_bonds.tsv")).completion.empty());
  const auto stress = curve.column("axial_stress"), strain = curve.column("strain_axial");
  const double peak = *std::max_element(stress.begin(), stress.end());
  EXPECT_LT(stress.back(), 0.7 * peak + 1e-9 * peak);
  EXPECT_GT(peak, 35e6);  // above the bonds' tensile strength
  EXPECT_LT(peak, 5 * 35e6);
  // a packing of touching discs with E_c = E_b has a modulus somewhat above E_c, and gauges in the
  // middle see at most as much strain as the platens
  const double modulus = slope(strain, stress, 0.4, 0.6);
  EXPECT_GT(modulus, 25e9);
  EXPECT_LT(modulus, 2.5 * 25e9);
  EXPECT_LT(slope(curve.column("strain_platen"), stress, 0.4, 0.6), 1.02 * modulus);
  // quasi-static: both platens carry the same load on the way up
  const auto top = curve.column("force_top"), bottom = curve.column("force_bottom");
  // (up to the first broken bond; each break sends a wave to one platen first)
  const auto broken = curve.column("broken_bonds");
  std::size_t looked_at = 0;
  for (std::size_t k = 0; k < stress.size() && broken[k] == 0.0; ++k)
    if (stress[k] > 0.1 * peak) {
      EXPECT_NEAR(top[k] / bottom[k], 1.0, 0.01) << "point " << k;
      ++looked_at;
    }
  EXPECT_GT(looked_at, 20u);
  // the list of broken bonds and the curve's count agree
  EXPECT_EQ(engine::read_table(folder.file("broken_bonds.tsv")).rows.size(),
            static_cast<std::size_t>(curve.last("broken_bonds")));
}

// Moduli, strengths and density times two: the same path, all stresses times two (PHYSICS: a scaling
// invariance). Two is a power of two, so every
// bit of the platen's force must agree.
TEST(UniaxialDeck, doubles_its_stresses_with_moduli_strengths_and_density) {
  engine::Table curves[2];
  for (const int k : {0, 1}) {
    engine::EngineFolder folder;
    const auto run = engine::run_deck(
        folder, deck("uniaxial_compression"), 1,
        with_specimen("rectangle_small_2d.data",
                      {"-var", "E_c", k ? "50e9" : "25e9", "-var", "E_b", k ? "50e9" : "25e9",
                       "-var", "platen_modulus", k ? "50e9" : "25e9", "-var", "sigma_c",
                       k ? "70e6" : "35e6", "-var", "tau_c", k ? "180e6" : "90e6", "-var",
                       "density", k ? "5244" : "2622"}));
    ASSERT_TRUE(run.ok()) << run.screen;
    curves[k] = engine::read_table(folder.file("curve.tsv"));
  }
  const auto once = curves[0].column("force_top"), twice = curves[1].column("force_top");
  ASSERT_EQ(once.size(), twice.size());
  for (std::size_t k = 0; k < once.size(); ++k) ASSERT_EQ(2.0 * once[k], twice[k]) << "point " << k;
  EXPECT_EQ(curves[0].column("strain_lateral"), curves[1].column("strain_lateral"));
}

// At the resolution of the granite study, 33 grains across (with 16 the disc breaks at its rim).
TEST(BrazilianDeck, splits_the_disc_along_the_load) {
  engine::EngineFolder folder;
  const std::string specimen = folder.file("disc.data");
  const std::string make = std::string("'") + BONDLAB_BIN + "' specimen disc --diameter '50 mm' --r-min '0.58 mm' --seed 1 --out '" +
                           specimen + "' > /dev/null 2>&1 < /dev/null";
  ASSERT_EQ(std::system(make.c_str()), 0);
  const auto run = engine::run_deck(
      folder, deck("brazilian"), 1,
      {"-var", "specimen", specimen, "-var", "diameter", "0.05", "-var", "jaw_radius", "1.5", "-var",
       "platen_mu", "0.3", "-var", "gap", "8e-5", "-var", "platen_speed", "0.1", "-var", "safety",
       "0.8", "-var", "sigma_c", "55e6"});
  ASSERT_TRUE(run.ok()) << run.screen;
  EXPECT_EQ(engine::read_table(folder.file("curve.tsv")).completion, "stop_after_peak");
  const engine::Table broken = engine::read_table(folder.file("broken_bonds.tsv"));
  const auto x = broken.column("x"), y = broken.column("y");
  const double radius = 0.025;
  int near = 0, middle = 0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    near += std::fabs(x[k]) < 0.2 * radius;
    middle += std::fabs(y[k]) < 0.5 * radius;
  }
  EXPECT_GT(near, 0.8 * x.size()) << "the breaks don't follow the loaded diameter";
  EXPECT_GT(middle, 0.25 * x.size()) << "the crack doesn't cross the middle";
  std::size_t tension = 0;
  for (const auto &row : broken.rows)
    for (const auto &word : row) tension += word == "tension";
  EXPECT_GT(tension, 0.7 * broken.rows.size());
}

// Jaws near the disc's own radius and a fifth as stiff as its grains spread the load.
TEST(BrazilianDeck, cracks_start_in_the_middle_between_close_soft_jaws) {
  engine::EngineFolder folder;
  const std::string specimen = folder.file("disc.data");
  const std::string make = std::string("'") + BONDLAB_BIN + "' specimen disc --diameter '50 mm' --r-min '0.58 mm' --seed 1 --out '" +
                           specimen + "' > /dev/null 2>&1 < /dev/null";
  ASSERT_EQ(std::system(make.c_str()), 0);
  const engine::Table t = curve_of(
      folder, "brazilian",
      {"-var", "specimen", specimen, "-var", "diameter", "0.05", "-var", "jaw_radius", "1.2", "-var",
       "platen_modulus", "5e9", "-var", "platen_mu", "0.3", "-var", "gap", "8e-5", "-var",
       "platen_speed", "0.1", "-var", "safety", "0.8", "-var", "sigma_c", "55e6"});
  const auto load = t.column("force_top");
  const double peak = t.column("time")[std::max_element(load.begin(), load.end()) - load.begin()];
  const engine::Table broken = engine::read_table(folder.file("broken_bonds.tsv"));
  const auto x = broken.column("x"), y = broken.column("y"), time = broken.column("time");
  std::size_t count = 0;
  while (count < x.size() && time[count] <= peak) ++count;
  ASSERT_GT(count, 5u);
  const auto mean = [&](std::size_t until) {  // distance from the centre over the radius
    double sum = 0;
    for (std::size_t k = 0; k < until; ++k) sum += std::hypot(x[k], y[k]);
    return sum / static_cast<double>(until) / 0.025;
  };
  // Cracks spread evenly would lie at 2/3, at the platens at 1. The first ones as `bondlab run` has
  // them; on another packing than this they are at 0.71 (README.md).
  EXPECT_LT(mean(std::max<std::size_t>(5, count / 10)), 0.6);
  EXPECT_LT(mean(count), 0.5);
}

TEST(BrazilianDeck, runs_in_3d) {
  engine::EngineFolder folder;
  const auto run = engine::run_deck(folder, deck("brazilian"), 2,
                                    with_specimen("brazilian_small_3d.data", kShortCylinder), 120);
  ASSERT_TRUE(run.ok()) << run.screen;
  EXPECT_EQ(engine::read_table(folder.file("curve.tsv")).completion, "stop_after_peak");
}

TEST(Decks, name_a_variable_that_is_out_of_range) {
  engine::EngineFolder folder;
  const auto run = engine::run_deck(folder, deck("uniaxial_compression"), 1,
                                    with_specimen("rectangle_small_2d.data", {"-var", "sigma_c", "-1"}));
  EXPECT_FALSE(run.ok());
  EXPECT_TRUE(run.says("sigma_c")) << run.screen;
  EXPECT_TRUE(run.says("must be positive")) << run.screen;
}

}  // namespace
