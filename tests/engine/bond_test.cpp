// SPDX-License-Identifier: GPL-2.0-or-later
//
// bond_style parallel and bond_install in the engine: which pairs are bonded, Newton's settings,
// strengths, breaks, and what a deck that is wrong is told.
#include <gtest/gtest.h>

#include <cmath>

#include "bond_deck.h"

using namespace engine;
using namespace engine::bonds;

namespace {

// Three grains in a row: gaps of 0 and 0.1 mm.
std::string three() {
  return data_file({{0, 0, 0}, {2e-3, 0, 0}, {4.1e-3, 0, 0}}, 3, 0.02);
}

Preamble row_of_three(const EngineFolder &folder, const std::string &install = "gap 2e-4") {
  folder.write("grains.data", three());
  Preamble p;
  p.specimen = "grains.data";
  p.install = install;
  return p;
}

}  // namespace

TEST(BondInstall, gap_is_between_surfaces) {
  EngineFolder folder;
  const struct {
    const char *gap;
    int bonds;
  } cases[] = {{"1e-6", 1}, {"9.9e-5", 1}, {"1.01e-4", 2}, {"3e-3", 3}};
  for (const auto &c : cases) {
    const EngineResult r = run_deck(folder, row_of_three(folder, std::string("gap ") + c.gap).text());
    EXPECT_TRUE(r.ok()) << r.screen;
    EXPECT_EQ(bonds_installed(r), c.bonds) << c.gap;
  }
}

TEST(BondInstall, list_and_gap_of_the_packing_agree_on_any_number_of_ranks) {
  EngineFolder folder;
  EXPECT_EQ(bonds_installed(run_deck(folder, small().text(), 1)), 2963);
  EXPECT_EQ(bonds_installed(run_deck(folder, small().text(), 4)), 2963);
  Preamble p = small();
  p.install = "gap 1e-6";
  const int one = bonds_installed(run_deck(folder, p.text(), 1));
  EXPECT_GT(one, 2000);
  EXPECT_EQ(one, bonds_installed(run_deck(folder, p.text(), 4)));
}

TEST(BondInstall, only_within_the_group_and_never_twice) {
  EngineFolder folder;
  Preamble p = row_of_three(folder, "");
  p.safety = 0.0;
  const EngineResult r = run_deck(folder, p.text() +
      "group left id 1 2\nbond_install left gap 2e-4\nbond_install all gap 2e-4\n"
      "velocity all ramp vx -0.5 0.5 x 0 4.1e-3\nfix i all nve/bonded\ntimestep 1e-8\nrun 10\n" + dump_all("end.txt"));
  ASSERT_TRUE(r.ok()) << r.screen;
  EXPECT_EQ(bonds_installed(r), 1);  // the first command's report
  // bond force of each pair: E A/l u, once
  const auto rows = read_dump(folder, "end.txt");
  const double k = 5e9 * 3.14159265358979 * 1e-6 / 2e-3;
  EXPECT_NEAR(rows.at(1)[9] / (k * (rows.at(2)[0] - rows.at(1)[0] - 2e-3)), 1.0, 1e-6);
}

// newton: `off` and `off on` give the same bits.
TEST(Newton, off_and_off_on_agree) {
  EngineFolder a, b;
  Preamble p = small();
  const std::string motion = "velocity all ramp vz -2 2 z 0 0.012\nfix i all nve/bonded\nrun 200\n";
  EXPECT_TRUE(run_deck(a, p.text() + motion + dump_all("end.txt"), 2).ok());
  p.newton = "off on";
  EXPECT_TRUE(run_deck(b, p.text() + motion + dump_all("end.txt"), 2).ok());
  EXPECT_FALSE(a.read("end.txt").empty());
  EXPECT_TRUE(a.read("end.txt") == b.read("end.txt"));
}

