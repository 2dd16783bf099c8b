// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: up to four linear equations, solved in place, for the generators' inner loops.
// Method: Gauss-Jordan elimination with row exchange; no allocation, and one order of sums, so that
//   a packing is the same on every machine.
// Units: any; rows should be of about unit length, as `singular` is a pivot. Failure: false.
#pragma once

#include <cmath>
#include <utility>

namespace bondlab {

// a x = b, with b in column n, which holds x then; false when a pivot is below `singular`.
inline bool solve_small(double a[4][5], int n, double singular) {
  for (int k = 0; k < n; ++k) {
    int best = k;
    for (int i = k + 1; i < n; ++i)
      if (std::fabs(a[i][k]) > std::fabs(a[best][k])) best = i;
    if (std::fabs(a[best][k]) < singular) return false;
    for (int j = 0; j <= n; ++j) std::swap(a[k][j], a[best][j]);
    for (int i = 0; i < n; ++i) {
      if (i == k) continue;
      const double factor = a[i][k] / a[k][k];
      for (int j = k; j <= n; ++j) a[i][j] -= factor * a[k][j];
    }
  }
  for (int k = 0; k < n; ++k) a[k][n] /= a[k][k];
  return true;
}

}  // namespace bondlab
