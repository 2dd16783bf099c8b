// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: beam bonds on the laws' test bench (chain_testbench.h). For tests only.
//
// A beam's row keeps all its numbers in PairRow::own, by the names below; `alive`, `sigma`, `tau`,
// `fate`, contact and loads stand where every row has them. Units: SI.
#ifndef BONDLAB_LAWS_BEAM_TESTBENCH_H
#define BONDLAB_LAWS_BEAM_TESTBENCH_H

#include <algorithm>
#include <memory>

#include "beam_mohr_coulomb.h"
#include "chain_testbench.h"

namespace bondlab::laws::testbench {

enum BeamColumn {
  kRest,
  kRadius,
  kModulus,
  kShear,
  kTwist,
  kFactor,
  kBeta1,
  kBeta2,
  kTanPhi,
  kCohesion,
  kCutoff,
  kFriction,
  kPoint,
  kFrame,
  kFrameEnd = kFrame + 7,
  kTension,
  kFailure,
  kViscous,
  kWorst,
  kLost,
  kBeamColumns
};

class BeamLaw : public BondLaw {
 public:
  bool options = false;

  void block(const Bench &, PairRow *const *rows, const Kinematics3 &k, const Orientations3 &o,
             const ContactParameters &contact, double *csx, double *csy, double *csz, bool advance,
             PairLoads3 &out) const override {
    Lanes c(rows);
    double *const *l = c.lane;
    const BeamArrays3 a{l[kRest],      l[kRadius],    l[kModulus],   l[kShear],     l[kTwist],
                        l[kFactor],    l[kBeta1],     l[kBeta2],     l[kTanPhi],    l[kCohesion],
                        l[kCutoff],    l[kFriction],  l[kPoint],     l[kFrame],     l[kFrame + 1],
                        l[kFrame + 2], l[kFrame + 3], l[kFrame + 4], l[kFrame + 5], l[kFrame + 6],
                        l[kFrame + 7], c.alive,       c.sigma,       c.tau,         c.fate};
    const OptionArrays q = c.option_arrays();
    if (options)
      advance ? beam_block_3d<true, true>(k, o, a, q, contact, csx, csy, csz, out)
              : beam_block_3d<false, true>(k, o, a, q, contact, csx, csy, csz, out);
    else
      advance ? beam_block_3d<true, false>(k, o, a, {}, contact, csx, csy, csz, out)
              : beam_block_3d<false, false>(k, o, a, {}, contact, csx, csy, csz, out);
    c.back(rows);
  }

  void block(const Bench &bench, PairRow *const *rows, const Kinematics2 &k, const Orientations2 &o,
             const ContactParameters &contact, double *cs, bool advance,
             PairLoads2 &out) const override {
    Lanes c(rows);
    double *const *l = c.lane;
    const BeamArrays2 a{l[kRest],   l[kRadius],    l[kModulus],   l[kShear],
                        l[kFactor], l[kBeta1],     l[kTanPhi],    l[kCohesion],
                        l[kCutoff], l[kFriction],  l[kPoint],     bench.thickness(),
                        l[kFrame],  l[kFrame + 1], l[kFrame + 2], l[kFrame + 3],
                        c.alive,    c.sigma,       c.tau,         c.fate};
    const OptionArrays q = c.option_arrays();
    if (options)
      advance ? beam_block_2d<true, true>(k, o, a, q, contact, cs, out)
              : beam_block_2d<false, true>(k, o, a, q, contact, cs, out);
    else
      advance ? beam_block_2d<true, false>(k, o, a, {}, contact, cs, out)
              : beam_block_2d<false, false>(k, o, a, {}, contact, cs, out);
    c.back(rows);
  }

  static BeamStiffness stiffness(const Bench &bench, const PairRow &p) {
    const auto &o = p.own;
    return bench.flat() ? beam_stiffness_2d(o[kModulus], o[kRadius], o[kRest], o[kShear],
                                            o[kFactor], bench.thickness())
                        : beam_stiffness_3d(o[kModulus], o[kRadius], 1.0 / o[kRest], o[kShear], o[kTwist],
                                            o[kFactor]);
  }

  static BeamShape3 shape3(const Bench &bench, const PairRow &p) {
    const Grain &i = bench.grains[p.i], &j = bench.grains[p.j];
    const auto &f = p.own;
    return BeamShape3(j.x - i.x,
                      Quaternion{i.q[0], i.q[1], i.q[2], i.q[3]} *
                          Quaternion{f[kFrame], f[kFrame + 1], f[kFrame + 2], f[kFrame + 3]},
                      Quaternion{j.q[0], j.q[1], j.q[2], j.q[3]} *
                          Quaternion{f[kFrame + 4], f[kFrame + 5], f[kFrame + 6], f[kFrame + 7]},
                      weight(bench, p), 2.0 - weight(bench, p));
  }

  static double weight(const Bench &bench, const PairRow &p) {
    const double ri = bench.grains[p.i].radius, rj = bench.grains[p.j].radius;
    return beam_weight(p.own[kPoint], ri, rj, 1.0 / (ri + rj));
  }

