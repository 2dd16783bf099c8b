// SPDX-License-Identifier: GPL-2.0-or-later
#include "specimen/exchange.h"

#include <gtest/gtest.h>

#include "base/table_file.h"
#include "base/test_folder.h"
#include "specimen/test_packings.h"

namespace bondlab {
namespace {

// Out in each form and in again: the same particles to the last bit, and so the same file.
TEST(Exchange, EveryFormComesBackTheSame) {
  const TestFolder folder;
  const Specimen made = make_specimen(small_disc());
  write_data_file(made, folder / "disc.data");
  const PackingFile packing = read_packing_file(folder / "disc.data");
  for (const char *name : {"disc.vtp", "disc.xyzr", "disc.txt"}) {
    export_packing(packing, folder / name);
    const Specimen again = import_packing(folder / name, small_disc());
    ASSERT_EQ(again.particles.size(), made.particles.size()) << name;
    for (std::size_t i = 0; i < made.particles.size(); ++i) {
      EXPECT_EQ(again.particles[i].x, packing.rows[i].particle.x) << name;
      EXPECT_EQ(again.particles[i].y, packing.rows[i].particle.y) << name;
      EXPECT_EQ(again.particles[i].r, packing.rows[i].particle.r) << name;
    }
    EXPECT_NEAR(again.statistics.porosity, made.statistics.porosity, 1e-12) << name;
  }
  EXPECT_EQ(import_packing(folder / "disc.data", small_disc()).particles.size(),
            made.particles.size());
}

TEST(Exchange, RefusesFormsItDoesntKnowAndFilesWithoutRadii) {
  const TestFolder folder;
  PackingFile packing;
  packing.rows.push_back({1, {0, 0, 0, 1}, 2600, 1});
  EXPECT_THROW(export_packing(packing, folder / "p.stl"), UserError);
  export_packing(packing, folder / "p.vtp");
  std::string text = read_text_file(folder / "p.vtp");
  text.replace(text.find("radius_m"), 4, "size");  // the diameter is left
  EXPECT_EQ(import_packing(folder.write("d.vtp", text), small_disc()).particles[0].r, 1);
  text.replace(text.find("diameter_m"), 4, "size");
  try {
    import_packing(folder.write("q.vtp", text), small_disc());
    FAIL();
  } catch (const UserError &error) {
    EXPECT_NE(error.text().find("no radius at the points"), std::string::npos) << error.text();
  }
}

}  // namespace
}  // namespace bondlab