// Two stressed halves of a dimer: breaking one bond takes its own force and leaves the contact's.
TEST(Break, contact_force_is_the_same_before_and_after) {
  EngineFolder folder;
  folder.write("grains.data", data_file({{0, 0, 0}, {2e-3, 0, 0}}, 3, 0.02));
  Preamble p;
  p.specimen = "grains.data";
  p.install = "gap 1e-5";
  p.bond = "5e9 2.0 1e12 3e5";  // breaks in shear
  p.safety = 0.0;
  // pressed together and sheared
  const EngineResult r = run_deck(folder, p.text() +
      "group second id 2\nvelocity second set -2 2 0\nfix i second nve/bonded\ntimestep 1e-9\n"
      "fix log all bond/log 1 broken.tsv\n"
      "variable f equal fx[2]\nvariable x equal x[2]\nvariable g equal fy[2]\nvariable y equal y[2]\n"
      "variable b equal f_log[1]\n"
      "fix curve all curve 1 curve.tsv fx N v_f fy N v_g x m v_x y m v_y b 1 v_b\n"
      "run 3000\n");
  ASSERT_TRUE(r.ok()) << r.screen.substr(r.screen.size() - 600);
  const Table t = read_table(folder.file("curve.tsv"));
  const std::vector<double> b = t.column("b"), fx = t.column("fx"), fy = t.column("fy"), x = t.column("x"), y = t.column("y");
  std::size_t at = 0;
  while (at < b.size() && b[at] == 0.0) ++at;
  ASSERT_LT(at, b.size() - 1);
  ASSERT_GT(at, 1u);
  const auto along = [&](std::size_t k) { return (fx[k] * x[k] + fy[k] * y[k]) / std::hypot(x[k], y[k]); };
  const auto across = [&](std::size_t k) { return (fy[k] * x[k] - fx[k] * y[k]) / std::hypot(x[k], y[k]); };
  const double squeeze = 2e-3 - std::hypot(x[at], y[at]);
  // after: normal force of the contact alone, from the bonding distance, and friction at most
  const double kn = 0.5 * 4.0 * 1e-3 * 5e9;
  if (squeeze > 0.0) {
    EXPECT_NEAR(along(at) / (kn * squeeze), 1.0, 1e-6);
    EXPECT_LE(std::fabs(across(at)), 0.5 * kn * squeeze * (1 + 1e-9));
  } else {
    EXPECT_EQ(along(at), 0.0);
  }
  EXPECT_GT(std::fabs(across(at - 1)), 3e5 * 3.1e-6 * 0.9);  // the bond's shear force just before
}

// The message says what was given, where, and what would be right.
struct Wrong {
  const char *name, *deck, *message;
};
class WrongDeck : public testing::TestWithParam<Wrong> {};

TEST_P(WrongDeck, is_told_so) {
  EngineFolder folder;
  folder.write("grains.data", three());
  folder.write("bad.pairs", "# comment\n1 2\n2 two\n");
  folder.write("same.pairs", "2 2\n");
  folder.write("ghosts.pairs", "1 2\n77 78\n");
  folder.write("ghost.pairs", "1 2\n2 78\n");
  folder.write("far.pairs", "1 3\n");
  // $HEAD: up to the data file; $COEFF: with coefficients
  std::string deck = GetParam().deck;
  const auto put = [&](const std::string &name, const std::string &text) {
    for (std::size_t at; (at = deck.find(name)) != std::string::npos;) deck.replace(at, name.size(), text);
  };
  put("$COEFF", "$HEAD\nread_data grains.data\nneighbor 1e-4 bin\npair_coeff * * 5e9 2 0.5\nbond_coeff 1 5e9 2 1e7 1e7");
  put("$HEAD", "$START\nbond_style parallel\npair_style grain");
  put("$START", "units si\ndimension 3\nnewton off\nboundary f f f\natom_style bonded/sphere\ncommunicate single vel yes");
  const EngineResult r = run_deck(folder, deck + "\n", 1, {}, 20.0);
  EXPECT_FALSE(r.ok());
  EXPECT_FALSE(r.timed_out);
  EXPECT_TRUE(r.says(GetParam().message)) << r.screen;
}

