// SPDX-License-Identifier: GPL-2.0-or-later
#include "view/frames.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/units.h"
#include "base/user_error.h"
#include "forward/frame_name.h"
#include "report/number_text.h"

namespace bondlab {

namespace fs = std::filesystem;

namespace {

// The time of a step, between the curve's rows and beyond them.
double time_of(const Curve &curve, long step) {
  const auto wanted = static_cast<double>(step);
  if (curve.rows() < 2 || !curve.has("step") || !curve.has("time")) return wanted;
  const std::vector<double> &steps = curve.column("step"), &times = curve.column("time");
  const auto above = std::lower_bound(steps.begin() + 1, steps.end() - 1, wanted);
  const auto k = static_cast<std::size_t>(above - steps.begin());
  if (!(steps[k] > steps[k - 1])) return wanted;
  return times[k - 1] + (times[k] - times[k - 1]) * (wanted - steps[k - 1]) / (steps[k] - steps[k - 1]);
}

// The step of the largest load; nothing without a curve that has a load.
std::optional<double> peak_step(const Curve &curve) {
  if (curve.rows() < 2 || !curve.has("step")) return std::nullopt;
  for (const char *load : {"axial_stress", "shear_stress", "force_top"}) {
    if (!curve.has(load)) continue;
    const std::vector<double> &values = curve.column(load);
    const auto peak = std::max_element(values.begin(), values.end()) - values.begin();
    return curve.column("step")[static_cast<std::size_t>(peak)];
  }
  return std::nullopt;
}

std::string steps_of(const std::vector<RunFrame> &frames) {
  std::vector<std::string> steps;
  for (const RunFrame &frame : frames) steps.push_back(std::to_string(frame.step));
  return join(steps);
}

}  // namespace

RunFrame frame_of_state(const RunView &run, const std::string &state) {
  const std::vector<RunFrame> frames = find_frames(run);
  if (frames.empty())
    throw UserError(Place{run.folder.string(), 0, 0},
                    "the run has no particles_STEP.txt, so the end is the only state to show (run it with "
                    "-var shots N, in a study variables = { shots = N })");
  if (state == "first") return frames.front();
  if (state == "last") return frames.back();
  if (state == "peak") {
    const std::optional<double> peak = peak_step(run.curve);
    if (!peak)
      throw UserError(Place{run.folder.string(), 0, 0},
                      "there is no peak: the run has no curve of a load by steps (allowed: first, last, " +
                          steps_of(frames) + ")");
    return *std::min_element(frames.begin(), frames.end(), [&](const RunFrame &a, const RunFrame &b) {
      return std::fabs(static_cast<double>(a.step) - *peak) < std::fabs(static_cast<double>(b.step) - *peak);
    });
  }
  for (const RunFrame &frame : frames)
    if (std::to_string(frame.step) == state) return frame;
  throw UserError("there is no state '" + state + "' of this run (allowed: first, last, peak, " +
                  steps_of(frames) + ")");
}

std::vector<RunFrame> find_frames(const RunView &run) {
  std::vector<RunFrame> frames;
  for (const fs::directory_entry &entry : fs::directory_iterator(run.folder)) {
    const auto step = frame_step(entry.path().filename().string(), "particles");
    if (!step) continue;
    RunFrame frame;
    frame.step = *step;
    frame.time = time_of(run.curve, *step);
    frame.particles = entry.path();
    const fs::path bonds = run.folder / ("bonds_" + std::to_string(*step) + ".txt");
    if (fs::is_regular_file(bonds)) frame.bonds = bonds;
    frames.push_back(frame);
  }
  std::sort(frames.begin(), frames.end(),
            [](const RunFrame &a, const RunFrame &b) { return a.step < b.step; });
  return frames;
}

RunView run_at(const RunView &run, const RunFrame &frame, const std::vector<std::string> &columns) {
  RunView then = run;
  const std::vector<EndParticle> places = read_particles(frame.particles);
  const auto other_particles = [&] {
    throw UserError(Place{frame.particles.string(), 0, 0},
                    "these aren't the particles of particles_end.txt (allowed: frames of this run)");
  };
  if (places.size() != then.particles.size()) other_particles();
  for (std::size_t k = 0; k < places.size(); ++k) {  // both by id
    ViewParticle &particle = then.particles[k];
    if (places[k].id != particle.id) other_particles();
    particle.end = {places[k].x, places[k].y, places[k].z};
    particle.stress = places[k].stress;
    particle.broken = 0;
    particle.fragment = -1;
  }
  then.moment = "step " + count_text(frame.step);
  if (frame.time != static_cast<double>(frame.step)) then.moment += ", " + format_quantity(frame.time, readable_unit(frame.time, "s"), 3);
  then.has_stress = !places.empty() && places.front().has_stress;
  for (ViewBond &bond : then.bonds) {
    if (bond.state == BondState::intact) continue;
    if (bond.step > frame.step) {
      bond.state = BondState::intact;
      bond.time = -1;
      continue;
    }
    for (const int end : {bond.a, bond.b}) ++then.particles[static_cast<std::size_t>(end)].broken;
  }
  find_fragments(then);
  then.forces.clear();
  then.has_forces = false;
  if (!frame.bonds.empty()) read_forces(then, frame.bonds, columns);
  return then;
}

std::string pvd_text(const std::vector<std::pair<double, std::string>> &files) {
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" "
      "byte_order=\"LittleEndian\">\n<Collection>\n";
  for (const auto &[time, file] : files)
    text += "<DataSet timestep=\"" + canonical_number(time) + "\" group=\"\" part=\"0\" file=\"" +
            file + "\"/>\n";
  return text + "</Collection>\n</VTKFile>\n";
}

}  // namespace bondlab
