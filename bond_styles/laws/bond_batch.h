// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: the plain arrays every bond and contact law reads and writes, one block of pairs at a time.
//
// A block is a fixed number of lanes. It is always processed whole: the unused lanes of the last
// block are padded with a harmless pair. So every pair goes through the same vector instructions
// whatever its place in the list is, and gives the same bits on 1, 2 or 4 ranks.
//
// Units: SI (m, rad, N, N m). Vectors in world axes. "i" is the particle with the smaller tag,
// "j" the other one. Forces and moments in the outputs act ON i; the force on j is the opposite,
// its moment follows from the lever arms (see PairLoads).
//
// Limits: a law never looks at particles, neighbour lists or an engine. It gets what it needs here.
#ifndef BONDLAB_LAWS_BOND_BATCH_H
#define BONDLAB_LAWS_BOND_BATCH_H

namespace bondlab::laws {

// Lanes in a block: 8 AVX-512 vectors of doubles; temporaries of a block stay in the first cache.
// Every array of a block is a whole number of cache lines, so aligning the struct aligns them all.
inline constexpr int kBlock = 64;

// Relative motion of one block of pairs over one time step, 3D.
struct alignas(64) Kinematics3 {
  double dx[kBlock], dy[kBlock], dz[kBlock];  // x_j - x_i now, m
  double ux[kBlock], uy[kBlock], uz[kBlock];  // its change over the step, m
  // rotation of the bond's two ends over the step, weighted by radius:
  // (R_i w_i + R_j w_j) dt / (R_i + R_j), rad
  double sx[kBlock], sy[kBlock], sz[kBlock];
  double qx[kBlock], qy[kBlock], qz[kBlock];  // (w_j - w_i) dt, rad
  double ri[kBlock], rj[kBlock];              // radii, m
  double per_both[kBlock];                    // 1/(R_i + R_j), 1/m
};

// Loads of one block of pairs, 3D. The contact point is a fraction R_i/(R_i+R_j) of the way from
// i to j, so that the arms always sum to the current distance. With e the unit vector i -> j:
//   force on i = f, on j = -f
//   torque on i = m + (a_i e) x f,  torque on j = -m + (a_j e) x f,  a_i + a_j = |x_j - x_i|
struct alignas(64) PairLoads3 {
  double fx[kBlock], fy[kBlock], fz[kBlock];     // N
  double tix[kBlock], tiy[kBlock], tiz[kBlock];  // N m, on i
  double tjx[kBlock], tjy[kBlock], tjz[kBlock];  // N m, on j
};

// The same in the plane. Rotations and moments are about +z.
struct alignas(64) Kinematics2 {
  double dx[kBlock], dy[kBlock];  // x_j - x_i now, m
  double ux[kBlock], uy[kBlock];  // its change over the step, m
  double s[kBlock];               // (R_i w_i + R_j w_j) dt / (R_i + R_j), rad
  double q[kBlock];               // (w_j - w_i) dt, rad
  double ri[kBlock], rj[kBlock];  // radii, m
  double per_both[kBlock];        // 1/(R_i + R_j), 1/m
};

struct alignas(64) PairLoads2 {
  double fx[kBlock], fy[kBlock];  // N
  double ti[kBlock], tj[kBlock];  // N m
};

// Orientations of the two ends of one block of pairs: unit quaternions (w, x, y, z) that turn a
// particle's body axes, which at its creation were the world's, to where they are now. Only for laws
// that need them. In the plane w and z alone.
struct alignas(64) Orientations3 {
  double iw[kBlock], ix[kBlock], iy[kBlock], iz[kBlock];
  double jw[kBlock], jx[kBlock], jy[kBlock], jz[kBlock];
};
struct alignas(64) Orientations2 {
  double iw[kBlock], iz[kBlock];
  double jw[kBlock], jz[kBlock];
};

// What a law says of a bond after a step.
enum class BondFate : unsigned char {
  intact = 0,
  broken_in_tension = 1,
  broken_in_shear = 2,
  broken_in_crushing = 3
};

}  // namespace bondlab::laws

#endif
