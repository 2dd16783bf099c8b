// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: random numbers that depend on a seed and nothing else, the same with every compiler and
// library. Method: xoshiro256++ (Blackman & Vigna, ACM Trans. Math. Softw. 47(4), 2021) seeded by
// splitmix64 (Steele, Lea & Flood,
//   OOPSLA 2014); distributions of our own, because those of <random> differ between libraries. A
//   stream number separates uses of the same seed (design, packing, strengths) so that adding a
//   draw to one doesn't shift another.
// Units: none. Failure: none; index(0) is our own mistake (assertion).
// Limits: normal() goes through log and sqrt of libm, so its last bit may differ between libm
// versions; not for secrets.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <vector>

namespace bondlab {

// One step of splitmix64: a bijective mix of 64 bits.
std::uint64_t mix64(std::uint64_t value);

// Hash of integers that depends on their order and number: hash_ints({seed, smaller_tag,
// larger_tag}).
std::uint64_t hash_ints(std::initializer_list<std::uint64_t> values);

// The top 53 bits as a number in (0, 1), never 0 or 1, so that inverse distribution functions stay
// finite.
double to_unit_interval(std::uint64_t bits);

class RandomStream {
 public:
  explicit RandomStream(std::uint64_t seed, std::uint64_t stream = 0);

  std::uint64_t bits();
  double uniform();                            // (0, 1)
  double uniform(double lower, double upper);  // (lower, upper)
  double normal();                             // mean 0, sd 1; inverse-free polar method
  std::size_t index(std::size_t count);        // 0 .. count-1, unbiased

  template <class T>
  void shuffle(std::vector<T> &items) {  // Fisher-Yates
    for (std::size_t i = items.size(); i > 1; --i) {
      const std::size_t j = index(i);
      if (j != i - 1) std::swap(items[i - 1], items[j]);
    }
  }

 private:
  std::uint64_t state_[4];
  double spare_ = 0;
  bool has_spare_ = false;
};

}  // namespace bondlab
