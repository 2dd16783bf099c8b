// SPDX-License-Identifier: GPL-2.0-or-later
#include "report/specimen_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

#include "report/curve_plots.h"
#include "report/number_text.h"
#include "report/palette.h"
#include "report/svg.h"

namespace bondlab {
namespace {

using Vector = std::array<double, 3>;

Vector position(const EndParticle &p) { return {p.x, p.y, p.z}; }

// The times that part the stages; both infinite when the curve tells nothing.
struct Stages {
  double near_peak = INFINITY, peak = INFINITY;
  bool known = false;
};

Stages stages_of(const Curve &curve) {
  Stages stages;
  if (curve.rows() < 2 || !curve.has("time")) return stages;
  std::vector<double> load;
  if (curve.has("axial_stress"))
    load = curve.column("axial_stress");
  else if (curve.has("force_top") && curve.has("force_bottom"))
    load = platen_force(curve);
  if (load.empty()) return stages;
  const std::size_t peak = peak_index(load);
  const std::size_t near = static_cast<std::size_t>(
      std::find_if(load.begin(), load.end(), [&](double l) { return l >= 0.9 * load[peak]; }) -
      load.begin());
  stages.near_peak = curve.column("time")[near];
  stages.peak = curve.column("time")[peak];
  stages.known = load[peak] > 0;
  return stages;
}

double quantile(std::vector<double> values, double share) {
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

struct Box {
  double x0, x1, y0, y1;
  bool holds(double x, double y) const { return x >= x0 && x <= x1 && y >= y0 && y <= y1; }
};

// Where the body is: all but the outermost 1 % of the particles at each side, and a margin that
// takes in that 1 % too.
Box body_box(const std::vector<double> &x, const std::vector<double> &y, double radius) {
  Box box{quantile(x, 0.01), quantile(x, 0.99), quantile(y, 0.01), quantile(y, 0.99)};
  const double margin = 0.05 * std::max(box.x1 - box.x0, box.y1 - box.y0) + 2 * radius;
  return {box.x0 - margin, box.x1 + margin, box.y0 - margin, box.y1 + margin};
}

}  // namespace

SpecimenView view_specimen(const std::vector<EndParticle> &particles,
                           const std::vector<BrokenBond> &events, const Curve &curve,
                           const ReportRunFiles &run) {
  SpecimenView view;
  view.horizontal = "x", view.vertical = "y";
  view.events = events.size();
  if (particles.empty()) return view;

  double mean_radius = 0, thickness = 0;
  for (const EndParticle &p : particles) {
    mean_radius += p.radius / static_cast<double>(particles.size());
    thickness = std::max(thickness, std::fabs(p.z - particles.front().z));
  }
  const auto dim = run.variables.find("dim");
  view.slice = dim != run.variables.end() ? dim->second == 3 : thickness > 0.01 * mean_radius;

  // h, v: axes of the picture; n: the axis that looks at the reader.
  int h = 0, v = 1, n = 2;
  double plane = 0;
  if (view.slice) {
    if (is_stress_strain(curve) || run.kind.find("uniaxial") != std::string::npos)
      v = 2, n = 1, view.vertical = "z";
    std::vector<double> depth;
    for (const EndParticle &p : particles)
      depth.push_back(position(p)[static_cast<std::size_t>(n)]);
    plane = (quantile(depth, 0.01) + quantile(depth, 0.99)) / 2;
  }
  const auto at = [](const Vector &vector, int axis) {
    return vector[static_cast<std::size_t>(axis)];
  };

  std::unordered_map<int, const EndParticle *> by_id;
  std::unordered_map<int, int> broken;
  for (const EndParticle &p : particles) by_id[p.id] = &p;
  for (const BrokenBond &event : events) ++broken[event.id1], ++broken[event.id2];

  std::vector<double> all_h, all_v;
  for (const EndParticle &p : particles)
    all_h.push_back(at(position(p), h)), all_v.push_back(at(position(p), v));
  const Box box = body_box(all_h, all_v, mean_radius);
  for (const EndParticle &p : particles) {
    const double x = at(position(p), h), y = at(position(p), v);
    if (!box.holds(x, y)) {
      ++view.out_of_view;
      continue;
    }
    double r = p.radius;
    if (view.slice) {
      const double off = at(position(p), n) - plane;
      if (std::fabs(off) >= p.radius) continue;
      r = std::sqrt(p.radius * p.radius - off * off);
    }
    const auto lost = broken.find(p.id);
    view.discs.push_back({x, y, r, lost == broken.end() ? 0 : lost->second});
  }

  const Stages stages = stages_of(curve);
  view.staged = stages.known;
  for (const BrokenBond &event : events) {
    const auto first = by_id.find(event.id1), second = by_id.find(event.id2);
    Vector place = {event.x, event.y, event.z};
    Crack crack;
    if (first != by_id.end() && second != by_id.end()) {
      const EndParticle &a = *first->second, &b = *second->second;
      Vector normal{};
      double distance = 0;
      for (std::size_t k = 0; k < 3; ++k)
        normal[k] = position(b)[k] - position(a)[k], distance += normal[k] * normal[k];
      distance = std::sqrt(distance);
      if (distance > 0) {
        const double half = std::min(a.radius, b.radius);
        // across the bond and in the plane of the picture: n x normal; shorter where the bond leans
        // out of the plane
        crack.dx = -at(normal, v) / distance * half;
        crack.dy = at(normal, h) / distance * half;
        if (distance < 1.5 * (a.radius + b.radius)) {
          const double share = (a.radius + (distance - a.radius - b.radius) / 2) / distance;
          for (std::size_t k = 0; k < 3; ++k) place[k] = position(a)[k] + share * normal[k];
        }
      }
    }
    if (view.slice && std::fabs(at(place, n) - plane) > mean_radius) continue;
    crack.x = at(place, h), crack.y = at(place, v);
    if (!box.holds(crack.x, crack.y)) continue;
    crack.shear = event.mode == "shear";
    crack.time = event.time;
    crack.stage = !stages.known || event.time > stages.peak ? 2
                  : event.time > stages.near_peak           ? 1
                                                            : 0;
    view.cracks.push_back(crack);
  }
  return view;
}

std::string draw_specimen(const SpecimenView &view, const std::string &title,
                          const std::string &sentence) {
  if (view.discs.empty()) return "";
  double x0 = INFINITY, x1 = -INFINITY, y0 = INFINITY, y1 = -INFINITY;
  for (const SpecimenView::Disc &disc : view.discs) {
    x0 = std::min(x0, disc.x - disc.r), x1 = std::max(x1, disc.x + disc.r);
    y0 = std::min(y0, disc.y - disc.r), y1 = std::max(y1, disc.y + disc.r);
  }
  const double width = 520, edge = 24, arrow = 34, legend = 104, widest = width - 2 * edge,
               highest = 660;
  const double scale = std::min(widest / (x1 - x0), highest / (y1 - y0));
  const double left = (width - scale * (x1 - x0)) / 2, top = arrow,
               body_bottom = top + scale * (y1 - y0);
  const double height = body_bottom + arrow + legend;
  const auto px = [&](double x) { return left + scale * (x - x0); };
  const auto py = [&](double y) { return top + scale * (y1 - y); };

  SvgWriter svg(width, height, title, sentence);
  const double hair = std::clamp(0.12 * scale * view.discs.front().r, 0.15, 0.7);
  for (const bool hurt : {false, true}) {
    svg.open_group(fmt::format("fill=\"{}\" stroke=\"{}\" stroke-width=\"{}\"",
                               light(hurt ? "disc-hurt" : "disc"), light("disc-edge"),
                               compact(hair)));
    for (const SpecimenView::Disc &disc : view.discs)
      if ((disc.broken > 0) == hurt) svg.circle(px(disc.x), py(disc.y), scale * disc.r);
    svg.close_group();
  }

  const char *roles[2][3] = {{"tension-early", "tension-mid", "tension-late"},
                             {"shear-early", "shear-mid", "shear-late"}};
  std::string paths[2][3];
  long counts[2][3] = {};
  for (const Crack &crack : view.cracks) {
    ++counts[crack.shear][crack.stage];
    paths[crack.shear][crack.stage] += fmt::format(
        "M{} {}l{} {}", compact(px(crack.x - crack.dx)), compact(py(crack.y - crack.dy)),
        compact(2 * scale * crack.dx), compact(-2 * scale * crack.dy));
  }
  const double mean_r = scale * view.discs[view.discs.size() / 2].r;
  const std::string pen = fmt::format("fill=\"none\" stroke-linecap=\"round\" stroke-width=\"{}\"",
                                      compact(std::clamp(0.45 * mean_r, 1.1, 2.6)));
  for (int stage = 0; stage < 3; ++stage)
    for (int shear = 0; shear < 2; ++shear)
      if (!paths[shear][stage].empty())
        svg.path(paths[shear][stage],
                 pen + fmt::format(" stroke=\"{}\"", light(roles[shear][stage])));

  // The load: an arrow onto each end.
  const double middle = width / 2;
  const std::string ink = fmt::format("fill=\"{}\"", light("quiet"));
  svg.path(fmt::format("M{0} {1}h6v-14h4v14h6l-8 10z", compact(middle - 8), compact(top - 16)),
           ink);
  svg.path(
      fmt::format("M{0} {1}h6v14h4v-14h6l-8 -10z", compact(middle - 8), compact(body_bottom + 16)),
      ink);

  // Scale bar: a round length, a fifth to a half of the body's width.
  const double wanted = 0.3 * (x1 - x0), power = std::pow(10, std::floor(std::log10(wanted)));
  double bar = power;
  for (const double step : {2.0, 5.0, 10.0})
    if (step * power <= 1.5 * wanted) bar = step * power;
  const double bar_y = body_bottom + arrow + 12, bar_right = width - edge;
  svg.path(fmt::format("M{} {}v8m0 -4h{}m0 -4v8", compact(bar_right - scale * bar),
                       compact(bar_y - 4), compact(scale * bar)),
           fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"1.5\"", light("ink")));
  const std::string words = fmt::format("fill=\"{}\"", light("ink")),
                    quiet = fmt::format("fill=\"{}\"", light("quiet"));
  const std::string bar_length =
      bar >= 1e-3 ? significant(bar * 1e3) + " mm" : significant(bar * 1e6) + " \u00b5m";
  svg.text(bar_right - scale * bar - 6, bar_y + 4, bar_length, words + " text-anchor=\"end\"");
  svg.text(edge, bar_y + 4,
           view.horizontal + "\u2013" + view.vertical + (view.slice ? " plane (slice)" : " plane"),
           quiet);

