// SPDX-License-Identifier: GPL-2.0-or-later
//
// The options of the uniaxial compression deck: bad ends, a leaning specimen, the machine's frame, a
// confining pressure, cycles, holds and rate steps; against closed forms where there are any.
#include <gtest/gtest.h>

#include <cmath>

#include "bond_styles/laws/reference_table.h"
#include "deck_tools.h"
#include "fixes_deck.h"

namespace {

using namespace engine::decks;
using engine::EngineFolder;
using engine::Table;

const double pi = std::acos(-1.0);
constexpr double kHeight = 0.050, kWidth = 0.025;

// The small rectangle; bonds that don't break unless said otherwise.
Table rectangle(const EngineFolder &folder,
                const std::vector<std::pair<std::string, std::string>> &values, int ranks = 1) {
  return curve_of(folder, "uniaxial_compression",
                  with_specimen("rectangle_small_2d.data") + var(values), ranks);
}

// ---- ends that are not parallel ----

// A bed of separate springs under a tilted platen: the law of seating of a rigid platen that
// doesn't turn (rows wedge_toe). Particles that are held, side by side on the end.
double wedge_force(bool circular, double s) {
  const int across = circular ? 150 : 400;
  const double d = 0.1, pitch = d / across, r = 0.4 * pitch, theta = 0.01, modulus = 1e9;
  std::vector<engine::Particle> end;
  for (int i = 0; i < across; ++i)
    for (int j = 0; j < (circular ? across : 1); ++j) {
      engine::Particle p;
      p.x = (i + 0.5) * pitch - 0.5 * d;
      p.z = circular ? (j + 0.5) * pitch - 0.5 * d : 0.0;
      if (std::hypot(p.x, p.z) > 0.5 * d) continue;
      p.radius = r;
      end.push_back(p);
    }
  EngineFolder folder;
  folder.write("particles.data", engine::data_file(end, circular ? 3 : 2, 0.1));
  const double u = s * std::tan(theta) * d;
  const std::string steps = "100", dt = "1e-6";
  const auto run = engine::run_deck(
      folder, engine::few_particles(circular ? 3 : 2, 1e-6) + "fix p all platen plane " +
                  engine::number(-0.5 * d) + " " + engine::number(r / std::cos(theta)) + " 0 " +
                  engine::number(std::sin(theta)) + " " + engine::number(-std::cos(theta)) +
                  " 0 modulus 1e9 velocity 0 " + engine::number(-u / 1e-4) +
                  " 0\nfix curve all curve 100 curve.tsv f N f_p[2] d m f_p[8]\nrun 100\n");
  EXPECT_TRUE(run.ok()) << run.screen;
  const Table t = engine::read_table(folder.file("curve.tsv"));
  EXPECT_NEAR(-t.last("d"), u, 1e-9 * u);
  const double k = circular ? 4 * r * modulus : 2 * 0.01 * modulus;
  return t.last("f") / (k * end.size() * std::sin(theta) * std::cos(theta) * d);
}

TEST(UniaxialDeck, a_tilted_platen_seats_as_the_wedge_law_says) {
  const bondlab::laws::testbench::ReferenceTable reference;
  for (const char *s : {"0.1", "0.25", "0.5", "0.75", "1", "1.5"}) {
    const double circle = reference(
        "wedge_toe",
        std::string("circular end, rigid non-rotating platen, end angle theta; s=u/(theta d)=") + s,
        "F/(E A theta d/L)");
    const double strip =
        reference("wedge_toe", std::string("rectangular end; s=") + s, "F/(E A theta d/L)");
    // midpoint rule: 1/(8 N^2) at the kink for the strip; the circle's rim is ragged by a pitch,
    // scattered over its N rows: N^-3/2
    EXPECT_NEAR(wedge_force(false, std::stod(s)), strip, 1.0 / (8 * 400 * 400) + 1e-9) << s;
    EXPECT_NEAR(wedge_force(true, std::stod(s)), circle, std::pow(150, -1.5)) << s;
  }
}

// Once the whole end is seated the specimen is as stiff as with good ends, behind by half of the
// wedge, alpha W/2; and a frictionless tilted platen is pushed aside with tan(alpha) of the load.
TEST(UniaxialDeck, an_end_out_of_parallel_delays_the_load_by_half_the_wedge) {
  EngineFolder a, b;
  const double wedge = 0.1 * pi / 180 * kWidth;
  const Table good = rectangle(a, {kStrong, kTough, {"max_strain", "0.004"}});
  const Table bad = rectangle(b, {kStrong, kTough, {"max_strain", "0.004"}, {"alpha", "0.1"}});
  const auto u = bad.column("displacement"), stress = bad.column("axial_stress"),
             side = bad.column("side_force"), top = bad.column("force_top"),
             good_u = good.column("displacement"), good_stress = good.column("axial_stress");
  const auto seated = [&](const std::vector<double> &way) {
    return [&way, wedge](std::size_t k) { return way[k] > 2 * wedge; };
  };
  const double stiff = slope_where(good_u, good_stress, seated(good_u));
  EXPECT_NEAR(slope_where(u, stress, seated(u)) / stiff, 1.0, 0.02);
  EXPECT_NEAR(u.back() - stress.back() / stiff - (good_u.back() - good_stress.back() / stiff),
              0.5 * wedge, 0.1 * wedge);
  for (std::size_t k = 20; k < u.size(); ++k)
    ASSERT_NEAR(side[k], -std::tan(0.1 * pi / 180) * top[k], 1e-9 * top.back());
  // the toe: half way of seating the load is well below the seated specimen's
  const auto half = std::find_if(u.begin(), u.end(), [&](double x) { return x > 0.5 * wedge; });
  EXPECT_LT(stress[half - u.begin()], 0.6 * stiff * *half);
}

// ---- the leaning specimen ----

TEST(UniaxialDeck, a_leaning_specimen_has_level_ends_and_is_weaker) {
  EngineFolder a, b;
  const Table upright = rectangle(a, {}), leaning = rectangle(b, {{"tilt", "10"}}, 2);
  // the packing loses the share H tan(tilt)/W of its discs, and the load meets whole ends
  const double left = 1.0 - kHeight * std::tan(10 * pi / 180) / kWidth;
  std::istringstream start(b.read("particles_start.txt"));
  std::string line;
  for (int k = 0; k < 3; ++k) std::getline(start, line);
  std::getline(start, line);
  EXPECT_NEAR(std::stod(line) / 299.0, left, 0.05);
  const double e = slope(upright.column("strain_platen"), upright.column("axial_stress"), 0.4, 0.6);
  const double lean =
      slope(leaning.column("strain_platen"), leaning.column("axial_stress"), 0.4, 0.6);
  EXPECT_LT(lean, e);
  EXPECT_GT(lean, 0.6 * e);
  EXPECT_LT(largest(leaning.column("axial_stress")), 0.95 * largest(upright.column("axial_stress")));
}

TEST(UniaxialDeck, lean_and_confinement_together_are_refused) {
  EngineFolder folder;
  const auto run = engine::run_deck(folder, deck("uniaxial_compression"), 1,
                                    with_specimen("rectangle_small_2d.data") +
                                        var({{"tilt", "2"}, {"confining_pressure", "1e6"}}));
  EXPECT_FALSE(run.ok());
  EXPECT_TRUE(run.says("tilt_and_confining_pressure_can_not_be_used_together")) << run.screen;
}

// ---- the machine ----

TEST(UniaxialDeck, the_frame_is_in_series_with_the_specimen) {
  EngineFolder folder;
  const double frame = 20e9;  // N/m
  const Table t =
      rectangle(folder, {kStrong, kTough, {"max_strain", "0.003"}, {"frame_stiffness", "20e9"}});
  const auto stress = t.column("axial_stress"), platen = t.column("strain_platen"),
             machine = t.column("strain_machine");
  const auto loaded = [&](std::size_t k) { return machine[k] > 0.001; };
  const double by_platen = slope_where(platen, stress, loaded);
  const double by_machine = slope_where(machine, stress, loaded);
  EXPECT_NEAR(1 / by_machine - 1 / by_platen, kWidth / (frame * kHeight),
              0.02 * kWidth / (frame * kHeight));
}

// ---- confinement ----

TEST(UniaxialDeck, confining_pressure_acts_on_all_sides_and_strengthens) {
  EngineFolder a, b;
  const Table free = rectangle(a, {{"mu", "0.5"}});
  const Table cell = rectangle(b, {{"confining_pressure", "5e6"}}, 2);
  const auto phase = cell.column("phase"), stress = cell.column("axial_stress");
  std::size_t last = 0;
  for (std::size_t k = 0; k < phase.size(); ++k)
    if (phase[k] == 3) last = k;
  ASSERT_GT(last, 3u);
  EXPECT_NEAR(stress[last], 5e6, 0.02 * 5e6);  // hydrostatic when the closing starts
  // at least the pressure itself on top, and the friction of a cracked specimen
  EXPECT_GT(largest(stress), largest(free.column("axial_stress")) + 5e6);
}

TEST(UniaxialDeck, confining_pressure_in_3d) {
  EngineFolder folder;
  const Table t = curve_of(folder, "uniaxial_compression",
                           with_specimen("cylinder_small_3d.data") +
                               var({{"dim", "3"}, {"diameter", "0.010"}, {"height", "0.020"},
                                    {"sigma_c", "20e6"}, {"gap", "2e-5"}, {"platen_speed", "0.2"},
                                    {"confining_pressure", "5e6"}}),
                           2);
  EXPECT_EQ(t.completion, "stop_after_peak");
  const auto phase = t.column("phase"), stress = t.column("axial_stress");
  std::size_t last = 0;
  for (std::size_t k = 0; k < phase.size(); ++k)
    if (phase[k] == 3) last = k;
  EXPECT_NEAR(stress[last], 5e6, 0.05 * 5e6);
}

// ---- the loading programme ----

// First and last point of a phase; 0 and 0 where it never came.
std::pair<std::size_t, std::size_t> points_of(const Table &t, double wanted) {
  const auto phase = t.column("phase");
  std::size_t first = 0, last = 0;
  for (std::size_t k = 0; k < phase.size(); ++k)
    if (phase[k] == wanted) {
      if (!first) first = k;
      last = k;
    }
  return {first, last};
}

TEST(UniaxialDeck, unloads_and_reloads_along_the_same_line_while_nothing_breaks) {
  EngineFolder folder;
  const Table t = rectangle(
      folder, {kStrong, kTough, {"cycles", "3"}, {"max_strain", "0.0025"}, {"cycle_stress", "1e7"}});
  const auto strain = t.column("strain_axial"), stress = t.column("axial_stress"),
             phase = t.column("phase");
  int unloadings = 0;
  std::vector<double> turns;
  for (std::size_t k = 1; k < phase.size(); ++k) {
    if (phase[k] == 4 && phase[k - 1] != 4) ++unloadings, turns.push_back(stress[k]);
    if (phase[k] != 4 && phase[k - 1] == 4) turns.push_back(stress[k]);
  }
  EXPECT_EQ(unloadings, 3);
  ASSERT_EQ(turns.size(), 6u);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(turns[2 * c], (c + 1) * 1e7, 1.5e6);      // found within a sample and the ramp
    EXPECT_NEAR(turns[2 * c + 1], 0.1 * (c + 1) * 1e7, 1.5e6);
  }
  const auto up = [&](std::size_t k) { return phase[k] == 0 && stress[k] > 5e6; };
  const auto down = [&](std::size_t k) { return phase[k] == 4 && stress[k] > 5e6; };
  EXPECT_NEAR(slope_where(strain, stress, down) / slope_where(strain, stress, up), 1.0, 0.02);
}

