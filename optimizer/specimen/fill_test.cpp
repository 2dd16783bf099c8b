// SPDX-License-Identifier: GPL-2.0-or-later
#include "specimen/fill.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "specimen/check_packing.h"
#include "specimen/data_file.h"
#include "specimen/floaters.h"
#include "specimen/neighbours.h"
#include "specimen/test_packings.h"

namespace bondlab {
namespace {

SpecimenRequest filled(SpecimenRequest request) {
  request.method = "filling";
  return request;
}

TEST(Fill, ParticlesTouchAndDontOverlapInEveryShape) {
  SpecimenRequest ball = small_cylinder();
  ball.shape = ContainerShape::sphere;
  for (const SpecimenRequest &request :
       {small_rectangle(), small_disc(), small_cylinder(), notched_beam(), ball}) {
    SCOPED_TRACE(shape_name(request.shape));
    const Container box = request.container();
    const auto sizes = size_distribution(request.size_settings(), box.dimension());
    RandomStream random(1);
    const std::vector<Particle> particles = fill_container(box, *sizes, random);
    ASSERT_GT(particles.size(), 150u);
    std::size_t touching = 0;
    for (std::size_t i = 0; i < particles.size(); ++i) {
      const Particle &p = particles[i];
      EXPECT_GE(p.r, sizes->smallest() * (1 - 1e-9));
      EXPECT_LE(p.r, sizes->largest() * (1 + 1e-9));
      EXPECT_GE(box.depth(p.x, p.y, p.z), p.r * (1 - 1e-9));
      int contacts = 0;
      box.walls_within(p.x, p.y, p.z, p.r * (1 + 1e-6),
                       [&](double, double, double, double, int) { ++contacts; });
      for (std::size_t j = 0; j < particles.size(); ++j) {
        if (j == i) continue;
        const double gap = gap_between(p, particles[j]);
        EXPECT_GE(gap, -1e-9 * p.r);
        contacts += gap < 1e-6 * p.r;
      }
      touching += contacts >= box.dimension();
    }
    EXPECT_GT(static_cast<double>(touching), 0.98 * static_cast<double>(particles.size()));
  }
}

TEST(Fill, LeavesNoHoleOfTheSmallestSize) {
  SpecimenRequest request = small_rectangle();
  request.r_min = 0.4e-3;
  request.r_ratio = 4;
  const Container box = request.container();
  const auto sizes = size_distribution(request.size_settings(), 2);
  RandomStream random(1);
  const std::vector<Particle> particles = fill_container(box, *sizes, random);
  for (double x = -0.0125; x < 0.0125; x += 0.1e-3)
    for (double y = 0; y < 0.05; y += 0.1e-3) {
      double room = box.depth(x, y, 0);
      for (const Particle &p : particles) room = std::min(room, std::hypot(x - p.x, y - p.y) - p.r);
      EXPECT_LT(room, 1.02 * sizes->smallest()) << x << " " << y;
    }
}

TEST(Fill, PackingsAreWholeDenseAndFreeOfStress) {
  for (const SpecimenRequest &request : {filled(small_rectangle()), filled(small_cylinder())}) {
    const Specimen specimen = make_specimen(request);
    const SpecimenStatistics &s = specimen.statistics;
    EXPECT_EQ(s.clusters, 1);
    EXPECT_LT(s.max_overlap, 1e-9);
    EXPECT_LT(s.stress_over_modulus, 1e-9);
    EXPECT_LT(s.porosity_inner, request.container().dimension() == 2 ? 0.23 : 0.45);
    EXPECT_LT(s.fabric_ratio, 1.25);
    EXPECT_NO_THROW(check_packing(specimen));
  }
}

TEST(Fill, WiderSizesFillDenser) {
  SpecimenRequest narrow = filled(small_rectangle()), wide = narrow;
  wide.r_min = 0.5e-3;
  wide.r_ratio = 4;
  EXPECT_LT(make_specimen(wide).statistics.porosity_inner,
            make_specimen(narrow).statistics.porosity_inner - 0.02);
}

TEST(Fill, SameSeedSameBytesAnotherSeedAnotherPacking) {
  SpecimenRequest request = filled(small_disc());
  const std::string one = data_file_text(make_specimen(request));
  EXPECT_EQ(data_file_text(make_specimen(request)), one);
  request.seed = 2;
  EXPECT_NE(data_file_text(make_specimen(request)), one);
  EXPECT_NE(specimen_key(request), specimen_key(small_disc()));
}

// Every way of packing takes every distribution.
TEST(Fill, EveryDistributionIsPacked) {
  SpecimenRequest request = small_rectangle();
  request.r_median = 1e-3, request.r_spread = 0.3;
  for (const char *sizes : {"log-normal", "discrete", "d10-d50-d90"})
    for (const std::string &method : packing_methods()) {
      SCOPED_TRACE(sizes + (" " + method));
      request.sizes = sizes;
      request.method = method;
      const bool insertion = method == "insertion";  // needs wider sizes
      request.classes = {{0.8e-3, 2}, {insertion ? 1.7e-3 : 1.3e-3, 1}};
      request.d10 = 1.6e-3, request.d50 = 2e-3, request.d90 = insertion ? 3.2e-3 : 2.6e-3;
      const Specimen specimen = make_specimen(request);
      EXPECT_NO_THROW(check_packing(specimen));
      const auto wanted = size_distribution(request.size_settings(), 2);
      EXPECT_GT(specimen.statistics.r_min, 0.98 * wanted->smallest());
      EXPECT_LT(specimen.statistics.r_max, 1.17 * wanted->largest());
      EXPECT_NEAR(specimen.statistics.r_mean / wanted->moment(1), 1, 0.12);
    }
}

}  // namespace
}  // namespace bondlab
