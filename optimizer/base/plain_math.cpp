// SPDX-License-Identifier: GPL-2.0-or-later
#include "base/plain_math.h"

#include <cmath>

namespace bondlab {

double plain_exp(double x) {
  int halvings = 0;
  for (; std::fabs(x) > 0.1; ++halvings) x *= 0.5;
  double sum = 1, term = 1;
  for (int k = 1; k <= 12; ++k) sum += term *= x / k;
  for (; halvings > 0; --halvings) sum *= sum;
  return sum;
}

// 2 artanh((x - 1) / (x + 1)) after square roots have brought x near 1.
double plain_log(double x) {
  double factor = 2;
  for (; std::fabs(x - 1) > 0.2; factor *= 2) x = std::sqrt(x);
  const double t = (x - 1) / (x + 1), t2 = t * t;
  double sum = 0, power = t;
  for (int k = 1; k <= 25; k += 2, power *= t2) sum += power / k;
  return factor * sum;
}

double plain_cube_root(double x) {
  double root = x > 1 ? x : 1;  // from above Newton's rule only falls
  for (int k = 0; k < 300; ++k) {
    const double next = (2 * root + x / (root * root)) / 3;
    if (next >= root) break;
    root = next;
  }
  return root;
}

double plain_normal_quantile(double p) {
  constexpr double root_two_pi = 2.50662827463100050242;
  double x = 0;
  for (int k = 0; k < 60; ++k) {
    // Phi(x) = 1/2 + phi(x) (x + x^3/3 + x^5/(3 5) + ...)
    double sum = x, term = x;
    for (int n = 3; n < 120; n += 2) sum += term *= x * x / n;
    const double density = plain_exp(-0.5 * x * x) / root_two_pi;
    const double step = (p - 0.5 - density * sum) / density;
    // Newton's rule overshoots in the tails.
    x += step > 1 ? 1 : step < -1 ? -1 : step;
    if (std::fabs(step) < 1e-15) break;
  }
  return x;
}

}  // namespace bondlab
