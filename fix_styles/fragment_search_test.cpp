// SPDX-License-Identifier: GPL-2.0-or-later
#include "fragment_search.h"

#include <gtest/gtest.h>

namespace {

using namespace bondlab;

std::vector<FragmentParticle> six() {
  std::vector<FragmentParticle> p(6);
  for (int k = 0; k < 6; ++k) {
    p[k].tag = 6 - k;  // in another order than their tags
    p[k].mass = 1.0 + 0.1 * (6 - k);
    p[k].density = 1000;
    p[k].x[0] = 6 - k;
  }
  return p;
}

TEST(Fragments, AreWhatBondsHoldTogetherHeaviestFirst) {
  const auto f = find_fragments(six(), {{4, 5}, {1, 2}, {2, 6}});
  ASSERT_EQ(f.size(), 3u);
  EXPECT_EQ(f[0].first_tag, 1);
  EXPECT_EQ(f[0].particles, 3);
  EXPECT_DOUBLE_EQ(f[0].mass, 1.1 + 1.2 + 1.6);
  EXPECT_DOUBLE_EQ(f[0].x[0], (1.1 * 1 + 1.2 * 2 + 1.6 * 6) / 3.9);
  EXPECT_EQ(f[1].first_tag, 4);
  EXPECT_EQ(f[2].particles, 1);
  EXPECT_EQ(f[2].first_tag, 3);
}

TEST(Fragments, DoNotDependOnTheOrderOfBondsOrTheirEnds) {
  const auto a = find_fragments(six(), {{1, 2}, {2, 3}, {5, 6}, {3, 4}});
  const auto b = find_fragments(six(), {{4, 3}, {6, 5}, {3, 2}, {1, 2}, {2, 4}});
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k) {
    EXPECT_EQ(a[k].mass, b[k].mass);
    EXPECT_EQ(a[k].first_tag, b[k].first_tag);
    EXPECT_EQ(a[k].x[0], b[k].x[0]);
  }
}

TEST(Fragments, SizeIsTheDiameterOfTheSphereOfItsMass) {
  std::vector<FragmentParticle> p(1);
  p[0].tag = 1;
  p[0].density = 2500;
  p[0].mass = 2500 * 4.0 / 3.0 * 3.14159265358979323846 * 1e-9;  // R = 1 mm
  const auto f = find_fragments(p, {{1, 2}});  // a partner that isn't there
  ASSERT_EQ(f.size(), 1u);
  EXPECT_NEAR(f[0].size, 2e-3, 1e-15);
}

TEST(Fragments, PassingIsTheMassBelowASize) {
  const auto f = find_fragments(six(), {{1, 2}, {2, 3}, {3, 4}});
  double all = 0;
  for (const auto &one : f) all += one.mass;
  EXPECT_DOUBLE_EQ(passing(f, f[0].size), (all - f[0].mass) / all);
  EXPECT_EQ(passing(f, 1e-9), 0.0);
  EXPECT_EQ(passing(f, 1e9), 1.0);
}

}  // namespace
