// SPDX-License-Identifier: GPL-2.0-or-later
//
// Frequencies, waves and the limit of the time step of bonded chains against eigenvalues and closed
// forms (PHYSICS.md 2.5, items 2, 3, 7 and 8), 3D and 2D.
//
// In velocity Verlet a mode of frequency w appears at (2/dt) asin(w dt/2): 2nd order in dt, and no
// solution beyond dt = 2/w.
#include <gtest/gtest.h>

#include "chain_runs.h"
#include "reference_table.h"

using namespace bondlab::laws;
using namespace bondlab::laws::testbench;

namespace {

const ReferenceTable &reference() {
  static const ReferenceTable table;
  return table;
}

Bench chain(const Rod &rod, int bonds, double ratio, bool clamped, bool flat = false,
            double thickness = 1.0) {
  Bench b(flat, thickness);
  for (int k = 0; k <= bonds; ++k)
    b.add({k * rod.spacing(), 0, 0}, rod.radius, rod.density, clamped && k == 0);
  ParallelParameters p;
  p.modulus = rod.E;
  p.ratio = ratio;
  for (int k = 0; k < bonds; ++k) b.bond(k, k + 1, p);
  b.transverse_only = true;
  return b;
}

DispersionPoint wave(const Rod &rod, double ratio, double kl, int axis_a, int axis_b) {
  return wave(chain(rod, 2, ratio, false), kl, axis_a, axis_b);
}

const char *kWaveNumbers[] = {"0.10", "0.25", "0.50", "1.00"};

}  // namespace

class Chain : public testing::TestWithParam<std::tuple<const char *, int>> {};
class ChainLimit : public Chain {};
class ChainFrequency : public Chain {};

// Eigenvalues of the stiffness that the kernels show, for all rows of the table. The lowest of long
// chains are small differences of stiff springs: (omega_max/omega_1)^2 = 1e8 of rounding at n = 40.
TEST_P(Chain, eigenvalues) {
  const auto [convention, n] = GetParam();
  const Rod rod;
  const double f1 = reference()("cantilever_vibration", rod.name(convention, n), "f1");
  const double limit = reference()("time_step", rod.name(convention, n), "2/omega_max (transverse+rotation)");
  const Bench b = chain(rod, n, rod.ratio(convention), true);
  double asymmetry = 1.0;
  const Modes m = bending_modes(b, &asymmetry);
  EXPECT_LT(asymmetry, 1e-10);  // forces and torques belong to one energy
  EXPECT_NEAR(2.0 / m.omega.back() / limit, 1.0, 1e-8);
  const double spread = std::pow(m.omega.back() / (2.0 * kPi * f1), 2);
  EXPECT_NEAR(m.omega.front() / (2.0 * kPi) / f1, 1.0, 1e-8 + 1e-12 * spread);
}

// The limit of the step, found by trying.
TEST_P(ChainLimit, time_step_by_bisection) {
  const auto [convention, n] = GetParam();
  const Rod rod;
  const double limit = reference()("time_step", rod.name(convention, n), "2/omega_max (transverse+rotation)");
  const Bench b = chain(rod, n, rod.ratio(convention), true);
  // 6000 steps tell a step 1e-5 beyond the limit: growth exp(6000 sqrt(8e-5)) in amplitude
  EXPECT_NEAR(stability_limit(b, limit) / limit, 1.0, 1e-5);
}

