// SPDX-License-Identifier: GPL-2.0-or-later
#include "report/specimen_picture.h"

#include <gtest/gtest.h>

#include <cmath>

#include "report/xml_for_tests.h"

namespace bondlab {
namespace {

EndParticle particle(int id, double radius, double x, double y, double z = 0) {
  EndParticle p;
  p.id = id, p.type = 1, p.radius = radius, p.x = x, p.y = y, p.z = z;
  return p;
}

BrokenBond event(int id1, int id2, double time, const std::string &mode, double x, double y,
                 double z = 0) {
  BrokenBond b;
  b.id1 = id1, b.id2 = id2, b.time = time, b.mode = mode, b.x = x, b.y = y, b.z = z;
  return b;
}

Curve loading() {  // peak 10 at t = 1, 90 % of it at t = 0.9
  Curve curve;
  curve.names = {"time", "force_top", "force_bottom", "displacement"};
  curve.columns = {{0, 0.5, 0.9, 1, 1.2}, {0, 5, 9, 10, 4}, {0, 5, 9, 10, 4}, {0, 1, 2, 3, 4}};
  return curve;
}

ReportRunFiles flat() {
  ReportRunFiles run;
  run.kind = "brazilian", run.variables = {{"dim", 2}};
  return run;
}

TEST(SpecimenPicture, DrawsTheCrackAcrossTheBondBetweenItsParticles) {
  // 2 along a slope of 3 : 4; gap 1 between the surfaces
  const std::vector<EndParticle> particles = {particle(1, 1, 0, 0), particle(2, 3, 3, 4)};
  const SpecimenView view =
      view_specimen(particles, {event(1, 2, 0, "tension", 9, 9)}, loading(), flat());
  ASSERT_EQ(view.cracks.size(), 1u);
  const Crack &crack = view.cracks[0];
  EXPECT_NEAR(crack.dx * 3 + crack.dy * 4, 0, 1e-12);
  EXPECT_NEAR(std::hypot(crack.dx, crack.dy), 1, 1e-12);  // the smaller radius
  EXPECT_NEAR(std::hypot(crack.x, crack.y), 1.5, 1e-12);  // in the middle of the gap
  EXPECT_NEAR(crack.x / crack.y, 0.75, 1e-12);
  EXPECT_FALSE(crack.shear);
}

TEST(SpecimenPicture, LeavesTheCrackWhereItBrokeWhenTheParticlesPartedOrAreGone) {
  const std::vector<EndParticle> particles = {particle(1, 1, 0, 0), particle(2, 1, 6, 0),
                                              particle(3, 1, 3, 3)};
  const SpecimenView view =
      view_specimen(particles, {event(1, 2, 0, "shear", 2, 1), event(1, 77, 0, "shear", 1, 2)},
                    loading(), flat());
  ASSERT_EQ(view.cracks.size(), 2u);
  EXPECT_EQ(view.cracks[0].x, 2);
  EXPECT_EQ(view.cracks[0].y, 1);
  EXPECT_NEAR(view.cracks[0].dx, 0, 1e-12);
  EXPECT_NEAR(std::fabs(view.cracks[0].dy), 1, 1e-12);
  EXPECT_TRUE(view.cracks[0].shear);
  EXPECT_EQ(view.cracks[1].dx, 0);
  EXPECT_EQ(view.cracks[1].dy, 0);
  EXPECT_EQ(view.cracks[1].x, 1);
}

TEST(SpecimenPicture, StagesFollowTheLoad) {
  const std::vector<EndParticle> particles = {particle(1, 1, 0, 0), particle(2, 1, 2, 0)};
  std::vector<BrokenBond> events;
  for (const double time : {0.5, 0.9, 0.95, 1.0, 1.1})
    events.push_back(event(1, 2, time, "tension", 1, 0));
  const SpecimenView view = view_specimen(particles, events, loading(), flat());
  ASSERT_TRUE(view.staged);
  std::vector<int> stages;
  for (const Crack &crack : view.cracks) stages.push_back(crack.stage);
  EXPECT_EQ(stages, (std::vector<int>{0, 0, 1, 1, 2}));
  EXPECT_FALSE(view_specimen(particles, events, Curve{}, flat()).staged);
  EXPECT_EQ(view.discs[0].broken, 5);
}

TEST(SpecimenPicture, SlicesASphereAtTheDepthOfThePlane) {
  ReportRunFiles run = flat();
  run.variables["dim"] = 3;
  std::vector<EndParticle> particles;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k)
      particles.push_back(
          particle(static_cast<int>(particles.size()) + 1, 1, 2 * i, 0.6 * k, 1.5 * k));
  const SpecimenView brazilian =
      view_specimen(particles, {}, loading(), run);  // z is the thickness; middle 1.5
  EXPECT_TRUE(brazilian.slice);
  EXPECT_EQ(brazilian.vertical, "y");
  ASSERT_EQ(brazilian.discs.size(), 3u);  // the others are 1.5 radii away
  for (const auto &disc : brazilian.discs) EXPECT_NEAR(disc.r, 1, 1e-12);
  run.kind = "uniaxial_compression";
  const SpecimenView cylinder =
      view_specimen(particles, {event(1, 2, 0, "tension", 0, 0.3, 0.7)}, Curve{}, run);
  EXPECT_EQ(cylinder.vertical, "z");
  ASSERT_EQ(cylinder.discs.size(), 9u);  // plane y = 0.6
  EXPECT_NEAR(cylinder.discs[0].r, 0.8, 1e-12);
  ASSERT_EQ(cylinder.cracks.size(), 1u);
  // A bond along (0, 0.6, 1.5): its disc cuts the x-z plane in a line along x.
  EXPECT_NEAR(cylinder.cracks[0].dy, 0, 1e-12);
}

TEST(SpecimenPicture, LeavesOutAndCountsWhatFlewAway) {
  std::vector<EndParticle> particles;
  for (int i = 0; i < 20; ++i)
    for (int j = 0; j < 20; ++j) particles.push_back(particle(20 * i + j + 1, 0.5, i, j));
  particles.push_back(particle(401, 0.5, 5000, 3));
  const SpecimenView view = view_specimen(particles, {}, loading(), flat());
  EXPECT_EQ(view.out_of_view, 1u);
  EXPECT_EQ(view.discs.size(), 400u);
}

TEST(SpecimenPicture, IsWellFormedSmallAndCountsEveryCrack) {
  std::vector<EndParticle> particles;
  std::vector<BrokenBond> events;
  for (int i = 0; i < 63; ++i)
    for (int j = 0; j < 63; ++j) {
      particles.push_back(particle(63 * i + j + 1, 0.5e-3, 1e-3 * i, 1e-3 * j));
      if (i > 0)
        events.push_back(event(63 * (i - 1) + j + 1, 63 * i + j + 1, 0.02 * i,
                               j % 2 ? "shear" : "tension", 1e-3 * (i - 0.5), 1e-3 * j));
    }
  const SpecimenView view = view_specimen(particles, events, loading(), flat());
  const std::string svg = draw_specimen(view, "<title>", "a & b");
  const xml::Document document = xml::parse(svg);
  EXPECT_EQ(document.error, "");
  EXPECT_EQ(document.count("circle"), particles.size());
  EXPECT_LT(svg.size(), 500000u);
  std::size_t drawn = 0;
  for (const xml::Element &element : document.elements) {
    const auto d = element.attributes.find("d");
    if (element.name == "path" && d != element.attributes.end() &&
        element.attributes.count("stroke-linecap"))
      drawn += static_cast<std::size_t>(std::count(d->second.begin(), d->second.end(), 'M'));
  }
  EXPECT_EQ(drawn, events.size());
  EXPECT_EQ(svg, draw_specimen(view, "<title>", "a & b"));
}

TEST(SpecimenPicture, IsNothingWithoutParticles) {
  EXPECT_EQ(draw_specimen(view_specimen({}, {}, Curve{}, flat()), "t", "s"), "");
}

}  // namespace
}  // namespace bondlab
