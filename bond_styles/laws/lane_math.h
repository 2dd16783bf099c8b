// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: exponential and logarithm that the compiler can run on all lanes of a vector at once.
//
// Method. The library's functions are calls and keep a loop scalar (their vector versions need
// -ffast-math, which we refuse: it removes the checks for not-a-number). These here are straight
// arithmetic without branches or tables, so any loop over lanes around them vectorises, with the same
// bits on every vector width:
//   exp:  x = k ln 2 + r, |r| <= ln2/2, Taylor series of e^r to r^13 (remainder below 5e-18), times 2^k
//   log:  x = 2^e m, m in [sqrt(1/2), sqrt 2), log m = 2 atanh f, f = (m-1)/(m+1), |f| <= 0.172,
//         series to f^19 (remainder below 3e-17)
// Both are good to about 2 units in the last place; lane_math_test.cpp bounds it by 1e-15.
//
// Source: standard argument reduction (e.g. Muller, Elementary Functions, 3rd ed. 2016, ch. 11).
// Units: none. Failure: NaN in, NaN out. Limits: log_lane wants positive normal numbers; exp_lane cuts
// its argument to +-kExpMost, so it neither overflows nor gets to 0.
#ifndef BONDLAB_LAWS_LANE_MATH_H
#define BONDLAB_LAWS_LANE_MATH_H

#include <cstdint>
#include <cstring>

namespace bondlab::laws {

inline constexpr double kExpMost = 700.0;

inline std::uint64_t bits_of(double x) {
  std::uint64_t u;
  std::memcpy(&u, &x, sizeof u);
  return u;
}
inline double from_bits(std::uint64_t u) {
  double x;
  std::memcpy(&x, &u, sizeof x);
  return x;
}

// x = k ln2 + r: e^r - 1 and 2^k. |x| <= kExpMost.
struct ExpParts {
  double rest, scale;
};
inline ExpParts exp_parts(double x) {
  // Adding 1.5 2^52 leaves the rounded quotient in the low bits of the sum.
  constexpr double magic = 6755399441055744.0, per_ln2 = 1.4426950408889634074;
  constexpr double ln2_hi = 6.93147180369123816490e-01, ln2_lo = 1.90821492927058770002e-10;
  const double shifted = x * per_ln2 + magic;
  const double k = shifted - magic;
  const double r = (x - k * ln2_hi) - k * ln2_lo;
  double s = 1.0 / 6227020800.0;
  s = s * r + 1.0 / 479001600.0;
  s = s * r + 1.0 / 39916800.0;
  s = s * r + 1.0 / 3628800.0;
  s = s * r + 1.0 / 362880.0;
  s = s * r + 1.0 / 40320.0;
  s = s * r + 1.0 / 5040.0;
  s = s * r + 1.0 / 720.0;
  s = s * r + 1.0 / 120.0;
  s = s * r + 1.0 / 24.0;
  s = s * r + 1.0 / 6.0;
  s = s * r + 0.5;
  return {r + r * r * s, from_bits((bits_of(shifted) << 52) + 0x3ff0000000000000ULL)};
}

inline double exp_lane(double x) {
  x = x < -kExpMost ? -kExpMost : x;
  x = x > kExpMost ? kExpMost : x;
  const ExpParts p = exp_parts(x);
  return p.scale + p.scale * p.rest;
}

// 1 - e^-x, x >= 0, also exact to rounding where x is tiny.
inline double decay_lane(double x) {
  x = x > kExpMost ? kExpMost : x;
  const ExpParts p = exp_parts(-x);
  return (1.0 - p.scale) - p.scale * p.rest;
}

// x = 2^e m with m in [sqrt(1/2), sqrt 2).
struct LogParts {
  double exponent, mantissa;
};
inline LogParts log_parts(double x) {
  constexpr std::uint64_t shift = 0x3ff0000000000000ULL - 0x3fe6a09e667f3bcdULL;
  const std::uint64_t u = bits_of(x);
  const std::uint64_t biased = (u + shift) >> 52;
  // 2^52 + biased, written by its bits
  const double exponent = from_bits(biased | 0x4330000000000000ULL) - (4503599627370496.0 + 1023.0);
  return {exponent, from_bits(u - (biased << 52) + 0x3ff0000000000000ULL)};
}

// atanh(f)/f for |f| <= 0.172, from f^2.
inline double atanh_ratio(double z) {
  double s = 1.0 / 19.0;
  s = s * z + 1.0 / 17.0;
  s = s * z + 1.0 / 15.0;
  s = s * z + 1.0 / 13.0;
  s = s * z + 1.0 / 11.0;
  s = s * z + 1.0 / 9.0;
  s = s * z + 1.0 / 7.0;
  s = s * z + 1.0 / 5.0;
  s = s * z + 1.0 / 3.0;
  return s * z + 1.0;
}

inline constexpr double kLn2 = 0.69314718055994530942;

inline double log_lane(double x) {
  const LogParts p = log_parts(x);
  const double f = (p.mantissa - 1.0) / (p.mantissa + 1.0);
  const double value = p.exponent * kLn2 + 2.0 * f * atanh_ratio(f * f);
  return x == x ? value : x;
}

// log(1 + y)/y, y > -1, 1 at y = 0.
inline double log1p_ratio(double y) {
  const LogParts p = log_parts(1.0 + y);
  const bool near = p.exponent == 0.0;  // log(1 + y) = 2 atanh(f), f = y/(2 + y): no digits of y lost
  const double f = (p.mantissa - 1.0) / (p.mantissa + 1.0);
  const double series = atanh_ratio(f * f);
  const double far = (p.exponent * kLn2 + 2.0 * f * series) / (near ? 1.0 : y);
  const double value = near ? 2.0 * series / (2.0 + y) : far;
  return y == y ? value : y;
}

}  // namespace bondlab::laws

#endif
