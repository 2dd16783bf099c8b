// SPDX-License-Identifier: GPL-2.0-or-later
#include "view/run_data.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/user_error.h"
#include "view/run_for_tests.h"

namespace bondlab {
namespace {

const ViewParticle &particle(const RunView &run, int id) {
  return *std::find_if(run.particles.begin(), run.particles.end(),
                       [&](const ViewParticle &p) { return p.id == id; });
}

TEST(RunData, BondsArePairsWithinTheGapOfTheLogLessTheBrokenOnes) {
  const TestFolder folder;
  write_lattice_run(folder);
  const RunView run = read_run(folder.path());
  EXPECT_EQ(run.dimension, 2);
  EXPECT_EQ(run.gap, 1e-5);
  EXPECT_TRUE(run.has_start && run.has_bonds && run.has_log);
  EXPECT_EQ(run.bonds.size(), 60u);  // 2 * 6 * 5 of the lattice
  EXPECT_EQ(run.broken(BondState::tension), 6u);
  EXPECT_EQ(run.broken(BondState::shear), 1u);
  EXPECT_EQ(particle(run, 36).broken, 2);
  EXPECT_EQ(particle(run, 1).broken, 0);
  EXPECT_NEAR(particle(run, 36).end[0] - particle(run, 36).start[0], 0.0008, 1e-12);
  for (const ViewBond &bond : run.bonds) EXPECT_EQ(bond.time > 0, bond.state != BondState::intact);
}

TEST(RunData, FragmentsAreTheConnectedPartsHeaviestFirst) {
  const TestFolder folder;
  write_lattice_run(folder);
  const RunView run = read_run(folder.path());
  ASSERT_EQ(run.fragments.size(), 3u);
  EXPECT_EQ(run.fragments[0].particles, 30);
  EXPECT_EQ(run.fragments[1].particles, 5);
  EXPECT_EQ(run.fragments[2].particles, 1);
  EXPECT_NEAR(run.fragments[1].share, 5.0 / 36, 1e-12);
  EXPECT_EQ(particle(run, 1).fragment, 0);
  EXPECT_EQ(particle(run, 6).fragment, 1);
  EXPECT_EQ(particle(run, 36).fragment, 2);
}

TEST(RunData, ForcesComeFromTheNewestDumpAtThePlacesOfItsStep) {
  const TestFolder folder;
  write_lattice_run(folder);
  std::string old = lattice_forces();
  old.replace(old.find("-100"), 4, "-999");
  folder.write("bonds_90.txt", old);
  folder.write("bonds_400.txt", lattice_forces());
  RunView run = read_run(folder.path());
  ASSERT_TRUE(run.has_forces);
  ASSERT_EQ(run.forces.size(), 2u);
  EXPECT_EQ(run.forces[0].normal, -100);
  EXPECT_EQ(run.forces[0].shear, 5);
  EXPECT_EQ(run.particles[static_cast<std::size_t>(run.forces[1].b)].id, 7);
  EXPECT_TRUE(run.force_places.empty());  // no particles of step 400
  folder.write("particles_400.txt", lattice_dump(false));
  run = read_run(folder.path());
  ASSERT_EQ(run.force_places.size(), 36u);
  EXPECT_NEAR(run.force_places[35][0], 0.010, 1e-12);
}

TEST(RunData, ARunOfTheStoreHasItsStartInTheSpecimen) {
  const TestFolder folder;
  folder.write("runs/1-ucs/particles_end.txt", lattice_dump(true));
  folder.write("runs/1-ucs/manifest.json",
               "{\"specimen\": \"moved/away/lattice.data\", \"virtual_test\": \"uniaxial\", "
               "\"si\": {\"width\": 0.012}}");
  std::string rows;
  for (int k = 0; k < 36; ++k)
    rows += std::to_string(k + 1) + " 1 0.002 2600 " + std::to_string(0.002 * (k % 6)) + " " +
            std::to_string(0.002 * (k / 6)) + " 0\n";
  folder.write("specimens/lattice.data",
               "# a packing\n\n36 atoms\n1 atom types\n\n-1 1 xlo xhi\n-1 1 ylo yhi\n-1 1 zlo "
               "zhi\n\nAtoms\n\n" +
                   rows);
  const RunView run = read_run(folder / "runs/1-ucs");
  EXPECT_TRUE(run.has_start);
  EXPECT_EQ(run.test, "uniaxial");
  EXPECT_EQ(run.variables.at("width"), 0.012);
  EXPECT_NEAR(particle(run, 6).end[0] - particle(run, 6).start[0], 0.0004, 1e-12);
}

TEST(RunData, WhatIsMissingIsSaidAndTheRestIsRead) {
  const TestFolder folder;
  folder.write("particles_end.txt", lattice_dump(true));
  const RunView run = read_run(folder.path());
  EXPECT_EQ(run.particles.size(), 36u);
  EXPECT_FALSE(run.has_start || run.has_bonds || run.has_log || run.has_forces);
  std::string all;
  for (const std::string &sentence : run.missing) all += sentence + "\n";
  for (const char *part : {"No displacement", "--gap", "No cracks", "No curve", "No force chains"})
    EXPECT_NE(all.find(part), std::string::npos) << part;
  EXPECT_THROW(read_run(folder / "nowhere"), UserError);
  EXPECT_THROW(read_run(folder.path().parent_path()), UserError);
}

// With a gap that doesn't fit the log of broken bonds, these are bonds all the same.
TEST(RunData, EveryBrokenBondIsABond) {
  const TestFolder folder;
  write_lattice_run(folder);
  ViewOptions options;
  options.gap = 1e-9;
  std::string start = lattice_dump(false);
  const RunView run = read_run(folder.path(), options);
  EXPECT_EQ(run.broken(BondState::tension) + run.broken(BondState::shear), 7u);
}

}  // namespace
}  // namespace bondlab