// The simulated frequency: right to 1e-3 at 0.4 of the limit and below, and second order in dt.
TEST_P(ChainFrequency, simulated) {
  const auto [convention, n] = GetParam();
  const Rod rod;
  const double exact = 2.0 * kPi * reference()("cantilever_vibration", rod.name(convention, n), "f1");
  const double limit = reference()("time_step", rod.name(convention, n), "2/omega_max (transverse+rotation)");
  const Bench b = chain(rod, n, rod.ratio(convention), true);
  const Modes m = bending_modes(b);
  double error[3];
  for (int k = 0; k < 3; ++k) {
    const double dt = 0.4 * limit / (1 << k);
    const double found = simulated_frequency(b, m.shape[0], exact, dt);
    error[k] = found / exact - 1.0;
    EXPECT_NEAR(found / (2.0 / dt * std::asin(0.5 * exact * dt)), 1.0, 1e-7);
  }
  EXPECT_LT(error[1], n == 1 ? 2e-3 : 1e-3);
  EXPECT_LT(error[2], 1e-3);
  if (n <= 2) {  // beyond, the error drowns in the digits of the reference
    EXPECT_NEAR(std::log2(error[0] / error[1]), 2.0, 0.03);
    EXPECT_NEAR(std::log2(error[1] / error[2]), 2.0, 0.03);
    EXPECT_NEAR((4.0 * error[2] - error[1]) / 3.0, 0.0, 3e-7);  // extrapolated to dt = 0
  }
}

const auto kConventions = testing::Values("GA/l", "12EI/l3", "Timoshenko");
INSTANTIATE_TEST_SUITE_P(AllRows, Chain, testing::Combine(kConventions, testing::Values(1, 2, 5, 10, 20, 40)));
INSTANTIATE_TEST_SUITE_P(Rows, ChainLimit, testing::Combine(kConventions, testing::Values(1, 2, 5, 40)));
INSTANTIATE_TEST_SUITE_P(Rows, ChainFrequency, testing::Combine(kConventions, testing::Values(1, 2, 5, 10)));

TEST(Waves, axial) {
  const Rod rod;
  for (const char *k : kWaveNumbers)
    EXPECT_NEAR(wave(rod, 2.6, std::atof(k) * kPi, 0, -1).lower /
                    reference()("dispersion_axial", rod.name() + "; k=" + k + " pi/l", "omega"),
                1.0, 1e-8);
}

TEST(Waves, flexural_both_branches) {
  const Rod rod;
  for (const char *convention : {"GA/l", "12EI/l3", "Timoshenko"})
    for (const char *k : kWaveNumbers) {
      const DispersionPoint w = wave(rod, rod.ratio(convention), std::atof(k) * kPi, 1, 5);
      const std::string name = rod.name(convention) + "; k=" + k + " pi/l";
      EXPECT_NEAR(w.lower / reference()("dispersion_flexural", name, "omega lower branch"), 1.0, 3e-8) << name;
      EXPECT_NEAR(w.upper / reference()("dispersion_flexural", name, "omega upper branch"), 1.0, 1e-8) << name;
      // the other plane of bending is the same
      const DispersionPoint z = wave(rod, rod.ratio(convention), std::atof(k) * kPi, 2, 4);
      EXPECT_NEAR(z.lower / w.lower, 1.0, 1e-8);
      EXPECT_NEAR(z.upper / w.upper, 1.0, 1e-8);
    }
}

TEST(Waves, torsional) {
  const Rod rod;
  EXPECT_NEAR(wave(rod, 2.6, kPi, 3, -1).lower /
                  reference()("dispersion_torsion", rod.name(), "omega at k=pi/l"),
              1.0, 1e-8);
}

TEST(Waves, speed_of_a_long_wave) {
  const Rod rod;
  const double kl = 0.01, shortening = std::sin(0.5 * kl) / (0.5 * kl);  // 1 - (kl)^2/24
  const double speed = wave(rod, 2.6, kl, 0, -1).lower * rod.spacing() / kl / shortening;
  EXPECT_NEAR(speed / reference()("wave_speed", rod.name(), "axial c0"), 1.0, 1e-7);
  EXPECT_NEAR(speed / std::sqrt(1.5 * rod.E / rod.density), 1.0, 1e-7);
}

