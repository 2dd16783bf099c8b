// SPDX-License-Identifier: GPL-2.0-or-later
#include "view/pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "report/number_text.h"
#include "report/palette.h"

namespace bondlab {

namespace {

// 0.00012, "m" -> "0.12 mm"
std::string with_prefix(double value, const char *unit) {
  static const struct {
    double factor;
    const char *prefix;
  } prefixes[] = {{1e9, "G"},  {1e6, "M"},       {1e3, "k"},  {1, ""},
                  {1e-3, "m"}, {1e-6, "\u00b5"}, {1e-9, "n"}, {1e-12, "p"}};
  if (value == 0) return std::string("0 ") + unit;
  for (const auto &p : prefixes)
    if (std::fabs(value) >= 0.9995 * p.factor)
      return significant(value / p.factor, 3) + " " + p.prefix + unit;
  return significant(value / 1e-12, 3) + " p" + unit;
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(
                                       std::ceil(share * static_cast<double>(values.size() - 1)));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

ColourBar bar_from(const std::string &words, double low, double high, const char *unit,
                   bool more_above) {
  ColourBar bar{words, {}};
  constexpr int steps = 4;
  for (int k = 0; k <= steps; ++k)
    bar.ticks.push_back((k == steps && more_above ? "\u2265 " : "") +
                        with_prefix(low + (high - low) * k / steps, unit));
  return bar;
}

using PlaceOf = std::function<const Vector3 &(const ViewParticle &)>;
const Vector3 &at_start(const ViewParticle &p) { return p.start; }
const Vector3 &at_end(const ViewParticle &p) { return p.end; }

void add_discs(Drawing &drawing, const RunView &run, const Projection &projection,
               const PlaceOf &place, const std::function<std::string(std::size_t)> &colour) {
  drawing.plane = projection.words();
  drawing.shaded = projection.whole();
  for (std::size_t i = 0; i < run.particles.size(); ++i) {
    const Vector3 &x = place(run.particles[i]);
    const double r = projection.radius(x, run.particles[i].r);
    if (r <= 0) continue;
    const Projection::Place at = projection.at(x);
    drawing.discs.push_back({at.x, at.y, r, colour(i), at.depth});
  }
}

struct CrackLine {
  Projection::Place place;
  double dx, dy;  // half of it; 0 when its direction isn't known
  double r;       // smaller radius of the two
};

// False when it isn't in the picture.
bool crack_line(const RunView &run, const Projection &projection, const ViewBond &bond,
                CrackLine &line) {
  const ViewParticle &a = run.particles[static_cast<std::size_t>(bond.a)],
                     &b = run.particles[static_cast<std::size_t>(bond.b)];
  Vector3 normal{}, place = bond.place;
  double distance = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    normal[k] = b.end[k] - a.end[k];
    distance += normal[k] * normal[k];
  }
  distance = std::sqrt(distance);
  line.r = std::min(a.r, b.r);
  line.dx = line.dy = 0;
  if (distance > 0 && distance < 1.5 * (a.r + b.r)) {
    const double share = (a.r + (distance - a.r - b.r) / 2) / distance;
    for (std::size_t k = 0; k < 3; ++k) place[k] = a.end[k] + share * normal[k];
  }
  if (!projection.shows(place)) return false;
  line.place = projection.at(place);
  if (distance > 0) {
    const Projection::Place from = projection.at(a.end), to = projection.at(b.end);
    line.dx = -(to.y - from.y) / distance * line.r;
    line.dy = (to.x - from.x) / distance * line.r;
  }
  return true;
}

std::string broken_sentence(const RunView &run) {
  const auto tension = run.broken(BondState::tension), shear = run.broken(BondState::shear);
  std::string text = counted(static_cast<long>(tension + shear), "bond", "bonds") + " broken";
  if (run.has_bonds) text += " of " + count_text(static_cast<long>(run.bonds.size()));
  return text + ": " + count_text(static_cast<long>(tension)) + " in tension, " +
         count_text(static_cast<long>(shear)) + " in shear.";
}

// Cracks as lines over pale particles; seen from a side, as dots in a pale silhouette.
void add_cracks(Drawing &drawing, const RunView &run, const Projection &projection,
                const std::function<std::string(const ViewBond &)> &colour) {
  add_discs(drawing, run, projection, at_end, [&](std::size_t i) {
    return std::string(
        light(run.particles[i].broken > 0 && !projection.whole() ? "disc-hurt" : "disc"));
  });
  drawing.shaded = false;
  double r_mean = 0;
  for (const ViewParticle &p : run.particles)
    r_mean += p.r / static_cast<double>(run.particles.size());
  if (projection.whole()) {
    drawing.outline = 0;
    for (DrawnDisc &disc : drawing.discs) disc.depth = -INFINITY;
  }
  std::size_t hidden = 0;
  for (const ViewBond &bond : run.bonds) {
    if (bond.state == BondState::intact) continue;
    CrackLine line;
    if (!crack_line(run, projection, bond, line)) {
      ++hidden;
      continue;
    }
    if (projection.whole())
      drawing.discs.push_back(
          {line.place.x, line.place.y, 0.35 * line.r, colour(bond), line.place.depth});
    else
      drawing.lines.push_back({line.place.x - line.dx, line.place.y - line.dy,
                               line.place.x + line.dx, line.place.y + line.dy, colour(bond), 2.0,
                               bond.time});
  }
  drawing.sentences.push_back(broken_sentence(run));
  if (hidden > 0)
    drawing.sentences.push_back(count_text(static_cast<long>(hidden)) +
                                " of them lie before or behind this slice.");
}

}  // namespace

Drawing specimen_picture(const RunView &run, const Projection &projection) {
  Drawing drawing;
  drawing.title = run.has_start         ? "Specimen"
                  : run.moment.empty() ? "Specimen, at the end"
                                       : "Specimen, at " + run.moment;
  double low = INFINITY, high = 0;
  for (const ViewParticle &p : run.particles) low = std::min(low, p.r), high = std::max(high, p.r);
  const bool equal = high - low < 1e-6 * high;
  add_discs(drawing, run, projection, at_start, [&](std::size_t i) {
    return scale_colour(equal ? 0.5 : (run.particles[i].r - low) / (high - low));
  });
  if (!equal) drawing.bar = bar_from("particle radius", low, high, "m", false);
  std::string text = count_text(static_cast<long>(run.particles.size())) +
                     (run.dimension == 2 ? " discs" : " spheres");
  if (equal) text += " of radius " + with_prefix(high, "m");
  if (run.has_bonds) text += ", " + count_text(static_cast<long>(run.bonds.size())) + " bonds";
  drawing.sentences.push_back(text + ".");
  return drawing;
}

Drawing cracks_by_mode(const RunView &run, const Projection &projection) {
  Drawing drawing;
  if (!run.has_log) return drawing;
  drawing.title = "Cracks by mode";
  const std::string tension = light("tension-mid"), shear = light("shear-late");
  add_cracks(drawing, run, projection, [&](const ViewBond &bond) {
    return bond.state == BondState::shear ? shear : tension;
  });
  const bool dots = projection.whole();
  drawing.keys = {{tension, "broken in tension", !dots, 3}, {shear, "broken in shear", !dots, 3}};
  return drawing;
}

Drawing cracks_by_time(const RunView &run, const Projection &projection) {
  Drawing drawing;
  if (!run.has_log || run.broken(BondState::intact) == run.bonds.size()) return drawing;
  drawing.title = "Cracks by time";
  double first = INFINITY, last = -INFINITY;
  for (const ViewBond &bond : run.bonds)
    if (bond.state != BondState::intact)
      first = std::min(first, bond.time), last = std::max(last, bond.time);
  const double span = last > first ? last - first : 1;
  add_cracks(drawing, run, projection,
             [&](const ViewBond &bond) { return scale_colour((bond.time - first) / span); });
  if (last > first) drawing.bar = bar_from("time of breaking", first, last, "s", false);
  drawing.sentences.push_back("First crack at " + with_prefix(first, "s") + ", last at " +
                              with_prefix(last, "s") + ".");
  return drawing;
}

Drawing force_chains(const RunView &run, const Projection &projection) {
  Drawing drawing;
  if (!run.has_forces || projection.whole()) return drawing;
  drawing.title = "Force chains";
  const auto place = [&](std::size_t i) -> const Vector3 & {
    return run.force_places.empty() ? run.particles[i].end : run.force_places[i];
  };
  drawing.plane = projection.words();
  drawing.outline = 0.6;
  for (std::size_t i = 0; i < run.particles.size(); ++i) {
    const double r = projection.radius(place(i), run.particles[i].r);
    const Projection::Place at = projection.at(place(i));
    if (r > 0) drawing.discs.push_back({at.x, at.y, r, light("panel"), at.depth});
  }
  std::vector<double> sizes;
  for (const BondForce &force : run.forces) sizes.push_back(std::fabs(force.normal));
  const double full = quantile(sizes, 0.98);
  const std::string push = light("series-1"), pull = light("bad");
  std::size_t pushed = 0;
  for (const BondForce &force : run.forces) {
    const Vector3 &a = place(static_cast<std::size_t>(force.a)),
                  &b = place(static_cast<std::size_t>(force.b));
    pushed += force.normal < 0;
    const double share = full > 0 ? std::fabs(force.normal) / full : 0;
    if (share < 0.02 || !projection.shows(a) || !projection.shows(b)) continue;
    const Projection::Place from = projection.at(a), to = projection.at(b);
    drawing.lines.push_back({from.x, from.y, to.x, to.y, force.normal < 0 ? push : pull,
                             0.3 + 4.2 * std::min(share, 1.0), share});
  }
  drawing.keys = {{push, "compression", true, 4}, {pull, "tension", true, 4}};
  drawing.sentences.push_back(
      "Normal forces of " + counted(static_cast<long>(run.forces.size()), "bond", "bonds") +
      " at step " + count_text(run.force_step) + ": " + count_text(static_cast<long>(pushed)) +
      " in compression. The widest lines carry " + with_prefix(full, "N") +
      " and more; below 2 % of that none is drawn.");
  if (run.force_places.empty())
    drawing.sentences.push_back("The particles are drawn where they are at the end.");
  drawing.sentences.push_back("Forces of contacts without a bond are not among them.");
  return drawing;
}

Drawing displacements(const RunView &run, const Projection &projection) {
  Drawing drawing;
  if (!run.has_start) return drawing;
  drawing.title = "Displacement";
  std::vector<double> size;
  for (const ViewParticle &p : run.particles)
    size.push_back(std::sqrt(std::pow(p.end[0] - p.start[0], 2) +
                             std::pow(p.end[1] - p.start[1], 2) +
                             std::pow(p.end[2] - p.start[2], 2)));
  const double largest = *std::max_element(size.begin(), size.end()), full = quantile(size, 0.98);
  add_discs(drawing, run, projection, at_end,
            [&](std::size_t i) { return scale_colour(full > 0 ? size[i] / full : 0); });
  drawing.bar = bar_from("displacement", 0, full, "m", largest > full);
  drawing.sentences.push_back(
      (run.moment.empty() ? "From the start to the end of the test" : "From the start to this moment") +
      std::string("; the largest is ") + with_prefix(largest, "m") + ".");
  if (projection.whole() || drawing.discs.empty()) return drawing;

  // Arrows of about 150 particles, one a square of the picture.
  double x0 = INFINITY, x1 = -INFINITY, y0 = INFINITY, y1 = -INFINITY;
  for (const ViewParticle &p : run.particles) {
    const Projection::Place at = projection.at(p.start);
    x0 = std::min(x0, at.x), x1 = std::max(x1, at.x);
    y0 = std::min(y0, at.y), y1 = std::max(y1, at.y);
  }
  const double cell =
      std::max(std::sqrt((x1 - x0) * (y1 - y0) / 150),
               2.2 * std::sqrt((x1 - x0) * (y1 - y0) / static_cast<double>(drawing.discs.size())));
  std::map<std::pair<long, long>, bool> taken;
  for (const ViewParticle &p : run.particles) {
    if (projection.radius(p.end, p.r) <= 0) continue;
    const Projection::Place from = projection.at(p.start), to = projection.at(p.end);
    const std::pair<long, long> square(std::lround(std::floor((to.x - x0) / cell)),
                                       std::lround(std::floor((to.y - y0) / cell)));
    if (!taken.emplace(square, true).second) continue;
    double dx = full > 0 ? (to.x - from.x) / full : 0, dy = full > 0 ? (to.y - from.y) / full : 0;
    const double length = std::hypot(dx, dy);
    if (length > 1) dx /= length, dy /= length;
    drawing.arrows.push_back({to.x, to.y, 24 * dx, 24 * dy});
  }
  drawing.sentences.push_back("Arrows: direction, and size up to the end of the scale.");
  return drawing;
}

Drawing fragments_picture(const RunView &run, const Projection &projection) {
  Drawing drawing;
  if (!run.has_bonds) return drawing;
  drawing.title = "Fragments";
  static const char *const colours[] = {"#d9cfb8", "#3b78b5", "#d8843a", "#4f9d69",
                                        "#9a6fb8", "#c9556a", "#5bb3b8", "#b39b2e"};
  constexpr std::size_t shown = sizeof colours / sizeof *colours;
  const std::string single = "#8b95a3", few = "#5c6878";
  const auto colour_of = [&](int fragment) -> std::string {
    const auto k = static_cast<std::size_t>(fragment);
    if (run.fragments[k].particles == 1 && k > 0) return single;
    return k < shown ? colours[k] : few;
  };
  add_discs(drawing, run, projection, at_end,
            [&](std::size_t i) { return colour_of(run.particles[i].fragment); });
  long parts = 0, alone = 0, unnamed = 0;
  for (std::size_t k = 0; k < run.fragments.size(); ++k) {
    const Fragment &fragment = run.fragments[k];
    if (fragment.particles == 1) {
      ++alone;
      continue;
    }
    ++parts;
    if (k >= shown)
      ++unnamed;
    else
      drawing.keys.push_back(
          {colours[k], fmt::format("{:.3g} %, {} particles", 100 * fragment.share,
                                   count_text(fragment.particles))});
  }
  if (unnamed > 0) drawing.keys.push_back({few, counted(unnamed, "smaller one", "smaller ones")});
  if (alone > 0)
    drawing.keys.push_back({single, counted(alone, "single particle", "single particles")});
  drawing.sentences.push_back(
      "Parts still connected by bonds: " + counted(parts, "part", "parts") +
      " of two and more particles, " + counted(alone, "particle", "particles") +
      " alone. The largest holds " +
      fmt::format("{:.3g} %", run.fragments.empty() ? 0 : 100 * run.fragments.front().share) +
      " of the mass (shares in the list are of the mass).");
  return drawing;
}

}  // namespace bondlab
