// SPDX-License-Identifier: GPL-2.0-or-later
#include "view/view.h"

#include "base/user_error.h"
#include "base/write_file.h"
#include "report/curve_plots.h"
#include "report/gnuplot.h"
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

}  // namespace

ViewWritten write_view(const RunView &run, const fs::path &folder, const ViewOutput &output) {
  ViewWritten written;
  written.missing = run.missing;
  make_folder(folder);
  const auto put = [&](const std::string &name, const Drawing &drawing) {
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
  }
  return written;
}

}  // namespace bondlab
