// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: golden numbers of every deck of the virtual laboratory: what the decks gave on 2026-11-29,
// to see drift; closed forms are tested elsewhere.
//
// Method: small specimens, one rank, settings as the other tests of the decks have them. The
//   elastic figure is a least squares slope over a stated window that must end before the first
//   break. Tolerances: E_b was changed by up to 5e-14 of itself, nine runs of each deck, to see
//   what rounding alone does, as between two processors. It moved the elastic figures by 0.04 % at
//   most, peaks and times by 0.6 %, the strain of creep by 0.2 % and its rate by 0.3 %, counts of
//   broken bonds by 13 %. The tolerances are two to five times that.
//
// Units: SI. Failure: deck, figure and both numbers are printed, the folder is left. Whoever
//   changes a deck on purpose stores what it gives then.
//
// Limits: without friction the disc finds one of two seats between its jaws by chance, 0.6 % apart
//   in stiffness: its jaws have some.
#include <gtest/gtest.h>

#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "deck_tools.h"

namespace {

using namespace engine::decks;
using engine::Table;

struct Figure {
  const char *name;
  std::function<double(const Table &)> measure;
  double stored;
  double tolerance;  // share of the stored number
};

struct Golden {
  const char *deck, *specimen;
  Values values;
  std::vector<Figure> figures;
};

void PrintTo(const Golden &golden, std::ostream *out) { *out << golden.deck; }  // for ctest

constexpr double kElastic = 0.001, kStrain = 0.01, kPath = 0.02, kCount = 0.25;

// A column of the curve; "load" is the mean of both ends' forces.
std::vector<double> column(const Table &t, const std::string &name) {
  if (name != "load") return t.column(name);
  std::vector<double> mean = t.column("force_top");
  const auto bottom = t.column("force_bottom");
  for (std::size_t k = 0; k < mean.size(); ++k) mean[k] = 0.5 * (mean[k] + bottom[k]);
  return mean;
}

std::size_t first_break(const Table &t) {
  const auto broken = t.column("broken_bonds");
  std::size_t k = 0;
  while (k < broken.size() && broken[k] == 0.0) ++k;
  return k;
}

std::function<double(const Table &)> slope_of(const char *y, const char *x, double from,
                                              double to) {
  return [=](const Table &t) {
    const auto way = column(t, x);
    const std::size_t whole = first_break(t);
    EXPECT_GT(way.at(whole - 1), to) << "a bond breaks before the window's end";
    return slope_where(way, column(t, y),
                       [&](std::size_t k) { return k < whole && way[k] > from && way[k] < to; });
  };
}

std::function<double(const Table &)> peak_of(const char *y) {
  return [=](const Table &t) { return largest(column(t, y)); };
}

double broken(const Table &t) { return t.last("broken_bonds"); }

// The wave of the first break shakes roller and clamp by a tenth of the load; what the beam bore
// does not depend on it.
double load_before_break(const Table &t) { return column(t, "load").at(first_break(t) - 1); }

// Of a linear specimen E V/2, its energy over the square of the strain. Stress over strain would
// see how the soft specimen swings between smooth platens: rounding moves that by 2 %.
double energy_of_strain(const Table &t) {
  auto square = t.column("strain_platen");
  for (double &e : square) e *= e;
  return slope_where(square, t.column("strain_energy"),
                     [&](std::size_t k) { return square[k] > 1e-6 && square[k] < 16e-6; });
}

// The points at which the load is kept.
std::vector<std::size_t> kept(const Table &t) {
  const auto phase = t.column("phase");
  std::vector<std::size_t> points;
  for (std::size_t k = 0; k < phase.size(); ++k)
    if (phase[k] == 3.0) points.push_back(k);
  return points;
}

double strain_at_end_of_hold(const Table &t) { return t.column("strain_axial").at(kept(t).back()); }

double creep_rate(const Table &t) {  // over the second half of that time
  const auto points = kept(t);
  return slope_where(t.column("time"), t.column("strain_axial"), [&](std::size_t k) {
    return k >= points.at(points.size() / 2) && k <= points.back();
  });
}

// Until the force is below a tenth of its peak for good: the last grains touch and leave by chance.
double contact_time(const Table &t) {
  const auto force = t.column("force_top"), time = t.column("time");
  const double least = 0.1 * largest(force);
  std::size_t last = 0;
  for (std::size_t k = 0; k < force.size(); ++k)
    if (force[k] > least) last = k;
  return time.at(last);
}

// clang-format off
const Golden kDecks[] = {
    {"uniaxial_compression", "rectangle_small_2d.data", {}, {
         {"modulus", slope_of("axial_stress", "strain_axial", 2e-4, 6e-4), 3.541084e10, kElastic},
         {"strength", peak_of("axial_stress"), 4.738554e7, kPath},
         {"broken bonds", broken, 74, kCount}}},
    {"brazilian", "disc_small_2d.data", {{"jaw_radius", "1.5"}, {"platen_mu", "0.3"}}, {
         {"stiffness", slope_of("load", "displacement", 5e-6, 2e-5), 6.802981e9, kElastic},
         {"peak load", peak_of("load"), 2.781612e5, kPath},
         {"broken bonds", broken, 27, kCount}}},
    {"three_point_bending", "beam_small_2d.data", {{"platen_speed", "0.05"}}, {
         {"stiffness", slope_of("load", "deflection", 1e-5, 4e-5), 3.133743e9, kElastic},
         {"peak load", peak_of("load"), 1.514118e5, kPath},
         {"broken bonds", broken, 11, kCount}}},
    {"direct_shear", "box_small_2d.data", {{"max_shear", "0.004"}}, {
         {"stiffness", slope_of("shear_stress", "displacement", 1e-5, 5e-5), 2.791920e11, kElastic},
         {"strength", peak_of("shear_stress"), 2.475159e7, kPath},
         {"broken bonds", broken, 91, kCount}}},
    {"direct_tension", "rectangle_small_2d.data", {}, {
         {"modulus", slope_of("axial_stress", "strain_axial", 2e-4, 8e-4), 1.929032e10, kElastic},
         {"strength", peak_of("axial_stress"), 1.865137e7, kPath},
         {"broken bonds", broken, 12, kCount}}},
    // the drop at which the others stop leaves it with three broken bonds
    {"cantilever", "beam_small_2d.data", {{"platen_speed", "0.1"}, {"stop_drop", "0.9"}}, {
         {"stiffness", slope_of("load", "deflection", 2e-5, 1.4e-4), 2.265064e8, kElastic},
         {"load before the first break", load_before_break, 3.382335e4, kPath},
         {"broken bonds", broken, 8, kCount}}},
    {"creep", "rectangle_small_2d.data", {{"creep_time", "3e-3"}}, {
         {"energy of strain", energy_of_strain, 4.311384e5, kElastic},
         {"strain at the end of the hold", strain_at_end_of_hold, 6.437396e-3, kStrain},
         {"creep rate", creep_rate, 0.2721403, kPath},
         {"broken bonds", broken, 0, kCount}}},  // none, exactly
    {"impact", "brazilian_small_3d.data", {{"ball_speed", "0.5"}}, {
         {"stiffness", slope_of("force_top", "displacement", 1e-6, 5e-6), 1.212700e7, kElastic},
         {"peak force", peak_of("force_top"), 223.4801, kPath},
         {"contact time", contact_time, 1.873337e-4, kPath},
         {"broken bonds", broken, 55, kCount}}}};
// clang-format on

class GoldenDecks : public testing::TestWithParam<Golden> {};

TEST_P(GoldenDecks, give_the_stored_numbers) {
  const Golden &golden = GetParam();
  engine::EngineFolder folder;
  const Table t =
      curve_of(folder, golden.deck, with_specimen(golden.specimen) + var(golden.values));
  for (const Figure &figure : golden.figures)
    EXPECT_NEAR(figure.measure(t), figure.stored, figure.tolerance * figure.stored)
        << golden.deck << ": " << figure.name;
}

INSTANTIATE_TEST_SUITE_P(Inputs, GoldenDecks, testing::ValuesIn(kDecks),
                         [](const auto &row) { return std::string(row.param.deck); });

}  // namespace
