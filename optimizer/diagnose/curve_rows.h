// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: the rows that the diagnosis takes from one curve of a test, the same for a measured curve
//   and a simulated one.
// Method: landmarks at shares of the peak load, on the loading branch: toe, slope, before the peak,
//   peak, the way down and what is carried in the end, from the columns there are. A curve with
//   axial_stress is a compression or tension (strain_machine or else strain_platen, strain_axial,
//   strain_lateral are used where given), one with force_top a test of a load over a travel (machine
//   or else displacement; deflection is a beam's gauge); another test gives the logarithms of its
//   responses. Compliances, strengths and falls are logarithms, so that a row's change is a share;
//   toes and what is carried in the end are shares, which stay finite where a logarithm does not.
//   A column `phase` (fix drive's: 2 holds the displacement, 3 the load, 4 unloads) tells of a
//   programme. A curve that turns under load gives the compliance up to the first turn, the first
//   unloading's stiffness over that of loading and the strain it leaves, what the first holds gain
//   and lose, and its peak; the other rows would straddle the turns.
// Units: SI in; rows have none. Failure: a row that a curve cannot give is NaN.
#pragma once

#include <Eigen/Dense>
#include <map>
#include <string>
#include <vector>

#include "diagnose/row_key.h"
#include "forward/curve.h"
#include "study/test_definition.h"

namespace bondlab::diagnose {

struct CurveQuantity {
  CurvePart part;
  std::string name;
};

// What every curve with these columns gives. `responses` are used when the columns carry no
// landmarks.
std::vector<CurveQuantity> quantities_of(const std::vector<std::string> &columns,
                                         const std::vector<std::string> &responses);

// In the same order.
Eigen::VectorXd rows_of_curve(const Curve &curve, const std::vector<CurveQuantity> &quantities,
                              const TestDefinition &test,
                              const std::map<std::string, double> &variables);

// Loads and stresses times `factor`, as a wrong conversion makes them.
void scale_loads(Curve &curve, double factor);

}  // namespace bondlab::diagnose
