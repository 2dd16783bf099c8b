// SPDX-License-Identifier: GPL-2.0-or-later
//
// Chains of beams against beam theory: static deflection, elastica, frequencies, waves, the limit
// of the time step (PHYSICS.md 2.5, items 1-3, 7, 8), 3D and 2D.
#include <gtest/gtest.h>

#include "beam_testbench.h"
#include "chain_runs.h"
#include "reference_table.h"

using namespace bondlab::laws;
using namespace bondlab::laws::testbench;

namespace {

const ReferenceTable &reference() {
  static const ReferenceTable table;
  return table;
}

BeamShear kind(const std::string &convention) {
  return convention == "GA/l"      ? BeamShear::GA
         : convention == "12EI/l3" ? BeamShear::euler
                                   : BeamShear::timoshenko;
}

// Grain 0 clamped, unless free; grains carry orientations that differ, as after a past.
Bench chain(const Rod &rod, int bonds, const char *convention, bool clamped = true,
            bool flat = false, double thickness = 1.0, Vec3 along = {1, 0, 0}) {
  Bench b = beam_bench(flat, thickness);
  for (int k = 0; k <= bonds; ++k) {
    b.add((k * rod.spacing()) * along, rod.radius, rod.density, clamped && k == 0);
    b.grains[k].q =
        turned_by({1, 0, 0, 0}, flat ? Vec3{0, 0, 0.3 * k} : Vec3{0.1 * k, 0.3 - k, 0.4 * k});
  }
  BeamParameters p;
  p.modulus = rod.E;
  p.poisson = rod.nu;
  p.shear = kind(convention);
  for (int k = 0; k < bonds; ++k) beam(b, k, k + 1, p);
  return b;
}

Bench plane_motion(Bench b) {
  b.transverse_only = true;
  return b;
}

const auto kConventions = testing::Values("GA/l", "12EI/l3", "Timoshenko");
const char *kWaveNumbers[] = {"0.10", "0.25", "0.50", "1.00"};

class Beam : public testing::TestWithParam<std::tuple<const char *, int>> {};
class BeamLimit : public Beam {};
class BeamFrequency : public Beam {};

}  // namespace

TEST_P(Beam, cantilever_tip_load) {
  const auto [convention, n] = GetParam();
  const Rod rod;
  const double deflection = reference()(
      "cantilever_tip_load", rod.name(convention, n) + " bonds; F=1e-3 N", "tip deflection");
  const double rotation =
      reference()("cantilever_tip_load", rod.name(convention, n), "tip rotation");
  const double fraction = std::min(1.0, 1e-5 / rotation), dt = 1.5e-6;
  Bench b = chain(rod, n, convention);
  b.grains[n].pull = {0, -1e-3 * fraction, 0};
  const double l = rod.spacing();
  settle(b, dt, slow_frequency(rod.E * rod.I(), b.grains[n].mass / l, (n + 0.5) * l));
  EXPECT_NEAR(-b.grains[n].x.y / fraction / deflection, 1.0, 1e-8);
  // The orientation is a product of a hundred thousand small turns: 1e-12 rad of rounding.
  EXPECT_NEAR(-b.grains[n].turned.z / fraction / rotation, 1.0,
              1e-8 + 1e-12 / (fraction * rotation));
  // The root carries the load; a position n l has its last digit at 1e-16 n l, times k_s.
  const double floor = 2e-16 * n * rod.shear_stiffness(convention) * l / (1e-3 * fraction);
  EXPECT_NEAR(b.grains[0].f.y / (-1e-3 * fraction), 1.0, 1e-8 + floor);
}

// Eigenvalues of the stiffness the kernel shows, as measured from a bent-free chain.
TEST_P(Beam, eigenvalues) {
  const auto [convention, n] = GetParam();
  const Rod rod;
  const double f1 = reference()("cantilever_vibration", rod.name(convention, n), "f1");
  const double limit =
      reference()("time_step", rod.name(convention, n), "2/omega_max (transverse+rotation)");
  double asymmetry = 1.0;
  const Modes m = bending_modes(plane_motion(chain(rod, n, convention)), &asymmetry);
  EXPECT_LT(asymmetry, 1e-10);  // forces and torques belong to one energy
  EXPECT_NEAR(2.0 / m.omega.back() / limit, 1.0, 1e-8);
  const double spread = std::pow(m.omega.back() / (2.0 * kPi * f1), 2);
  EXPECT_NEAR(m.omega.front() / (2.0 * kPi) / f1, 1.0, 1e-8 + 1e-12 * spread);
}

