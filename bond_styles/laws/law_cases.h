// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: one entry a bond law for the tests that every law must pass (bond_options_test.cpp,
// fuzz_test.cpp): how to bond two grains of a bench with it, and its stiffness in closed form.
//
// To put a law to these tests, write its LawCase and add it to all_laws(). For tests only.
// Units: SI. Limits: the cases are those of one material; a law's own features have tests of their own.
#ifndef BONDLAB_LAWS_LAW_CASES_H
#define BONDLAB_LAWS_LAW_CASES_H

#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "chain_testbench.h"

namespace bondlab::laws::testbench {

// What a test asks of a bond; the bond is round or a strip with the smaller grain's radius.
struct BondCase {
  double modulus = 1e9, ratio = 2.6;  // Pa; normal over shear stiffness
  double sigma_c = 1e300;             // Pa, mean stress at which pure tension breaks it
  double tau_c = 1e300;               // Pa, mean stress at which pure shear breaks it
  ContactSpec contact;
};

struct BondStiffness {
  double normal, shear, bend, twist;  // N/m, N/m, N m, N m; twist 0 in the plane
};

struct LawCase {
  std::string name;
  std::function<PairRow &(Bench &, int i, int j, const BondCase &)> bond;
  std::function<BondStiffness(const Bench &, const PairRow &)> stiffness;
  std::function<void(PairRow &)> unbreakable;  // takes the strength of a bond away
};

inline LawCase parallel_case() {
  LawCase law;
  law.name = "parallel";
  law.bond = [](Bench &b, int i, int j, const BondCase &c) -> PairRow & {
    ParallelParameters p;
    p.modulus = c.modulus;
    p.ratio = c.ratio;
    PairRow &row = b.bond(i, j, p, c.contact);
    row.sigma_c = c.sigma_c;
    row.tau_c = c.tau_c;
    return row;
  };
  law.stiffness = [](const Bench &b, const PairRow &row) {
    const BondSection s = b.section(row);
    const double kn = row.stiffness, ks = kn / row.ratio;
    return BondStiffness{kn * s.area, ks * s.area, kn * s.bend, ks * s.twist};
  };
  law.unbreakable = [](PairRow &row) { row.sigma_c = row.tau_c = 1e300; };
  return law;
}

// One line a law.
inline const std::vector<LawCase> &all_laws() {
  static const std::vector<LawCase> laws = {
      parallel_case(),
  };
  return laws;
}

// A law in space and in the plane: the parameter of these tests and its name.
struct LawAndSpace {
  std::size_t law;
  bool flat;
  const LawCase &operator()() const { return all_laws()[law]; }
};
inline std::vector<LawAndSpace> laws_in_space_and_plane() {
  std::vector<LawAndSpace> all;
  for (std::size_t k = 0; k < all_laws().size(); ++k)
    for (const bool flat : {false, true}) all.push_back({k, flat});
  return all;
}
inline std::string name_of(const LawAndSpace &c) {
  return c().name + (c.flat ? "_plane" : "_space");
}
inline void PrintTo(const LawAndSpace &c, std::ostream *out) { *out << name_of(c); }

}  // namespace bondlab::laws::testbench

#endif