TEST(UniaxialDeck, cycles_do_not_end_the_run_before_the_specimen_fails) {
  EngineFolder a, b;
  const Table cycled = rectangle(a, {{"cycles", "3"}}), once = rectangle(b, {});
  EXPECT_EQ(cycled.completion, "stop_after_peak");
  EXPECT_NEAR(largest(cycled.column("axial_stress")) / largest(once.column("axial_stress")), 1.0,
              0.05);
}

TEST(UniaxialDeck, holds_a_displacement_or_a_load) {
  for (const bool creep : {false, true}) {
    EngineFolder folder;
    const Table t = rectangle(folder, {kStrong, kTough, {"max_strain", "0.002"},
                                       {creep ? "creep_time" : "relax_time", "2e-4"}});
    const auto stress = t.column("axial_stress"), way = t.column("displacement"),
               time = t.column("time");
    const auto [first, last] = points_of(t, creep ? 3 : 2);
    ASSERT_GT(first, 0u);
    EXPECT_NEAR(time[last] - time[first], 2e-4, 2e-5);  // within the sampling
    // elastic: nothing relaxes and nothing creeps; what rang at the stop is damped out by then
    EXPECT_NEAR(stress[last] / stress[first], 1.0, 0.01);
    EXPECT_NEAR(way[last] / way[first], 1.0, creep ? 0.01 : 1e-12);
    EXPECT_GT(stress[first], 20e6);
    EXPECT_GT(stress.back(), 1.5 * stress[last]);  // and on
  }
}

