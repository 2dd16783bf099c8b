// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: relax the stresses of a bond at constant strain for some time: Norton's power law, exact for
// one stress alone, stable for any time, never changing a sign.
//
// Law (Norton 1929, The Creep of Steel at High Temperatures): strain rates A s_eq^(m-1) s of the normal
// stress s and 3 A s_eq^(m-1) tau of the shear stress. While the total strain is held,
//     ds/dx = -E s,   dtau/dx = -3 G tau,   dx/dt = A s_eq^(m-1)
// with the reduced time x (1/Pa), so s = s0 exp(-E x), tau = tau0 exp(-3 G x): the sign cannot change.
//     coupled    s_eq^2 = s^2 + 3 tau^2 (von Mises) in both rates
//     separate   s_eq = |s| for s, 3^(1/2) |tau| for tau: rates A |s|^m and A_s |tau|^m,
//                A_s = 3^((m+1)/2) A unless another A_s/A is given
//
// One stress alone: x = ln(1 + y)/((m-1) E), y = (m-1) E A dt |s0|^(m-1), exact; it is the closed form
// [|s0|^(1-m) + (m-1) E A dt]^(1/(1-m)), written so that m = 1 (x = A dt), m close to 1, tiny and huge
// creep all go through the same arithmetic. For m < 1 a stress reaches zero in finite time: y <= -1.
//
// Coupled: x solves  I(x) = int_0^x s_eq(x')^(1-m) dx' = A dt, which has no closed form when E != 3G.
// s_eq decays with a rate K = (E s^2 + 3G 3tau^2)/s_eq^2 between E and 3G; freezing it at its value at
// the start makes the integral elementary: the formula above with K in place of E. It is exact for
// either stress alone and if E = 3G; otherwise x is wrong by a term of third order in the creep of the
// step, and always within the solutions for E and for 3G. norton_step_test.cpp bounds it: at E A dt
// s_eq^(m-1) = 0.01 the relative error of s_eq is below 3e-6 for 3G up to 3 E and m up to 5.
//
// Moments (option): a section in steady creep carries M = (k/A)^(1/m) I_m with the curvature rate k,
// I_m = c_b R^(3+1/m); a twisted one T = (psi/A_s)^(1/m) J_m, J_m = c_t R^(3+1/m) (Odqvist 1966;
// elastic distribution ignored: the section is taken to creep as when redistributed). So each moment
// relaxes like one stress alone, s = M/(c_b R^3) with modulus E (pi/4)/c_b, s = T/(c_t R^3) with
// modulus G (pi/2)/c_t and A_s.
//     round section: c_b = 2 B(1 + 1/(2m), 3/2), c_t = 2 pi/(3 + 1/m)
//     strip, width 2R, thickness t: s = M/(c_b t R^2), c_b = 2/(2 + 1/m), modulus E (2/3)/c_b
//
// Units: Pa, s; logarithms of A in Pa^-m s^-1. Failure: none, NaN in, NaN out.
// Limits: the decay of a step is 1 - exp(-E x) with x cut at exp(600); stresses below 1e-140 Pa creep
// as if they were 1e-140 Pa.
#ifndef BONDLAB_LAWS_NORTON_STEP_H
#define BONDLAB_LAWS_NORTON_STEP_H

#include <cmath>

#include "bond_batch.h"
#include "lane_math.h"

