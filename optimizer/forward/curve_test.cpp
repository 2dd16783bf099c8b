// SPDX-License-Identifier: GPL-2.0-or-later
#include "forward/curve.h"

#include <gtest/gtest.h>

#include "base/table_file.h"
#include "base/test_folder.h"

namespace bondlab {
namespace {

const std::string kCurve =
    "# bondlab-curve 1\n# names: step\ttime\taxial_stress\n# units: "
    "1\ts\tPa\n0\t0\t0\n10\t1e-6\t2.5e6\n";

template <class Function>
std::string message(Function function) {
  try {
    function();
  } catch (const UserError &error) {
    std::string text = error.what();
    const std::size_t slash = text.rfind('/', text.find(": "));
    return slash == std::string::npos ? text : text.substr(slash + 1);
  }
  return "accepted";
}

std::string curve_message(const std::string &text) {
  const TestFolder folder;
  const auto file = folder.write("curve.tsv", text);
  return message([&] { read_curve(file); });
}

TEST(ReadCurve, CompleteOnlyWithItsLastLine) {
  const TestFolder folder;
  const Curve whole =
      read_curve(folder.write("whole.tsv", kCurve + "# complete: stop_after_peak\n"));
  EXPECT_TRUE(whole.complete);
  EXPECT_EQ(whole.completion, "stop_after_peak");
  EXPECT_EQ(whole.rows(), 2u);
  EXPECT_EQ(whole.column("axial_stress")[1], 2.5e6);
  const Curve cut = read_curve(folder.write("cut.tsv", kCurve));
  EXPECT_FALSE(cut.complete);
  EXPECT_EQ(cut.rows(), 2u);
}

TEST(ReadCurve, ARowCutOffInMidLineIsNoData) {
  const TestFolder folder;
  EXPECT_EQ(read_curve(folder.write("a.tsv", kCurve + "20\t2e-6\t2.")).rows(), 2u);
  EXPECT_EQ(read_curve(folder.write("b.tsv", kCurve + "20\t2e-")).rows(), 2u);
}

TEST(ReadCurve, SaysFileLineAndColumnOfWhatIsWrong) {
  EXPECT_EQ(curve_message(kCurve + "20\t2e-6\tabc\n"),
            "curve.tsv:6:9: 'abc' in column 'axial_stress' isn't a number");
  EXPECT_EQ(curve_message(kCurve + "20\t2e-6\n"),
            "curve.tsv:6: cells in this row: 2, names in the '# names:' line: 3 (separator: tab)");
  EXPECT_EQ(curve_message("# bondlab-curve 2\n# names: a\n# units: 1\n"),
            "curve.tsv:1: the first line must be '# bondlab-curve 1', it is '# bondlab-curve 2'");
  EXPECT_EQ(curve_message("# bondlab-curve 1\n# names: a\n1\n"),
            "curve.tsv:2: a '# units:' line is needed below the names");
  EXPECT_EQ(curve_message("# bondlab-curve 1\n# names: a\tb\n# units: 1\n"),
            "curve.tsv:3: 1 units for 2 names");
  EXPECT_EQ(curve_message("# bondlab-curve 1\n# names: a\ta\n# units: 1\t1\n"),
            "curve.tsv:2: two columns are named 'a'");
  EXPECT_EQ(curve_message("# bondlab-curve 1\n# names: a\n# units: MPa\n"),
            "curve.tsv:3: the engine's files are in SI, the unit 'MPa' isn't");
  EXPECT_EQ(curve_message("# bondlab-curve 1\n1\t2\n"),
            "curve.tsv:2: a row before the '# names:' line; name the columns first");
  EXPECT_EQ(curve_message(kCurve + "# complete: end_of_run\n20\t2e-6\t1\n"),
            "curve.tsv:6: '# complete:' must be the last line");
  EXPECT_EQ(curve_message(""), "curve.tsv: there is no '# names:' line");
}

TEST(ReadCurve, NotANumberIsAnErrorOfItsOwnKind) {
  const TestFolder folder;
  for (const char *text : {"nan", "-nan", "inf", "-inf"})
    EXPECT_THROW(read_curve(folder.write("c.tsv", kCurve + "20\t2e-6\t" + text + "\n")), NotFinite)
        << text;
}

TEST(ReadCurve, AMissingColumnListsTheOnesThereAre) {
  const TestFolder folder;
  const Curve curve = read_curve(folder.write("c.tsv", kCurve));
  EXPECT_EQ(message([&] { curve.column("force"); }),
            "the curve has no column 'force'; columns: step, time, axial_stress");
}

const std::string kEvents =
    "# bondlab-broken-bonds 1\n# names: "
    "step\ttime\tid1\tid2\ttype\tx\ty\tz\tmode\tsigma\ttau\tsigma_c\ttau_c\n"
    "# units: 1\ts\t1\t1\t1\tm\tm\tm\t1\tPa\tPa\tPa\tPa\n";

TEST(ReadBrokenBonds, ReadsEveryColumn) {
  const TestFolder folder;
  const auto bonds = read_broken_bonds(folder.write(
      "b.tsv",
      kEvents +
          "7\t1e-6\t3\t12\t1\t0.1\t0.2\t0\tshear\t1e6\t2e6\t3e6\t4e6\n# complete: end_of_run\n"));
  ASSERT_EQ(bonds.size(), 1u);
  EXPECT_EQ(bonds[0].step, 7);
  EXPECT_EQ(bonds[0].id2, 12);
  EXPECT_EQ(bonds[0].y, 0.2);
  EXPECT_EQ(bonds[0].mode, "shear");
  EXPECT_EQ(bonds[0].tau_c, 4e6);
  EXPECT_TRUE(read_broken_bonds(folder.write("none.tsv", kEvents)).empty());
}

TEST(ReadBrokenBonds, RefusesAnUnknownModeAndAFractionOfAnId) {
  const TestFolder folder;
  EXPECT_EQ(message([&] {
              read_broken_bonds(folder.write(
                  "b.tsv", kEvents + "7\t1e-6\t3\t12\t1\t0\t0\t0\tbending\t1\t1\t1\t1\n"));
            }),
            "b.tsv:4:21: 'bending' isn't a mode of breaking; allowed: tension, shear");
  EXPECT_EQ(message([&] {
              read_broken_bonds(folder.write(
                  "b.tsv", kEvents + "7\t1e-6\t3.5\t12\t1\t0\t0\t0\tshear\t1\t1\t1\t1\n"));
            }),
            "b.tsv:4:8: '3.5' in column 'id1' isn't a whole number");
}

std::string frame(int count) {
  return "ITEM: TIMESTEP\n5\nITEM: NUMBER OF ATOMS\n" + std::to_string(count) +
         "\nITEM: BOX BOUNDS ff ff pp\n-1 1\n-1 1\n-1 1\nITEM: ATOMS id type radius x y z \n";
}

TEST(ReadParticles, TakesTheLastFrameSortedById) {
  const TestFolder folder;
  const auto particles = read_particles(folder.write(
      "p.txt", frame(1) + "1 1 0.5 9 9 9\n" + frame(2) + "2 1 0.5 3 4 5\n1 1 0.25 0 1 2\n"));
  ASSERT_EQ(particles.size(), 2u);
  EXPECT_EQ(particles[0].id, 1);
  EXPECT_EQ(particles[0].radius, 0.25);
  EXPECT_EQ(particles[1].z, 5);
}

TEST(ReadParticles, RefusesWhatIsCutOff) {
  const TestFolder folder;
  EXPECT_EQ(message([&] { read_particles(folder.write("p.txt", frame(2) + "2 1 0.5 3 4 5\n")); }),
            "p.txt:11: the dump ends after 1 of 2 particles");
  EXPECT_EQ(message([&] { read_particles(folder.write("p.txt", frame(1) + "2 1 0.5 3\n")); }),
            "p.txt:10: 4 numbers in a row of 6 columns");
  EXPECT_EQ(message([&] { read_particles(folder.write("p.txt", "nothing\n")); }),
            "p.txt: this isn't a dump: there is no 'ITEM: NUMBER OF ATOMS' line");
}

}  // namespace
}  // namespace bondlab
