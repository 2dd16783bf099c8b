// SPDX-License-Identifier: GPL-2.0-or-later
//
// bond_style beam/mohr/coulomb in the engine: a cantilever against beam theory, ranks and restarts bit for
// bit with breaks, hybrid, what a break leaves, and what is said to a user's mistakes.
#include <gtest/gtest.h>

#include <cmath>

#include "bond_deck.h"

using namespace engine;
using namespace engine::bonds;

namespace {

const double kPi = 3.14159265358979323846;

// The preamble's deck with beams in the place of parallel bonds, without grain contact unless named.
std::string beams(Preamble p, const std::string &coefficients, const std::string &contact = "0 1 0") {
  p.contact = contact;
  p.bond = coefficients;
  std::string deck = p.text();
  const std::string was = "bond_style parallel";
  deck.replace(deck.find(was), was.size(), "bond_style beam/mohr/coulomb");
  return deck;
}

const std::string kWeak = "5e9 0.2 12e6 40 friction 0.5 shear_point surface scatter weibull 5 seed 4";

const std::string kRun =
    "fix integrate all nve/bonded\nfix damp all damp/local 0.7\n"
    "compute energy all energy/bonded\n"
    "variable top equal f_top[3]\nvariable strain equal c_energy[1]\n"
    "fix curve all curve 100 curve.tsv top N v_top strain J v_strain\n"
    "fix log all bond/log 100 broken.tsv\n";

struct Outcome {
  std::string particles, curve, broken;
  int breaks = 0;
};

Outcome run(const EngineFolder &folder, const std::string &deck, int ranks) {
  const EngineResult r = run_deck(folder, deck, ranks, {}, 300.0);
  EXPECT_TRUE(r.ok()) << r.screen.substr(r.screen.size() > 1500 ? r.screen.size() - 1500 : 0);
  Outcome o{folder.read("end.txt"), folder.read("curve.tsv"), folder.read("broken.tsv"), 0};
  EXPECT_FALSE(o.particles.empty());
  if (folder.has("broken.tsv"))
    o.breaks = static_cast<int>(read_table(folder.file("broken.tsv")).rows.size());
  return o;
}

void expect_same(const Outcome &a, const Outcome &b, const std::string &what) {
  EXPECT_TRUE(a.particles == b.particles) << what << ": particles differ";
  EXPECT_TRUE(a.curve == b.curve) << what << ": curves differ";
  EXPECT_TRUE(a.broken == b.broken) << what << ": broken bonds differ";
}

std::string again(const std::string &file) {
  return "atom_style bonded/sphere\nnewton off\ncommunicate single vel yes\nread_restart " + file +
         "\nneighbor 5e-5 bin\nneigh_modify delay 0\nthermo 100000\nthermo_style custom step time ke\n"
         "thermo_modify lost error\n";
}

// A rod of n bonds along x, grain 1 held.
std::string rod(const EngineFolder &folder, int n, const std::string &coefficients) {
  std::vector<Particle> grains(n + 1);
  for (int k = 0; k <= n; ++k) grains[k].x = 2e-3 * (k - 0.5 * n);
  folder.write("rod.data", data_file(grains, 3, 0.03));
  Preamble p;
  p.specimen = "rod.data";
  p.install = "gap 1e-5";
  p.safety = 0.5;
  return beams(p, coefficients) + "group held id 1\ngroup free subtract all held\n";
}

}  // namespace

