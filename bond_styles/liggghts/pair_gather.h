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

// One record a particle or ghost: x y z vx vy vz _ _, wx wy wz r; in the plane x y vx vy w r _ _.
class ParticleRecords {
 public:
  static constexpr int kSpace = 12, kPlane = 8;

  void fill_space(int n, double *const *x, double *const *v, double *const *w, const double *r) {
    grow(n, kSpace);
    if (n == 0) return;
    const double *X = x[0], *V = v[0], *W = w[0];
    for (int i = 0; i < n; ++i) {
      double *p = records_.data() + kSpace * i;
      for (int d = 0; d < 3; ++d) p[d] = X[3 * i + d], p[3 + d] = V[3 * i + d], p[8 + d] = W[3 * i + d];
      p[11] = r[i];
    }
  }
  void fill_plane(int n, double *const *x, double *const *v, double *const *w, const double *r) {
    grow(n, kPlane);
    if (n == 0) return;
    const double *X = x[0], *V = v[0], *W = w[0];
    for (int i = 0; i < n; ++i) {
      double *p = records_.data() + kPlane * i;
      p[0] = X[3 * i], p[1] = X[3 * i + 1], p[2] = V[3 * i], p[3] = V[3 * i + 1];
      p[4] = W[3 * i + 2], p[5] = r[i];
    }
  }
  const double *space(int i) const { return records_.data() + kSpace * std::size_t(i); }
  const double *plane(int i) const { return records_.data() + kPlane * std::size_t(i); }

 private:
  HugeVector records_;
  void grow(int n, int width) {
    const std::size_t needed = std::size_t(n) * width;
    if (records_.size() < needed) records_.resize(needed + needed / 8, 0.0);
  }
};

inline void gather(const PairTable &t, int first, double dt, const ParticleRecords &p,
                   laws::Kinematics3 &k) {
  const int *at_lo = t.at_lo.data() + first, *at_hi = t.at_hi.data() + first;
  for (int b = 0; b < laws::kBlock; b += 8) {
    Lanes8 motion[8], spin[8];
    for (int l = 0; l < 8; ++l) {
      const double *i = p.space(at_lo[b + l]), *j = p.space(at_hi[b + l]);
      motion[l] = load8(j) - load8(i);
      spin[l] = load4_4(i + 8, j + 8);
    }
    transpose8(motion);
    transpose8(spin);
    store8(k.dx + b, motion[0]), store8(k.dy + b, motion[1]), store8(k.dz + b, motion[2]);
    store8(k.ux + b, dt * motion[3]), store8(k.uy + b, dt * motion[4]), store8(k.uz + b, dt * motion[5]);
    const Lanes8 ri = spin[3], rj = spin[7], share = dt / (ri + rj), si = share * ri, sj = share * rj;
    store8(k.sx + b, si * spin[0] + sj * spin[4]);
    store8(k.sy + b, si * spin[1] + sj * spin[5]);
    store8(k.sz + b, si * spin[2] + sj * spin[6]);
    store8(k.qx + b, dt * (spin[4] - spin[0]));
    store8(k.qy + b, dt * (spin[5] - spin[1]));
    store8(k.qz + b, dt * (spin[6] - spin[2]));
    store8(k.ri + b, ri), store8(k.rj + b, rj);
  }
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
    const Lanes8 wi = rows[4], ri = rows[5], wj = rows[6], rj = rows[7], share = dt / (ri + rj);
    store8(k.s + b, share * ri * wi + share * rj * wj);
    store8(k.q + b, dt * (wj - wi));
    store8(k.ri + b, ri), store8(k.rj + b, rj);
  }
}

// quat: the atom style's [n][4] orientations.
inline void gather(const PairTable &t, int first, double *const *quat, laws::Orientations3 &q) {
  const double *Q = quat[0];
  const int *at_lo = t.at_lo.data() + first, *at_hi = t.at_hi.data() + first;
  for (int b = 0; b < laws::kBlock; b += 8) {
    Lanes8 rows[8];
    for (int l = 0; l < 8; ++l) rows[l] = load4_4(Q + 4 * at_lo[b + l], Q + 4 * at_hi[b + l]);
    transpose8(rows);
    store8(q.iw + b, rows[0]), store8(q.ix + b, rows[1]), store8(q.iy + b, rows[2]), store8(q.iz + b, rows[3]);
    store8(q.jw + b, rows[4]), store8(q.jx + b, rows[5]), store8(q.jy + b, rows[6]), store8(q.jz + b, rows[7]);
  }
}

inline void gather(const PairTable &t, int first, double *const *quat, laws::Orientations2 &q) {
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