// Rotation governs the step when k_s/k_n > 0.4: sqrt(10 k_s/m) beyond sqrt(4 k_n/m).
TEST(Waves, rotation_branch_governs_above_stiffness_ratio_of_0_4) {
  const Rod rod;
  for (const double ks_kn : {0.3, 0.39, 0.41, 0.5}) {
    const double top = wave(rod, 1.0 / ks_kn, 0.0, 1, 5).upper;
    const double axial = wave(rod, 1.0 / ks_kn, kPi, 0, -1).lower;
    const double mass = 4.0 / 3.0 * kPi * std::pow(rod.radius, 3) * rod.density;
    const double kn = rod.E * rod.area() / rod.spacing();
    EXPECT_NEAR(top / std::sqrt(10.0 * ks_kn * kn / mass), 1.0, 1e-8);
    EXPECT_EQ(top > axial, ks_kn > 0.4);
  }
}

// The step of a long free chain in tension: sqrt(m/k_n) = sqrt(2/3) l sqrt(rho/E).
TEST(TimeStep, axial_limit_of_a_long_chain) {
  const Rod rod;
  const double limit = reference()("time_step", rod.name() + "; free chain", "axial 2/omega_max");
  const int n = 60;
  Bench b = chain(rod, n, 1e6, false);  // shear and rotation soft
  b.transverse_only = false;
  // the highest mode of n + 1 free grains: sin(pi n/(2 (n+1))) of the infinite chain's
  const double expected = limit / std::sin(0.5 * kPi * n / (n + 1));
  EXPECT_NEAR(stability_limit(b, expected) / expected, 1.0, 1e-5);
  EXPECT_NEAR(expected / limit, 1.0, 4e-4);
}

// In the plane: disc m = pi R^2 t rho, I = m R^2/2, A = 2 R t, I_b = 2 R^3 t/3, in the general form
// (4ks S^2 - m w^2)(ks l^2 C^2 + 4kb S^2 - I w^2) = 4 ks^2 l^2 S^2 C^2.
TEST(TimeStep, plane_chain_frequencies_and_limit) {
  const Rod rod;
  const double t = 5e-3, l = rod.spacing(), mass = kPi * rod.radius * rod.radius * t * rod.density;
  const double inertia = 0.5 * mass * rod.radius * rod.radius;
  const double kn = rod.E * 2.0 * rod.radius * t / l, ks = kn / 2.6;
  const double kb = rod.E * 2.0 / 3.0 * std::pow(rod.radius, 3) * t / l;
  const int n = 8;
  const Bench b = chain(rod, n, 2.6, true, true, t);
  const Modes m = bending_modes(b);
  // the matrix written down from the law's stiffnesses
  const std::vector<Freedom> freedoms = freedoms_of(b, {1, 5});
  Matrix K(2 * n, std::vector<double>(2 * n, 0.0));
  for (int bond = 0; bond < n; ++bond) {
    // shear: u_j - u_i - l/2 (w_i + w_j);  bend: w_j - w_i
    const int i = 2 * (bond - 1), j = 2 * bond;
    const double shear[4] = {-1, -0.5 * l, 1, -0.5 * l}, bend[4] = {0, -1, 0, 1};
    const int place[4] = {i, i + 1, j, j + 1};
    for (int r = 0; r < 4; ++r)
      for (int c = 0; c < 4; ++c)
        if (place[r] >= 0 && place[c] >= 0)
          K[place[r]][place[c]] += ks * shear[r] * shear[c] + kb * bend[r] * bend[c];
  }
  for (int r = 0; r < 2 * n; ++r)
    for (int c = 0; c < 2 * n; ++c)
      K[r][c] /= std::sqrt((r % 2 ? inertia : mass) * (c % 2 ? inertia : mass));
  const Modes written = modes(K);
  for (int k = 0; k < 2 * n; ++k) EXPECT_NEAR(m.omega[k] / written.omega[k], 1.0, 2e-7) << k;
  const double limit = 2.0 / written.omega.back();
  EXPECT_NEAR(stability_limit(b, limit) / limit, 1.0, 1e-5);
}
