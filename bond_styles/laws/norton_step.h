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
// s_eq decays with a rate K = (E s^2 + 3G 3tau^2)/s_eq^2 between E and 3G that drifts from one to the
// other; with K held the integral is elementary: the formula above with K in place of E. So a step takes
// x_0 with the K_0 of its start; then the exact mean Kbar = -ln(s_eq(x_0)/s_eq(0))/x_0 and
//     K = K_0 + 2c (Kbar - K_0),   c = (1 + z/4)/(3 (1 + z/6)),   z = (m-1) Kbar x_0
// and x with that. 2c is the weight for which a K that drifts evenly gives the right integral: exact are
// c(0) = 1/3, its slope 1/36 and c(infinity) = 1/2. K always lies between E and 3G, so the step is stable
// and keeps signs at any size. It is exact for either stress alone, if E = 3G and for m = 1; otherwise x is
// wrong by a term of the fourth order in the creep of the step. What is left of the stresses after 0.1, 1, 10
// and 1000 relaxations in one step (h = E A dt s_eq^(m-1)) is off by at most 1e-8, 1e-5, 1.2e-3 and 4e-2 of itself
// for nu = 0.25 (3G = 1.2 E), m from 2 to 5 and any mixture (m = 1.5: 2.5e-3 and 0.11 of the little that is left).
// The second look is taken where K_0 A dt s_eq^(m-1) > 1e-3; below, the first is good to 1e-10.
// For nu = 0 it is off by 2e-7, 1.3e-4, 2e-2 and 0.3 (norton_step_test.cpp). Without the second look, for nu = 0.25:
// 9e-6, 1e-3, 3e-2 and 0.4.
//
// Tried and rejected: Newton's iteration on I(x) by quadrature (eight exponentials a look, for digits that a step
// of any use doesn't show), and on x = A dt s_eq(x)^(m-1), which is of the second order only.
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

// A dt s_eq^(m-1), 1/Pa. log_a_dt: ln(A dt); m1 = m - 1; log_s: ln s_eq at the start.
inline double creep_power(double log_a_dt, double m1, double log_s) {
  const double power = log_a_dt + m1 * log_s;
  return exp_lane(power > 600.0 ? 600.0 : power);
}
// Reduced time of a step, 1/Pa, if ln s_eq falls at the rate `modulus`, Pa. p: creep_power().
inline double creep_time(double p, double m1, double modulus) {
  double y = m1 * modulus * p;
  y = y < -1.0 + 0x1p-52 ? -1.0 + 0x1p-52 : y;  // m < 1: nothing is left
  return p * log1p_ratio(y);
}
inline double creep_time(double log_a_dt, double m1, double log_s, double modulus) {
  return creep_time(creep_power(log_a_dt, m1, log_s), m1, modulus);
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

// The coupled step, first look and second. three_g = 3 G.
struct CoupledTime {
  double x;                       // reduced time so far, 1/Pa
  double power, rate, fast, apart;  // creep_power(), K_0, share of s_eq^2 that decays faster, |E - 3G|
};
inline CoupledTime coupled_time(double s, double tau2, double modulus, double three_g,
                                double log_a_dt, double m1) {
  const double s2 = s * s, t2 = 3.0 * tau2, sum = s2 + t2;
  const double e2 = sum < kLeastStress2 ? kLeastStress2 : sum;
  const bool shear_faster = three_g > modulus;
  const double slow = shear_faster ? modulus : three_g, apart = std::fabs(three_g - modulus);
  const double fast = (shear_faster ? t2 : s2) / e2, rate = slow + apart * fast;
  const double power = creep_power(log_a_dt, m1, 0.5 * log_lane(e2));
  return {creep_time(power, m1, rate), power, rate, fast, apart};
}
// So little creeps (K_0 A dt s_eq^(m-1)) that the first look is good to 1e-10 for any nu from 0 to 0.5.
inline constexpr double kLittle = 1e-3;
inline double coupled_again(const CoupledTime &t, double m1) {
  const double gone = t.fast * decay_lane(2.0 * t.apart * t.x);
  const double drift = 0.5 * gone * log1p_ratio(-gone) / t.x - t.apart * t.fast;  // Kbar - K_0
  double z = m1 * (t.rate + drift) * t.x;
  z = z < -2.0 ? -2.0 : z;
  const double x = creep_time(t.power, m1, t.rate + (8.0 + 2.0 * z) / (12.0 + 2.0 * z) * drift);
  return t.rate * t.power > kLittle ? x : t.x;
}

// Shares of s and tau lost in a step, coupled.
inline CreepLoss coupled_creep(double s, double tau2, double modulus, double three_g,
                               double log_a_dt, double m1) {
  const double x = coupled_again(coupled_time(s, tau2, modulus, three_g, log_a_dt, m1), m1);
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
    struct alignas(64) {
      double x[kBlock], power[kBlock], rate[kBlock], fast[kBlock], apart[kBlock];
    } t;
#pragma GCC ivdep
    for (int b = 0; b < kBlock; ++b) {
      const CoupledTime one = coupled_time(c.stress[b], c.tau2[b], c.modulus[b], 3.0 * c.shear[b],
                                           log_creep[b] + log_time, exponent[b] - 1.0);
      t.x[b] = one.x, t.power[b] = one.power, t.rate[b] = one.rate, t.fast[b] = one.fast, t.apart[b] = one.apart;
    }
    // The second look is for lanes where much creeps; the others keep the first, whatever their neighbours do.
    double much = 0.0;
    for (int b = 0; b < kBlock; ++b) much += t.rate[b] * t.power[b] > kLittle ? 1.0 : 0.0;
    if (much > 0.0) {
#pragma GCC ivdep
      for (int b = 0; b < kBlock; ++b)
        t.x[b] = coupled_again({t.x[b], t.power[b], t.rate[b], t.fast[b], t.apart[b]}, exponent[b] - 1.0);
    }
#pragma GCC ivdep
    for (int b = 0; b < kBlock; ++b) {
      c.lost_normal[b] = decay_lane(c.modulus[b] * t.x[b]);
      c.lost_shear[b] = decay_lane(3.0 * c.shear[b] * t.x[b]);
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
