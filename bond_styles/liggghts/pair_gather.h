// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: between the engine's particle arrays and a law's blocks: read the relative motion of a block
// of pairs, add up its loads in order of rows. Shared by bonds and contacts.
//
// Method: what a pair needs of a particle is copied once a step into one record a particle; a block
// then loads whole records and transposes them (lane_transpose.h).
// Velocities are those of the half step, so dt times their difference is exactly the change of
// distance since the last force. With dt = 0 (set-up of a run) nothing moves and no history advances.
// Loads go to own particles only: the other side of a cut pair is computed by its owner. Rows come in
// order of the smaller tag, so what they add to that particle is kept in registers until the next one:
// the same sums in the same order as one by one.
// Units: m, m/s, rad/s, s, N, N m.
#ifndef BONDLAB_PAIR_GATHER_H
#define BONDLAB_PAIR_GATHER_H

#include <algorithm>

#include "huge_vector.h"
#include "lane_transpose.h"
#include "laws/bond_batch.h"
#include "pair_table.h"

namespace bondlab {

// One record a particle or ghost: x y z vx vy vz _ _, wx wy wz r and, if a law wants it, the orientation;
// in the plane x y vx vy w r _ _.
class ParticleRecords {
 public:
  static constexpr int kPlane = 8;

  void fill_space(int n, double *const *x, double *const *v, double *const *w, const double *r,
                  double *const *quat) {
    width_ = quat ? 16 : 12;
    grow(n, width_);
    if (n == 0) return;
    const double *X = x[0], *V = v[0], *W = w[0], *Q = quat ? quat[0] : nullptr;
    for (int i = 0; i < n; ++i) {
      double *p = records_.data() + width_ * i;
      for (int d = 0; d < 3; ++d) p[d] = X[3 * i + d], p[3 + d] = V[3 * i + d], p[8 + d] = W[3 * i + d];
      p[11] = r[i];
      if (Q)
        for (int d = 0; d < 4; ++d) p[12 + d] = Q[4 * i + d];
    }
  }
  void fill_plane(int n, double *const *x, double *const *v, double *const *w, const double *r) {
    width_ = kPlane;
    grow(n, kPlane);
    if (n == 0) return;
    const double *X = x[0], *V = v[0], *W = w[0];
    for (int i = 0; i < n; ++i) {
      double *p = records_.data() + kPlane * i;
      p[0] = X[3 * i], p[1] = X[3 * i + 1], p[2] = V[3 * i], p[3] = V[3 * i + 1];
      p[4] = W[3 * i + 2], p[5] = r[i];
    }
  }
  const double *space(int i) const { return records_.data() + width_ * i; }
  const double *plane(int i) const { return records_.data() + kPlane * std::size_t(i); }
  // Do they fit the second cache of a processor? Then asking ahead for single ones costs more than it saves.
  bool near() const { return used_ * sizeof(double) < (std::size_t(2) << 20); }

