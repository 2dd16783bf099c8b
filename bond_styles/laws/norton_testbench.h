// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: Norton bonds on the laws' test bench (chain_testbench.h).
//
// One type for all bonds of a bench; sigma_c, tau_c and beta are those of the rows. The step's time is
// set by the test (`time`, of one call; creep every n-th call with n times that). Energies: SI.
// Failure: none, it is for tests only.
#ifndef BONDLAB_LAWS_NORTON_TESTBENCH_H
#define BONDLAB_LAWS_NORTON_TESTBENCH_H

#include "chain_testbench.h"
#include "norton_type.h"

namespace bondlab::laws::testbench {

class NortonLaw : public BondLaw {
 public:
  // PairRow::own
  enum Own { STRAIN, THEN, DISSIPATED, WORST, LOST, CALLS, TENSION, FAILURE, VISCOUS, KELVIN };

  NortonType type;
  double time = 0.0;  // s a call
  int every = 1;
  bool options = false;

  void block(const Bench &bench, PairRow *const *rows, const Kinematics3 &k, const Orientations3 &,
             const ContactParameters &contact, double *csx, double *csy, double *csz, bool advance,
             PairLoads3 &out) const override {
    Columns c;
    const NortonStep step = fill(bench, rows, c, advance);
    const NortonArrays3 a{constants(c), c.rest, c.alive, c.own[STRAIN], c.own[THEN],
                          c.own[DISSIPATED], c.f[0], c.f[1], c.f[2], c.m[0], c.m[1], c.m[2], c.mt,
                          c.sigma, c.tau, c.fate};
    if (!advance)
      options ? norton_block_3d<false, true>(k, a, step, contact, csx, csy, csz, out, shared(c))
              : norton_block_3d<false>(k, a, step, contact, csx, csy, csz, out);
    else
      options ? norton_block_3d<true, true>(k, a, step, contact, csx, csy, csz, out, shared(c))
              : norton_block_3d<true>(k, a, step, contact, csx, csy, csz, out);
    empty(rows, c, advance);
  }

  void block(const Bench &bench, PairRow *const *rows, const Kinematics2 &k, const Orientations2 &,
             const ContactParameters &contact, double *cs, bool advance,
             PairLoads2 &out) const override {
    Columns c;
    const NortonStep step = fill(bench, rows, c, advance);
    const NortonArrays2 a{constants(c), bench.thickness(), c.rest, c.alive, c.own[STRAIN],
                          c.own[THEN], c.own[DISSIPATED], c.f[0], c.m[0], c.sigma, c.tau, c.fate};
    if (!advance)
      options ? norton_block_2d<false, true>(k, a, step, contact, cs, out, shared(c))
              : norton_block_2d<false>(k, a, step, contact, cs, out);
    else
      options ? norton_block_2d<true, true>(k, a, step, contact, cs, out, shared(c))
              : norton_block_2d<true>(k, a, step, contact, cs, out);
    empty(rows, c, advance);
  }

  double kelvin(const PairRow &p) const {
    return p.own[KELVIN] > 0.0 ? p.own[KELVIN] : type.temperature.reference;
  }
  double bond_length(const Bench &b, const PairRow &p) const {
    return norton_length(type, p.rest, b.grains[p.i].radius, b.grains[p.j].radius);
  }
  BondSection section(const Bench &b, const PairRow &p) const {
    return b.flat() ? strip_section(p.radius, b.thickness()) : round_section(p.radius);
  }
  double modulus_n(const PairRow &p, double elastic) const {
    const double E = modulus_at(type, kelvin(p));
    return options && elastic > 0.0 ? E * p.own[TENSION] : E;
  }
  // Effective normal stress now, Pa.
  double stress(const Bench &b, const PairRow &p) const {
    const double strain = (b.distance(p.i, p.j) - p.rest) / bond_length(b, p) - p.own[STRAIN];
    const double s = modulus_n(p, strain) * strain;
    return type.cut_only ? std::min(s, type.yield_t) : s;
  }
  double energy(const Bench &b, const PairRow &p) const override {
    if (p.alive == 0.0) return 0.0;
    const double s = stress(b, p), share = options ? integrity(p.own[WORST], p.own[FAILURE]) : 1.0;
    return norton_energy(s, modulus_n(p, s), length(p.fs), length(p.mb), p.mt,
                         modulus_at(type, kelvin(p)), 0.5 / (1.0 + type.poisson), bond_length(b, p),
                         share, section(b, p));
  }

