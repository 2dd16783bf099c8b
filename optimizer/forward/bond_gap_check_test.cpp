// SPDX-License-Identifier: GPL-2.0-or-later
#include "forward/bond_gap_check.h"

#include <gtest/gtest.h>

#include "base/test_folder.h"
#include "base/user_error.h"
#include "specimen/data_file.h"

namespace bondlab {
namespace {

// A row of 200 discs of 1 mm with gaps of 0.02 mm, but one of `between` in the middle; `alone` more
// without a partner.
std::filesystem::path packing(const TestFolder &folder, int alone, double between = 2e-5) {
  Specimen specimen;
  specimen.request.shape = ContainerShape::rectangle;
  specimen.request.width = specimen.request.height = 2;
  specimen.request.r_min = 1e-3;
  for (int i = 0; i < 200; ++i)
    specimen.particles.push_back(
        {2.02e-3 * i - 0.9 + (i < 120 ? 0 : between - 2e-5), 0.1, 0, 1e-3});
  for (int i = 0; i < alone; ++i) specimen.particles.push_back({0.01 * i - 0.9, 0.5, 0, 1e-3});
  specimen.densities.assign(specimen.particles.size(), 2600);
  write_data_file(specimen, folder / "p.data");
  return folder / "p.data";
}

TEST(CheckBondGap, AFewFloatersAreNoReasonToRefuse) {
  const TestFolder folder;
  EXPECT_NO_THROW(check_bond_gap(packing(folder, 2), 3e-5));
}

TEST(CheckBondGap, MoreThanOneInAHundredIs) {
  const TestFolder folder;
  EXPECT_THROW(check_bond_gap(packing(folder, 3), 3e-5), UserError);
}

TEST(CheckBondGap, AGapThatBondsNothingIsRefusedWithFileLineAndAnUsualGap) {
  const TestFolder folder;
  try {
    check_bond_gap(packing(folder, 0), 1e-5);
    FAIL();
  } catch (const UserError &error) {
    EXPECT_EQ(error.place().file, (folder / "p.data").string());
    EXPECT_GT(error.place().line, 1);
    EXPECT_EQ(error.text(),
              "200 of 200 particles, this one first, touch no other within the bond gap of 0.01 mm "
              "(deck variable 'gap'); usual for this packing: 0.05 mm, a "
              "twentieth of the mean radius");
  }
}

TEST(CheckBondGap, APackingInPiecesIsRefusedThoughEveryParticleHasANeighbour) {
  const TestFolder folder;
  EXPECT_NO_THROW(check_bond_gap(packing(folder, 0, 2.9e-5), 3e-5));
  try {
    check_bond_gap(packing(folder, 0, 3.1e-5), 3e-5);
    FAIL();
  } catch (const UserError &error) {
    EXPECT_EQ(error.text().find("the packing is in pieces: 80 of 200 particles, this one first, "
                                "touch the largest piece nowhere within the bond gap of 0.03 mm"),
              0u)
        << error.text();
    EXPECT_EQ(read_packing_file(folder / "p.data").rows[120].line, error.place().line);
  }
}

}  // namespace
}  // namespace bondlab