namespace bondlab::laws {

inline constexpr double kLeastStress2 = 1e-280;  // Pa^2
inline constexpr double kLn3 = 1.09861228866810969140;

// Reduced time of a step, 1/Pa. log_a_dt: ln(A dt); m1 = m - 1; log_s: ln s_eq at the start;
// modulus: rate at which ln s_eq falls, Pa.
inline double creep_time(double log_a_dt, double m1, double log_s, double modulus) {
  double power = log_a_dt + m1 * log_s;
  power = power > 600.0 ? 600.0 : power;
  const double p = exp_lane(power);  // A dt s^(m-1)
  double y = m1 * modulus * p;
  y = y < -1.0 + 0x1p-52 ? -1.0 + 0x1p-52 : y;  // m < 1: nothing is left
  return p * log1p_ratio(y);
}

// Half the logarithm of s^2.
inline double log_of_square(double s2) {
  return 0.5 * log_lane(s2 < kLeastStress2 ? kLeastStress2 : s2);
}

// Share of a single stress lost in a step: q, s -> (1 - q) s.
inline double single_creep(double s2, double modulus, double log_a_dt, double m1) {
  return decay_lane(modulus * creep_time(log_a_dt, m1, log_of_square(s2), modulus));
}

struct CreepLoss {
  double normal, shear;
};

// Shares of s and tau lost in a step, coupled. three_g = 3 G.
inline CreepLoss coupled_creep(double s, double tau2, double modulus, double three_g,
                               double log_a_dt, double m1) {
  const double s2 = s * s, t2 = 3.0 * tau2, sum = s2 + t2;
  const double e2 = sum < kLeastStress2 ? kLeastStress2 : sum;
  // at vanishing stress the mixture has no meaning, and any rate will do
  const double rate = (modulus * s2 + three_g * t2 + modulus * (e2 - sum)) / e2;
  const double x = creep_time(log_a_dt, m1, 0.5 * log_lane(e2), rate);
  return {decay_lane(modulus * x), decay_lane(three_g * x)};
}

// Which stresses creep. In `separate` and `coupled` normal and shear stress do.
enum class CreepKind { none, separate, coupled };

// One block: trial stresses in, shares lost out. Shapes [kBlock].
struct alignas(64) CreepBlock {
  double stress[kBlock];                     // normal, Pa
  double tau2[kBlock];                       // shear stress squared, Pa^2
  double bend2[kBlock], twist2[kBlock];      // reduced stresses of the moments, squared, Pa^2
  double modulus[kBlock], shear[kBlock];     // E of the normal stress' side, G; Pa
  double bend[kBlock], twist[kBlock];        // moduli of the moments' reduced stresses, Pa
  double lost_normal[kBlock], lost_shear[kBlock], lost_bend[kBlock], lost_twist[kBlock];
};

// log_creep: ln A; log_shear: ln(A_s/A); log_time: ln dt.
inline void creep_stresses(CreepBlock &c, CreepKind kind, const double *__restrict exponent,
                           const double *__restrict log_creep, const double *__restrict log_shear,
                           double log_time) {
  if (kind == CreepKind::none) {
    for (int b = 0; b < kBlock; ++b) c.lost_normal[b] = c.lost_shear[b] = 0.0;
  } else if (kind == CreepKind::coupled) {
#pragma GCC ivdep
    for (int b = 0; b < kBlock; ++b) {
      const CreepLoss lost = coupled_creep(c.stress[b], c.tau2[b], c.modulus[b], 3.0 * c.shear[b],
                                           log_creep[b] + log_time, exponent[b] - 1.0);
      c.lost_normal[b] = lost.normal;
      c.lost_shear[b] = lost.shear;
    }
  } else {
#pragma GCC ivdep
    for (int b = 0; b < kBlock; ++b) {
      const double a = log_creep[b] + log_time, m1 = exponent[b] - 1.0;
      c.lost_normal[b] = single_creep(c.stress[b] * c.stress[b], c.modulus[b], a, m1);
      c.lost_shear[b] = single_creep(c.tau2[b], c.shear[b], a + log_shear[b], m1);
    }
  }
}

inline void creep_moments(CreepBlock &c, bool creeps, const double *__restrict exponent,
                          const double *__restrict log_creep, const double *__restrict log_shear,
                          double log_time) {
  if (!creeps) {
    for (int b = 0; b < kBlock; ++b) c.lost_bend[b] = c.lost_twist[b] = 0.0;
    return;
  }
#pragma GCC ivdep
  for (int b = 0; b < kBlock; ++b) {
    const double a = log_creep[b] + log_time, m1 = exponent[b] - 1.0;
    c.lost_bend[b] = single_creep(c.bend2[b], c.bend[b], a, m1);
    c.lost_twist[b] = single_creep(c.twist2[b], c.twist[b], a + log_shear[b], m1);
  }
}

// c_b of the round section and of the strip, c_t of the round one; A_s/A of von Mises.
inline double round_bend_shape(double m) {
  const double a = 1.0 + 0.5 / m;
  return 2.0 * std::exp(std::lgamma(a) + std::lgamma(1.5) - std::lgamma(a + 1.5));
}
inline double strip_bend_shape(double m) { return 2.0 * m / (2.0 * m + 1.0); }
inline double round_twist_shape(double m) { return 6.28318530717958647692 * m / (3.0 * m + 1.0); }
inline double log_mises_ratio(double m) { return 0.5 * (m + 1.0) * kLn3; }

}  // namespace bondlab::laws

#endif
