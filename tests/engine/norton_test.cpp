// SPDX-License-Identifier: GPL-2.0-or-later
//
// bond_style norton in the engine: closed forms, temperature, ranks, restart, wrong words.
#include <gtest/gtest.h>

#include <cmath>

#include "bond_deck.h"

using namespace engine;
using namespace engine::bonds;

namespace {

// Two grains of 1 mm at 2 mm, then 2.01 mm apart, held there by not being integrated.
std::string held_pair(const std::string &words, const std::string &before = "", const std::string &style = "norton",
                      int type = 1) {
  std::ostringstream o;
  o << "units si\nnewton off\nboundary f f f\natom_style bonded/sphere\ncommunicate single vel yes\n"
    << "bond_style " << style << "\npair_style grain\nread_data pair.data\nneighbor 1e-3 bin\n"
    << "neigh_modify delay 0\npair_coeff * * 0 1 0\n" << before << words
    << "\nbond_install all gap 1e-4 type " << type << "\ntimestep 1e-3\nthermo_modify lost error\n"
    << "group second id 2\n";
  return o.str();
}

const std::string kPull =
    "displace_atoms second move 1e-5 0 0\n"
    "compute energy all energy/bonded\n"
    "variable elastic equal c_energy[1]\nvariable creep equal c_energy[6]\n"
    "fix curve all curve 1000 curve.tsv elastic J v_elastic creep J v_creep\n"
    "run 1000\n";

std::string pair_data() {
  return "two\n\n2 atoms\n1 atom types\n2 bond types\n\n-0.01 0.01 xlo xhi\n-0.01 0.01 ylo yhi\n"
         "-0.01 0.01 zlo zhi\n\nAtoms\n\n1 1 0.002 2500 0 0 0\n2 1 0.002 2500 0.002 0 0\n";
}

// Stress of the pair at the end (Pa), from its elastic energy 1/2 L A s^2/E.
double stress_after(const std::string &deck, double E = 1e9) {
  EngineFolder folder;
  folder.write("pair.data", pair_data());
  const EngineResult r = run_deck(folder, deck + kPull, 1, {}, 60.0);
  EXPECT_TRUE(r.ok()) << r.screen.substr(r.screen.size() > 1500 ? r.screen.size() - 1500 : 0);
  if (!r.ok()) return 0.0;
  const double energy = read_table(folder.file("curve.tsv")).last("elastic");
  return std::sqrt(energy * 2.0 * E / (2e-3 * 3.14159265358979323846e-6));
}

// 5 MPa relax by the closed form [s^(1-m) + (m-1) E A t]^(1/(1-m)) within one second.
const double kA = 1e-21, kRelaxed = 1.0 / std::sqrt(1.0 / 25e12 + 2 * 1e9 * 1e-21);

std::string coefficients(const std::string &more) {
  return "bond_coeff * 1e9 0.3 1e12 1e12 1e-21 3 " + more;
}

const char *kMelt = "rate_at 20 5e6 moment_creep yes yield 9e6 30e6 yield_shear 7e6 crushing 60e6 "
                    "scatter normal 0.3 0.3 seed 4 arrhenius 60e3 modulus_slope -1e-3 strength_slope -0.01 ";

// `small`, pressed until hundreds of bonds have broken while all of it creeps; warm at one end.
Preamble melting(const std::string &more, const std::string &temperature = "particles") {
  Preamble p = small();
  p.bond_style = "norton";
  p.bond = std::string("5e9 0.25 8e6 8e6 0 3 ") + kMelt + "temperature " + temperature + " " + more;
  p.before_bonds = "fix warm all property/atom Temp scalar yes yes no 263.15\n";
  return p;
}

const std::string kWarmEnd = "run 0\nregion low block INF INF INF INF INF 0.006\ngroup low region low\n"
                             "set group low property/atom Temp 268.15\n";
const std::string kFixes = press_small(0.5) + "fix integrate all nve/bonded\nfix damp all damp/local 0.7\n"
                           "fix log all bond/log 100 broken.tsv\ncompute energy all energy/bonded\n";
const std::string kEnd = dump_all("end.txt") +
                         "variable a equal f_top[3]\nvariable b equal c_energy[1]\nvariable c equal c_energy[6]\n"
                         "variable d equal f_log[1]\nfix end all curve 1 last.tsv a N v_a b J v_b c J v_c d 1 v_d\nrun 0\n";

struct End {
  std::string particles, broken, values;
  double creep = 0.0, breaks = 0.0;
};
End run(EngineFolder &folder, const std::string &deck, int ranks) {
  const EngineResult r = run_deck(folder, deck, ranks, {}, 300.0);
  EXPECT_TRUE(r.ok()) << r.screen.substr(r.screen.size() > 1500 ? r.screen.size() - 1500 : 0);
  End e;
  e.particles = folder.read("end.txt");
  e.broken = folder.read("broken.tsv");
  if (folder.has("last.tsv")) {
    const Table t = read_table(folder.file("last.tsv"));
    for (std::size_t c = 0; c < t.names.size(); ++c)
      if (t.names[c] != "time") e.values += t.rows.back()[c] + " ";
    e.creep = t.last("c");
    e.breaks = t.last("d");
  }
  return e;
}

}  // namespace

