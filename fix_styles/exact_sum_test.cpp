// SPDX-License-Identifier: GPL-2.0-or-later
//
// ExactSum against references that are exact by construction: integers, numbers of few enough bits
// for __float128 (113), and sums whose value is known.
#include "exact_sum.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace {

using bondlab::ExactSum;
using bondlab::ExactSums;

double sum_of(const std::vector<double> &numbers) {
  ExactSum s;
  for (double x : numbers) s.add(x);
  return s.value();
}

bool same_bits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }

TEST(ExactSum, EmptyIsZero) { EXPECT_TRUE(same_bits(sum_of({}), 0.0)); }

TEST(ExactSum, OneNumberComesBackUnchanged) {
  std::mt19937_64 random(1);
  for (int k = 0; k < 200000; ++k) {
    const std::uint64_t bits = random();
    double x;
    std::memcpy(&x, &bits, sizeof x);
    if (!std::isfinite(x) || x == 0.0) continue;
    ASSERT_TRUE(same_bits(sum_of({x}), x)) << x;
  }
}

TEST(ExactSum, OrderDoesNotMatter) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> mantissa(-1.0, 1.0);
  std::uniform_int_distribution<int> exponent(-300, 300);
  std::vector<double> numbers(2000);
  for (double &x : numbers) x = std::ldexp(mantissa(random), exponent(random));
  const double reference = sum_of(numbers);
  for (int k = 0; k < 50; ++k) {
    std::shuffle(numbers.begin(), numbers.end(), random);
    ASSERT_TRUE(same_bits(sum_of(numbers), reference));
  }
}

TEST(ExactSum, PartsAddUpToTheWhole) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal(0.0, 1e5);
  std::vector<double> numbers(1003);
  for (double &x : numbers) x = normal(random);
  const double reference = sum_of(numbers);
  for (int parts : {2, 3, 4, 64}) {
    std::vector<ExactSum> part(parts);
    for (std::size_t i = 0; i < numbers.size(); ++i) part[(i * 7) % parts].add(numbers[i]);
    ExactSum whole;
    for (const ExactSum &p : part) whole.add(p);
    EXPECT_TRUE(same_bits(whole.value(), reference)) << parts;
    // What MPI_SUM does with the words.
    ExactSum words;
    for (ExactSum p : part) {
      p.prepare_to_send();
      for (int i = 0; i < ExactSum::words; ++i) words.data()[i] += p.data()[i];
    }
    EXPECT_TRUE(same_bits(words.value(), reference)) << parts;
  }
}

TEST(ExactSum, CancellationLeavesTheSmallNumber) {
  EXPECT_EQ(sum_of({1e300, 1.0, -1e300}), 1.0);
  EXPECT_EQ(sum_of({1.0, 1e300, -1e300, 1e-300}), 1.0);
  EXPECT_EQ(sum_of({1e300, 5e-324, -1e300}), 5e-324);
  EXPECT_EQ(sum_of({1e300, -5e-324, -1e300}), -5e-324);
  EXPECT_EQ(sum_of({3.0, -1e17, 1e17, -3.0}), 0.0);
}

TEST(ExactSum, Denormals) {
  const double tiny = std::numeric_limits<double>::denorm_min();
  EXPECT_EQ(sum_of({tiny, tiny, tiny}), 3 * tiny);
  const double smallest_normal = std::numeric_limits<double>::min();
  EXPECT_EQ(sum_of({smallest_normal, -tiny}), smallest_normal - tiny);
  EXPECT_EQ(sum_of({smallest_normal, smallest_normal, -tiny}), 2 * smallest_normal - tiny);
}

