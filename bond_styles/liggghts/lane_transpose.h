// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: turn eight rows of eight doubles into eight columns in registers.
//
// Reading particle by particle and transposing takes two loads a particle where gathering component
// by component takes nine; on processors whose gather is a loop inside (all so far) it is twice as
// fast. Written with the compiler's own vectors: one instruction each where the processor has
// 512-bit registers, several where it has not, the same bits everywhere.
// Units: none. Failure: none.
#ifndef BONDLAB_LANE_TRANSPOSE_H
#define BONDLAB_LANE_TRANSPOSE_H

#include <cstring>

namespace bondlab {

typedef double Lanes8 __attribute__((vector_size(64)));
typedef long long Picks8 __attribute__((vector_size(64)));

inline Lanes8 load8(const double *p) {
  Lanes8 v;
  std::memcpy(&v, p, sizeof v);
  return v;
}
inline Lanes8 load4_4(const double *p, const double *q) {
  Lanes8 v;
  std::memcpy(&v, p, sizeof v / 2);
  std::memcpy(reinterpret_cast<char *>(&v) + sizeof v / 2, q, sizeof v / 2);
  return v;
}
inline void store8(double *p, Lanes8 v) { std::memcpy(p, &v, sizeof v); }

// r[k][l] becomes r[l][k].
inline void transpose8(Lanes8 (&r)[8]) {
  const Picks8 low1 = {0, 8, 2, 10, 4, 12, 6, 14}, high1 = {1, 9, 3, 11, 5, 13, 7, 15};
  const Picks8 low2 = {0, 1, 8, 9, 4, 5, 12, 13}, high2 = {2, 3, 10, 11, 6, 7, 14, 15};
  const Picks8 low4 = {0, 1, 2, 3, 8, 9, 10, 11}, high4 = {4, 5, 6, 7, 12, 13, 14, 15};
  Lanes8 a[8], b[8];
  for (int k = 0; k < 8; k += 2) {
    a[k] = __builtin_shuffle(r[k], r[k + 1], low1);
    a[k + 1] = __builtin_shuffle(r[k], r[k + 1], high1);
  }
  for (int k = 0; k < 8; k += 4)
    for (int l = 0; l < 2; l++) {
      b[k + l] = __builtin_shuffle(a[k + l], a[k + l + 2], low2);
      b[k + l + 2] = __builtin_shuffle(a[k + l], a[k + l + 2], high2);
    }
  for (int k = 0; k < 4; k++) {
    r[k] = __builtin_shuffle(b[k], b[k + 4], low4);
    r[k + 4] = __builtin_shuffle(b[k], b[k + 4], high4);
  }
}

}  // namespace bondlab

#endif
