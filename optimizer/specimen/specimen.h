// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: make a seeded, dense, isotropic, nearly stress-free packing of discs or spheres in a
//   rectangle, disc, cylinder, prism or sphere, notched or not (container.h).
// Method: the material genesis of Potyondy & Cundall 2004 (Int. J. Rock Mech. Min. Sci. 41,
//   1329-1364, appendix): random places, radii scaled to a low isotropic stress between rigid
//   frictionless walls, floaters grown until they are held. Differences: equilibrium by energy
//   minimisation (relax.h) instead of damped dynamics, and the stress is reached from above, from
//   a compressed state, which leaves the density even over the specimen. specimen.md has the
//   figures.
// Units: SI (m, kg/m3). The generator itself works in mean radii.
// Failure: UserErrors from check_request() for a request that makes no sense; UserError when no
//   equilibrium is found.
// Limits: the count follows from the container and the sizes; to reach the stress the radii of a
//   packing are all scaled by one factor within about 0.5 % of 1, and a floater may grow up to 15 %
//   beyond r_max (30 % where it would have no bond otherwise). Statistics give the radii as they
//   are.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "specimen/container.h"
#include "specimen/insertion.h"
#include "specimen/size_distribution.h"
#include "specimen/statistics.h"

namespace bondlab {

struct SpecimenRequest {
  ContainerShape shape = ContainerShape::rectangle;
  // m; which of them a shape has, and where they lie: container.h
  double width = 0;                         // rectangle, prism: along x
  double height = 0;                        // rectangle, prism: along y; cylinder: along its axis z
  double diameter = 0;                      // disc, cylinder, sphere
  double length = 0;                        // prism: along z
  double notch_depth = 0, notch_width = 0;  // rectangle, cylinder, prism; depth 0: no notch
  double r_min = 0;                         // m; smallest radius; uniform
  double r_ratio = 1.66;                    // largest over smallest radius; uniform
  std::string sizes = "uniform";            // a name of size_distribution_names()
  double r_median = 0, r_spread = 0;        // m, 1; log-normal
  std::vector<SizeClass> classes;           // discrete
  double d10 = 0, d50 = 0, d90 = 0;         // m; d10-d50-d90
  std::string method = "expansion";         // a name of packing_methods()
  long tries = default_tries;               // insertion: failures in a row until it gives up
  std::uint64_t seed = 1;
  double density =
      2600;  // kg/m3, of the particles; written to the file, without influence on the packing
  double overlap = 2e-5;  // mean overlap of contacts over mean radius: the locked-in stress, about
                          // 2e-5 of the modulus E_c

  Dimensions dimensions() const {
    return {width, height, diameter, length, notch_depth, notch_width};
  }
  void set_dimensions(const Dimensions &size) {
    width = size.width, height = size.height, diameter = size.diameter, length = size.length;
    notch_depth = size.notch_depth, notch_width = size.notch_width;
  }
  SizeSettings size_settings() const {
    return {sizes, r_min, r_ratio, r_median, r_spread, classes, d10, d50, d90};
  }
  Container container() const { return Container(shape, dimensions()); }
};

struct Specimen {
  SpecimenRequest request;
  std::vector<Particle> particles;  // m; particle i has the permanent id i + 1; space-filling order
  std::vector<double> densities;    // kg/m3
  SpecimenStatistics statistics;
};

struct SpecimenProgress {
  std::string stage;    // what is being done, in words
  double fraction = 0;  // 0 .. 1, rough
};
using SpecimenProgressCallback = std::function<void(const SpecimenProgress &)>;

// "expansion": radii scaled to a low stress; "filling": touching particles, no stress (fill.h);
// "insertion": the same as GenGeo does it, with holes left (insertion.h).
std::vector<std::string> packing_methods();

// Throws UserErrors with everything that is wrong with a request.
void check_request(const SpecimenRequest &request);

// The request with its numbers rounded to 12 digits: "0.56 mm" and 0.56e-3 differ in the last bit,
// and a packing would make that the difference of two seeds.
SpecimenRequest canonical_request(const SpecimenRequest &request);

// The same request gives the same bytes on every machine.
Specimen make_specimen(const SpecimenRequest &request,
                       const SpecimenProgressCallback &progress = {});

// All that the packing depends on, as text with the generator's version; and its hash, 16
// hexadecimal digits.
std::string canonical_text(const SpecimenRequest &request);
std::string specimen_key(const SpecimenRequest &request);

}  // namespace bondlab
