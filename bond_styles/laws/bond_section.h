// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: the cross-section of a bond: a disc of radius R in 3D, in the plane a strip of width 2 R and the
// thickness t of the discs.
//     3D: A = pi R^2,  I = pi R^4/4,  J = pi R^4/2        2D: A = 2 R t,  I = 2 R^3 t/3,  no twist
// With the inverses laws divide by, from one division (the slowest thing a law does); what a law
// doesn't use costs nothing.
// Units: m, m2, m4. Failure: none; radius 0 gives infinities.
#ifndef BONDLAB_LAWS_BOND_SECTION_H
#define BONDLAB_LAWS_BOND_SECTION_H

namespace bondlab::laws {

inline constexpr double kPi = 3.14159265358979323846;

struct BondSection {
  double area, bend, twist;
  double per_area, per_bend, per_twist;  // inverses; per_twist is 0 without twist
};

// per_radius2: 1/R^2, for who has it.
inline BondSection round_section(double radius, double per_radius2) {
  const double r2 = radius * radius, area = kPi * r2, per_area = (1.0 / kPi) * per_radius2;
  const double per_bend = 4.0 * per_area * per_radius2;
  return {area, 0.25 * area * r2, 0.5 * area * r2, per_area, per_bend, 0.5 * per_bend};
}
inline BondSection round_section(double radius) { return round_section(radius, 1.0 / (radius * radius)); }

inline BondSection strip_section(double radius, double thickness) {
  const double r2 = radius * radius, area = 2.0 * radius * thickness, per_bend = 3.0 / (area * r2);
  return {area, (1.0 / 3.0) * area * r2, 0.0, (1.0 / 3.0) * per_bend * r2, per_bend, 0.0};
}

}  // namespace bondlab::laws

#endif
