// SPDX-License-Identifier: GPL-2.0-or-later
//
// Strengths scattered from bond to bond: the distributions, and that they depend on the pair, the
// seed and the stream alone.
#include "strength.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

using namespace bondlab::laws;

namespace {

std::vector<double> sample(const StrengthDistribution &d, int n) {
  std::vector<double> values;
  // tags as in a specimen: neighbours in a numbering along a curve
  for (int a = 1; static_cast<int>(values.size()) < n; ++a)
    for (int b = a + 1; b < a + 9; ++b) values.push_back(bond_strength(d, a, b));
  return values;
}

// Largest distance between the sample's distribution and `cdf`, times sqrt(n).
template <class Cdf>
double kolmogorov(std::vector<double> v, Cdf cdf) {
  std::sort(v.begin(), v.end());
  const double n = static_cast<double>(v.size());
  double worst = 0.0;
  for (std::size_t k = 0; k < v.size(); ++k) {
    const double p = cdf(v[k]);
    worst = std::max({worst, (k + 1) / n - p, p - k / n});
  }
  return worst * std::sqrt(n);
}
constexpr double kKolmogorovLimit = 1.95;  // exceeded by chance once in a thousand

double mean(const std::vector<double> &v) {
  double sum = 0.0;
  for (const double x : v) sum += x;
  return sum / v.size();
}

double deviation(const std::vector<double> &v) {
  const double m = mean(v);
  double sum = 0.0;
  for (const double x : v) sum += (x - m) * (x - m);
  return std::sqrt(sum / (v.size() - 1));
}

double correlation(const std::vector<double> &a, const std::vector<double> &b) {
  const double ma = mean(a), mb = mean(b);
  double sum = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += (a[k] - ma) * (b[k] - mb);
  return sum / (a.size() - 1) / deviation(a) / deviation(b);
}

}  // namespace

// Quantiles of the standard normal to 16 digits (Abramowitz & Stegun tables extended; R's qnorm).
TEST(InverseNormal, known_quantiles) {
  const struct {
    double p, x;
  } known[] = {{0.5, 0.0},
               {0.841344746068542948, 1.0},
               {0.977249868051820793, 2.0},
               {0.975, 1.959963984540054},
               {0.995, 2.575829303548901},
               {0.9, 1.281551565544600},
               {0.75, 0.6744897501960817},
               {1e-3, -3.090232306167814},
               {1e-6, -4.753424308822899},
               {1e-10, -6.361340902404056}};
  for (const auto &k : known) {
    EXPECT_NEAR(inverse_normal(k.p), k.x, 3e-15 * (1.0 + std::fabs(k.x)));
    if (k.p > 0.1) {
      EXPECT_NEAR(inverse_normal(1.0 - k.p), -k.x, 3e-15 * (1.0 + std::fabs(k.x)) / std::min(1.0, 20 * (1.0 - k.p)));
    }
  }
}

TEST(InverseNormal, inverts_the_distribution_over_the_range_of_the_hash) {
  for (double p = 1.2e-16; p < 0.5; p *= 1.7) {
    const double x = inverse_normal(p);
    EXPECT_NEAR(0.5 * std::erfc(-x / std::sqrt(2.0)) / p, 1.0, 1e-13 * (1 + x * x)) << p;
  }
  double last = -100.0;
  for (int k = 1; k < 20000; ++k) {
    const double x = inverse_normal(k / 20000.0);
    EXPECT_GT(x, last);
    last = x;
  }
}

TEST(Scatter, uniform_numbers_are_uniform) {
  std::vector<double> v;
  for (int a = 1; a <= 5000; ++a)
    for (int b = a + 1; b < a + 9; ++b) v.push_back(uniform_of_pair(a, b, 1, 0));
  EXPECT_LT(kolmogorov(v, [](double x) { return x; }), kKolmogorovLimit);
  EXPECT_GT(*std::min_element(v.begin(), v.end()), 0.0);
  EXPECT_LT(*std::max_element(v.begin(), v.end()), 1.0);
  EXPECT_EQ(std::set<double>(v.begin(), v.end()).size(), v.size());
  // neighbours in the list don't know of each other
  const std::vector<double> first(v.begin(), v.end() - 1), second(v.begin() + 1, v.end());
  EXPECT_LT(std::fabs(correlation(first, second)), 3.3 / std::sqrt(v.size()));
}

