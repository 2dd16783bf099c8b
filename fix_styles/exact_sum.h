// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: add doubles so that the result doesn't depend on their order, nor on how they are dealt out
// to ranks.
//
// Method: a superaccumulator. A double is an integer of 53 bits times a power of two, so a sum of
// doubles is an integer on a fixed grid of 2^-1074. That integer is kept in 68 limbs of int64, 32
// bits apart; adding a number touches three limbs and never rounds, and the spare 32 bits of a limb
// take 2^30 additions before carries must be moved on. Limbs are plain int64, so MPI_SUM over ranks
// is exact as well (exact_sum_mpi.h). The one rounding (to nearest, ties to even) is in value().
// Why: forces on a platen and mean displacements are sums over ranks; a sum in floating point would
// depend on the number of ranks, and local damping amplifies such a last bit (sign of a velocity).
//
// Source: R. M. Neal, "Fast exact summation using small and large superaccumulators", 2015
// (arXiv:1505.05571), the small accumulator; limb layout our own.
//
// Units: those of the numbers added. Failure: a NaN or infinity added makes value() NaN, whatever
// else is added; a finite sum beyond the range of double gives infinity. Limits: 2^60 additions.
#ifndef BONDLAB_EXACT_SUM_H
#define BONDLAB_EXACT_SUM_H

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

namespace bondlab {

class ExactSum {
 public:
  static constexpr int limbs = 68;         // 32 bits each: 2098 bits of double and 63 of headroom
  static constexpr int words = limbs + 2;  // what is sent between ranks

  void clear() { word_.fill(0); }

  void add(double x) {
    std::uint64_t bits;
    std::memcpy(&bits, &x, sizeof bits);
    const int exponent = static_cast<int>(bits >> 52) & 0x7ff;
    std::uint64_t mantissa = bits & ((std::uint64_t(1) << 52) - 1);
    if (exponent == 0x7ff) {
      ++word_[invalid];
      return;
    }
    int shift = 0;  // in units of the grid, 2^-1074
    if (exponent) {
      mantissa |= std::uint64_t(1) << 52;
      shift = exponent - 1;
    }
    const int first = shift >> 5, offset = shift & 31;
    const std::uint64_t low = mantissa << offset;
    const std::uint64_t high = offset ? mantissa >> (64 - offset) : 0;
    const std::int64_t sign = -static_cast<std::int64_t>(bits >> 63);  // 0 or -1
    word_[first] += (static_cast<std::int64_t>(low & 0xffffffffu) ^ sign) - sign;
    word_[first + 1] += (static_cast<std::int64_t>(low >> 32) ^ sign) - sign;
    word_[first + 2] += (static_cast<std::int64_t>(high) ^ sign) - sign;
    if (++word_[pending] == max_pending) carry();
  }

  void add(const ExactSum &other) {
    ExactSum o = other;
    o.carry();
    carry();
    for (int i = 0; i < words; ++i) word_[i] += o.word_[i];
  }

  // Before the words of several sums are added up (2^29 of them at most), carries must be moved on.
  void prepare_to_send() { carry(); }
  std::int64_t *data() { return word_.data(); }

  double value() const {
    if (word_[invalid]) return std::numeric_limits<double>::quiet_NaN();
    ExactSum s = *this;
    s.carry();
    const bool negative = s.word_[limbs - 1] < 0;
    if (negative) {
      for (int i = 0; i < limbs; ++i) s.word_[i] = -s.word_[i];
      s.carry();
    }
    int top = limbs - 1;
    while (top >= 0 && s.word_[top] == 0) --top;
    if (top < 0) return 0.0;
    int msb = 31;  // limbs are below 2^32 here but for the last, which a sum in range leaves small
    while (!(s.word_[top] >> msb)) --msb;
    const int high_bit = 32 * top + msb;
    if (high_bit <= 52) {  // fits: the grid is that of the denormals
      const std::uint64_t whole = s.bits(0, 53);
      return signed_value(negative, std::ldexp(static_cast<double>(whole), -1074));
    }
    const int low_bit = high_bit - 52;
    std::uint64_t mantissa = s.bits(low_bit, 53);
    if (s.bit(low_bit - 1) && ((mantissa & 1) || s.any_below(low_bit - 1))) ++mantissa;
    return signed_value(negative, std::ldexp(static_cast<double>(mantissa), low_bit - 1074));
  }

 private:
  static constexpr int invalid = limbs;      // how many NaN or infinite numbers were added
  static constexpr int pending = limbs + 1;  // bound on additions since carries were moved
  static constexpr std::int64_t max_pending = std::int64_t(1) << 30;

  // Afterwards all limbs but the last are in [0, 2^32); the last carries the sign.
  void carry() {
    std::int64_t moved = 0;
    for (int i = 0; i + 1 < limbs; ++i) {
      const std::int64_t t = word_[i] + moved;
      word_[i] = t & 0xffffffff;
      moved = t >> 32;
    }
    word_[limbs - 1] += moved;
    word_[pending] = 1;
  }

  static double signed_value(bool negative, double x) { return negative ? -x : x; }
  bool bit(int position) const { return (word_[position >> 5] >> (position & 31)) & 1; }
  bool any_below(int position) const {
    for (int i = 0; i < position >> 5; ++i)
      if (word_[i]) return true;
    return word_[position >> 5] & ((std::int64_t(1) << (position & 31)) - 1);
  }
  std::uint64_t bits(int from, int count) const {
    std::uint64_t result = 0;
    for (int k = count - 1; k >= 0; --k) result = result << 1 | std::uint64_t(bit(from + k));
    return result;
  }

  std::array<std::int64_t, words> word_{};
};

// Several sums kept side by side, so that one message carries them all.
template <std::size_t N>
class ExactSums {
 public:
  static constexpr std::size_t size = N;
  void clear() {
    for (ExactSum &s : sum_) s.clear();
  }
  void add(std::size_t i, double x) { sum_[i].add(x); }
  double value(std::size_t i) const { return sum_[i].value(); }
  ExactSum *data() { return sum_.data(); }

 private:
  std::array<ExactSum, N> sum_{};
};

}  // namespace bondlab

#endif