TEST_P(BeamLimit, time_step_by_bisection) {
  const auto [convention, n] = GetParam();
  const Rod rod;
  const double limit =
      reference()("time_step", rod.name(convention, n), "2/omega_max (transverse+rotation)");
  EXPECT_NEAR(stability_limit(plane_motion(chain(rod, n, convention)), limit) / limit, 1.0, 1e-5);
}

TEST_P(BeamFrequency, simulated) {
  const auto [convention, n] = GetParam();
  const Rod rod;
  const double exact =
      2.0 * kPi * reference()("cantilever_vibration", rod.name(convention, n), "f1");
  const double limit =
      reference()("time_step", rod.name(convention, n), "2/omega_max (transverse+rotation)");
  const Bench b = plane_motion(chain(rod, n, convention));
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
    EXPECT_NEAR((4.0 * error[2] - error[1]) / 3.0, 0.0, 3e-7);
  }
}

INSTANTIATE_TEST_SUITE_P(AllRows, Beam,
                         testing::Combine(kConventions, testing::Values(1, 2, 5, 10, 20, 40)));
INSTANTIATE_TEST_SUITE_P(Rows, BeamLimit,
                         testing::Combine(kConventions, testing::Values(1, 2, 5, 40)));
INSTANTIATE_TEST_SUITE_P(Rows, BeamFrequency,
                         testing::Combine(kConventions, testing::Values(1, 2, 5, 10)));

TEST(BeamChain, oblique_cantilever_bends_alike) {
  const Rod rod;
  const int n = 5;
  const double deflection = reference()("cantilever_tip_load",
                                        rod.name("GA/l", n) + " bonds; F=1e-3 N", "tip deflection");
  const Vec3 along = unit({-1, -2, 0.7}), across = unit(cross(along, Vec3{0.3, 1, 2}));
  Bench b = chain(rod, n, "GA/l", true, false, 1.0, along);
  b.grains[n].pull = 1e-4 * across;
  const Vec3 start = b.grains[n].x;
  settle(b, 1.5e-6, slow_frequency(rod.E * rod.I(), b.grains[n].mass / 2e-3, 5.5 * 2e-3));
  const Vec3 moved = b.grains[n].x - start;
  EXPECT_NEAR(dot(moved, across) / (0.1 * deflection), 1.0, 1e-8);
  EXPECT_LT(length(moved - dot(moved, across) * across), 1e-4 * length(moved));
}

TEST(BeamChain, plane_cantilever) {
  const Rod rod;
  const double t = 4e-3, E = rod.E, l = rod.spacing();
  const double area = 2.0 * rod.radius * t, I = 2.0 / 3.0 * std::pow(rod.radius, 3) * t;
  const double kappa = 10.0 * (1.0 + rod.nu) / (12.0 + 11.0 * rod.nu);
  for (const int n : {1, 2, 5, 10}) {
    const double GA = rod.G() * area / l, euler = 12.0 * E * I / (l * l * l);
    const std::pair<const char *, double> cases[] = {
        {"GA/l", GA}, {"12EI/l3", euler}, {"Timoshenko", 1.0 / (1.0 / euler + 1.0 / (kappa * GA))}};
    for (const auto &[convention, ks] : cases) {
      Bench b = chain(rod, n, convention, true, true, t);
      const double L = n * l, F = 1e-5 * 2.0 * E * I / (L * L);
      b.grains[n].pull = {0, F, 0};
      settle(b, 1.2e-6, slow_frequency(E * I, b.grains[n].mass / l, (n + 0.5) * l));
      const double tip = F * L * L * L / (3.0 * E * I) * (1.0 - 0.25 / (n * n)) + F * L / (ks * l);
      EXPECT_NEAR(b.grains[n].x.y / tip, 1.0, 1e-8) << n << convention;
    }
  }
}