 private:
  HugeVector records_;
  std::ptrdiff_t width_ = kPlane;  // doubles a record
  std::size_t used_ = 0;
  void grow(int n, std::ptrdiff_t width) {
    const std::size_t needed = used_ = std::size_t(n) * width;
    if (records_.size() < needed) records_.resize(needed + needed / 8, 0.0);
  }
};

// Asks for the records of a block ahead of its use: those of the larger tags are scattered.
inline void prefetch(const PairTable &t, int first, const ParticleRecords &p) {
  if (p.near()) return;
  const int *at_hi = t.at_hi.data() + first;
  for (int b = 0; b < laws::kBlock; ++b) {
    __builtin_prefetch(p.space(at_hi[b]));
    __builtin_prefetch(p.space(at_hi[b]) + 8);
  }
}

// Motion of a block and, with `turned`, the orientations of its particles.
template <bool turned>
inline void gather_space(const PairTable &t, int first, double dt, const ParticleRecords &p,
                         laws::Kinematics3 &k, laws::Orientations3 *q) {
  const int *at_lo = t.at_lo.data() + first, *at_hi = t.at_hi.data() + first;
  for (int b = 0; b < laws::kBlock; b += 8) {
    Lanes8 motion[8], i[8], j[8];
    for (int l = 0; l < 8; ++l) motion[l] = load8(p.space(at_hi[b + l])) - load8(p.space(at_lo[b + l]));
    transpose8(motion);
    store8(k.dx + b, motion[0]), store8(k.dy + b, motion[1]), store8(k.dz + b, motion[2]);
    store8(k.ux + b, dt * motion[3]), store8(k.uy + b, dt * motion[4]), store8(k.uz + b, dt * motion[5]);
    if constexpr (turned) {
      for (int l = 0; l < 8; ++l) i[l] = load8(p.space(at_lo[b + l]) + 8);
      transpose8(i);
      store8(q->iw + b, i[4]), store8(q->ix + b, i[5]), store8(q->iy + b, i[6]), store8(q->iz + b, i[7]);
      for (int l = 0; l < 8; ++l) j[l] = load8(p.space(at_hi[b + l]) + 8);
      transpose8(j);
      store8(q->jw + b, j[4]), store8(q->jx + b, j[5]), store8(q->jy + b, j[6]), store8(q->jz + b, j[7]);
    } else {
      for (int l = 0; l < 8; ++l) i[l] = load4_4(p.space(at_lo[b + l]) + 8, p.space(at_hi[b + l]) + 8);
      transpose8(i);
      for (int d = 0; d < 4; ++d) j[d] = i[4 + d];
    }
    const Lanes8 ri = i[3], rj = j[3], per_both = 1.0 / (ri + rj), share = dt * per_both,
                 si = share * ri, sj = share * rj;
    store8(k.sx + b, si * i[0] + sj * j[0]);
    store8(k.sy + b, si * i[1] + sj * j[1]);
    store8(k.sz + b, si * i[2] + sj * j[2]);
    store8(k.qx + b, dt * (j[0] - i[0]));
    store8(k.qy + b, dt * (j[1] - i[1]));
    store8(k.qz + b, dt * (j[2] - i[2]));
    store8(k.ri + b, ri), store8(k.rj + b, rj), store8(k.per_both + b, per_both);
  }
}
inline void gather(const PairTable &t, int first, double dt, const ParticleRecords &p,
                   laws::Kinematics3 &k) {
  gather_space<false>(t, first, dt, p, k, nullptr);
}
inline void gather(const PairTable &t, int first, double dt, const ParticleRecords &p, double *const *,
                   laws::Kinematics3 &k, laws::Orientations3 &q) {
  gather_space<true>(t, first, dt, p, k, &q);
}

inline void gather(const PairTable &t, int first, double dt, const ParticleRecords &p,
                   laws::Kinematics2 &k) {
  const int *at_lo = t.at_lo.data() + first, *at_hi = t.at_hi.data() + first;
  const Picks8 both = {8, 9, 10, 11, 4, 5, 4, 5};       // differences, then i's spin and radius ...
  const Picks8 second = {0, 1, 2, 3, 4, 5, 12, 13};     // ... then j's
  for (int b = 0; b < laws::kBlock; b += 8) {
    Lanes8 rows[8];
    for (int l = 0; l < 8; ++l) {
      const Lanes8 i = load8(p.plane(at_lo[b + l])), j = load8(p.plane(at_hi[b + l]));
      rows[l] = __builtin_shuffle(__builtin_shuffle(i, j - i, both), j, second);
    }
    transpose8(rows);
    store8(k.dx + b, rows[0]), store8(k.dy + b, rows[1]);
    store8(k.ux + b, dt * rows[2]), store8(k.uy + b, dt * rows[3]);
    const Lanes8 wi = rows[4], ri = rows[5], wj = rows[6], rj = rows[7], per_both = 1.0 / (ri + rj),
                 share = dt * per_both;
    store8(k.s + b, share * ri * wi + share * rj * wj);
    store8(k.q + b, dt * (wj - wi));
    store8(k.ri + b, ri), store8(k.rj + b, rj), store8(k.per_both + b, per_both);
  }
}

// The same with orientations; quat: the atom style's [n][4], which the records of the plane leave out.
inline void gather(const PairTable &t, int first, double dt, const ParticleRecords &p, double *const *quat,
                   laws::Kinematics2 &k, laws::Orientations2 &q) {
  gather(t, first, dt, p, k);
  const double *Q = quat[0];
  const int *at_lo = t.at_lo.data() + first, *at_hi = t.at_hi.data() + first;
  for (int b = 0; b < laws::kBlock; ++b) {
    q.iw[b] = Q[4 * at_lo[b]], q.iz[b] = Q[4 * at_lo[b] + 3];
    q.jw[b] = Q[4 * at_hi[b]], q.jz[b] = Q[4 * at_hi[b] + 3];
  }
}

// counts(row): may this row add its loads? All may, but for blocks that several bond styles share.
template <class Counts>
inline void scatter(const PairTable &t, int first, int nlocal, const laws::PairLoads3 &p,
                    double **force, double **torque, const Counts &counts) {
  if (nlocal == 0) return;
  double *F = force[0], *T = torque[0];
  const int n = std::min(laws::kBlock, t.size() - first);
  const int *own_lo = t.own_lo.data() + first, *own_hi = t.own_hi.data() + first;
  int held = -1;  // whose sums are in registers
  double f[3] = {0.0, 0.0, 0.0}, m[3] = {0.0, 0.0, 0.0};
  const auto put_back = [&] {
    if (held < 0 || held >= nlocal) return;
    for (int d = 0; d < 3; ++d) F[3 * held + d] = f[d], T[3 * held + d] = m[d];
  };
  for (int b = 0; b < n; ++b) {
    if (!counts(first + b)) continue;
    const int i = own_lo[b], j = own_hi[b];
    if (i != held) {
      put_back();
      held = i;
      if (i < nlocal)
        for (int d = 0; d < 3; ++d) f[d] = F[3 * i + d], m[d] = T[3 * i + d];
    }
    f[0] += p.fx[b], f[1] += p.fy[b], f[2] += p.fz[b];
    m[0] += p.tix[b], m[1] += p.tiy[b], m[2] += p.tiz[b];
    if (j < nlocal) {
      F[3 * j] -= p.fx[b], F[3 * j + 1] -= p.fy[b], F[3 * j + 2] -= p.fz[b];
      T[3 * j] += p.tjx[b], T[3 * j + 1] += p.tjy[b], T[3 * j + 2] += p.tjz[b];
    }
  }
  put_back();
}

template <class Counts>
inline void scatter(const PairTable &t, int first, int nlocal, const laws::PairLoads2 &p,
                    double **force, double **torque, const Counts &counts) {
  if (nlocal == 0) return;
  double *F = force[0], *T = torque[0];
  const int n = std::min(laws::kBlock, t.size() - first);
  const int *own_lo = t.own_lo.data() + first, *own_hi = t.own_hi.data() + first;
  for (int b = 0; b < n; ++b) {
    if (!counts(first + b)) continue;
    const int i = own_lo[b], j = own_hi[b];
    if (i < nlocal) {
      F[3 * i] += p.fx[b], F[3 * i + 1] += p.fy[b];
      T[3 * i + 2] += p.ti[b];
    }
    if (j < nlocal) {
      F[3 * j] -= p.fx[b], F[3 * j + 1] -= p.fy[b];
      T[3 * j + 2] += p.tj[b];
    }
  }
}

// Force on the smaller-tag particle of one lane, N.
inline void force_of(const laws::PairLoads3 &l, int lane, double *f) {
  f[0] = l.fx[lane], f[1] = l.fy[lane], f[2] = l.fz[lane];
}
inline void force_of(const laws::PairLoads2 &l, int lane, double *f) {
  f[0] = l.fx[lane], f[1] = l.fy[lane], f[2] = 0.0;
}

template <class Loads>
inline void scatter(const PairTable &t, int first, int nlocal, const Loads &p, double **force,
                    double **torque) {
  scatter(t, first, nlocal, p, force, torque, [](int) { return true; });
}

}  // namespace bondlab

#endif
