// SPDX-License-Identifier: GPL-2.0-or-later
#include "response/cantilever.h"

#include <gtest/gtest.h>

#include <cmath>

namespace bondlab {
namespace {

constexpr double e = 20e9, nu = 0.3, arm = 0.03, d = 0.01;
const double inertia = M_PI * d * d * d * d / 64, area = M_PI * d * d / 4;
const double kappa = 6 * (1 + nu) / (7 + 6 * nu);
const double timoshenko =
    arm * arm * arm / (3 * e * inertia) + arm / (kappa * e / (2 * (1 + nu)) * area);

Curve cantilever_curve() {
  Curve curve;
  curve.names = {"time", "force_top", "force_bottom", "deflection"};
  curve.columns.resize(4);
  for (int i = 0; i < 300; ++i) {
    const double s = i / 200.0, load = 50 * (s <= 1 ? s : std::fmax(0.2, 1 - 4 * (s - 1)));
    const double row[] = {1e-5 * i, load, load, s * 50 * timoshenko};
    for (std::size_t c = 0; c < 4; ++c) curve.columns[c].push_back(row[c]);
  }
  curve.complete = true;
  return curve;
}

TEST(Cantilever, TakesItsTimoshenkoDeflectionBack) {
  const ResponseContext bar{{{"dim", 3}, {"diameter", d}, {"arm", arm}, {"poisson", nu}}};
  EXPECT_NEAR(evaluate("cantilever.compliance", cantilever_curve(), bar), timoshenko,
              1e-9 * timoshenko);
  EXPECT_NEAR(evaluate("cantilever.modulus", cantilever_curve(), bar), e, 1e-6 * e);
  EXPECT_LT(evaluate("cantilever.modulus_slender", cantilever_curve(), bar), 0.95 * e);
  EXPECT_NEAR(evaluate("cantilever.strength", cantilever_curve(), bar),
              50 * arm * (d / 2) / inertia, 1.0);
}

TEST(Cantilever, APrismIsARectangleOfItsWidthAndHeight) {
  ResponseContext prism{{{"dim", 3}, {"diameter", d}, {"arm", arm}, {"poisson", nu},
                         {"length", 0.05}, {"width", 0.004}, {"height", 0.006}}};
  EXPECT_NEAR(evaluate("cantilever.strength", cantilever_curve(), prism),
              6 * 50 * arm / (0.004 * 0.006 * 0.006), 1.0);
}

}  // namespace
}  // namespace bondlab