INSTANTIATE_TEST_SUITE_P(
    Deck, WrongDeck,
    testing::Values(
        Wrong{"bond_style_without_atom_style", "units si\nnewton off\natom_style sphere\nbond_style parallel",
              "Bond_style command when no bonds allowed"},
        Wrong{"pair_style_without_atom_style", "units si\nnewton off\natom_style sphere\npair_style grain",
              "pair_style grain needs particles of `atom_style bonded/sphere`"},
        Wrong{"nve_without_atom_style", "units si\nnewton off\natom_style sphere\nboundary f f f\nregion b block 0 1 0 1 0 1 units box\ncreate_box 1 b\nfix i all nve/bonded",
              "fix nve/bonded needs particles of `atom_style bonded/sphere`"},
        Wrong{"atom_style_keyword", "units si\natom_style bonded/sphere width 3", "unknown keyword 'width', allowed are 'thickness' (m) and 'density' (kg/m3)"},
        Wrong{"negative_thickness", "units si\natom_style bonded/sphere thickness -1", "thickness is -1, it must be a positive number"},
        Wrong{"thickness_without_value", "units si\natom_style bonded/sphere thickness", "a keyword has no value"},
        Wrong{"newton_on", "units si\ndimension 3\nnewton on\nboundary f f f\natom_style bonded/sphere\ncommunicate single vel yes\nbond_style parallel\npair_style grain\nread_data grains.data\nneighbor 1e-4 bin\npair_coeff * * 5e9 2 0.5\nbond_coeff 1 5e9 2 1e7 1e7\nbond_install all gap 1e-5",
              "`newton off` (or `newton off on`)"},
        Wrong{"bond_style_words", "$START\nbond_style parallel fast", "bond_style takes no further words, 'fast' was given"},
        Wrong{"pair_style_words", "$START\npair_style grain 2", "pair_style grain takes no further words, '2' was given"},
        Wrong{"too_few_coefficients", "$HEAD\nread_data grains.data\nbond_coeff 1 5e9 2.0 1e7", "bond_coeff for bond_style parallel: 'tau_c (Pa)' has no value"},
        Wrong{"negative_strength", "$HEAD\nread_data grains.data\nbond_coeff 1 5e9 2.0 -1e7 1e7", "sigma_c (Pa) is -1e7, it must be positive"},
        Wrong{"zero_modulus", "$HEAD\nread_data grains.data\nbond_coeff 1 0 2.0 1e7 1e7", "E_b (Pa) is 0, it must be positive"},
        Wrong{"strength_not_a_number", "$HEAD\nread_data grains.data\nbond_coeff 1 5e9 2.0 strong 1e7", "sigma_c (Pa) is strong, it must be positive"},
        Wrong{"strength_nan", "$HEAD\nread_data grains.data\nbond_coeff 1 5e9 2.0 nan 1e7", "sigma_c (Pa) is nan, it must be positive"},
        Wrong{"strength_with_unit", "$HEAD\nread_data grains.data\nbond_coeff 1 5e9 2.0 10MPa 1e7", "sigma_c (Pa) is 10MPa, it must be positive"},
        Wrong{"modulus_of_contact_text", "$HEAD\nread_data grains.data\npair_coeff * * stiff 2 0.5", "E_c is stiff, it must be 0 (no contact) or positive, Pa"},
        Wrong{"gap_text", "$COEFF\nbond_install all gap small", "gap is small m, it must be 0 or positive"},
        Wrong{"thickness_text", "units si\natom_style bonded/sphere thickness thin", "thickness is thin, it must be a positive number"},
        Wrong{"safety_text", "$COEFF\nbond_install all gap 1e-5\ntimestep_bonded yes", "SAFETY is yes, it must be above 0 and at most 1"},
        Wrong{"unknown_bond_keyword", "$HEAD\nread_data grains.data\nbond_coeff 1 5e9 2.0 1e7 1e7 radius 2", "unknown keyword 'radius', allowed are lambda, beta, friction_angle"},
        Wrong{"keyword_without_value", "$HEAD\nread_data grains.data\nbond_coeff 1 5e9 2.0 1e7 1e7 lambda", "'lambda' has no value"},
        Wrong{"friction_angle", "$HEAD\nread_data grains.data\nbond_coeff 1 5e9 2.0 1e7 1e7 friction_angle 90", "friction_angle must be below 90 degrees"},
        Wrong{"unknown_scatter", "$HEAD\nread_data grains.data\nbond_coeff 1 5e9 2.0 1e7 1e7 scatter gamma 1 1", "gamma"},
        Wrong{"negative_scatter", "$HEAD\nread_data grains.data\nbond_coeff 1 5e9 2.0 1e7 1e7 scatter normal -0.2 0.2", "-0.2"},
        Wrong{"broken_seed", "$HEAD\nread_data grains.data\nbond_coeff 1 5e9 2.0 1e7 1e7 seed 1.5", "seed is 1.5, it must be a whole number"},
        Wrong{"negative_fracture_energy", "$HEAD\nread_data grains.data\nbond_coeff 1 5e9 2.0 1e7 1e7 softening -3", "softening (fracture energy, J/m2) is -3, it must be 0 or positive"},
        Wrong{"zero_tension_modulus", "$HEAD\nread_data grains.data\nbond_coeff 1 5e9 2.0 1e7 1e7 tension_modulus 0", "tension_modulus (E_t/E_c) is 0, it must be positive"},
        Wrong{"negative_damping", "$HEAD\nread_data grains.data\nbond_coeff 1 5e9 2.0 1e7 1e7 damping -0.1", "damping (share of the critical) is -0.1, it must be 0 or positive"},
        Wrong{"contact_maybe", "$HEAD\nread_data grains.data\nbond_coeff 1 5e9 2.0 1e7 1e7 contact maybe", "contact is maybe, it must be yes or no"},
        Wrong{"option_without_value", "$HEAD\nread_data grains.data\nbond_coeff 1 5e9 2.0 1e7 1e7 damping", "'damping (share of the critical)' has no value"},
        Wrong{"coefficients_missing", "$HEAD\nread_data grains.data\nneighbor 1e-4 bin\npair_coeff * * 5e9 2 0.5\nbond_install all gap 1e-5", "bond_install: give `bond_coeff` for bond type 1 before `bond_install`"},
        Wrong{"pair_coefficients_missing", "$HEAD\nread_data grains.data\nneighbor 1e-4 bin\nbond_coeff 1 5e9 2 1e7 1e7\nbond_install all gap 1e-5", "pair coeffs are not set"},
        Wrong{"pair_coefficients_count", "$HEAD\nread_data grains.data\npair_coeff * * 5e9 2", "expected `pair_coeff I J E_c kn_ks mu`"},
        Wrong{"negative_modulus", "$HEAD\nread_data grains.data\npair_coeff * * -5e9 2 0.5", "E_c is -5e9, it must be 0 (no contact) or positive, Pa"},
        Wrong{"zero_ratio", "$HEAD\nread_data grains.data\npair_coeff * * 5e9 0 0.5", "kn_ks is 0, it must be positive"},
        Wrong{"negative_friction", "$HEAD\nread_data grains.data\npair_coeff * * 5e9 2 -0.5", "mu is -0.5, it must be 0 or positive"},
        Wrong{"install_before_specimen", "$HEAD\nbond_install all gap 1e-5", "bond_install: read a specimen first"},
        Wrong{"install_without_bond_style", "$START\npair_style grain\nread_data grains.data\nbond_install all gap 1e-5", "bond_install: give `bond_style`"},
        Wrong{"install_without_pair_style", "$START\nbond_style parallel\nread_data grains.data\nbond_coeff 1 5e9 2 1e7 1e7\nbond_install all gap 1e-5", "bond_install: give `pair_style grain` before"},
        Wrong{"install_words", "$COEFF\nbond_install all", "expected `bond_install GROUP gap GAP [keywords]`, `bond_install GROUP file FILE [keywords]` or"},
        Wrong{"install_unknown_way", "$COEFF\nbond_install all touch 3", "unknown word 'touch', allowed are gap, file and data"},
        Wrong{"install_unknown_group", "$COEFF\nbond_install rocks gap 1e-5", "there is no group 'rocks'"},
        Wrong{"install_negative_gap", "$COEFF\nbond_install all gap -1e-5", "gap is -1e-5 m, it must be 0 or positive"},
        Wrong{"install_type", "$COEFF\nbond_install all gap 1e-5 type 2", "bond type 2 is not between 1 and 1"},
        Wrong{"install_trailing", "$COEFF\nbond_install all gap 1e-5 quickly", "unknown word 'quickly'"},
        Wrong{"nothing_touches", "$COEFF\nset atom 2 x 0.01\nbond_install all gap 1e-9", "no pair of particles is within reach"},
        Wrong{"list_missing", "$COEFF\nbond_install all file nowhere.pairs", "can't open nowhere.pairs"},
        Wrong{"list_text", "$COEFF\nbond_install all file bad.pairs", "bad.pairs:3: expected two different positive ids, found `2 two`"},
        Wrong{"list_same", "$COEFF\nbond_install all file same.pairs", "same.pairs:1: expected two different positive ids"},
        Wrong{"list_unknown_ids", "$COEFF\nbond_install all file ghosts.pairs", "the particles 77 and 78 are missing or further apart"},
        Wrong{"list_one_unknown_id", "$COEFF\nbond_install all file ghost.pairs", "the particles 2 and 78 are missing or further apart"},
        Wrong{"list_too_far", "$COEFF\nbond_install all file far.pairs", "the particles 1 and 3 are missing or further apart than four of the largest radii"},
        Wrong{"no_safety", "$COEFF\nbond_install all gap 1e-5\ntimestep_bonded", "expected `timestep_bonded SAFETY`"},
        Wrong{"large_safety", "$COEFF\nbond_install all gap 1e-5\ntimestep_bonded 1.5", "SAFETY is 1.5, it must be above 0 and at most 1"},
        Wrong{"no_bonds_for_step", "$COEFF\ntimestep_bonded 0.5", "no bonds are installed"},
        Wrong{"nve_words", "$COEFF\nfix i all nve/bonded rotate yes", "'rotate' is not understood, allowed is `orientation yes|no`"},
        Wrong{"partner_deleted", "$COEFF\nbond_install all gap 2e-4\ngroup last id 3\ndelete_atoms group last\nfix i all nve/bonded\nrun 1", "Bond atoms 2 3 missing at step 0"},
        Wrong{"middle_deleted", "$COEFF\nbond_install all gap 2e-4\ngroup mid id 2\ndelete_atoms group mid\nfix i all nve/bonded\nrun 1", "Bond atoms 1 2 missing at step 0"}),
    [](const auto &info) { return info.param.name; });

TEST(DataFile, wrong_particle_lines) {
  const struct {
    const char *line, *message;
  } cases[] = {{"0 1 2e-3 2500 0 0 0", "the id must be a positive integer"},
               {"2 7 2e-3 2500 0 0 0", "the type must be between 1 and the number of atom types"},
               {"2 1 0 2500 0 0 0", "the diameter (m) must be positive"},
               {"2 1 2e-3 -1 0 0 0", "the density (kg/m3) must be positive"}};
  for (const auto &c : cases) {
    EngineFolder folder;
    folder.write("grains.data", std::string("particles\n\n2 atoms\n1 atom types\n1 bond types\n\n-1 1 xlo xhi\n-1 1 ylo yhi\n-1 1 zlo zhi\n\nAtoms\n\n1 1 2e-3 2500 0.1 0 0\n") + c.line + "\n");
    Preamble p;
    p.specimen = "grains.data";
    p.safety = 0.0;
    const EngineResult r = run_deck(folder, p.text(), 1, {}, 20.0);
    EXPECT_FALSE(r.ok());
    EXPECT_TRUE(r.says(c.message)) << r.screen;
  }
}
