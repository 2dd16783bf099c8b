// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: how much a beam between two grains is stretched, sheared, bent and twisted, and which forces
// and couples belong to these four strains, for finite rotations, from positions and orientations
// alone.
//
// Method: co-rotational and total. Each end carries a frame that at bonding had its first axis
// along the bond; n_i and n_j are these axes now, e the unit vector i -> j, l the distance.
// Strains:
//     stretch  l - l_0
//     bend     theta, the angle from n_i to n_j          } the swing and the twist of the rotation
//     twist    psi, of frame j against frame i about it  } from frame i to frame j, exactly
//     shear    beta, the angle from e to s = w_i n_i + w_j n_j: for small angles the weighted mean
//     of
//              the angles phi_i, phi_j from e to n_i and to n_j
// The weights, w_i + w_j = 2, say where between the centres shear is measured and its force acts:
// both 1 in the middle (a beam from centre to centre), 2 R_i/(R_i + R_j) and 2 R_j/(R_i + R_j) at
// the grains' contact. (Wang 2009, Acta Geotech. 4, 117-127, decomposes the relative rotation
// alike; there shear is the angle of n_i against e less theta/2, that is measured in the middle,
// while its force acts at the contact: not reciprocal, and without an energy, if the radii differ.)
// From a beam's energy
//     U = k_n (l - l_0)^2/2 + S beta^2/2 + k_b theta^2/2 + k_t psi^2/2,    S = k_s l_0^2
// the loads are its exact derivatives; no cycle of motions makes energy:
//     force on j   - k_n (l - l_0) e + S B (s - (s.e) e)/l
//     couple on i  k_b (theta/sin theta) n_i x n_j + k_t psi (n_i + n_j)/(1 + n_i.n_j), opposite on
//     j torque on i  S B (w_i n_i x e - h n_i x n_j),  on j  S B (w_j n_j x e + h n_i x n_j) B =
//     beta/|s x e|,  h = w_i w_j (s.e)/|s|^2
// Both momenta are kept identically. To first order this is the Timoshenko beam element with
// k_s = 12 E I/(l^3 (1 + Phi)) and 4 E I/l, 2 E I/l (PHYSICS.md 3.2).
//
// The reference is two unit quaternions a bond (the frames, seen from the particles), filled once
// at bonding, so that installing bonds at any orientations is exact; nothing is accumulated, so
// nothing drifts. Incremental laws and the logarithm of the relative rotation (its bend is 4 % too
// large at a twist of 1 rad) were rejected.
//
// Angles come as 2 atan2(sine, 1 + cosine): no acos, which has an angle floor of 1.5e-8 rad. atan
// on [0, 1] is a polynomial of degree 19 in the square, a Chebyshev fit with an error of 4e-17.
//
// Units: m, rad. Failure: NaN in, NaN out. Range: theta, psi and beta over [0, pi]; psi jumps from
// pi to -pi, and at theta or beta = pi directions have no meaning (the loads stay finite).
#ifndef BONDLAB_LAWS_BEAM_GEOMETRY_H
#define BONDLAB_LAWS_BEAM_GEOMETRY_H

#include <cmath>

#include "pair_geometry.h"

