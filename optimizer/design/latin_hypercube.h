// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: a seeded Latin hypercube of points in the unit cube, spread out by exchange.
// Method: one point in each of n equal strata of every axis (McKay, Beckman & Conover,
//   Technometrics 21, 1979), placed at random in its stratum; then the better of many random
//   exchanges of two coordinates along one axis, judged by the phi_p criterion of Morris & Mitchell
//   (J. Stat. Plan. Inference 43, 1995), a smooth stand-in for the smallest distance. Exchange
//   keeps the strata, so that every axis stays evenly covered.
// Why not Sobol': a dozen points is too few for its balance to show, and n is then bound to powers
//   of two.
// Units: none; ParameterSpace::from_unit_cube turns a point into parameter values. Failure: none (0
//   points give none).
#pragma once

#include <cstdint>
#include <vector>

namespace bondlab {

std::vector<std::vector<double>> latin_hypercube(int points, int dimensions, std::uint64_t seed);

// Smallest Euclidean distance of two points.
double smallest_distance(const std::vector<std::vector<double>> &points);

}  // namespace bondlab
