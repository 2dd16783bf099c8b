// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: turn the relative motion of a pair over a step into what all laws need: the unit vector, the
// distance, the relative shear displacement, and how a stored transverse vector is carried along.
//
// Method. A transverse vector v (shear force, bending moment) stored with the old direction e0 is
// carried to the new direction e by the smallest rotation that takes e0 to e,
//     v' = v - (v.e) (e0 + e) / (1 + e0.e),
// and then spun about e by the mean spin of the pair (as a fraction of tan(psi/2), so its length is
// kept to rounding). Projecting on the new plane without this loses length at every step, which
// shows as a slow relaxation of a bond that merely rotates (seen in public codes, PHYSICS.md 3.1).
//
// The rotation of the pair over a step is a spin psi about the bond between two halves of that
// smallest rotation (by theta about n = e0 x e), with m half-way between e0 and e. Its rotation
// vector is then, without approximation,
//     s = S/sin(S/2) [ sin(psi/2) m + sin(theta/2) cos(psi/2) n ],   cos(S/2) = cos(theta/2) cos(psi/2)
// so a rigid motion has s.m = psi (1 + theta^2/24) and s.n = theta (1 - psi^2/12), to the fifth order
// of the angles of a step, and no other component. What the particles turned beyond that, times the
// distance, is the shear displacement: zero for any rigid motion, also when the bond spins and
// tumbles at once (with e in place of m it is psi theta / 2 a step, which adds up over turns to a
// shear of first order in the step). Increments are taken half-way and carried on to e, so that
// strain during rotation is integrated to second order.
//
// Divisions and square roots take most of the time of a law, so one division serves both lengths, and
// what depends on the turn and the spin of the step alone is a series: a carried vector keeps its length to
// 1e-15 at angles of 0.03 rad and to 1e-9 at 0.15 rad a step (pair_geometry_test.cpp); a usable time step has
// less than 0.01 rad, since a bond that turns so fast is torn apart by its ends.
//
// Source: geometry only. The old direction is x_j - x_i minus its change over the step, so nothing
// about directions is stored. Units: m, rad. Limits: the bond turns, and spins, by less than about
// 0.2 rad a step.
#ifndef BONDLAB_LAWS_PAIR_GEOMETRY_H
#define BONDLAB_LAWS_PAIR_GEOMETRY_H

#include <cmath>

namespace bondlab::laws {

struct Vec3 {
  double x, y, z;
};
inline Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3 operator*(double s, Vec3 a) { return {s * a.x, s * a.y, s * a.z}; }
inline double dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3 cross(Vec3 a, Vec3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

// asin(s)/s to s^4: exact to 1e-9 at a turn of 0.04 rad, far beyond any usable time step.
inline double angle_over_sine(double s2) { return 1.0 + s2 * (1.0 / 6.0 + s2 * (3.0 / 40.0)); }

// (1 - y)^(-1/2); what is left out is below 0.25 y^5/(1 - y).
inline double inverse_cosine(double y) {
  double s = 35.0 / 128.0;
  s = s * y + 5.0 / 16.0;
  s = s * y + 3.0 / 8.0;
  s = s * y + 0.5;
  return s * y + 1.0;
}

// One pair over one step in 3D. Increments are given in the frame at its end.
struct PairStep3 {
  double distance;  // now, m
  Vec3 e;           // unit vector i -> j now
  Vec3 both;        // e0 + e, e0 that of one step ago
  Vec3 shear;       // displacement of j relative to i across e over the step, m
  double twist;     // rotation of j relative to i about the bond over the step, rad
  Vec3 bend;        // rotation of j relative to i across e over the step, rad
  double carry;     // 1 / (1 + e0.e)
  double per_sum;   // 1 / (|d| + |d_0|), 1/m
  double cos_spin, sin_spin;  // of psi

  PairStep3(Vec3 d, Vec3 u, Vec3 s, Vec3 q) {
    const Vec3 d0 = d - u;
    distance = std::sqrt(dot(d, d));
    const double distance0 = std::sqrt(dot(d0, d0)), sum = distance + distance0;
    const double inverse = 1.0 / (distance * distance0 * sum);
    e = (inverse * distance0 * sum) * d;
    const Vec3 e0 = (inverse * distance * sum) * d0;
    per_sum = inverse * distance * distance0;
    both = e0 + e;
    const Vec3 turn = cross(e0, e), gap = e - e0;
    const double y = 0.25 * dot(gap, gap), sine2 = 4.0 * y * (1.0 - y);  // 1 + e0.e = 2 (1 - y)
    const double inverse_half = inverse_cosine(y);
    carry = 0.5 * inverse_half * inverse_half;
    const Vec3 m = (0.5 * inverse_half) * both;
    const double along = dot(s, m);
    const double spin = along * (1.0 - sine2 * (1.0 / 24.0)), spin2 = spin * spin;
    sin_spin = spin * (1.0 + spin2 * (-1.0 / 6 + spin2 * (1.0 / 120)));
    cos_spin = 1.0 + spin2 * (-0.5 + spin2 * (1.0 / 24 + spin2 * (-1.0 / 720)));

    const double angle = angle_over_sine(sine2) * (1.0 - spin2 * (1.0 / 12.0));
    const Vec3 beyond = cross(angle * turn - (s - along * m), e);
    shear = (0.5 * sum) * half_spun(beyond, spin);
    twist = dot(q, m);
    const Vec3 across = q - twist * m;
    bend = half_spun(across - dot(across, e) * e, spin);
  }

  // A vector across e, spun about e by half of psi.
  Vec3 half_spun(Vec3 v, double spin) const { return v + (0.5 * spin) * cross(e, v); }

  Vec3 carried(Vec3 v) const {
    const double along = dot(v, e) * carry;
    v = v - along * both;
    const Vec3 w = cross(e, v);
    return cos_spin * v + sin_spin * w;
  }
};

// One pair over one step in the plane. The transverse direction is t = z x e, so a stored shear
// force is a scalar along t and needs no carrying.
struct PairStep2 {
  double distance, ex, ey;
  double shear;    // displacement of j relative to i along t over the step, m
  double per_sum;  // as in 3D

  PairStep2(double dx, double dy, double ux, double uy, double s) {
    const double x0 = dx - ux, y0 = dy - uy;
    distance = std::sqrt(dx * dx + dy * dy);
    const double distance0 = std::sqrt(x0 * x0 + y0 * y0), sum = distance + distance0;
    const double inverse = 1.0 / (distance * distance0 * sum), inverse_now = inverse * distance0 * sum;
    ex = inverse_now * dx;
    ey = inverse_now * dy;
    per_sum = inverse * distance * distance0;
    const double turn = (x0 * dy - y0 * dx) * (inverse * sum);
    const double angle = angle_over_sine(turn * turn) * turn;
    shear = 0.5 * sum * (angle - s);
  }
};

}  // namespace bondlab::laws

#endif
