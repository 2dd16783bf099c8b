// SPDX-License-Identifier: GPL-2.0-or-later
#include "base/random.h"

#include <cassert>
#include <cmath>

namespace bondlab {

std::uint64_t mix64(std::uint64_t value) {
  value += 0x9e3779b97f4a7c15ULL;
  value = (value ^ (value >> 30)) * 0xbf58476d1ce4e5b9ULL;
  value = (value ^ (value >> 27)) * 0x94d049bb133111ebULL;
  return value ^ (value >> 31);
}

std::uint64_t hash_ints(std::initializer_list<std::uint64_t> values) {
  std::uint64_t hash = mix64(values.size());
  for (const std::uint64_t value : values) hash = mix64(hash ^ mix64(value));
  return hash;
}

double to_unit_interval(std::uint64_t bits) {
  return (static_cast<double>(bits >> 12) + 0.5) * 0x1.0p-52;
}

RandomStream::RandomStream(std::uint64_t seed, std::uint64_t stream) {
  std::uint64_t x = hash_ints({seed, stream});
  for (std::uint64_t &word : state_) {
    word = mix64(x);
    x += 0x9e3779b97f4a7c15ULL;
  }
}

static std::uint64_t rotate_left(std::uint64_t x, int k) { return (x << k) | (x >> (64 - k)); }

std::uint64_t RandomStream::bits() {
  std::uint64_t *s = state_;
  const std::uint64_t result = rotate_left(s[0] + s[3], 23) + s[0];
  const std::uint64_t shifted = s[1] << 17;
  s[2] ^= s[0];
  s[3] ^= s[1];
  s[1] ^= s[2];
  s[0] ^= s[3];
  s[2] ^= shifted;
  s[3] = rotate_left(s[3], 45);
  return result;
}

double RandomStream::uniform() { return to_unit_interval(bits()); }

double RandomStream::uniform(double lower, double upper) {
  return lower + (upper - lower) * uniform();
}

double RandomStream::normal() {
  if (has_spare_) {
    has_spare_ = false;
    return spare_;
  }
  for (;;) {  // Marsaglia's polar method: two independent normals from a point in the unit disc
    const double u = 2 * uniform() - 1, v = 2 * uniform() - 1, r2 = u * u + v * v;
    if (r2 >= 1 || r2 == 0) continue;
    const double scale = std::sqrt(-2 * std::log(r2) / r2);
    spare_ = v * scale;
    has_spare_ = true;
    return u * scale;
  }
}

std::size_t RandomStream::index(std::size_t count) {
  assert(count > 0);
  const std::uint64_t n = count;
  const std::uint64_t reject_below =
      (0 - n) % n;  // 2^64 mod n: draws below it would favour the small indices
  for (;;) {
    const std::uint64_t draw = bits();
    if (draw >= reject_below) return static_cast<std::size_t>(draw % n);
  }
}

}  // namespace bondlab
