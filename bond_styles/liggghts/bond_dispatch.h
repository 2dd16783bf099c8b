// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: what adapters of bond laws share: choosing the compiled variant of a law for a block, and the
// sizes of bonds that follow from their particles.
// Units: m, Pa, Pa/m.
#ifndef BONDLAB_BOND_DISPATCH_H
#define BONDLAB_BOND_DISPATCH_H

#include <type_traits>

#include "laws/bond_batch.h"

namespace bondlab {

// Calls run(advance, options, contact) with three compile-time truths.
template <class Run>
void dispatch(bool advance, bool options, bool contact, Run run) {
  const auto with_contact = [&](auto a, auto o) {
    if (contact)
      run(a, o, std::true_type{});
    else
      run(a, o, std::false_type{});
  };
  const auto with_options = [&](auto a) {
    if (options)
      with_contact(a, std::true_type{});
    else
      with_contact(a, std::false_type{});
  };
  if (advance)
    with_options(std::true_type{});
  else
    with_options(std::false_type{});
}

// R_b = lambda min(R_i, R_j) and kbar_n = E_b / (R_i + R_j) of a block of bonds.
template <class Kinematics>
inline void bond_sizes(const Kinematics &k, const double *__restrict lambda,
                       const double *__restrict modulus, double *__restrict radius,
                       double *__restrict stiffness) {
  for (int b = 0; b < laws::kBlock; ++b) {
    radius[b] = lambda[b] * (k.ri[b] < k.rj[b] ? k.ri[b] : k.rj[b]);
    stiffness[b] = modulus[b] * k.per_both[b];
  }
}

}  // namespace bondlab

#endif
