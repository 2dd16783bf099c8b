// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: a picture of a specimen at the end of its test, with every broken bond drawn as a crack.
// Method: 2D specimens are drawn whole; of 3D ones a slice (uniaxial: the plane through the axis;
//   Brazilian: the middle of the thickness), spheres as the circles the plane cuts out of them,
//   cracks within one mean radius of it. A crack is a segment across the line of its two particles,
//   as long as the bond was wide (twice the smaller radius). While the two are still near (less
//   than 1.5 times the sum of their radii apart) it lies between them at the end, so that it moves
//   with its grains; otherwise it lies at the place of breaking. Colour tells the mode, shade the
//   time: before 90 % of the peak load, from there to the peak, after it.
// Units: SI in, pixels out.
// Failure: none; without particles there is no picture (empty string).
// Limits: a crack whose particles are not in the file is a dot; particles far outside the body are
//   not drawn, but counted.
#pragma once

#include <string>
#include <vector>

#include "forward/curve.h"
#include "report/report.h"

namespace bondlab {

struct Crack {
  double x = 0, y = 0;    // in the picture's plane, m
  double dx = 0, dy = 0;  // half of the segment, m; both 0: direction not known
  bool shear = false;
  int stage = 2;    // 0 before 90 % of the peak load, 1 up to the peak, 2 after it
  double time = 0;  // s
};

struct SpecimenView {
  struct Disc {
    double x, y, r;
    int broken;  // bonds it lost
  };
  std::string horizontal, vertical;  // names of the axes: x, y or z
  bool slice = false;
  bool staged = false;  // the curve told when the peak was
  std::vector<Disc> discs;
  std::vector<Crack> cracks;
  std::size_t out_of_view = 0;  // particles far outside
  std::size_t events = 0;       // broken bonds in the log, in the slice or not
};

// `curve` may have no rows: then all cracks are of one stage.
SpecimenView view_specimen(const std::vector<EndParticle> &particles,
                           const std::vector<BrokenBond> &events, const Curve &curve,
                           const ReportRunFiles &run);

std::string draw_specimen(const SpecimenView &view, const std::string &title,
                          const std::string &sentence);
std::string specimen_data(const SpecimenView &view);  // TSV: discs, then cracks

}  // namespace bondlab
