// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: how a bond's creep rate, modulus and strength follow its temperature.
//
// Laws: creep by Arrhenius, A(T) = A_ref exp[-(Q/R)(1/T - 1/T_ref)]; modulus and strengths linear,
// p(T) = p_ref [1 + c (T - T_ref)]. At T_ref all have their values of reference.
// Two activation energies (ice has one below and one above about -10 degrees, Paterson & Budd 1982,
// Cold Reg. Sci. Technol. 6, 175-177) are two runs of types, not one law: a bond type has one.
//
// Source: any text on creep, e.g. Frost & Ashby 1982, Deformation-Mechanism Maps. Units: K, J/mol, 1/K.
// Failure: none. Limits: a linear share is never less than 1 % (a modulus or strength of zero or below
// has no meaning); no thermal strain, no latent heat; a change of modulus with temperature changes the
// stored elastic energy, which is not a part of the mechanical balance.
#ifndef BONDLAB_LAWS_TEMPERATURE_H
#define BONDLAB_LAWS_TEMPERATURE_H

namespace bondlab::laws {

inline constexpr double kGasConstant = 8.31446261815324;  // J/(mol K), exact since 2019
inline constexpr double kLeastShare = 0.01;

struct TemperatureLaw {
  double reference = 263.15;  // T_ref, K
  double activation = 0.0;    // Q, J/mol; 0: creep doesn't depend on temperature
  double modulus = 0.0;       // relative change of E_b per K, 1/K
  double strength = 0.0;      // relative change of all strengths and yield stresses per K, 1/K
};

// ln of A(T)/A_ref.
inline double log_arrhenius(const TemperatureLaw &law, double kelvin) {
  return -law.activation / kGasConstant * (1.0 / kelvin - 1.0 / law.reference);
}

inline double linear_share(double slope, double kelvin, double reference) {
  const double share = 1.0 + slope * (kelvin - reference);
  return share > kLeastShare ? share : kLeastShare;
}

}  // namespace bondlab::laws

#endif
