// SPDX-License-Identifier: GPL-2.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <set>

#include "base/user_error.h"
#include "specimen/specimen.h"
#include "specimen/test_packings.h"

namespace bondlab {
namespace {

std::string complaint(const std::function<void(SpecimenRequest &)> &spoil,
                      SpecimenRequest request = small_rectangle()) {
  spoil(request);
  try {
    check_request(request);
  } catch (const UserError &error) {
    return error.what();
  }
  return "";
}

void expect_part(const std::string &text, const std::string &part) {
  EXPECT_NE(text.find(part), std::string::npos) << "\"" << text << "\" without \"" << part << "\"";
}

TEST(SpecimenRequest, GoodOnesPass) {
  const auto nothing = [](SpecimenRequest &) {};
  EXPECT_EQ(complaint(nothing), "");
  EXPECT_EQ(complaint(nothing, small_disc()), "");
  EXPECT_EQ(complaint(nothing, small_cylinder()), "");
  EXPECT_EQ(complaint([](SpecimenRequest &r) { r.r_ratio = 1; }), "");
}

TEST(SpecimenRequest, BadSizesAreNamedWithTheValueAndWhatIsAllowed) {
  expect_part(complaint([](SpecimenRequest &r) { r.width = -0.05; }),
              "width of a rectangle is -0.05 m (allowed: > 0)");
  expect_part(complaint([](SpecimenRequest &r) { r.height = 0; }),
              "height of a rectangle is 0 m (allowed: > 0)");
  expect_part(complaint([](SpecimenRequest &r) { r.diameter = std::nan(""); }, small_disc()),
              "diameter of a disc is nan");
  expect_part(
      complaint([](SpecimenRequest &r) { r.height = std::numeric_limits<double>::infinity(); },
                small_cylinder()),
      "height of a cylinder is inf");
  expect_part(complaint([](SpecimenRequest &r) { r.r_min = -1e-3; }),
              "r_min is -0.001 m (allowed: > 0)");
  expect_part(complaint([](SpecimenRequest &r) { r.r_ratio = 0.6; }), "is 0.6 (allowed: 1 to 10)");
  expect_part(complaint([](SpecimenRequest &r) { r.r_ratio = 11; }), "is 11 (allowed: 1 to 10)");
  expect_part(complaint([](SpecimenRequest &r) { r.density = 0; }),
              "density is 0 kg/m3 (allowed: > 0)");
  expect_part(complaint([](SpecimenRequest &r) { r.overlap = 0.5; }), "locked-in overlap is 0.5");
  expect_part(complaint([](SpecimenRequest &r) { r.sizes = "gauss"; }),
              "unknown size distribution \"gauss\"");
}

TEST(SpecimenRequest, InsertionNeedsTriesAndRoomBetweenItsSizes) {
  const auto inserted = [](double ratio, long tries, const char *method = "insertion") {
    return complaint(
        [=](SpecimenRequest &r) { r.method = method, r.r_ratio = ratio, r.tries = tries; });
  };
  EXPECT_EQ(inserted(3, 1), "");
  EXPECT_EQ(inserted(3, most_tries), "");
  expect_part(inserted(3, 0), "tries is 0 (allowed: 1 to 1000000)");
  expect_part(inserted(3, most_tries + 1), "tries is 1000001 (allowed: 1 to 1000000)");
  EXPECT_EQ(inserted(2, 1000), "");
  expect_part(inserted(1.9, 1000), "is 1.9 times the smallest");
  EXPECT_EQ(inserted(1.9, 0, "filling"), "");
}

TEST(SpecimenRequest, AllErrorsAtOnce) {
  const std::string all = complaint([](SpecimenRequest &r) {
    r.width = r.height = -1;
    r.r_ratio = 0;
  });
  expect_part(all, "width");
  expect_part(all, "height");
  expect_part(all, "ratio");
}

TEST(SpecimenRequest, ContainerMustHoldFiveParticlesAcross) {
  // Mean diameter 2 x 1.33 r_min.
  const double limit = 0.025 / (5 * 2.66);
  EXPECT_EQ(complaint([&](SpecimenRequest &r) { r.r_min = 0.999 * limit; }), "");
  expect_part(complaint([&](SpecimenRequest &r) { r.r_min = 1.001 * limit; }),
              "five particles across");
  expect_part(complaint([&](SpecimenRequest &r) { r.height = 0.003; }, small_cylinder()),
              "0.003 m in its smallest direction");
}

TEST(SpecimenRequest, NotchMustLeaveAnOpeningAndALigament) {
  const auto notched = [](double depth, double width) {
    return complaint([=](SpecimenRequest &r) {
      r.width = 0.05, r.height = 0.025, r.notch_depth = depth, r.notch_width = width;
    });
  };
  EXPECT_EQ(notched(0.01, 0.002), "");
  expect_part(notched(0.02, 0.002), "(above or beside the notch included)");
  expect_part(notched(0.01, 0.0003), "bonds would cross it (allowed: at least 0.00051");
  expect_part(notched(0.01, 0), "notch_width of a rectangle is 0 m");
  expect_part(notched(-0.01, 0.002), "notch_depth of a rectangle is -0.01 m");
  expect_part(complaint([](SpecimenRequest &r) { r.notch_depth = 1e-3; }, small_disc()),
              "a disc can't have a notch");
}

TEST(SpecimenRequest, SlipInAUnitDoesNotAskForABillionParticles) {
  expect_part(complaint([](SpecimenRequest &r) { r.r_min = 1e-7; }), "more than 2000000 particles");
}

TEST(SpecimenKey, IsTheSameForever) {
  // A cached specimen must be found again: these change only with the generator's version.
  EXPECT_EQ(specimen_key(small_rectangle()), "825d84085f557391");
  EXPECT_EQ(specimen_key(small_cylinder()), "47cbd88510eaa613");
  EXPECT_EQ(canonical_text(small_disc()),
            "bondlab specimen 1\ngenerator radius-expansion-1\nshape disc\ndiameter 0.025\nr_min "
            "0.00049\nr_ratio 1.66\n"
            "sizes uniform\nseed 1\ndensity 2600\noverlap 2e-05\n");
}

TEST(SpecimenKey, DependsOnAllThatMakesThePackingAndOnNothingElse) {
  std::set<std::string> keys = {specimen_key(small_rectangle()), specimen_key(small_disc()),
                                specimen_key(small_cylinder())};
  const std::vector<std::function<void(SpecimenRequest &)>> changes = {
      [](SpecimenRequest &r) { r.width *= 1 + 1e-9; },
      [](SpecimenRequest &r) { r.height = 0.06; },
      [](SpecimenRequest &r) { r.r_min = 0.7e-3; },
      [](SpecimenRequest &r) { r.r_ratio = 1.7; },
      [](SpecimenRequest &r) { r.seed = 2; },
      [](SpecimenRequest &r) { r.density = 2622; },
      [](SpecimenRequest &r) { r.overlap = 1e-4; },
      [](SpecimenRequest &r) { r.sizes = "other"; },
      [](SpecimenRequest &r) { r.notch_depth = 0.01, r.notch_width = 0.002; },
      [](SpecimenRequest &r) { r.notch_depth = 0.01, r.notch_width = 0.003; }};
  for (const auto &change : changes) {
    SpecimenRequest request = small_rectangle();
    change(request);
    EXPECT_TRUE(keys.insert(specimen_key(request)).second) << canonical_text(request);
  }
  SpecimenRequest same = small_rectangle();
  same.r_min = 0.78 * 0.001 * (1 + 1e-15);  // the last bit of a unit's conversion
  EXPECT_EQ(specimen_key(same), specimen_key(small_rectangle()));
  SpecimenRequest stray = small_disc();
  stray.width = 3;  // a disc has none
  EXPECT_EQ(specimen_key(stray), specimen_key(small_disc()));
}

}  // namespace
}  // namespace bondlab