 private:
  struct alignas(64) Columns {
    double length[kBlock], radius[kBlock], modulus[kBlock], shear[kBlock], beta[kBlock];
    double sigma_c[kBlock], tau_c[kBlock], crush[kBlock], yield[3][kBlock];
    double exponent[kBlock], log_creep[kBlock], log_shear[kBlock], bend_shape[kBlock];
    double rest[kBlock], alive[kBlock], f[3][kBlock], m[3][kBlock], mt[kBlock];
    double own[10][kBlock], sigma[kBlock], tau[kBlock], fate[kBlock];
  };

  NortonStep fill(const Bench &bench, PairRow *const *rows, Columns &c, bool advance) const {
    for (int b = 0; b < kBlock; ++b) {
      const PairRow &p = *rows[b];
      const double T = kelvin(p), share = strength_share_at(type, T);
      c.length[b] = bond_length(bench, p), c.radius[b] = p.radius;
      c.modulus[b] = modulus_at(type, T), c.shear[b] = 0.5 / (1.0 + type.poisson);
      c.beta[b] = p.beta, c.sigma_c[b] = p.sigma_c * share, c.tau_c[b] = p.tau_c * share;
      c.crush[b] = type.crush * share, c.yield[0][b] = type.yield_t * share;
      c.yield[1][b] = type.yield_c * share, c.yield[2][b] = type.yield_s * share;
      c.exponent[b] = type.exponent, c.log_creep[b] = log_creep_at(type, T);
      c.log_shear[b] = log_shear_ratio(type);
      c.bend_shape[b] = norton_bend_shape(type, bench.flat());
      c.rest[b] = p.rest, c.alive[b] = p.alive, c.mt[b] = p.mt;
      c.f[0][b] = p.fs.x, c.f[1][b] = p.fs.y, c.f[2][b] = p.fs.z;
      c.m[0][b] = p.mb.x, c.m[1][b] = p.mb.y, c.m[2][b] = p.mb.z;
      for (int k = 0; k < 10; ++k) c.own[k][b] = p.own[k];
    }
    NortonStep step;
    step.cut_only = type.cut_only;
    if (advance && time > 0.0 && std::fmod(rows[0]->own[CALLS] + 1.0, every) == 0.0) {
      step.creep = type.creep;
      step.moments = type.moments;
      step.log_time = std::log(every * time);
    }
    return step;
  }

  static void empty(PairRow *const *rows, const Columns &c, bool advance) {
    for (int b = 0; b < kBlock; ++b) {
      PairRow &p = *rows[b];
      if (b > 0 && rows[b] == rows[b - 1]) continue;  // padding
      p.alive = c.alive[b], p.mt = c.mt[b], p.sigma = c.sigma[b], p.tau = c.tau[b];
      p.fate = static_cast<BondFate>(static_cast<int>(c.fate[b]));
      p.fs = {c.f[0][b], c.f[1][b], c.f[2][b]}, p.mb = {c.m[0][b], c.m[1][b], c.m[2][b]};
      for (int k = STRAIN; k <= LOST; ++k) p.own[k] = c.own[k][b];
      p.own[CALLS] += advance;
    }
  }

  static NortonConstants constants(const Columns &c) {
    return {c.length,   c.radius,   c.modulus,  c.shear,    c.beta,      c.sigma_c,   c.tau_c,
            c.crush,    c.yield[0], c.yield[1], c.yield[2], c.exponent,  c.log_creep, c.log_shear,
            c.bend_shape};
  }
  static OptionArrays shared(Columns &c) {
    return {c.own[TENSION], c.own[FAILURE], c.own[VISCOUS], c.own[WORST], c.own[LOST]};
  }
};

// A bench of Norton bonds; `law` may be changed between steps.
struct NortonBench : Bench {
  std::shared_ptr<NortonLaw> norton;

  NortonBench(const NortonType &type, bool flat = false, double thickness = 1.0)
      : Bench(flat, thickness), norton(std::make_shared<NortonLaw>()) {
    norton->type = type;
    law = norton;
  }
  NortonBench(const NortonBench &other)
      : Bench(other), norton(std::make_shared<NortonLaw>(*other.norton)) {
    law = norton;
  }

  PairRow &norton_bond(int i, int j, const ContactSpec &contact = {}) {
    PairRow &p = bond(i, j, ParallelParameters(), contact);
    p.radius = norton_radius(norton->type, grains[i].radius, grains[j].radius);
    p.own[NortonLaw::TENSION] = p.own[NortonLaw::FAILURE] = 1.0;
    return p;
  }
  double dissipated() const {
    double sum = 0.0;
    for (const PairRow &p : pairs) sum += p.own[NortonLaw::DISSIPATED] + p.own[NortonLaw::LOST];
    return sum;
  }
};

}  // namespace bondlab::laws::testbench

#endif