TEST(NortonEngine, held_pair_relaxes_by_the_closed_form) {
  EXPECT_NEAR(stress_after(held_pair(coefficients(""))) / kRelaxed, 1.0, 1e-9);
  EXPECT_NEAR(stress_after(held_pair(coefficients("every 50"))) / kRelaxed, 1.0, 1e-9);
  EXPECT_NEAR(stress_after(held_pair(coefficients("creep separate"))) / kRelaxed, 1.0, 1e-9);
  EXPECT_NEAR(stress_after(held_pair(coefficients("creep none"))) / 5e6, 1.0, 1e-9);
  EXPECT_NEAR(stress_after(held_pair("bond_coeff * 1e9 0.3 1e12 1e12 0 3 rate_at 1e-9 1e4 rate_factor 1e0")) / kRelaxed, 1.0, 1e-9);
  const double fast = 1.0 / std::sqrt(1.0 / 25e12 + 2e3 * 1e9 * kA);
  EXPECT_NEAR(stress_after(held_pair(coefficients("rate_factor 1e3"))) / fast, 1.0, 1e-9);
}

// The same temperature by number, by variable and by particles; warm ones relax by Arrhenius.
TEST(NortonEngine, temperature_by_number_variable_and_particles) {
  const std::string law = "reference 258.15 arrhenius 60e3 modulus_slope -1.4e-3 temperature ";
  const double faster = std::exp(-60e3 / 8.31446261815324 * (1 / 268.15 - 1 / 258.15)), E = 1e9 * (1 - 0.014);
  const double s0 = 5e-3 * E, right = 1.0 / std::sqrt(1.0 / (s0 * s0) + 2 * E * kA * faster);
  EXPECT_NEAR(stress_after(held_pair(coefficients(law + "268.15")), E) / right, 1.0, 1e-9);
  EXPECT_NEAR(stress_after(held_pair(coefficients(law + "v_T"), "variable T equal 268.15\n"), E) / right, 1.0, 1e-9);
  EXPECT_NEAR(stress_after(held_pair(coefficients(law + "particles"),
                                     "fix warm all property/atom Temp scalar yes yes no 266.15\n") +
                           "run 0\nset atom 2 property/atom Temp 270.15\n", E) / right, 1.0, 1e-9);
  // a ramp: A(T) integrated over the time
  const double ramped = stress_after(held_pair(coefficients(law + "v_T"), "variable T equal 258.15+step*1e-2\n"), E);
  EXPECT_LT(ramped, kRelaxed);
  EXPECT_GT(ramped, right);
}

TEST(NortonEngine, beside_another_style_in_hybrid) {
  const std::string both = "bond_coeff 1 parallel 1e9 2.6 1e12 1e12\nbond_coeff 2 norton 1e9 0.3 1e12 1e12 1e-21 3\n";
  EXPECT_NEAR(stress_after(held_pair(both, "", "hybrid parallel norton", 2)) / kRelaxed, 1.0, 1e-9);
  EXPECT_NEAR(stress_after(held_pair(both, "", "hybrid parallel norton", 1)) / 5e6, 1.0, 1e-9);
}

