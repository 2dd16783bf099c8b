// SPDX-License-Identifier: GPL-2.0-or-later
#include "specimen/check_packing.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/test_folder.h"
#include "specimen/test_packings.h"

namespace bondlab {
namespace {

// Unit discs on a square lattice of n x n cells of 2 m.
Specimen lattice(int n) {
  Specimen specimen;
  specimen.request.shape = ContainerShape::rectangle;
  specimen.request.width = specimen.request.height = 2.0 * n;
  specimen.request.r_min = 1;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) specimen.particles.push_back({2.0 * i + 1 - n, 2.0 * j + 1, 0, 1});
  specimen.densities.assign(specimen.particles.size(), 2600);
  return specimen;
}

std::string complaint(const Specimen &specimen, const PackingLimits &limits = {}) {
  try {
    check_packing(specimen, limits);
  } catch (const UserError &error) {
    return error.what();
  }
  return "";
}

void expect_part(const std::string &text, const std::string &part) {
  EXPECT_NE(text.find(part), std::string::npos) << "\"" << text << "\" without \"" << part << "\"";
}

TEST(CheckPacking, PackingsOfTheGeneratorPass) {
  for (const SpecimenRequest &request : {small_rectangle(), small_disc(), small_cylinder()})
    EXPECT_EQ(complaint(make_specimen(request)), "");
  EXPECT_EQ(complaint(lattice(6)), "");
}

TEST(CheckPacking, ParticleOutsideTheSpecimen) {
  Specimen specimen = lattice(6);
  specimen.particles[5].x += 0.002;  // the one on the right of the lowest row
  expect_part(
      complaint(specimen),
      "particle 6 at (5.002, 1, 0) m sticks out of the rectangle by 0.002 m (allowed: 0.001 m)");
  PackingLimits wide;
  wide.stick_out = 0.01;
  EXPECT_EQ(complaint(specimen, wide), "");
}

TEST(CheckPacking, ParticleOutsideTheBoxNamesItsLine) {
  const TestFolder folder;
  Specimen specimen = lattice(6);
  specimen.particles[5].x = 50;
  specimen.statistics = measure_packing(specimen.request.container(), specimen.particles);
  write_data_file(specimen, folder / "a.data");
  try {
    check_packing(folder / "a.data");
    FAIL();
  } catch (const UserError &error) {
    expect_part(error.what(), (folder / "a.data").string() +
                                  ":18: particle 6 at (50, 1, 0) m is outside the box of the file");
  }
}

TEST(CheckPacking, ParticleOutOfThePlane) {
  Specimen specimen = lattice(4);
  specimen.particles[7].z = 1e-6;
  expect_part(complaint(specimen), "particle 8 ");
  expect_part(complaint(specimen), "out of the plane");
}

TEST(CheckPacking, ParticleThatTouchesNoOther) {
  Specimen specimen = lattice(6);
  specimen.particles[14].r = 0.9;  // gap 0.1 to its four neighbours
  expect_part(complaint(specimen), "particle 15 at (-1, 5, 0) m touches no other");
  PackingLimits wide;
  wide.gap = 0.11;
  EXPECT_EQ(complaint(specimen, wide), "");
}

TEST(CheckPacking, PackingInTwoParts) {
  Specimen specimen = lattice(6);
  for (Particle &p : specimen.particles)
    if (p.y > 8) p.y += 0.1;  // the upper two rows
  specimen.request.height += 0.1;
  expect_part(complaint(specimen),
              "particle 25 belongs to a part of 12 particles that touches the rest nowhere");
}

TEST(CheckPacking, BondsAcrossTheNotch) {
  Specimen specimen = lattice(6);
  specimen.request.notch_depth = 2.5;
  specimen.request.notch_width = 0.1;
  for (Particle &p : specimen.particles)  // the sides stand 0.1 m apart, above they touch
    if (p.y < 4) p.x += p.x < 0 ? -0.05 : 0.05;
  PackingLimits limits;
  limits.stick_out = 1;
  limits.gap = 0.11;
  const std::string text = complaint(specimen, limits);
  expect_part(text, "would be bonded to particle 3 across the notch");  // y = 1
  EXPECT_EQ(text.find("particle 9 across"), std::string::npos);         // y = 3 is above it
  limits.gap = 0.09;
  EXPECT_EQ(complaint(specimen, limits), "");
}

TEST(CheckPacking, LargeOverlap) {
  Specimen specimen = lattice(6);
  specimen.particles[14].x += 0.05;
  expect_part(complaint(specimen),
              "particle 16 overlaps particle 15 by 0.05 of the smaller radius (allowed: 0.02)");
}

TEST(CheckPacking, NotFinite) {
  for (double Particle::*member : {&Particle::x, &Particle::y, &Particle::z, &Particle::r}) {
    Specimen specimen = lattice(4);
    specimen.particles[3].*member = std::nan("");
    expect_part(complaint(specimen), "particle 4 has a place or radius that is not finite");
  }
  Specimen specimen = lattice(4);
  specimen.particles[3].r = 0;
  expect_part(complaint(specimen), "particle 4 has a place or radius");
}

TEST(CheckPacking, DuplicateIdsAreFoundInTheFile) {
  const TestFolder folder;
  std::string text = data_file_text(lattice(4));
  const std::size_t at = text.find("\n7 1 2 ");
  ASSERT_NE(at, std::string::npos);
  text.replace(at, 2, "\n8");
  try {
    check_packing(folder.write("a.data", text));
    FAIL();
  } catch (const UserError &error) {
    expect_part(error.what(), "id 8 stands already in line 19");
  }
}

TEST(CheckPacking, NoParticles) {
  Specimen specimen = lattice(4);
  specimen.particles.clear();
  expect_part(complaint(specimen), "no particles");
}

TEST(CheckPacking, ListsTenOfAKindAndCountsTheRest) {
  Specimen specimen = lattice(6);
  for (Particle &p : specimen.particles) p.r = 0.9;
  const std::string all = complaint(specimen);
  expect_part(all, "particle 10 at");
  EXPECT_EQ(all.find("particle 11 at"), std::string::npos);
  expect_part(all, "26 more particles without a neighbour");
}

}  // namespace
}  // namespace bondlab
