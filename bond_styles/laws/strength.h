// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: the strength of a bond, scattered from bond to bond, the same on any number of ranks.
//
// Method: a strength is a pure function of (smaller tag, larger tag, seed, stream): a hash of the
// four gives a uniform number in (0,1), the inverse of the distribution turns it into a strength.
// Nothing is drawn in sequence, so neither ranks nor the order of bonds can change it, and nothing
// needs storing or migrating. Streams keep tensile and shear strength independent.
//
// Distributions: `none` (the mean), `normal` (mean, standard deviation; cut off below at 1 % of the
// mean, since a bond of negative strength has no meaning), `weibull` (mean, modulus m; the scale is
// mean / Gamma(1 + 1/m)).
//
// Sources: mixing of the hash: the finaliser constants of SplitMix64 (Steele, Lea & Flood 2014);
// inverse normal: bisection-free Halley refinement of a logistic start on erfc, good to rounding.
// Units: those of the mean. Failure: parameters are checked by the caller.
#ifndef BONDLAB_LAWS_STRENGTH_H
#define BONDLAB_LAWS_STRENGTH_H

#include <cmath>
#include <cstdint>

namespace bondlab::laws {

enum class Scatter { none, normal, weibull };

struct StrengthDistribution {
  double mean = 0.0;
  Scatter scatter = Scatter::none;
  double spread = 0.0;  // normal: standard deviation; weibull: modulus m
  std::uint64_t seed = 1;
  std::uint64_t stream = 0;
};

inline std::uint64_t mix_bits(std::uint64_t z) {
  z += 0x9e3779b97f4a7c15ULL;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

// Uniform in the open interval (0,1); symmetric in the two tags.
inline double uniform_of_pair(std::int64_t tag_a, std::int64_t tag_b, std::uint64_t seed,
                              std::uint64_t stream) {
  const std::uint64_t lo = static_cast<std::uint64_t>(tag_a < tag_b ? tag_a : tag_b);
  const std::uint64_t hi = static_cast<std::uint64_t>(tag_a < tag_b ? tag_b : tag_a);
  std::uint64_t h = mix_bits(seed);
  h = mix_bits(h ^ stream);
  h = mix_bits(h ^ lo);
  h = mix_bits(h ^ hi);
  return (static_cast<double>(h >> 11) + 0.5) * 0x1.0p-53;
}

// x with P(X <= x) = p for a standard normal X, p in (0,1). Computed in the nearer tail, where erfc
// keeps its relative accuracy.
inline double inverse_normal(double p) {
  const bool upper = p > 0.5;
  const double tail = upper ? 1.0 - p : p;
  // logistic start: within 0.3 of the answer for tail > 1e-17
  double x = tail < 0.5 ? -std::sqrt(std::fmax(0.0, -2.0 * std::log(tail) - std::log(1.0 - 2.0 * std::log(tail)))) : 0.0;
  for (int i = 0; i < 8; ++i) {
    const double cdf = 0.5 * std::erfc(-x * 0.70710678118654752440);
    const double density = 0.39894228040143267794 * std::exp(-0.5 * x * x);
    const double newton = (cdf - tail) / density;
    const double step = newton / (1.0 + 0.5 * x * newton);
    x -= step;
    if (std::fabs(step) < 1e-15 * (1.0 + std::fabs(x))) break;
  }
  return upper ? -x : x;
}

inline double bond_strength(const StrengthDistribution& d, std::int64_t tag_a,
                            std::int64_t tag_b) {
  switch (d.scatter) {
    case Scatter::none: return d.mean;
    case Scatter::normal: {
      const double u = uniform_of_pair(tag_a, tag_b, d.seed, d.stream);
      const double value = d.mean + d.spread * inverse_normal(u);
      return value < 0.01 * d.mean ? 0.01 * d.mean : value;
    }
    case Scatter::weibull: {
      const double u = uniform_of_pair(tag_a, tag_b, d.seed, d.stream);
      const double scale = d.mean / std::tgamma(1.0 + 1.0 / d.spread);
      return scale * std::pow(-std::log(u), 1.0 / d.spread);
    }
  }
  return d.mean;
}

}  // namespace bondlab::laws

#endif
