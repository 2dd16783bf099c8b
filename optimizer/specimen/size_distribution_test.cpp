// SPDX-License-Identifier: GPL-2.0-or-later
#include "specimen/size_distribution.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/user_error.h"

namespace bondlab {
namespace {

TEST(SizeDistribution, UniformQuantilesAndMoments) {
  const auto sizes = size_distribution("uniform", 2, 1.5);
  EXPECT_DOUBLE_EQ(sizes->smallest(), 2);
  EXPECT_DOUBLE_EQ(sizes->largest(), 3);
  EXPECT_DOUBLE_EQ(sizes->quantile(0.25), 2.25);
  for (int power = 1; power <= 3; ++power) {  // against the mid-point rule
    double sum = 0;
    const int n = 100000;
    for (int i = 0; i < n; ++i) sum += std::pow(sizes->quantile((i + 0.5) / n), power) / n;
    EXPECT_NEAR(sizes->moment(power), sum, 1e-8) << power;
  }
  EXPECT_DOUBLE_EQ(size_distribution("uniform", 2, 1)->moment(3), 8);  // equal sizes
}

TEST(SizeDistribution, UnknownNameListsTheKnown) {
  try {
    size_distribution("gauss", 1, 2);
    FAIL();
  } catch (const UserError &error) {
    EXPECT_NE(std::string(error.what()).find("allowed: uniform"), std::string::npos);
  }
}

TEST(SizeDistribution, DrawnRadiiFollowItInRandomOrder) {
  RandomStream random(7);
  const auto sizes = size_distribution("uniform", 1, 3);
  const std::size_t n = 1000;
  const std::vector<double> drawn = draw_radii(*sizes, n, random);
  std::vector<double> sorted = drawn;
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t i = 0; i < n; ++i) {  // one in each stratum
    EXPECT_GT(sorted[i], sizes->quantile(static_cast<double>(i) / n) - 1e-12);
    EXPECT_LT(sorted[i], sizes->quantile(static_cast<double>(i + 1) / n) + 1e-12);
  }
  double covariance = 0;  // of neighbours in the list: 0 +- sd^2 / sqrt(n) = 0.011 for a shuffled
                          // one, 0.33 for a sorted one
  for (std::size_t i = 1; i < n; ++i) covariance += (drawn[i] - 2) * (drawn[i - 1] - 2) / n;
  EXPECT_NEAR(covariance, 0, 0.04);
}

SizeSettings log_normal() {
  SizeSettings s;
  s.name = "log-normal", s.r_median = 2, s.r_spread = 0.4;
  return s;
}
SizeSettings discrete() {
  SizeSettings s;
  s.name = "discrete", s.classes = {{3, 1}, {1, 2}, {2, 5}};
  return s;
}
SizeSettings by_mass() {
  SizeSettings s;
  s.name = "d10-d50-d90", s.d10 = 2, s.d50 = 3, s.d90 = 5;
  return s;
}

TEST(SizeDistribution, MomentsAreThoseOfTheQuantiles) {
  for (const SizeSettings &settings : {log_normal(), discrete(), by_mass()})
    for (const int dimension : {2, 3}) {
      const auto sizes = size_distribution(settings, dimension);
      double last = sizes->smallest();
      const int n = 200000;
      double sum[4] = {};
      for (int i = 0; i < n; ++i) {
        const double r = sizes->quantile((i + 0.5) / n);
        EXPECT_GE(r, last * (1 - 1e-12)) << settings.name;
        last = r;
        for (int power = 1; power <= 3; ++power) sum[power] += std::pow(r, power) / n;
      }
      EXPECT_LE(last, sizes->largest() * (1 + 1e-12)) << settings.name;
      for (int power = 1; power <= 3; ++power)
        EXPECT_NEAR(sizes->moment(power) / sum[power], 1, 2e-5) << settings.name << power;
    }
}

TEST(SizeDistribution, LogNormalHasItsMedianAndSpread) {
  const auto sizes = size_distribution(log_normal(), 3);
  EXPECT_NEAR(sizes->quantile(0.5), 2, 1e-12);
  // One standard deviation of ln r: 84.13 % of all, of the middle 95 % (0.8413 - 0.025) / 0.95.
  EXPECT_NEAR(sizes->quantile((0.841344746068543 - 0.025) / 0.95), 2 * std::exp(0.4), 1e-9);
}

TEST(SizeDistribution, DiscreteClassesHaveTheirSharesOfTheNumber) {
  const auto sizes = size_distribution(discrete(), 2);
  EXPECT_EQ(sizes->quantile(0.24), 1);
  EXPECT_EQ(sizes->quantile(0.26), 2);
  EXPECT_EQ(sizes->quantile(0.87), 2);
  EXPECT_EQ(sizes->quantile(0.88), 3);
  EXPECT_EQ(sizes->smallest(), 1);
  EXPECT_EQ(sizes->largest(), 3);
}

TEST(SizeDistribution, SieveCurvePassesThroughItsPointsByMass) {
  for (const int dimension : {2, 3}) {
    const auto sizes = size_distribution(by_mass(), dimension);
    const int n = 400000;
    double total = 0, below[3] = {};
    for (int i = 0; i < n; ++i) {
      const double r = sizes->quantile((i + 0.5) / n), mass = std::pow(r, dimension);
      total += mass;
      below[0] += r < 1 ? mass : 0;
      below[1] += r < 1.5 ? mass : 0;
      below[2] += r < 2.5 ? mass : 0;
    }
    EXPECT_NEAR(below[0] / total, 0.1, 1e-4) << dimension;
    EXPECT_NEAR(below[1] / total, 0.5, 1e-4) << dimension;
    EXPECT_NEAR(below[2] / total, 0.9, 1e-4) << dimension;
  }
}

TEST(SizeDistribution, ValuesThatMakeNoneAreRefused) {
  const auto complaint = [](SizeSettings s) -> std::string {
    try {
      check_sizes(s);
    } catch (const UserError &error) {
      return error.what();
    }
    return "";
  };
  for (const SizeSettings &good : {log_normal(), discrete(), by_mass()})
    EXPECT_EQ(complaint(good), "") << good.name;
  SizeSettings s = log_normal();
  s.r_spread = 0.7;
  EXPECT_NE(complaint(s).find("is 0.7 (allowed: > 0, up to 0.587)"), std::string::npos);
  s = discrete();
  s.classes[0].share = -1;
  EXPECT_NE(complaint(s).find("share is -1"), std::string::npos);
  s.classes = {{1, 1}, {11, 1}};
  EXPECT_NE(complaint(s).find("largest over smallest up to 10"), std::string::npos);
  s.classes.clear();
  EXPECT_NE(complaint(s).find("no classes"), std::string::npos);
  s = by_mass();
  s.d50 = 6;
  EXPECT_NE(complaint(s).find("(allowed: increasing)"), std::string::npos);
  s.d10 = 0.5, s.d50 = 3;
  EXPECT_NE(complaint(s).find("largest over smallest up to 10"), std::string::npos);
}

TEST(SizeDistribution, ClassesAreReadFromText) {
  const SizeClass c = parse_size_class(" 0.5 mm: 30 %");
  EXPECT_DOUBLE_EQ(c.r, 0.5e-3);
  EXPECT_EQ(c.share, 30);
  EXPECT_THROW(parse_size_class("0.5 mm"), UserError);
  EXPECT_THROW(parse_size_class("0.5 MPa: 1"), UserError);
  EXPECT_THROW(parse_size_class("0.5 mm: 1 kg"), UserError);
}

}  // namespace
}  // namespace bondlab
