// SPDX-License-Identifier: GPL-2.0-or-later
#include "view/frames.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "base/table_file.h"
#include "base/user_error.h"
#include "base/vtp_file.h"
#include "forward/frame_name.h"
#include "report/number_text.h"
#include "report/xml_for_tests.h"
#include "view/paraview.h"
#include "view/run_for_tests.h"
#include "view/view.h"

namespace bondlab {
namespace {

// The dump of the lattice at its start with the stresses 1 .. 6 times the id.
std::string frame_with_stress() {
  std::string text = lattice_dump(false), with;
  std::istringstream lines(text);
  bool rows = false;
  for (std::string line; std::getline(lines, line);) {
    with += line;
    const int id = rows ? std::stoi(line) : 0;
    for (int k = 1; rows && k <= 6; ++k) with += " " + std::to_string(k * id);
    if (line.rfind("ITEM: ATOMS", 0) == 0) {
      for (int k = 1; k <= 6; ++k) with += "c_stress[" + std::to_string(k) + "] ";
      rows = true;
    }
    with += "\n";
  }
  return with;
}

// The lattice loses a bond at each of the steps 100 to 105 and one at 200; 1 us a step.
void write_run_with_frames(const TestFolder &folder) {
  write_lattice_run(folder);
  folder.write("curve.tsv",
               "# bondlab-curve 1\n# names: step\ttime\tload\n# units: 1\ts\tN\n0\t0\t0\n"
               "100\t1e-4\t1\n200\t2e-4\t2\n# complete: end_of_run\n");
  folder.write("particles_102.txt", frame_with_stress());
  folder.write("particles_50.txt", lattice_dump(false));
  folder.write("particles_300.txt", lattice_dump(true));
  folder.write("bonds_102.txt", lattice_forces());
}

std::size_t broken(const RunView &run) {
  return run.broken(BondState::tension) + run.broken(BondState::shear);
}

TEST(FrameName, IsAStepBetweenItsWords) {
  EXPECT_EQ(frame_step("particles_4000.txt", "particles"), 4000);
  EXPECT_EQ(frame_step("particles_0.txt", "particles"), 0);
  for (const char *name : {"particles_end.txt", "particles_start.txt", "particles_.txt", "particles_4",
                           "particles_-4.txt", "particles_4x.txt", "bonds_4.txt"})
    EXPECT_FALSE(frame_step(name, "particles")) << name;
  EXPECT_TRUE(is_frame("bonds_4.txt"));
  EXPECT_FALSE(is_frame("broken_bonds.tsv"));
}

TEST(Frames, AreFoundInTheOrderOfTheirStepsWithTheirTimes) {
  const TestFolder folder;
  write_run_with_frames(folder);
  const std::vector<RunFrame> frames = find_frames(read_run(folder.path()));
  ASSERT_EQ(frames.size(), 3u);
  EXPECT_EQ(frames[0].step, 50);
  EXPECT_DOUBLE_EQ(frames[0].time, 50e-6);   // between two rows of the curve
  EXPECT_DOUBLE_EQ(frames[1].time, 102e-6);
  EXPECT_DOUBLE_EQ(frames[2].time, 300e-6);  // beyond the last one
  EXPECT_TRUE(frames[0].bonds.empty());
  EXPECT_EQ(frames[1].bonds.filename(), "bonds_102.txt");
}

TEST(Frames, AStateHasOnlyTheCracksOfItsTime) {
  const TestFolder folder;
  write_run_with_frames(folder);
  const RunView run = read_run(folder.path());
  const std::vector<RunFrame> frames = find_frames(run);
  const RunView before = run_at(run, frames[0]), middle = run_at(run, frames[1]),
                end = run_at(run, frames[2]);
  EXPECT_EQ(broken(before), 0u);
  EXPECT_EQ(before.fragments.size(), 1u);
  EXPECT_EQ(broken(middle), 3u);
  EXPECT_EQ(middle.fragments.size(), 1u) << "the column still hangs on three bonds";
  EXPECT_EQ(broken(end), 7u);
  EXPECT_EQ(end.fragments.size(), run.fragments.size());
  int lost = 0;
  for (const ViewParticle &p : middle.particles) lost += p.broken;
  EXPECT_EQ(lost, 6);
  for (const ViewBond &bond : middle.bonds) EXPECT_EQ(bond.time >= 0, bond.state != BondState::intact);
  EXPECT_NEAR(end.particles[5].end[0] - middle.particles[5].end[0], 0.0004, 1e-12);
  EXPECT_TRUE(middle.has_forces);
  EXPECT_FALSE(end.has_forces);
}

TEST(Frames, AFrameOfAnotherRunIsRefused) {
  const TestFolder folder;
  write_run_with_frames(folder);
  std::string text = lattice_dump(false);
  text.replace(text.find("\n36 1 "), 4, "\n37 ");
  folder.write("particles_50.txt", text);
  const RunView run = read_run(folder.path());
  try {
    run_at(run, find_frames(run)[0]);
    FAIL();
  } catch (const UserError &error) {
    EXPECT_NE(std::string(error.what()).find("particles_50.txt"), std::string::npos);
  }
}

TEST(Frames, StressIsASymmetricTensorForParaview) {
  const TestFolder folder;
  write_run_with_frames(folder);
  const RunView run = read_run(folder.path());
  const VtpData data = particle_data(run_at(run, find_frames(run)[1]));
  const VtpArray *stress = data.find("stress_Pa");
  ASSERT_NE(stress, nullptr);
  EXPECT_EQ(stress->components, 9);
  const std::vector<double> of_2(stress->values.begin() + 9, stress->values.begin() + 18);
  // xx xy xz, yx yy yz, zx zy zz from xx yy zz xy xz yz = 2 4 6 8 10 12
  EXPECT_EQ(of_2, (std::vector<double>{2, 8, 10, 8, 4, 12, 10, 12, 6}));
  EXPECT_EQ(particle_data(run).find("stress_Pa"), nullptr) << "particles_end.txt has none";
}

// Read by a parser of its own: a VTKFile of type Collection whose DataSets are files that are there.
TEST(Frames, ASeriesNamesItsFilesAndTimes) {
  const TestFolder folder;
  write_run_with_frames(folder);
  ViewOutput output;
  write_view(read_run(folder.path()), folder / "view", output);
  for (const char *what : {"particles", "bonds"}) {
    std::string text = read_text_file(folder / "view" / (std::string(what) + ".pvd"));
    ASSERT_EQ(text.rfind("<?xml version=\"1.0\"?>\n", 0), 0u);
    const std::string body = text.substr(text.find('\n') + 1);
    const xml::Document document = xml::parse(body);
    ASSERT_EQ(document.error, "");
    EXPECT_EQ(document.elements[0].name, "VTKFile");
    EXPECT_EQ(document.elements[0].attributes.at("type"), "Collection");
    EXPECT_EQ(document.elements[1].name, "Collection");
    EXPECT_EQ(document.count("DataSet"), 3u);
    double last = -1;
    for (const xml::Element &element : document.elements) {
      if (element.name != "DataSet") continue;
      const double time = std::stod(element.attributes.at("timestep"));
      EXPECT_GT(time, last);
      last = time;
      const auto file = folder / "view" / element.attributes.at("file");
      EXPECT_EQ(read_vtk_points(file).size(), 36u) << file;
    }
    EXPECT_DOUBLE_EQ(last, 300e-6);
  }
}

TEST(Frames, AreNamedByWordsOrTheirSteps) {
  const TestFolder folder;
  write_run_with_frames(folder);
  folder.write("curve.tsv",
               "# bondlab-curve 1\n# names: step\ttime\tforce_top\n# units: 1\ts\tN\n0\t0\t0\n"
               "100\t1e-4\t3\n200\t2e-4\t2\n# complete: end_of_run\n");
  const RunView run = read_run(folder.path());
  EXPECT_EQ(frame_of_state(run, "first").step, 50);
  EXPECT_EQ(frame_of_state(run, "last").step, 300);
  EXPECT_EQ(frame_of_state(run, "peak").step, 102) << "the load is largest at step 100";
  EXPECT_EQ(frame_of_state(run, "300").step, 300);
  try {
    frame_of_state(run, "103");
    FAIL();
  } catch (const UserError &error) {
    EXPECT_EQ(error.text(), "there is no state '103' of this run (allowed: first, last, peak, 50, 102, 300)");
  }
}

TEST(Frames, AStateThatCantBeSaysWhy) {
  const TestFolder folder;
  write_lattice_run(folder);
  const auto why = [&](const std::string &state) {
    try {
      frame_of_state(read_run(folder.path()), state);
    } catch (const UserError &error) {
      return error.text();
    }
    return std::string();
  };
  EXPECT_NE(why("first").find("-var shots N"), std::string::npos);
  folder.write("particles_50.txt", lattice_dump(false));
  EXPECT_NE(why("peak").find("no curve of a load"), std::string::npos);
  EXPECT_EQ(why("first"), "");
}

TEST(Frames, PicturesShowTheStateAskedForAndTheSeriesAll) {
  const TestFolder folder;
  write_run_with_frames(folder);
  const RunView run = read_run(folder.path());
  ViewOutput output;
  output.state = "102";
  write_view(run, folder / "view", output);
  const std::string cracks = read_text_file(folder / "view" / "cracks_by_mode.svg");
  EXPECT_NE(cracks.find(counted(3, "bond", "bonds") + " broken"), std::string::npos);
  EXPECT_NE(cracks.find("This is step 102"), std::string::npos);
  EXPECT_NE(read_text_file(folder / "view" / "displacement.svg").find("to this moment"), std::string::npos);
  EXPECT_NE(read_text_file(folder / "view" / "force_chains.svg").find("This is step 102"), std::string::npos);
  EXPECT_EQ(read_text_file(folder / "view" / "specimen.svg").find("step 102"), std::string::npos) << "the start";
  write_view(run, folder / "end", {});
  const std::string at_end = read_text_file(folder / "end" / "cracks_by_mode.svg");
  EXPECT_NE(at_end.find(counted(7, "bond", "bonds") + " broken"), std::string::npos);
  EXPECT_EQ(at_end.find("This is"), std::string::npos);
  for (const char *file : {"frames/bonds_300.vtp", "frames/particles_50.vtp", "particles.pvd"})
    EXPECT_EQ(read_text_file(folder / "view" / file), read_text_file(folder / "end" / file)) << file;
}

}  // namespace
}  // namespace bondlab