// Creeping bonds give way under a held load, twice as fast at twice the creep rate. Grains don't touch
// beside their bonds: contacts would take the load over.
TEST(UniaxialDeck, creeps_under_a_held_load_in_proportion_to_the_creep_rate) {
  const auto crept = [](const std::string &rate) {
    EngineFolder folder;
    const Table t = rectangle(folder, {kStrong, kTough, {"max_strain", "0.003"}, {"creep_time", "2e-4"},
                                       {"creep_rate", rate}, {"bond_contact", "no"}});
    const auto way = t.column("displacement");
    const auto [first, last] = points_of(t, 3);
    EXPECT_GT(first, 0u);
    return way[last] - way[first + (last - first) / 3];  // behind the servo's start
  };
  const double none = crept("0"), slow = crept("0.05") - none, fast = crept("0.1") - none;
  EXPECT_GT(slow, 10 * std::abs(none));
  EXPECT_NEAR(fast / slow, 2.0, 0.1);  // 2.05 here, 1.97 at rates of 0.02 and 0.04: the servo swings
}

TEST(UniaxialDeck, steps_the_rate_at_its_strain) {
  EngineFolder folder;
  const Table t = rectangle(folder, {kStrong, kTough, {"max_strain", "0.0016"},
                                     {"rate_strain", "8e-4"}, {"rate_factor", "0.25"}});
  const auto time = t.column("time"), strain = t.column("strain_platen");
  const double before =
      slope_where(time, strain, [&](std::size_t k) { return strain[k] > 4e-4 && strain[k] < 7e-4; });
  const double after = slope_where(time, strain, [&](std::size_t k) { return strain[k] > 1.1e-3; });
  EXPECT_NEAR(before, 0.1 / kHeight, 1e-6 * before);
  EXPECT_NEAR(after / before, 0.25, 1e-6);
}

TEST(UniaxialDeck, all_options_are_the_same_on_1_2_and_4_ranks) {
  expect_same_on_ranks("uniaxial_compression",
                       with_specimen("rectangle_small_2d.data") +
                           var({{"alpha", "0.02"}, {"frame_stiffness", "2e10"},
                                {"confining_pressure", "2e6"}, {"confine_time", "3e-5"},
                                {"platen_speed", "0.4"}, {"platen_ramp", "2e-5"}, {"cycles", "1"},
                                {"cycle_rest", "0.7"}, {"hold_stress", "3e7"},
                                {"creep_time", "2e-5"}, {"rate_strain", "1e-3"},
                                {"rate_factor", "0.8"}}));
}

}  // namespace