// F L^3/(3EI)(1 - 1/(4n^2)) + F L/(k_s l); the load small enough that the linear theory holds to 1e-8.
TEST(BeamEngine, cantilever) {
  const double E = 1e9, nu = 0.3, R = 1e-3, l = 2e-3, A = kPi * R * R, I = 0.25 * A * R * R;
  const int n = 10;
  const double G = E / (2 * (1 + nu)), euler = 12 * E * I / (l * l * l), kappa = 6 * (1 + nu) / (7 + 6 * nu);
  const struct {
    const char *kind;
    double ks;
  } kinds[] = {{"GA", G * A / l}, {"euler", euler}, {"timoshenko", 1 / (1 / euler + l / (kappa * G * A))}};
  for (const auto &k : kinds) {
    EngineFolder folder;
    const double F = 1e-4, L = n * l;
    const std::string deck = rod(folder, n, std::string("1e9 0.3 1e12 30 shear ") + k.kind) +
                             "fix integrate free nve/bonded\n"
                             "group tip id 11\nfix pull tip addforce 0 1e-4 0\nfix damp all damp/local 0.5\n"
                             "run 150000\n" + dump_all("end.txt");
    run(folder, deck, 1);
    const double tip = F * L * L * L / (3 * E * I) * (1 - 0.25 / (n * n)) + F * L / (k.ks * l);
    EXPECT_NEAR(read_dump(folder, "end.txt").at(n + 1)[1] / tip, 1.0, 1e-6) << k.kind;
  }
}

TEST(BeamEngine, breaking_and_sliding_is_the_same_on_1_2_and_4) {
  EngineFolder a, b, c;
  const std::string deck = beams(small(), kWeak) + press_small(0.5) + kRun + "run 6000\n" + dump_all("end.txt");
  const Outcome one = run(a, deck, 1);
  EXPECT_GT(one.breaks, 300);
  expect_same(one, run(b, deck, 2), "2 ranks");
  expect_same(one, run(c, deck, 4), "4 ranks");
}

// With dashpots, softening and the grains' own contact as well.
TEST(BeamEngine, options_are_the_same_on_1_2_and_4) {
  EngineFolder a, b, c;
  const std::string deck = beams(small(), kWeak + " softening 25 damping 0.02 tension_modulus 0.8", "5e9 2 0.5") +
                           press_small(0.5) + kRun + "run 5000\n" + dump_all("end.txt");
  const Outcome one = run(a, deck, 1);
  EXPECT_GT(one.breaks, 20);
  expect_same(one, run(b, deck, 2), "2 ranks");
  expect_same(one, run(c, deck, 4), "4 ranks");
}

TEST(BeamEngine, restart_at_any_step_on_another_number_of_ranks) {
  EngineFolder a, b;
  const std::string fixes = press_small(0.5) + kRun;
  const Outcome whole = run(a, beams(small(), kWeak) + fixes + "restart 2113 state.*\nrun 5000\n" + dump_all("end.txt"), 1);
  EXPECT_GT(whole.breaks, 100);
  ASSERT_TRUE(a.has("state.4226"));
  for (const auto &[step, ranks] : {std::pair<int, int>{2113, 2}, {4226, 1}}) {
    EngineFolder other;
    const Outcome end = run(other, again(a.file("state." + std::to_string(step))) + fixes + "run " +
                                       std::to_string(5000 - step) + "\n" + dump_all("end.txt"), ranks);
    EXPECT_TRUE(whole.particles == end.particles) << "from step " << step;
  }
  run(b, beams(small(), kWeak) + fixes + "run 1\nrun 1233\nrun 0\nrun 766\nrun 3000\n" + dump_all("end.txt"), 1);
  EXPECT_TRUE(whole.particles == b.read("end.txt")) << "in pieces";
}

// Two halves of a rod under tension, one of each law: equal forces, and each with its own stiffness.
TEST(BeamEngine, hybrid_with_parallel) {
  EngineFolder folder;
  std::vector<Particle> grains(3);
  for (int k = 0; k < 3; ++k) grains[k].x = 2e-3 * (k - 1);
  std::string data = data_file(grains, 3, 0.03);
  folder.write("rod.data", data.replace(data.find("1 bond types"), 12, "2 bond types"));
  folder.write("first", "1 2\n");
  folder.write("second", "2 3\n");
  const std::string deck =
      "units si\nnewton off\nboundary f f f\natom_style bonded/sphere\ncommunicate single vel yes\n"
      "bond_style hybrid parallel beam/mohr/coulomb\npair_style grain\nread_data rod.data\n"
      "neighbor 5e-5 bin\nneigh_modify delay 0\npair_coeff * * 0 1 0\n"
      "bond_coeff 1 parallel 1e9 2.6 1e12 1e12\nbond_coeff 2 beam/mohr/coulomb 2e9 0.3 1e12 30\n"
      "bond_install all file first type 1\nbond_install all file second type 2\ntimestep_bonded 0.5\n"
      "thermo 100000\nthermo_style custom step time ke\ngroup held id 1\ngroup free subtract all held\n"
      "group tip id 3\nfix integrate free nve/bonded\n"
      "fix pull tip addforce 0.01 0 0\nfix damp all damp/local 0.5\nrun 20000\n" + dump_all("end.txt");
  run(folder, deck, 1);
  const auto rows = read_dump(folder, "end.txt");
  const double unit = 0.01 * 2e-3 / (1e9 * kPi * 1e-6);
  EXPECT_NEAR(rows.at(2)[0] / unit, 1.0, 1e-6);
  EXPECT_NEAR((rows.at(3)[0] - 2e-3) / unit, 1.5, 1e-6);
}

