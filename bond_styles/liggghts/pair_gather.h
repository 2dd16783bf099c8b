// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: between the engine's particle arrays and a law's blocks: read the relative motion of a block
// of pairs, add up its loads in order of rows. Shared by bonds and contacts.
//
// Velocities are those of the half step, so dt times their difference is exactly the change of
// distance since the last force. With dt = 0 (set-up of a run) nothing moves and no history advances.
// Loads go to own particles only: the other side of a cut pair is computed by its owner.
// Units: m, m/s, rad/s, s, N, N m.
#ifndef BONDLAB_PAIR_GATHER_H
#define BONDLAB_PAIR_GATHER_H

#include <algorithm>

#include "laws/bond_batch.h"
#include "pair_table.h"

namespace bondlab {

// x, v, w: the engine's [n][3] arrays; ri, rj: radii of the block's lanes.
inline void gather(const PairTable &t, int first, double dt, double *const *x, double *const *v,
                   double *const *w, const double *ri, const double *rj,
                   laws::Kinematics3 &k) {
  const double *X = x[0], *V = v[0], *W = w[0];
  const int *at_lo = t.at_lo.data() + first, *at_hi = t.at_hi.data() + first;
#pragma GCC ivdep
  for (int b = 0; b < laws::kBlock; ++b) {
    const int i = 3 * at_lo[b], j = 3 * at_hi[b];
    k.dx[b] = X[j] - X[i], k.dy[b] = X[j + 1] - X[i + 1], k.dz[b] = X[j + 2] - X[i + 2];
    k.ux[b] = dt * (V[j] - V[i]);
    k.uy[b] = dt * (V[j + 1] - V[i + 1]);
    k.uz[b] = dt * (V[j + 2] - V[i + 2]);
    const double share = dt / (ri[b] + rj[b]), si = share * ri[b], sj = share * rj[b];
    k.sx[b] = si * W[i] + sj * W[j];
    k.sy[b] = si * W[i + 1] + sj * W[j + 1];
    k.sz[b] = si * W[i + 2] + sj * W[j + 2];
    k.qx[b] = dt * (W[j] - W[i]);
    k.qy[b] = dt * (W[j + 1] - W[i + 1]);
    k.qz[b] = dt * (W[j + 2] - W[i + 2]);
    k.ri[b] = ri[b], k.rj[b] = rj[b];
  }
}

inline void gather(const PairTable &t, int first, double dt, double *const *x, double *const *v,
                   double *const *w, const double *ri, const double *rj,
                   laws::Kinematics2 &k) {
  const double *X = x[0], *V = v[0], *W = w[0];
  const int *at_lo = t.at_lo.data() + first, *at_hi = t.at_hi.data() + first;
#pragma GCC ivdep
  for (int b = 0; b < laws::kBlock; ++b) {
    const int i = 3 * at_lo[b], j = 3 * at_hi[b];
    k.dx[b] = X[j] - X[i], k.dy[b] = X[j + 1] - X[i + 1];
    k.ux[b] = dt * (V[j] - V[i]);
    k.uy[b] = dt * (V[j + 1] - V[i + 1]);
    const double share = dt / (ri[b] + rj[b]);
    k.s[b] = share * ri[b] * W[i + 2] + share * rj[b] * W[j + 2];
    k.q[b] = dt * (W[j + 2] - W[i + 2]);
    k.ri[b] = ri[b], k.rj[b] = rj[b];
  }
}

inline void scatter(const PairTable &t, int first, int nlocal, const laws::PairLoads3 &p,
                    double **force, double **torque) {
  double *F = force[0], *T = torque[0];
  const int n = std::min(laws::kBlock, t.size() - first);
  const int *own_lo = t.own_lo.data() + first, *own_hi = t.own_hi.data() + first;
  for (int b = 0; b < n; ++b) {
    const int i = own_lo[b], j = own_hi[b];
    if (i < nlocal) {
      F[3 * i] += p.fx[b], F[3 * i + 1] += p.fy[b], F[3 * i + 2] += p.fz[b];
      T[3 * i] += p.tix[b], T[3 * i + 1] += p.tiy[b], T[3 * i + 2] += p.tiz[b];
    }
    if (j < nlocal) {
      F[3 * j] -= p.fx[b], F[3 * j + 1] -= p.fy[b], F[3 * j + 2] -= p.fz[b];
      T[3 * j] += p.tjx[b], T[3 * j + 1] += p.tjy[b], T[3 * j + 2] += p.tjz[b];
    }
  }
}

inline void scatter(const PairTable &t, int first, int nlocal, const laws::PairLoads2 &p,
                    double **force, double **torque) {
  double *F = force[0], *T = torque[0];
  const int n = std::min(laws::kBlock, t.size() - first);
  const int *own_lo = t.own_lo.data() + first, *own_hi = t.own_hi.data() + first;
  for (int b = 0; b < n; ++b) {
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

}  // namespace bondlab

#endif