  const double row = body_bottom + arrow + 52;
  const double columns[3] = {124, 258, 386};
  if (view.staged) {
    const char *heads[3] = {"to 90 % of the peak", "90 % to the peak", "after the peak"};
    for (int stage = 0; stage < 3; ++stage) svg.text(columns[stage], row - 8, heads[stage], quiet);
  } else {
    svg.text(columns[0], row - 8, "all cracks", quiet);
  }
  svg.text(edge, row - 8, "broken bonds", quiet);
  for (int shear = 0; shear < 2; ++shear) {
    const double y = row + 14 + 20 * shear;
    svg.text(edge, y, shear ? "in shear" : "in tension", words);
    for (int stage = view.staged ? 0 : 2; stage < 3; ++stage) {
      const double x = columns[view.staged ? stage : 0];
      svg.line(x, y - 4, x + 20, y - 4,
               fmt::format("stroke=\"{}\" stroke-width=\"3\" stroke-linecap=\"round\"",
                           light(roles[shear][stage])));
      svg.text(x + 28, y, count_text(counts[shear][stage]), words);
    }
  }
  return svg.finish();
}

std::string specimen_data(const SpecimenView &view) {
  std::string out =
      fmt::format("# bondlab-specimen-picture 1\n# discs: {}, {}, radius (m), bonds lost\n",
                  view.horizontal, view.vertical);
  for (const SpecimenView::Disc &disc : view.discs)
    out += fmt::format("{:.7g}\t{:.7g}\t{:.7g}\t{}\n", disc.x, disc.y, disc.r, disc.broken);
  out += fmt::format("\n\n# cracks: {}, {}, half segment (m, m), mode, stage, time (s)\n",
                     view.horizontal, view.vertical);
  const char *stages[3] = {"before_90_percent", "to_peak", "after_peak"};
  for (const Crack &crack : view.cracks)
    out += fmt::format("{:.7g}\t{:.7g}\t{:.7g}\t{:.7g}\t{}\t{}\t{:.7g}\n", crack.x, crack.y,
                       crack.dx, crack.dy, crack.shear ? "shear" : "tension",
                       view.staged ? stages[crack.stage] : "unknown", crack.time);
  return out;
}

}  // namespace bondlab