TEST(NortonEngine, creeping_and_breaking_is_the_same_on_1_2_and_4) {
  const std::string deck = melting("").text() + kWarmEnd + kFixes + "run 2000\n" + kEnd;
  EngineFolder one;
  const End a = run(one, deck, 1);
  EXPECT_GT(a.breaks, 100);
  EXPECT_GT(a.creep, 0.0);
  for (const int ranks : {2, 4}) {
    EngineFolder other;
    const End b = run(other, deck, ranks);
    EXPECT_TRUE(a.particles == b.particles) << ranks;
    EXPECT_TRUE(a.broken == b.broken) << ranks;
    EXPECT_EQ(a.values, b.values) << ranks;
  }
}

// Options and creep every third step, cut at a step that is no multiple of it.
TEST(NortonEngine, restart_at_any_step_on_another_number_of_ranks) {
  const std::string start = melting("every 3 softening 5 damping 0.05 tension_modulus 0.8", "v_warm").text();
  const std::string warm = "variable warm equal 263.15+2e-3*step\n";
  EngineFolder one;
  const End whole = run(one, start + warm + kFixes + "restart 953 state.*\nrun 2000\n" + kEnd, 1);
  EXPECT_GT(whole.breaks, 20);
  ASSERT_TRUE(one.has("state.953"));
  for (const int ranks : {1, 2}) {
    EngineFolder other;
    const std::string again = "atom_style bonded/sphere\nnewton off\ncommunicate single vel yes\nread_restart " +
                              one.file("state.953") + "\nneighbor 5e-5 bin\nneigh_modify delay 0\nthermo 100000\n"
                              "thermo_style custom step time ke\nthermo_modify lost error\n";
    const End end = run(other, again + warm + kFixes + "run 1047\n" + kEnd, ranks);
    EXPECT_TRUE(whole.particles == end.particles) << ranks;
    EXPECT_EQ(whole.values, end.values) << ranks;
  }
}

// Crushing is a mode of its own in the log and its counts; as printed, every compressed bond is at risk.
TEST(NortonEngine, crushing_is_logged_by_name) {
  Preamble p = small();
  p.bond_style = "norton";
  p.bond = "5e9 0.25 20e6 20e6 0 3 printed yes";
  EngineFolder folder;
  const EngineResult r = run_deck(folder, p.text() + kFixes + "run 3000\n", 1, {}, 100.0);
  ASSERT_TRUE(r.ok());
  const std::string log = folder.read("broken.tsv");
  EXPECT_NE(log.find("crushing"), std::string::npos);
  EXPECT_NE(log.find("tension"), std::string::npos);
}

TEST(NortonEngine, wrong_words_are_named) {
  const struct {
    const char *words, *says;
  } cases[] = {
      {"bond_coeff * 1e9 0.3 1e6", "'tau_max (Pa)' has no value"},
      {"bond_coeff * 1e9 0.6 1e6 1e6 0 3", "nu_b must be above -1 and at most 0.5"},
      {"bond_coeff * 1e9 0.3 1e6 1e6 0 -1", "m is -1, it must be positive"},
      {"bond_coeff * 1e9 0.3 1e6 1e6 0 3 creep fast", "creep is 'fast', allowed are coupled, separate, none"},
      {"bond_coeff * 1e9 0.3 1e6 1e6 0 3 every 2.5", "every must be a whole number"},
      {"bond_coeff * 1e9 0.3 1e6 1e6 0 3 length gap", "allowed are center, radii and surface"},
      {"bond_coeff * 1e9 0.3 1e6 1e6 0 3 temperature cold", "allowed are a positive number (K), v_NAME, particles"},
      {"bond_coeff * 1e9 0.3 1e6 1e6 0 3 temperature particles", "needs the particles' temperature"},
      {"bond_coeff * 1e9 0.3 1e6 1e6 0 3 temperature v_none", "isn't an equal-style variable"},
      {"bond_coeff * 1e9 0.3 1e6 1e6 0 3 moments yes", "unknown keyword 'moments'"},
      {"bond_coeff 1 1e9 0.3 1e6 1e6 0 3\nbond_coeff 2 1e9 0.3 1e6 1e6 0 3 every 2", "must be the same for all bond types"},
  };
  for (const auto &c : cases) {
    EngineFolder folder;
    folder.write("pair.data", pair_data());
    const EngineResult r = run_deck(folder, held_pair(c.words) + "run 1\n", 1, {}, 30.0);
    EXPECT_FALSE(r.ok()) << c.words;
    EXPECT_TRUE(r.says(c.says)) << c.words << "\n" << r.screen;
  }
}
