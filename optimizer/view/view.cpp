// SPDX-License-Identifier: GPL-2.0-or-later
#include "view/view.h"

#include <fmt/format.h>

#include "base/user_error.h"
#include "base/write_file.h"
#include "report/curve_plots.h"
#include "report/gnuplot.h"
#include "view/frames.h"
#include "view/paraview.h"
#include "view/pictures.h"
#include "view/png.h"

namespace bondlab {

namespace fs = std::filesystem;

namespace {

void add_curve(const RunView &run, const fs::path &folder, ViewWritten &written) {
  if (run.curve.rows() < 2) return;
  ReportRunFiles about;
  about.test = about.kind = run.test;
  about.directory = run.folder.string();
  about.variables = run.variables;
  about.variables["dim"] = run.dimension;
  Plot plot;
  try {
    plot = curve_plot(run.curve, about, {}, {});
  } catch (const UserError &error) {  // a curve without the columns of a load
    written.missing.push_back("No plot of the curve: " + error.text());
    return;
  }
  plot.name = "curve";
  write_file(folder / "curve.svg", draw_plot(plot, folder));
  written.files.push_back(folder / "curve.svg");
}

// The frames on the way as two time series, particles.pvd and bonds.pvd.
void add_series(const RunView &run, const fs::path &folder, const ViewOutput &output,
                ViewWritten &written) {
  const std::vector<RunFrame> frames = find_frames(run);
  if (frames.empty()) return;
  make_folder(folder / "frames");
  std::vector<std::pair<double, std::string>> particles, bonds;
  const auto put = [&](std::vector<std::pair<double, std::string>> &series, const RunFrame &frame,
                       const char *what, const VtpData &data) {
    const std::string name = fmt::format("frames/{}_{}.vtp", what, frame.step);
    write_file(folder / name, vtp_text(data));
    series.emplace_back(frame.time, name);
  };
  for (const RunFrame &frame : frames) {
    const RunView then = run_at(run, frame, output.bond_columns);
    put(particles, frame, "particles", particle_data(then));
    if (run.has_bonds) put(bonds, frame, "bonds", bond_data(then));
  }
  for (const auto &[name, series] : {std::pair{"particles.pvd", particles}, {"bonds.pvd", bonds}}) {
    if (series.empty()) continue;
    write_file(folder / name, pvd_text(series));
    written.files.push_back(folder / name);
  }
}

}  // namespace

ViewWritten write_view(const RunView &whole_run, const fs::path &folder, const ViewOutput &output) {
  const RunView run = output.state.empty()
                          ? whole_run
                          : run_at(whole_run, frame_of_state(whole_run, output.state), output.bond_columns);
  ViewWritten written;
  written.missing = run.missing;
  make_folder(folder);
  const auto put = [&](const std::string &name, Drawing drawing) {
    const bool of_start = name.find("specimen") == 0 && run.has_start;
    if (!run.moment.empty() && !of_start) drawing.sentences.push_back("This is " + run.moment + ".");
    const std::string svg = draw(drawing);
    if (svg.empty()) return;
    write_file(folder / (name + ".svg"), svg);
    written.files.push_back(folder / (name + ".svg"));
  };
  const Projection plane(run, Look3d::slice, output.plane);
  put("specimen", specimen_picture(run, plane));
  put("cracks_by_mode", cracks_by_mode(run, plane));
  put("cracks_by_time", cracks_by_time(run, plane));
  put("force_chains", force_chains(run, plane));
  put("displacement", displacements(run, plane));
  put("fragments", fragments_picture(run, plane));
  if (run.dimension == 3) {
    const Projection whole(run, Look3d::whole, output.plane);
    put("specimen_whole", specimen_picture(run, whole));
    put("cracks_by_mode_whole", cracks_by_mode(run, whole));
    put("cracks_by_time_whole", cracks_by_time(run, whole));
    put("displacement_whole", displacements(run, whole));
    put("fragments_whole", fragments_picture(run, whole));
  }
  add_curve(run, folder, written);
  if (output.png) {
    const std::vector<fs::path> pictures = written.files;
    for (const fs::path &picture : pictures) written.files.push_back(png_from_svg(picture));
  }
  if (output.paraview) {
    write_file(folder / "particles.vtp", vtp_text(particle_data(run)));
    written.files.push_back(folder / "particles.vtp");
    const VtpData bonds = bond_data(run);
    if (!bonds.lines.empty()) {
      write_file(folder / "bonds.vtp", vtp_text(bonds));
      written.files.push_back(folder / "bonds.vtp");
    }
    add_series(whole_run, folder, output, written);
  }
  return written;
}

}  // namespace bondlab