TEST(BeamChain, torsion_under_end_torque) {
  const Rod rod;
  for (const int n : {1, 4, 12}) {
    Bench b = chain(rod, n, "GA/l");
    const double M = 1e-5;
    b.grains[n].turn = {M, 0, 0};
    const double kt = rod.G() * rod.J() / rod.spacing(), inertia = b.grains[n].inertia;
    const double omega = 2.0 * std::sqrt(kt / inertia) * std::sin(0.5 * kPi / (2 * n + 1));
    settle(b, 1e-6, omega);
    for (const PairRow &p : b.pairs) EXPECT_NEAR(BeamLaw::loads(b, p).mt / M, 1.0, 1e-9);
    EXPECT_NEAR(b.grains[n].turned.x / (M * n * rod.spacing() / (rod.G() * rod.J())), 1.0, 1e-9);
  }
}

// A chain bent by an end moment is an arc of a circle at any size: n bonds turn by M L/(E I) in
// all.
TEST(BeamChain, end_moment_bends_to_a_circle) {
  const Rod rod;
  const int n = 20;
  for (const bool flat : {false, true}) {
    const double t = 3e-3, I = flat ? 2.0 / 3.0 * std::pow(rod.radius, 3) * t : rod.I();
    Bench b = chain(rod, n, "GA/l", true, flat, t);
    const double L = n * rod.spacing(), angle = 0.5 * kPi, M = angle * rod.E * I / L;
    b.grains[n].turn = {0, 0, M};
    settle(b, 1.0e-6, slow_frequency(rod.E * I, b.grains[n].mass / rod.spacing(), L));
    EXPECT_NEAR(b.grains[n].turned.z / angle, 1.0, 1e-8);
    for (const PairRow &p : b.pairs) EXPECT_NEAR(std::fabs(BeamLaw::loads(b, p).mb) / M, 1.0, 1e-8);
    // chords of the length of a bond, each turned by angle/n, the first by half of it
    Vec3 tip{0, 0, 0};
    for (int k = 0; k < n; ++k)
      tip = tip + rod.spacing() *
                      Vec3{std::cos((k + 0.5) * angle / n), std::sin((k + 0.5) * angle / n), 0};
    EXPECT_LT(length(b.grains[n].x - tip), 1e-7 * L);
  }
}

// Large deflection under a tip force: the elastica. Its end slope a solves
//   sqrt(2 P/(E I)) L = integral_0^a dt/sqrt(sin a - sin t),  deflection = sqrt(E I/(2P)) int sin t
//   dt/...
// With t by sin t = sin a (1 - u^2) the integrands are smooth. A chain of n bonds of k_s = 12 E
// I/l^3 differs by the order 1/n^2 from it and by the stretch; both errors fall as n grows.
TEST(BeamChain, elastica) {
  const Rod rod;
  const auto integrals = [](double a, double &length_part, double &drop_part) {
    length_part = drop_part = 0.0;
    const int steps = 20000;
    const double s = std::sin(a);
    for (int k = 0; k < steps; ++k) {
      const double u = (k + 0.5) / steps, sine = s * (1.0 - u * u);
      const double w =
          2.0 * std::sqrt(s) / std::sqrt(1.0 - sine * sine) / steps;  // dt/sqrt(sin a - sin t)
      length_part += w;
      drop_part += w * sine;
    }
  };
  const double a = 0.9;  // end slope, rad
  double whole, drop;
  integrals(a, whole, drop);
  const auto tip = [&](int n) {
    Rod thin = rod;
    thin.radius = 0.5 * 40e-3 / n;  // of the bonds' spacing; the section is fixed below
    Bench b = chain(thin, n, "12EI/l3");
    const double radius = 0.25e-3, E = rod.E, I = 0.25 * kPi * std::pow(radius, 4), L = 40e-3,
                 l = L / n;
    for (PairRow &p : b.pairs) {
      p.own[kRadius] = radius;
      p.own[kShear] = beam_shear_ratio(BeamShear::euler, radius, l, rod.nu, false);
    }
    const double P = 0.5 * E * I * std::pow(whole / L, 2);
    b.grains[n].pull = {0, P, 0};
    // light damping by the mass; grains of the chain's spacing
    settle(b, 0.3 * std::sqrt(b.grains[1].mass / (E * kPi * radius * radius / l)),
           slow_frequency(E * I, b.grains[1].mass / l, L + 0.5 * l));
    EXPECT_NEAR(b.grains[n].turned.z, a, 0.5 / (n * n) + 1e-3);
    return b.grains[n].x.y / (L * drop / whole);
  };
  const double coarse = tip(8), fine = tip(16);
  EXPECT_NEAR(coarse, 1.0, 4e-3);
  EXPECT_NEAR(fine, 1.0, 1e-3);
  EXPECT_NEAR((4.0 * fine - coarse) / 3.0, 1.0, 2e-4);
}