  // What the bond carries now, effective (without softening).
  static BeamLoads loads(const Bench &bench, const PairRow &p) {
    const Grain &i = bench.grains[p.i], &j = bench.grains[p.j];
    const auto &f = p.own;
    BeamStiffness k = stiffness(bench, p);
    double distance, shear, bend, twist = 0.0;
    if (bench.flat()) {
      const BeamShape2 s(j.x.x - i.x.x, j.x.y - i.x.y, i.q[0], i.q[3], j.q[0], j.q[3],
                         {f[kFrame], f[kFrame + 1], f[kFrame + 2], f[kFrame + 3]}, weight(bench, p),
                         2.0 - weight(bench, p));
      distance = s.distance, shear = s.shear, bend = s.bend;
    } else {
      const BeamShape3 s = shape3(bench, p);
      distance = s.distance, shear = s.shear, bend = s.bend, twist = s.twist;
    }
    if (distance > f[kRest]) k.normal *= f[kTension];
    return beam_loads(k, f[kRest], distance, shear, bend, twist);
  }

  // Of the bond as it is softened, and of the contact that has replaced it (bench counts grain
  // contacts).
  double energy(const Bench &bench, const PairRow &p) const override {
    const BeamStiffness k = stiffness(bench, p);
    const double overlap = p.reference - bench.distance(p.i, p.j);
    if (p.alive == 0.0)
      return p.kn > 0.0 ? 0.0
                        : contact_energy(overlap > 0.0 ? k.normal * overlap : 0.0, length(p.cs),
                                         k.normal, k.shear);
    const BeamLoads l = loads(bench, p);
    const double share = options ? integrity(p.own[kWorst], p.own[kFailure]) : 1.0;
    const double closed = l.fn < 0.0 ? 0.5 * l.fn * l.fn / k.normal : 0.0;  // carried in full
    return closed + share * (l.energy - closed);
  }

 private:
  struct Lanes {
    alignas(64) double column[kBeamColumns][kBlock];
    alignas(64) double alive[kBlock], sigma[kBlock], tau[kBlock], fate[kBlock];
    double *lane[kBeamColumns];

    explicit Lanes(PairRow *const *rows) {
      for (int c = 0; c < kBeamColumns; ++c) lane[c] = column[c];
      for (int b = 0; b < kBlock; ++b) {
        alive[b] = rows[b]->alive;
        for (int c = 0; c < kBeamColumns; ++c) column[c][b] = rows[b]->own[c];
      }
    }
    OptionArrays option_arrays() {
      return {lane[kTension], lane[kFailure], lane[kViscous], lane[kWorst], lane[kLost]};
    }
    void back(PairRow *const *rows) const {
      for (int b = 0; b < kBlock; ++b) {
        PairRow &p = *rows[b];
        p.alive = alive[b], p.sigma = sigma[b], p.tau = tau[b];
        p.fate = static_cast<BondFate>(static_cast<int>(fate[b]));
        p.own[kWorst] = column[kWorst][b], p.own[kLost] = column[kLost][b];
      }
    }
  };
};

inline Bench beam_bench(bool flat = false, double thickness = 1.0, bool options = false) {
  Bench b(flat, thickness);
  auto law = std::make_shared<BeamLaw>();
  law->options = options;
  b.law = law;
  return b;
}

// Bonds grains i and j where they are and as they are turned.
inline PairRow &beam(Bench &b, int i, int j, const BeamParameters &p, const ContactSpec &c = {}) {
  PairRow &row = b.contact(i, j, c);
  const Grain &gi = b.grains[i], &gj = b.grains[j];
  auto &o = row.own;
  row.bonded = true;
  row.alive = 1.0;
  o[kRest] = p.touching ? gi.radius + gj.radius : b.distance(i, j);
  row.reference = o[kRest];
  o[kRadius] = p.lambda * 0.5 * (gi.radius + gj.radius);
  o[kModulus] = p.modulus;
  o[kShear] = beam_shear_ratio(p.shear, o[kRadius], o[kRest], p.poisson, b.flat());
  o[kTwist] = 0.5 / (1.0 + p.poisson);
  o[kFactor] = p.bend_factor, o[kBeta1] = p.beta1, o[kBeta2] = p.beta2, o[kTanPhi] = p.tan_phi;
  o[kCohesion] = p.cohesion > 0.0 ? p.cohesion : 1e300;
  o[kCutoff] = p.cutoff, o[kFriction] = p.friction, o[kPoint] = p.at_contact;
  o[kTension] = o[kFailure] = 1.0;
  if (b.flat()) {
    const Vec3 d = gj.x - gi.x;
    const BeamReference2 r = beam_reference(d.x, d.y, gi.q[0], gi.q[3], gj.q[0], gj.q[3]);
    o[kFrame] = r.ix, o[kFrame + 1] = r.iy, o[kFrame + 2] = r.jx, o[kFrame + 3] = r.jy;
  } else {
    const BeamReference3 r = beam_reference(gi.x, gj.x, {gi.q[0], gi.q[1], gi.q[2], gi.q[3]},
                                            {gj.q[0], gj.q[1], gj.q[2], gj.q[3]});
    o[kFrame] = r.i.w, o[kFrame + 1] = r.i.x, o[kFrame + 2] = r.i.y, o[kFrame + 3] = r.i.z;
    o[kFrame + 4] = r.j.w, o[kFrame + 5] = r.j.x, o[kFrame + 6] = r.j.y, o[kFrame + 7] = r.j.z;
  }
  return row;
}

}  // namespace bondlab::laws::testbench

#endif
