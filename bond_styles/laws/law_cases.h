// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: one entry a bond law for the tests that every law must pass (bond_options_test.cpp, bond_damping_test.cpp,
// scaling_test.cpp, bugs_of_others_test.cpp, fuzz_test.cpp): how to bond two grains with it, its stiffness.
//
// To put a law to these tests, write its LawCase and add it to all_laws(). For tests only.
// Units: SI. Limits: the cases are those of one material; a law's own features have tests of their own.
#ifndef BONDLAB_LAWS_LAW_CASES_H
#define BONDLAB_LAWS_LAW_CASES_H

#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "beam_testbench.h"
#include "chain_testbench.h"
#include "norton_testbench.h"

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

struct ContactParametersOfPair {
  double kn, ks, mu;  // N/m, N/m, 1
};

struct LawCase {
  std::string name;
  std::function<PairRow &(Bench &, int i, int j, const BondCase &)> bond;
  std::function<BondStiffness(const Bench &, const PairRow &)> stiffness;
  std::function<void(PairRow &)> unbreakable;  // takes the strength of a bond away
  // the contact that acts after a break where there was none before; null if there is none then
  std::function<ContactParametersOfPair(const Bench &, const PairRow &)> replaced_by;
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

// A law whose own test bench keeps the common options in PairRow::own, at these places: takes them from
// and puts them back to the members of the row.
struct OptionPlaces {
  int tension, failure, viscous, worst, lost;
};

template <class Inner>
class RowOptions : public BondLaw {
 public:
  mutable Inner inner;
  explicit RowOptions(const OptionPlaces &places) : at_(places) {}

  void block(const Bench &bench, PairRow *const *rows, const Kinematics3 &k, const Orientations3 &o,
             const ContactParameters &contact, double *csx, double *csy, double *csz, bool advance,
             PairLoads3 &out) const override {
    give(bench, rows);
    inner.block(bench, rows, k, o, bench.contacts ? contact : no_contact(contact), csx, csy, csz, advance, out);
    take(rows);
  }
  void block(const Bench &bench, PairRow *const *rows, const Kinematics2 &k, const Orientations2 &o,
             const ContactParameters &contact, double *cs, bool advance,
             PairLoads2 &out) const override {
    give(bench, rows);
    inner.block(bench, rows, k, o, bench.contacts ? contact : no_contact(contact), cs, advance, out);
    take(rows);
  }
  double energy(const Bench &bench, const PairRow &p) const override {
    PairRow row = p, *one = &row;
    give_one(bench, *one);
    if (!bench.contacts) row.kn = row.ks = 0.0;
    return inner.energy(bench, row);
  }

 private:
  OptionPlaces at_;
  void give_one(const Bench &bench, PairRow &p) const {
    inner.options = bench.options;
    p.own[at_.tension] = p.tension, p.own[at_.failure] = p.failure;
    p.own[at_.viscous] = bench.dt > 0.0 ? p.viscous / bench.dt : 0.0;
    p.own[at_.worst] = p.worst, p.own[at_.lost] = p.lost;
  }
  void give(const Bench &bench, PairRow *const *rows) const {
    for (int b = 0; b < kBlock; ++b) give_one(bench, *rows[b]);
  }
  void take(PairRow *const *rows) const {
    for (int b = 0; b < kBlock; ++b)
      rows[b]->worst = rows[b]->own[at_.worst], rows[b]->lost = rows[b]->own[at_.lost];
  }
  static ContactParameters no_contact(const ContactParameters &c) {
    alignas(64) static const double none[kBlock] = {};
    return {c.reference, none, none, none};
  }
};

inline LawCase beam_case() {
  LawCase law;
  law.name = "beam";
  static constexpr double friction = 0.4;
  law.bond = [](Bench &b, int i, int j, const BondCase &c) -> PairRow & {
    if (!b.law) b.law = std::make_shared<RowOptions<BeamLaw>>(OptionPlaces{kTension, kFailure, kViscous, kWorst, kLost});
    BeamParameters p;
    p.modulus = c.modulus;
    p.cohesion = c.tau_c;
    p.cutoff = c.sigma_c;
    p.friction = friction;
    PairRow &row = beam(b, i, j, p, c.contact);
    row.own[kShear] = row.own[kTwist] = 1.0 / c.ratio;
    row.radius = row.own[kRadius];
    return row;
  };
  law.stiffness = [](const Bench &b, const PairRow &row) {
    const BeamStiffness k = BeamLaw::stiffness(b, row);
    return BondStiffness{k.normal, k.shear, k.bend, k.twist};
  };
  law.unbreakable = [](PairRow &row) { row.own[kCohesion] = row.own[kCutoff] = 1e300; };
  law.replaced_by = [](const Bench &b, const PairRow &row) {
    const BeamStiffness k = BeamLaw::stiffness(b, row);
    return ContactParametersOfPair{k.normal, k.shear, friction};
  };
  return law;
}

// Without creep: that has tests of its own.
inline LawCase norton_case() {
  LawCase law;
  law.name = "norton";
  law.bond = [](Bench &b, int i, int j, const BondCase &c) -> PairRow & {
    using Own = NortonLaw::Own;
    if (!b.law)
      b.law = std::make_shared<RowOptions<NortonLaw>>(OptionPlaces{Own::TENSION, Own::FAILURE, Own::VISCOUS, Own::WORST, Own::LOST});
    NortonType type;
    type.modulus = c.modulus;
    type.poisson = 0.5 * c.ratio - 1.0;  // G = E/ratio
    static_cast<const RowOptions<NortonLaw> &>(*b.law).inner.type = type;
    PairRow &row = b.bond(i, j, ParallelParameters(), c.contact);
    row.radius = norton_radius(type, b.grains[i].radius, b.grains[j].radius);
    row.stiffness = c.modulus / row.rest;
    row.ratio = c.ratio;
    row.sigma_c = c.sigma_c;
    row.tau_c = c.tau_c;
    return row;
  };
  law.stiffness = parallel_case().stiffness;
  law.unbreakable = parallel_case().unbreakable;
  return law;
}

// One line a law.
inline const std::vector<LawCase> &all_laws() {
  static const std::vector<LawCase> laws = {
      parallel_case(),
      beam_case(),
      norton_case(),
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