TEST(BeamWaves, axial_flexural_torsional) {
  const Rod rod;
  for (const char *convention : {"GA/l", "12EI/l3", "Timoshenko"}) {
    const Bench b = plane_motion(chain(rod, 2, convention, false));
    for (const char *k : kWaveNumbers) {
      const double kl = std::atof(k) * kPi;
      EXPECT_NEAR(wave(b, kl, 0, -1).lower /
                      reference()("dispersion_axial", rod.name() + "; k=" + k + " pi/l", "omega"),
                  1.0, 1e-8);
      const DispersionPoint w = wave(b, kl, 1, 5), z = wave(b, kl, 2, 4);
      const std::string name = rod.name(convention) + "; k=" + k + " pi/l";
      EXPECT_NEAR(w.lower / reference()("dispersion_flexural", name, "omega lower branch"), 1.0,
                  3e-8)
          << name;
      EXPECT_NEAR(w.upper / reference()("dispersion_flexural", name, "omega upper branch"), 1.0,
                  1e-8)
          << name;
      EXPECT_NEAR(z.lower / w.lower, 1.0, 1e-8);
      EXPECT_NEAR(z.upper / w.upper, 1.0, 1e-8);
    }
    EXPECT_NEAR(wave(b, kPi, 3, -1).lower /
                    reference()("dispersion_torsion", rod.name(), "omega at k=pi/l"),
                1.0, 1e-8);
    const double kl = 0.01, shortening = std::sin(0.5 * kl) / (0.5 * kl);
    const double speed = wave(b, kl, 0, -1).lower * rod.spacing() / kl / shortening;
    EXPECT_NEAR(speed / reference()("wave_speed", rod.name(), "axial c0"), 1.0, 1e-7);
  }
}

TEST(BeamTimeStep, axial_limit_of_a_long_chain) {
  const Rod rod;
  const double limit = reference()("time_step", rod.name() + "; free chain", "axial 2/omega_max");
  const int n = 60;
  Bench b = chain(rod, n, "GA/l", false);
  for (PairRow &p : b.pairs) p.own[kShear] = p.own[kTwist] = p.own[kFactor] = 1e-6;  // soft
  const double expected = limit / std::sin(0.5 * kPi * n / (n + 1));
  EXPECT_NEAR(stability_limit(b, expected) / expected, 1.0, 1e-5);
}

TEST(BeamTimeStep, plane_chain) {
  const Rod rod;
  const double t = 5e-3, l = rod.spacing(), mass = kPi * rod.radius * rod.radius * t * rod.density;
  const double kn = rod.E * 2.0 * rod.radius * t / l;
  // one bond between two free discs, turning alike against each other: k_s l^2/2 twice over
  Bench b = plane_motion(chain(rod, 1, "GA/l", false, true, t));
  const Modes m = bending_modes(b);
  const double ks = kn / 2.6, inertia = 0.5 * mass * rod.radius * rod.radius;
  // shear strain u - l w of displacements +-u/2 and a common turn w
  const double omega = std::sqrt(ks * (2.0 / mass + 0.5 * l * l / inertia));
  EXPECT_NEAR(m.omega.back() / omega, 1.0, 1e-8);
  EXPECT_NEAR(stability_limit(b, 2.0 / omega) * omega / 2.0, 1.0, 1e-5);
}