namespace bondlab::laws {

// atan(sqrt y)/sqrt y on [0, 1]; even and odd powers apart, so that a processor has two short
// chains.
[[gnu::always_inline]] inline double atan_ratio(double y) {
  const double z = y * y;
  double odd = -1.93423475928923e-05;
  odd = odd * z - 0.0011252544302234645;
  odd = odd * z - 0.00899108054265826;
  odd = odd * z - 0.02556862364437174;
  odd = odd * z - 0.040811247503178855;
  odd = odd * z - 0.052374234719188166;
  odd = odd * z - 0.06665764910689723;
  odd = odd * z - 0.09090899793217341;
  odd = odd * z - 0.14285714266926733;
  odd = odd * z - 0.333333333333307;
  double even = 0.00021423810738603946;
  even = even * z + 0.003751138483965141;
  even = even * z + 0.01671959606350739;
  even = even * z + 0.03387126702700675;
  even = even * z + 0.04668745304848529;
  even = even * z + 0.058768281144872724;
  even = even * z + 0.07692198997458294;
  even = even * z + 0.11111110578002083;
  even = even * z + 0.1999999999964796;
  even = even * z + 1.0;
  return odd * y + even;
}

// 2 atan2(a, b) for a, b >= 0, and the same divided by a. Both 0: finite. inverse: 1/larger(a, b).
struct DoubleAngle {
  double angle, over;
};
[[gnu::always_inline]] inline double larger(double a, double b) {
  const double large = a > b ? a : b;
  return large > 1e-100 ? large : 1e-100;
}
[[gnu::always_inline]] inline DoubleAngle double_angle(double a, double b, double inverse) {
  const bool steep = a > b;
  const double small = steep ? b : a;
  const double r = small * inverse, twice = 2.0 * atan_ratio(r * r);
  const double angle = steep ? 3.14159265358979323846 - r * twice : r * twice;
  return {angle, steep ? angle * inverse : twice * inverse};
}
[[gnu::always_inline]] inline DoubleAngle double_angle(double a, double b) {
  return double_angle(a, b, 1.0 / larger(a, b));
}

struct Quaternion {
  double w, x, y, z;
};
inline Quaternion operator*(Quaternion a, Quaternion b) {
  return {
      a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
      a.w * b.y + a.y * b.w + a.z * b.x - a.x * b.z, a.w * b.z + a.z * b.w + a.x * b.y - a.y * b.x};
}
inline Quaternion conjugate(Quaternion q) { return {q.w, -q.x, -q.y, -q.z}; }
// Where a frame's first axis points.
inline Vec3 first_axis(Quaternion q) {
  return {q.w * q.w + q.x * q.x - q.y * q.y - q.z * q.z, 2.0 * (q.x * q.y + q.w * q.z),
          2.0 * (q.x * q.z - q.w * q.y)};
}

// A frame whose first axis is the unit vector e; which one of them is of no consequence.
inline Quaternion frame_along(Vec3 e) {
  // the smallest turn of the nearer of x and -x to e; for -x, x is first turned there about z
  const double flip = e.x < 0.0 ? -1.0 : 1.0, c = 1.0 + flip * e.x;
  const double norm = 1.0 / std::sqrt(2.0 * c);
  const Quaternion turn{c * norm, 0.0, -flip * e.z * norm, flip * e.y * norm};
  return flip > 0.0 ? turn : turn * Quaternion{0.0, 0.0, 0.0, 1.0};
}

// The reference of a new bond: its frame along x_j - x_i, as seen from each particle. Written once.
struct BeamReference3 {
  Quaternion i, j;
};
inline BeamReference3 beam_reference(Vec3 xi, Vec3 xj, Quaternion qi, Quaternion qj) {
  const Vec3 d = xj - xi;
  const Quaternion frame = frame_along((1.0 / std::sqrt(dot(d, d))) * d);
  return {conjugate(qi) * frame, conjugate(qj) * frame};
}

// Strains of one bond in 3D, and what multiplies its stiffnesses in the loads (see above).
struct BeamShape3 {
  double distance, inverse_distance;
  Vec3 e;
  double shear, bend, twist;       // beta, theta, psi
  Vec3 bend_couple, twist_couple;  // on i, over k_b and k_t
  Vec3 shear_force;                // on i, over S: -B (s - (s.e) e)/l
  Vec3 shear_i, shear_j;           // torques over S