TEST(Scatter, normal) {
  const StrengthDistribution d{100e6, Scatter::normal, 20e6, 5, 0};
  const std::vector<double> v = sample(d, 40000);
  EXPECT_NEAR(mean(v), 100e6, 3.3 * 20e6 / std::sqrt(v.size()));
  EXPECT_NEAR(deviation(v), 20e6, 3.3 * 20e6 / std::sqrt(2.0 * v.size()));
  EXPECT_LT(kolmogorov(v, [](double x) { return 0.5 * std::erfc((100e6 - x) / 20e6 / std::sqrt(2.0)); }), kKolmogorovLimit);
}

TEST(Scatter, normal_is_cut_off_at_a_hundredth_of_the_mean) {
  const StrengthDistribution d{100e6, Scatter::normal, 80e6, 5, 0};
  const std::vector<double> v = sample(d, 40000);
  EXPECT_EQ(*std::min_element(v.begin(), v.end()), 1e6);
  const double share = static_cast<double>(std::count(v.begin(), v.end(), 1e6)) / v.size();
  const double expected = 0.5 * std::erfc(99.0 / 80.0 / std::sqrt(2.0));
  EXPECT_NEAR(share, expected, 3.3 * std::sqrt(expected / v.size()));
}

TEST(Scatter, weibull) {
  for (const double m : {1.0, 3.0, 10.0}) {
    const StrengthDistribution d{50e6, Scatter::weibull, m, 9, 1};
    const std::vector<double> v = sample(d, 40000);
    const double g1 = std::tgamma(1 + 1 / m), g2 = std::tgamma(1 + 2 / m), scale = 50e6 / g1;
    const double sd = scale * std::sqrt(g2 - g1 * g1);
    EXPECT_NEAR(mean(v), 50e6, 3.3 * sd / std::sqrt(v.size())) << m;
    EXPECT_NEAR(deviation(v) / sd, 1.0, m == 1.0 ? 0.05 : 0.02) << m;
    EXPECT_LT(kolmogorov(v, [&](double x) { return 1.0 - std::exp(-std::pow(x / scale, m)); }), kKolmogorovLimit) << m;
  }
}

TEST(Scatter, none_is_the_mean) {
  EXPECT_EQ(bond_strength({7e6, Scatter::none, 3e6, 1, 0}, 3, 4), 7e6);
}

// What ranks change is the order of bonds and which particle is called first: neither matters.
TEST(Scatter, depends_on_the_pair_not_on_order_or_naming) {
  const StrengthDistribution d{100e6, Scatter::normal, 20e6, 5, 0};
  std::vector<double> forward, backward;
  for (int k = 1; k < 1000; ++k) forward.push_back(bond_strength(d, k, k + 3));
  for (int k = 999; k >= 1; --k) backward.push_back(bond_strength(d, k + 3, k));
  std::reverse(backward.begin(), backward.end());
  EXPECT_EQ(forward, backward);
}

TEST(Scatter, seeds_and_streams_are_independent) {
  const auto draw = [](std::uint64_t seed, std::uint64_t stream) {
    return sample({100e6, Scatter::normal, 20e6, seed, stream}, 20000);
  };
  const std::vector<double> base = draw(1, 0);
  EXPECT_EQ(base, draw(1, 0));
  const double chance = 3.3 / std::sqrt(base.size());
  for (const auto &[seed, stream] : {std::pair<int, int>{1, 1}, {2, 0}, {0, 0}, {2, 1}, {3, 0}}) {
    const std::vector<double> other = draw(seed, stream);
    EXPECT_NE(base, other);
    EXPECT_LT(std::fabs(correlation(base, other)), chance) << seed << ' ' << stream;
  }
  EXPECT_LT(std::fabs(correlation(draw(2, 0), draw(1, 1))), chance);
}