TEST(ExactSum, RoundsToNearestTiesToEven) {
  const double one = 1.0, half_ulp = std::ldexp(1.0, -53), tiny = std::ldexp(1.0, -200);
  EXPECT_EQ(sum_of({one, half_ulp}), one);
  EXPECT_EQ(sum_of({one, half_ulp, tiny}), one + 2 * half_ulp);
  EXPECT_EQ(sum_of({one, half_ulp, -tiny}), one);
  const double odd = one + 2 * half_ulp;
  EXPECT_EQ(sum_of({odd, half_ulp}), one + 4 * half_ulp);
  EXPECT_EQ(sum_of({-odd, -half_ulp}), -(one + 4 * half_ulp));
  // Rounding that carries into a new power of two.
  EXPECT_EQ(sum_of({2.0 - 2 * half_ulp, half_ulp}), 2.0);
}

TEST(ExactSum, AgreesWithQuadPrecisionWhereThatIsExact) {
  std::mt19937_64 random(4);
  std::uniform_int_distribution<std::int64_t> mantissa(-(std::int64_t(1) << 52), std::int64_t(1)
                                                                                     << 52);
  std::uniform_int_distribution<int> exponent(-20, 20);  // 53 + 40 + 10 bits < 113
  for (int round = 0; round < 500; ++round) {
    std::vector<double> numbers(1 + round);
    __float128 reference = 0;
    for (double &x : numbers) {
      x = std::ldexp(static_cast<double>(mantissa(random)), exponent(random));
      reference += x;
    }
    ASSERT_TRUE(same_bits(sum_of(numbers), static_cast<double>(reference))) << round;
  }
}

TEST(ExactSum, ManyNumbersOfLargestLimb) {
  // 0xffffffff in every limb touched, so that carries matter; 2^26 additions of a number whose
  // total is exact in double, and the same through merging up to 2^60 terms.
  const double x = std::ldexp(static_cast<double>((std::uint64_t(1) << 53) - 1), -20);
  ExactSum s;
  const std::uint64_t count = std::uint64_t(1) << 26;
  for (std::uint64_t k = 0; k < count; ++k) s.add(x);
  EXPECT_EQ(s.value(), std::ldexp(x, 26));
  for (int doubling = 26; doubling < 60; ++doubling) {
    const ExactSum copy = s;
    s.add(copy);
  }
  EXPECT_EQ(s.value(), std::ldexp(x, 60));
}

TEST(ExactSum, CarriesAreMovedBeforeALimbOverflows) {
  // A number that is one full limb, 2^32 - 1 on a limb's boundary: after 2^31 additions a limb of
  // int64 would overflow if carries were never moved.
  const double x = std::ldexp(4294967295.0, 32 * 34 - 1074);
  ExactSum s;
  const std::uint64_t count = (std::uint64_t(1) << 31) + 5;
  for (std::uint64_t k = 0; k < count; ++k) s.add(x);
  EXPECT_EQ(s.value(), static_cast<double>(static_cast<__float128>(x) * count));
}

TEST(ExactSum, NotFiniteGivesNaN) {
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(std::isnan(sum_of({1.0, std::nan(""), 2.0})));
  EXPECT_TRUE(std::isnan(sum_of({inf})));
  EXPECT_TRUE(std::isnan(sum_of({inf, -inf})));
  ExactSum a, b;
  a.add(1.0);
  b.add(-inf);
  a.add(b);
  EXPECT_TRUE(std::isnan(a.value()));
  a.clear();
  a.add(2.0);
  EXPECT_EQ(a.value(), 2.0);
}

TEST(ExactSum, RangeIsThatOfDouble) {
  const double largest = std::numeric_limits<double>::max();
  EXPECT_EQ(sum_of({largest, largest, -largest}), largest);
  EXPECT_TRUE(std::isinf(sum_of({largest, largest})));
  EXPECT_EQ(sum_of({-largest, -largest, largest, largest, -7.0}), -7.0);
}

TEST(ExactSums, ComponentsAreIndependent) {
  ExactSums<3> s;
  s.add(0, 1.5);
  s.add(2, 1e300);
  s.add(2, -1e300);
  s.add(2, 0.25);
  EXPECT_EQ(s.value(0), 1.5);
  EXPECT_EQ(s.value(1), 0.0);
  EXPECT_EQ(s.value(2), 0.25);
}

}  // namespace