  // frame_i, frame_j: particle orientation times reference
  [[gnu::always_inline]] BeamShape3(Vec3 d, Quaternion frame_i, Quaternion frame_j,
                                    double weight_i = 1.0, double weight_j = 1.0) {
    distance = std::sqrt(dot(d, d));
    inverse_distance = 1.0 / distance;
    e = inverse_distance * d;
    const Vec3 ni = first_axis(frame_i), nj = first_axis(frame_j), sum = ni + nj,
               s = weight_i * ni + weight_j * nj;

    // of frame j seen from frame i: scalar part and component along the first axis
    const Quaternion &a = frame_i, &b = frame_j;
    const double scalar = a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z;
    const double along = a.w * b.x - a.x * b.w - a.y * b.z + a.z * b.y;
    const double close = 2.0 * (scalar * scalar + along * along);  // 1 + n_i.n_j = |s|^2/2
    const double one_plus = close > 1e-24 ? close : 1e-24;
    const Vec3 x = cross(ni, nj), wi = weight_i * cross(ni, e), wj = weight_j * cross(nj, e), w = wi + wj;
    const double sine = std::sqrt(dot(x, x)), across = std::sqrt(dot(w, w));
    const double apart = weight_i - weight_j, both = weight_i * weight_j;
    const double size2 = apart * apart + 2.0 * both * one_plus;  // |s|^2
    const double se = dot(s, e), length = std::sqrt(size2) + se, ahead = length > 0.0 ? length : 0.0;
    const double turn = std::fabs(along), still = std::fabs(scalar);

    // what divides, two and three at a time: divisions are the slowest of all this
    const double l1 = larger(turn, still), l2 = larger(sine, one_plus), l3 = larger(across, ahead);
    const double pair = 1.0 / (one_plus * l2), three = 1.0 / (l1 * l3 * size2);

    const DoubleAngle half_twist = double_angle(turn, still, three * l3 * size2);
    twist = (scalar < 0.0 ? -along : along) * half_twist.over;
    twist_couple = (twist * (pair * l2)) * sum;
    const DoubleAngle swing = double_angle(sine, one_plus, pair * one_plus);
    bend = swing.angle;
    bend_couple = swing.over * x;
    const DoubleAngle off = double_angle(across, ahead, three * l1 * size2);
    shear = off.angle;
    const double h = both * se * (three * l1 * l3);
    shear_force = (-off.over * inverse_distance) * (s - se * e);
    shear_i = off.over * (wi - h * x);
    shear_j = off.over * (wj + h * x);
  }
};

// The same in the plane; angles turn about z and carry signs: bend from n_i to n_j, shear from e to
// m.
struct BeamReference2 {
  double ix, iy, jx, jy;  // direction of the bond seen from i and from j
};
// Cosine and sine of the angle of a particle whose quaternion is (w, 0, 0, z).
inline BeamReference2 beam_reference(double dx, double dy, double wi, double zi, double wj,
                                     double zj) {
  const double inverse = 1.0 / std::sqrt(dx * dx + dy * dy), x = inverse * dx, y = inverse * dy;
  const double ci = wi * wi - zi * zi, si = 2.0 * wi * zi;
  const double cj = wj * wj - zj * zj, sj = 2.0 * wj * zj;
  return {ci * x + si * y, ci * y - si * x, cj * x + sj * y, cj * y - sj * x};
}

struct BeamShape2 {
  double distance, ex, ey;
  double shear, bend;       // beta, theta
  double share_i, share_j;  // of the shear's torque that goes to i and to j; their sum is 1

  [[gnu::always_inline]] BeamShape2(double dx, double dy, double wi, double zi, double wj,
                                    double zj, const BeamReference2 &r, double weight_i = 1.0,
                                    double weight_j = 1.0) {
    distance = std::sqrt(dx * dx + dy * dy);
    const double inverse = 1.0 / distance;
    ex = inverse * dx;
    ey = inverse * dy;
    const double ci = wi * wi - zi * zi, si = 2.0 * wi * zi;
    const double cj = wj * wj - zj * zj, sj = 2.0 * wj * zj;
    const double ix = ci * r.ix - si * r.iy, iy = ci * r.iy + si * r.ix;
    const double jx = cj * r.jx - sj * r.jy, jy = cj * r.jy + sj * r.jx;
    const double turn = ix * jy - iy * jx, close = 1.0 + ix * jx + iy * jy;
    const double one_plus = close > 1e-24 ? close : 1e-24;
    bend = double_angle(std::fabs(turn), one_plus).over * turn;
    const double sx = weight_i * ix + weight_j * jx, sy = weight_i * iy + weight_j * jy;
    const double apart = weight_i - weight_j, both = weight_i * weight_j;
    const double size2 = apart * apart + 2.0 * both * one_plus;  // |s|^2
    const double off = ex * sy - ey * sx, ahead = std::sqrt(size2) + ex * sx + ey * sy;
    shear = double_angle(std::fabs(off), ahead > 0.0 ? ahead : 0.0).over * off;
    share_i = (weight_i * apart + both * one_plus) / size2;  // w_i s.n_i/|s|^2
    share_j = 1.0 - share_i;
  }
};

}  // namespace bondlab::laws

#endif
