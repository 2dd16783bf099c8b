// SPDX-License-Identifier: GPL-2.0-or-later
//
// The creep deck as a user starts it: macroscopic exponent, temperature, relaxation, ranks.
// Small specimens of inputs/specimens; units SI.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "engine_run.h"

namespace {

const std::string kInputs = std::string(BONDLAB_SOURCE_DIR) + "/inputs/";

std::string deck() {
  std::ifstream in(kInputs + "creep/in.creep");
  std::stringstream all;
  all << in.rdbuf();
  return all.str();
}

std::vector<std::string> settings(std::vector<std::string> more) {
  std::vector<std::string> all{"-var", "specimen", kInputs + "specimens/rectangle_small_2d.data"};
  for (std::size_t k = 0; k + 1 < more.size(); k += 2) all.insert(all.end(), {"-var", more[k], more[k + 1]});
  return all;
}

engine::Table curve(const std::vector<std::string> &more) {
  engine::EngineFolder folder;
  const auto r = engine::run_deck(folder, deck(), 1, settings(more), 240.0);
  EXPECT_TRUE(r.ok()) << r.screen.substr(r.screen.size() > 1500 ? r.screen.size() - 1500 : 0);
  return engine::read_table(folder.file("curve.tsv"));
}

// Over the last half of the time in which the load is kept.
struct Steady {
  double rate = 0.0, stress = 0.0;  // 1/s of the run, Pa
};
Steady steady(const engine::Table &t) {
  const auto time = t.column("time"), strain = t.column("strain_axial"), stress = t.column("axial_stress"),
             phase = t.column("phase");
  std::vector<std::size_t> kept;
  for (std::size_t k = 0; k < phase.size(); ++k)
    if (phase[k] == 3.0) kept.push_back(k);
  EXPECT_GT(kept.size(), 40u);
  double n = 0, st = 0, se = 0, stt = 0, ste = 0, load = 0;
  for (std::size_t k = kept.size() / 2; k < kept.size(); ++k) {
    const std::size_t at = kept[k];
    n += 1, st += time[at], se += strain[at], stt += time[at] * time[at], ste += time[at] * strain[at];
    load += stress[at];
  }
  return {(n * ste - st * se) / (n * stt - st * st), load / n};
}

}  // namespace

// All that carries load creeps with m = 3 and no contact shares it, so the specimen's exponent is 3. The
// smaller run is the larger one with all strains half as large; what is left is geometry.
TEST(CreepDeck, macroscopic_exponent_is_that_of_the_bond) {
  const Steady high = steady(curve({"load_stress", "2e6", "rate_factor", "12e5", "platen_speed", "0.1"}));
  const Steady low = steady(curve({"load_stress", "1e6", "rate_factor", "48e5", "platen_speed", "0.05"}));
  EXPECT_GT(high.rate, 0.0);
  const double exponent = std::log(high.rate / 12e5 / (low.rate / 48e5)) / std::log(high.stress / low.stress);
  EXPECT_NEAR(exponent, 3.0, 0.015);
}

// Warmer by ten degrees and A(T) times slower a run: the same curve.
TEST(CreepDeck, temperature_shifts_the_time) {
  const double a = std::exp(-60e3 / 8.31446261815324 * (1 / 268.15 - 1 / 258.15));
  std::ostringstream factor;
  factor.precision(17);
  factor << 3e5 / a;
  const std::vector<std::string> common{"reference", "258.15", "activation", "60e3", "creep_time", "3e-3"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.end(), common.begin(), common.end());
    return curve(more);
  };
  const auto cold = with({"temperature", "258.15"}), warm = with({"temperature", "268.15", "rate_factor", factor.str()});
  EXPECT_NEAR(warm.last("strain_axial") / cold.last("strain_axial"), 1.0, 1e-6);
  const auto warmer = with({"temperature", "268.15"});
  EXPECT_GT(steady(warmer).rate, 1.5 * steady(cold).rate);
}

TEST(CreepDeck, stress_relaxes_at_held_strain) {
  const auto t = curve({"hold_time", "3e-3", "creep_time", "0"});
  const auto phase = t.column("phase"), stress = t.column("axial_stress"), strain = t.column("strain_platen");
  std::size_t first = 0, last = 0;
  for (std::size_t k = 0; k < phase.size(); ++k)
    if (phase[k] == 2.0) first = first ? first : k, last = k;
  ASSERT_GT(last, first + 20);
  EXPECT_LT(stress[last], 0.9 * stress[first]);
  EXPECT_GT(stress[last], 0.2 * stress[first]);
  EXPECT_NEAR(strain[last] / strain[first], 1.0, 1e-9);
}

TEST(CreepDeck, is_the_same_on_1_2_and_4_ranks) {
  const auto more = settings({"creep_time", "5e-4", "sigma_max", "12e6", "tau_max", "12e6"});
  engine::EngineFolder one;
  const auto first = engine::run_deck(one, deck(), 1, more, 120.0);
  ASSERT_TRUE(first.ok()) << first.screen;
  for (const int ranks : {2, 4}) {
    engine::EngineFolder other;
    const auto run = engine::run_deck(other, deck(), ranks, more, 300.0);
    ASSERT_TRUE(run.ok()) << run.screen;
    for (const char *file : {"curve.tsv", "broken_bonds.tsv", "particles_end.txt"})
      EXPECT_EQ(one.read(file), other.read(file)) << file << " on " << ranks << " ranks";
  }
}
