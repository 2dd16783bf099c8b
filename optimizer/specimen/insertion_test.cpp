// SPDX-License-Identifier: GPL-2.0-or-later
#include "specimen/insertion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/user_error.h"
#include "specimen/check_packing.h"
#include "specimen/data_file.h"
#include "specimen/neighbours.h"
#include "specimen/test_packings.h"

namespace bondlab {
namespace {

std::vector<SpecimenRequest> wide_ones() {
  SpecimenRequest ball = small_cylinder();
  ball.shape = ContainerShape::sphere;
  ball.r_min = 0.4e-3;
  std::vector<SpecimenRequest> requests = {small_rectangle(), small_disc(), small_cylinder(),
                                           notched_beam(), ball};
  for (SpecimenRequest &request : requests) {
    request.method = "insertion";
    request.r_ratio = 3;
  }
  return requests;
}

InsertedParticles insert(const SpecimenRequest &request, long tries = default_tries,
                         std::uint64_t seed = 1) {
  const Container box = request.container();
  RandomStream random(seed);
  return insert_particles(box, *size_distribution(request.size_settings(), box.dimension()), tries,
                          random);
}

double solid_share(const SpecimenRequest &request, const std::vector<Particle> &particles) {
  const Container box = request.container();
  double solid = 0;
  for (const Particle &p : particles)
    solid += box.dimension() == 2 ? std::acos(-1.0) * p.r * p.r
                                  : 4 * std::acos(-1.0) / 3 * p.r * p.r * p.r;
  return solid / box.measure();
}

TEST(Insertion, InEveryShapeParticlesAreInsideInRangeAndDontOverlap) {
  for (const SpecimenRequest &request : wide_ones()) {
    SCOPED_TRACE(shape_name(request.shape));
    const Container box = request.container();
    const auto sizes = size_distribution(request.size_settings(), box.dimension());
    const std::vector<Particle> particles = insert(request).particles;
    ASSERT_GT(particles.size(), 100u);
    for (std::size_t i = 0; i < particles.size(); ++i) {
      const Particle &p = particles[i];
      EXPECT_GE(p.r, sizes->smallest());
      EXPECT_LE(p.r, sizes->largest());
      EXPECT_GE(box.depth(p.x, p.y, p.z), p.r * (1 - 1e-12));
      for (std::size_t j = 0; j < i; ++j) EXPECT_GE(gap_between(p, particles[j]), -1e-12 * p.r);
      if (box.dimension() == 2) {
        EXPECT_EQ(p.z, 0);
      }
    }
  }
}

// As many as a place and a radius need; those that came before it, since later ones touch it too.
TEST(Insertion, InsertedParticlesTouchOneSurfaceMoreThanTheSpaceHasDimensions) {
  for (const SpecimenRequest &request : wide_ones()) {
    SCOPED_TRACE(shape_name(request.shape));
    const Container box = request.container();
    const InsertedParticles packing = insert(request);
    ASSERT_GT(packing.seeds, 0u);
    ASSERT_GT(packing.particles.size(), 2 * packing.seeds);
    for (std::size_t i = packing.seeds; i < packing.particles.size(); ++i) {
      const Particle &p = packing.particles[i];
      int contacts = 0;
      box.walls_within(p.x, p.y, p.z, p.r * (1 + 1e-9),
                       [&](double, double, double, double, int) { ++contacts; });
      for (std::size_t j = 0; j < i; ++j)
        contacts += gap_between(p, packing.particles[j]) < 1e-9 * p.r;
      EXPECT_GE(contacts, box.dimension() + 1) << i;
    }
  }
}

TEST(Insertion, SeedsAreOfTheSmallerHalfOfTheDistributionAndNotOnALattice) {
  SpecimenRequest request = small_cylinder();
  request.r_min = 0.2e-3;
  request.r_ratio = 4;
  const InsertedParticles packing = insert(request, 1);
  ASSERT_GT(packing.seeds, 150u);
  double largest = 0, smallest = 1, mean = 0;
  std::vector<double> heights;
  for (std::size_t i = 0; i < packing.seeds; ++i) {
    const Particle &p = packing.particles[i];
    largest = std::max(largest, p.r);
    smallest = std::min(smallest, p.r);
    mean += p.r / static_cast<double>(packing.seeds);
    heights.push_back(p.z);
  }
  EXPECT_LE(largest, 0.5e-3);
  EXPECT_GT(largest, 0.48e-3);
  EXPECT_LT(smallest, 0.22e-3);
  EXPECT_NEAR(mean, 0.35e-3, 0.02e-3);  // a standard error of 0.007e-3
  std::sort(heights.begin(), heights.end());
  EXPECT_EQ(std::adjacent_find(heights.begin(), heights.end()), heights.end());
}

TEST(Insertion, MoreTriesGiveTheSameParticlesAndThenMore) {
  for (const SpecimenRequest &request : wide_ones()) {
    SCOPED_TRACE(shape_name(request.shape));
    std::vector<Particle> before;
    for (const long tries : {1L, 10L, 100L, 1000L, 3000L}) {
      const std::vector<Particle> now = insert(request, tries).particles;
      ASSERT_GE(now.size(), before.size());
      for (std::size_t i = 0; i < before.size(); ++i) {
        EXPECT_EQ(now[i].x, before[i].x);
        EXPECT_EQ(now[i].r, before[i].r);
      }
      EXPECT_GE(solid_share(request, now), solid_share(request, before));
      before = now;
    }
    EXPECT_GT(before.size(), insert(request, 10).particles.size());
    SpecimenRequest few = request, many = request;
    few.tries = 100, many.tries = 3000;
    EXPECT_LE(make_specimen(few).particles.size(), make_specimen(many).particles.size());
  }
}

// Holes of the smallest size stay, unlike in a filling.
TEST(Insertion, GivesUpWhileThereAreHoles) {
  SpecimenRequest request = small_rectangle();
  request.r_min = 0.4e-3;
  request.r_ratio = 4;
  const Container box = request.container();
  const auto holes = [&](long tries) {
    const std::vector<Particle> particles = insert(request, tries).particles;
    int count = 0;
    for (double x = -0.0125; x < 0.0125; x += 0.1e-3)
      for (double y = 0; y < 0.05; y += 0.1e-3) {
        double room = box.depth(x, y, 0);
        for (const Particle &p : particles)
          room = std::min(room, std::hypot(x - p.x, y - p.y) - p.r);
        count += room > request.r_min;
      }
    return count;
  };
  EXPECT_GT(holes(10), 20);
  EXPECT_LT(holes(10000), holes(10) / 10);
}

// In a disc the points to try are even in the distance from the middle: half of them, and the most
// particles a share of the area, are within half the radius, a quarter of the area.
TEST(Insertion, TriesRoundContainersMoreInTheMiddle) {
  SpecimenRequest request = small_disc();
  request.r_min = 0.15e-3;
  request.r_ratio = 4;
  double inner = 0, outer = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const InsertedParticles packing = insert(request, 10, seed);
    for (std::size_t i = packing.seeds; i < packing.particles.size(); ++i)
      ++(std::hypot(packing.particles[i].x, packing.particles[i].y) < 0.25 * request.diameter
             ? inner
             : outer);
  }
  EXPECT_GT(inner / 0.25, 1.3 * outer / 0.75);
}

TEST(Insertion, PackingsHangTogetherAndCanBeTested) {
  for (SpecimenRequest request : wide_ones()) {
    SCOPED_TRACE(shape_name(request.shape));
    const Specimen specimen = make_specimen(request);
    EXPECT_EQ(specimen.statistics.clusters, 1);
    EXPECT_LT(specimen.statistics.max_overlap, 1e-9);
    EXPECT_LT(specimen.statistics.stress_over_modulus, 1e-9);
    EXPECT_NO_THROW(check_packing(specimen));
    // Denser than seeds, looser than a filling, which leaves no hole.
    request.tries = 100;
    const double looser = make_specimen(request).statistics.porosity;
    EXPECT_GT(looser, specimen.statistics.porosity);
    request.method = "filling";
    EXPECT_LT(make_specimen(request).statistics.porosity, looser);
  }
}

TEST(Insertion, TakesOutTheFewLooseOnesAndRefusesToTakeOutMany) {
  SpecimenRequest request = small_cylinder();
  request.method = "insertion";
  request.r_min = 0.3e-3;
  request.r_ratio = 2;
  request.tries = 30;
  const Specimen specimen = make_specimen(request);
  EXPECT_EQ(specimen.statistics.clusters, 1);
  EXPECT_NO_THROW(check_packing(specimen));
  request.tries = 1;
  try {
    make_specimen(request);
    ADD_FAILURE();
  } catch (const UserError &error) {
    EXPECT_NE(error.text().find("particles don't hang together with the rest (allowed: 10 %)"),
              std::string::npos)
        << error.text();
  }
}

TEST(Insertion, SameRequestSameBytesAnotherSeedOrTriesAnotherPacking) {
  SpecimenRequest request = wide_ones()[1];
  const std::string one = data_file_text(make_specimen(request)), key = specimen_key(request);
  EXPECT_EQ(data_file_text(make_specimen(request)), one);
  request.tries = 100;
  EXPECT_NE(data_file_text(make_specimen(request)), one);
  EXPECT_NE(specimen_key(request), key);
  request.tries = default_tries;
  request.seed = 2;
  EXPECT_NE(data_file_text(make_specimen(request)), one);
  EXPECT_NE(specimen_key(request), key);
}

TEST(Insertion, ItsKeyHasTheTriesAndOtherMethodsDont) {
  SpecimenRequest request = small_disc();
  request.method = "insertion";
  EXPECT_EQ(canonical_text(request),
            "bondlab specimen 1\ngenerator insertion-1\nshape disc\ndiameter 0.025\nr_min "
            "0.00049\nr_ratio 1.66\nsizes uniform\nseed 1\ndensity 2600\ntries 1000\n");
  for (const char *method : {"expansion", "filling"}) {
    request.method = method;
    const std::string key = specimen_key(request);
    request.tries = 7;
    EXPECT_EQ(specimen_key(request), key);
    request.tries = default_tries;
  }
}

}  // namespace
}  // namespace bondlab