// Without any pair style: a broken pair that is pressed is carried by the contact that took the bond's
// place, E_b A/l_0; pulled, by nothing.
TEST(BeamEngine, contact_in_the_place_of_the_bond) {
  EngineFolder folder;
  std::vector<Particle> grains(2);
  grains[0].x = -1e-3, grains[1].x = 1e-3;
  folder.write("pair.data", data_file(grains, 3, 0.03));
  const auto deck = [](double push) {
    return "units si\nnewton off\nboundary f f f\natom_style bonded/sphere\ncommunicate single vel yes\n"
           "bond_style beam/mohr/coulomb\npair_style grain\nread_data pair.data\nneighbor 5e-5 bin\n"
           "neigh_modify delay 0\npair_coeff * * 0 1 0\nbond_coeff 1 1e9 0.3 1e3 0 tension_cutoff 1e3\n"
           "bond_install all gap 1e-5\ntimestep_bonded 0.1\nthermo 100000\nthermo_style custom step time ke\n"
           "group held id 1\ngroup free subtract all held\nfix integrate free nve/bonded\n"
           "fix log all bond/log 1 broken.tsv\nfix pull free addforce 0.05 0 0\nfix damp all damp/local 0.5\n"
           "run 2000\nunfix pull\nunfix damp\nfix push free addforce " + std::to_string(push) + " 0 0\n"
           "fix damp all damp/local 0.5\nvelocity all set 0 0 0\nset group free x 0.00099999\nrun 30000\n" + dump_all("end.txt");
  };
  const Outcome pressed = run(folder, deck(-0.3), 1);
  EXPECT_EQ(pressed.breaks, 1);
  const double kn = 1e9 * kPi * 1e-6 / 2e-3;
  EXPECT_NEAR(1e-3 - read_dump(folder, "end.txt").at(2)[0], 0.3 / kn, 1e-6 * 0.3 / kn);
}

TEST(BeamEngine, mistakes_are_named) {
  const struct {
    const char *words, *says;
  } cases[] = {
      {"5e9 0.2 12e6", "friction_angle"},
      {"-5e9 0.2 12e6 40", "E_b (Pa) is -5e9, it must be positive"},
      {"5e9 0.7 12e6 40", "nu_b must be above -1, at most 0.5"},
      {"5e9 0.2 12e6 90", "friction_angle must be below 90 degrees"},
      {"5e9 0.2 12e6 40 shear foo", "shear is 'foo', allowed are GA, euler, timoshenko"},
      {"5e9 0.2 12e6 40 rest foo", "rest is 'foo', allowed are distance, touching"},
      {"5e9 0.2 12e6 40 shear_point foo", "shear_point is 'foo', allowed are middle, surface"},
      {"5e9 0.2 12e6 40 beta 1", "unknown keyword 'beta', allowed are lambda, tension_cutoff"},
      {"5e9 0.2 12e6 40 friction", "'friction' has no value"},
  };
  for (const auto &c : cases) {
    EngineFolder folder;
    const EngineResult r = run_deck(folder, beams(small(), c.words), 1, {}, 30.0);
    EXPECT_FALSE(r.ok()) << c.words;
    EXPECT_TRUE(r.says(c.says)) << c.words << "\n" << r.screen.substr(r.screen.size() > 600 ? r.screen.size() - 600 : 0);
  }
}
