// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/curve_rows.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "response/response.h"

namespace bondlab::diagnose {

namespace {

using Column = std::vector<double>;
constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr double least_strain = 1e-9;
constexpr double largest_toe = 5;             // of the strain from 0.3 to 0.6 of the peak
constexpr double least_fall = 0.01;           // of the way to the peak: steeper is all the same
constexpr double residual_from = 0.75;        // of the travel
constexpr double least_programme_load = 0.1;  // of the peak: below, a test is set up

// First time that the load reaches a share of its peak: the channel there, interpolated.
double at_share(const Column &load, std::size_t peak, const Column &channel, double share) {
  const double wanted = share * load[peak];
  std::size_t i = 1;
  while (i < peak && load[i] < wanted) ++i;
  const double low = load[i - 1], high = load[i];
  const double t = high > low ? std::clamp((wanted - low) / (high - low), 0.0, 1.0) : 1;
  return channel[i - 1] + t * (channel[i] - channel[i - 1]);
}

struct Landmarks {
  const Column &load;
  std::size_t peak;

  double between(const Column &channel, double from, double to) const {
    return at_share(load, peak, channel, to) - at_share(load, peak, channel, from);
  }
  double log_compliance(const Column &channel, double from, double to) const {
    return std::log(std::max(least_strain, between(channel, from, to)) /
                    ((to - from) * load[peak]));
  }
  // None of a channel that hardly moves, or goes back, while the load climbs: its share is
  // anything.
  double toe(const Column &channel, double share) const {
    const double value = between(channel, 0, share) / between(channel, 0.3, 0.6);
    return std::abs(value) < largest_toe && between(channel, 0.3, 0.6) > least_strain ? value
                                                                                      : none;
  }
  // Way from the peak until the load has fallen to a share, over the way to the peak, its
  // logarithm: falls of specimens of one rock differ by factors. A curve that ends before has none.
  double fall(const Column &channel, double share) const {
    std::size_t i = peak;
    while (i + 1 < load.size() && load[i] > share * load[peak]) ++i;
    if (load[i] > share * load[peak]) return none;
    const double way = channel[i] - channel[peak];
    return std::log(least_fall + way / std::max(least_strain, channel[peak] - channel.front()));
  }
};

bool has(const std::vector<std::string> &names, const std::string &name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

Column load_of(const Curve &curve) {
  if (curve.has("axial_stress")) return curve.column("axial_stress");
  Column load = curve.column("force_top");
  if (curve.has("force_bottom")) {
    const auto &other = curve.column("force_bottom");
    for (std::size_t i = 0; i < load.size(); ++i) load[i] = 0.5 * (load[i] + other[i]);
  }
  return load;
}

// The way of the machine's drive, or that of the platens.
const Column &travel_of(const Curve &curve, const std::string &quantity) {
  const bool stress = curve.has("axial_stress");
  if (quantity.rfind("machine", 0) == 0) return curve.column(stress ? "strain_machine" : "machine");
  return curve.column(stress && curve.has("strain_platen") ? "strain_platen" : "displacement");
}

bool has_gauge(const Curve &curve) { return curve.has("strain_axial") || curve.has("deflection"); }

const Column &gauge_of(const Curve &curve) {
  return curve.column(curve.has("strain_axial") ? "strain_axial" : "deflection");
}

double mean_of(const Column &v, std::size_t first, std::size_t last) {
  double sum = 0;
  for (std::size_t i = first; i < last; ++i) sum += v[i];
  return sum / static_cast<double>(last - first);
}

// Mean of b over mean of a while the load climbs between two shares of its peak.
double ratio_while_loading(const Landmarks &at, const Column &a, const Column &b, double from,
                           double to) {
  double top = 0, bottom = 0;
  for (std::size_t i = 0; i <= at.peak; ++i)
    if (at.load[i] >= from * at.load[at.peak] && at.load[i] <= to * at.load[at.peak])
      top += b[i], bottom += a[i];
  return bottom > 0 ? top / bottom : none;
}

// What is carried on average over the last quarter of the travel, over the peak; a test that does
// not go on to twice the way to the peak has none.
double residual(const Landmarks &at, const Column &travel) {
  const double end = travel.back() - travel.front();
  if (!(end >= 2 * (travel[at.peak] - travel.front()))) return none;
  std::size_t i = at.peak;
  while (travel[i] - travel.front() < residual_from * end) ++i;
  return mean_of(at.load, i, at.load.size()) / at.load[at.peak];
}

double landmark(const Landmarks &at, const Curve &curve, const std::string &name) {
  const auto gauge = [&]() -> const Column & { return gauge_of(curve); };
  const auto travel = [&]() -> const Column & { return travel_of(curve, name); };
  const auto is = [&](const char *travelled) {
    return name == std::string("platen ") + travelled ||
           name == std::string("machine ") + travelled;
  };
  const auto poisson = [&](double from, double to) {
    return at.between(curve.column("strain_lateral"), from, to) /
           std::max(least_strain, at.between(gauge(), from, to));
  };
  if (is("strain to 0.2")) return at.toe(travel(), 0.2);
  if (name == "gauge strain to 0.2") return at.toe(gauge(), 0.2);
  if (is("compliance 0.3 to 0.6")) return at.log_compliance(travel(), 0.3, 0.6);
  if (name == "gauge compliance 0.3 to 0.6") return at.log_compliance(gauge(), 0.3, 0.6);
  if (name == "Poisson's ratio 0.3 to 0.6") return poisson(0.3, 0.6);
  if (name == "side force 0.3 to 0.6")
    return ratio_while_loading(at, curve.column("force_top"), curve.column("side_force"), 0.3, 0.6);
  if (is("compliance 0.6 to 0.9")) return at.log_compliance(travel(), 0.6, 0.9);
  if (name == "gauge compliance 0.6 to 0.9") return at.log_compliance(gauge(), 0.6, 0.9);
  if (name == "fall to 0.8" || name == "machine fall to 0.8") return at.fall(travel(), 0.8);
  if (name == "residual load") return residual(at, travel());
  return none;
}

// As fix drive numbers what it does in the column `phase`.
enum Phase { going_on = 0, stopping = 1, holding = 2, keeping = 3, unloading = 4 };

struct Stretch {
  Phase phase;
  std::size_t first, last;  // [first, last)
};

// Stretches of a programme under load; the machine's stopping before a stretch is part of none.
std::vector<Stretch> programme_of(const Curve &curve, const Column &load, std::size_t peak) {
  std::vector<Stretch> out;
  if (!curve.has("phase")) return out;
  const auto &phase = curve.column("phase");
  for (std::size_t i = 1; i < phase.size();) {
    std::size_t j = i + 1;
    while (j < phase.size() && phase[j] == phase[i]) ++j;
    const bool turned = phase[i] == holding || phase[i] == keeping || phase[i] == unloading;
    if (turned && i < peak && load[i] > least_programme_load * load[peak])
      out.push_back({static_cast<Phase>(std::lround(phase[i])), i, j});
    i = j;
  }
  return out;
}

// Strain when the load first reaches a value on the way up to sample `last`.
double strain_at(const Column &load, const Column &strain, double value, std::size_t last) {
  std::size_t i = 1;
  while (i < last && load[i] < value) ++i;
  const double t = load[i] > load[i - 1]
                       ? std::clamp((value - load[i - 1]) / (load[i] - load[i - 1]), 0.0, 1.0)
                       : 1;
  return strain[i - 1] + t * (strain[i] - strain[i - 1]);
}

// A programme's rows; `name` tells which.
double of_programme(const Column &load, const Curve &curve, const std::vector<Stretch> &programme,
                    const std::string &name) {
  const Phase wanted = name == "strain gained in a hold" ? keeping
                       : name == "load fallen in a hold" ? holding
                                                         : unloading;
  const auto &strain = has_gauge(curve) ? gauge_of(curve) : travel_of(curve, name);
  if (name == "compliance to the first turn") {
    const std::size_t turn = programme.front().first;
    const double low = 0.3 * load[turn], high = 0.9 * load[turn];
    return std::log(std::max(least_strain, strain_at(load, strain, high, turn) -
                                               strain_at(load, strain, low, turn)) /
                    (high - low));
  }
  for (const auto &stretch : programme) {
    if (stretch.phase != wanted || stretch.last - stretch.first < 5) continue;
    const std::size_t count = stretch.last - stretch.first,
                      few = std::max<std::size_t>(1, count / 10);
    const double strain_there = std::max(least_strain, strain[stretch.first] - strain.front());
    if (wanted == keeping)  // not its first tenth, in which the servo finds the load
      return (mean_of(strain, stretch.last - few, stretch.last) -
              mean_of(strain, stretch.first + few, stretch.first + 2 * few)) /
             strain_there;
    if (wanted == holding)
      return 1 - mean_of(load, stretch.last - few, stretch.last) /
                     mean_of(load, stretch.first, stretch.first + few);
    // Down: the slope over the middle of the loads, and what is left of the strain, against the
    // first loading between the same loads.
    const double top = load[stretch.first], rest = load[stretch.last - 1];
    const auto down = [&](double value) {
      std::size_t i = stretch.first + 1;
      while (i + 1 < stretch.last && load[i] > value) ++i;
      const double t = load[i - 1] > load[i]
                           ? std::clamp((load[i - 1] - value) / (load[i - 1] - load[i]), 0.0, 1.0)
                           : 1;
      return strain[i - 1] + t * (strain[i] - strain[i - 1]);
    };
    const double high = top - 0.2 * (top - rest), low = top - 0.8 * (top - rest);
    const auto up = [&](double value) { return strain_at(load, strain, value, stretch.first); };
    if (name == "unloading stiffness over loading")
      return std::log(std::max(least_strain, up(high) - up(low)) /
                      std::max(least_strain, down(high) - down(low)));
    return (down(low) - up(low)) / strain_there;
  }
  return none;
}

const std::vector<CurveQuantity> &programme_quantities() {
  static const std::vector<CurveQuantity> list = {
      {CurvePart::slope, "compliance to the first turn"},
      {CurvePart::hold, "strain gained in a hold"},
      {CurvePart::hold, "load fallen in a hold"},
      {CurvePart::unload, "unloading stiffness over loading"},
      {CurvePart::unload, "strain left after unloading"}};
  return list;
}

bool of_programmes(const std::string &name) {
  for (const auto &quantity : programme_quantities())
    if (quantity.name == name) return true;
  return false;
}

}  // namespace

std::vector<CurveQuantity> quantities_of(const std::vector<std::string> &columns,
                                         const std::vector<std::string> &responses) {
  using P = CurvePart;
  std::vector<CurveQuantity> out;
  const bool stress = has(columns, "axial_stress");
  const bool machine = has(columns, stress ? "strain_machine" : "machine");
  const bool platen = has(columns, stress ? "strain_platen" : "displacement");
  const bool gauge = has(columns, stress ? "strain_axial" : "deflection");
  const bool lateral = stress && gauge && has(columns, "strain_lateral");
  const bool travel = machine || platen;
  const std::string drive = machine ? "machine " : "platen ";
  if ((!stress && !has(columns, "force_top")) || !(travel || gauge)) {
    for (const auto &name : responses) out.push_back({P::slope, "response " + name});
    return out;
  }
  if (travel) out.push_back({P::toe, drive + "strain to 0.2"});
  if (gauge) out.push_back({P::toe, "gauge strain to 0.2"});
  if (travel) out.push_back({P::slope, drive + "compliance 0.3 to 0.6"});
  if (gauge) out.push_back({P::slope, "gauge compliance 0.3 to 0.6"});
  if (lateral) out.push_back({P::slope, "Poisson's ratio 0.3 to 0.6"});
  if (has(columns, "side_force") && has(columns, "force_top"))
    out.push_back({P::slope, "side force 0.3 to 0.6"});
  // By the gauges a crack that misses or hits them would decide.
  out.push_back({P::pre_peak, (travel ? drive : std::string("gauge ")) + "compliance 0.6 to 0.9"});
  out.push_back({P::peak, "log peak"});
  if (travel) out.push_back({P::post_peak, machine ? "machine fall to 0.8" : "fall to 0.8"});
  if (platen) out.push_back({P::post_peak, "residual load"});
  if (has(columns, "phase"))
    for (const auto &quantity : programme_quantities()) out.push_back(quantity);
  return out;
}

Eigen::VectorXd rows_of_curve(const Curve &curve, const std::vector<CurveQuantity> &quantities,
                              const TestDefinition &test,
                              const std::map<std::string, double> &variables) {
  Eigen::VectorXd rows =
      Eigen::VectorXd::Constant(static_cast<Eigen::Index>(quantities.size()), none);
  Column load;
  for (std::size_t i = 0; i < quantities.size(); ++i) {
    const auto &name = quantities[i].name;
    auto &row = rows(static_cast<Eigen::Index>(i));
    if (name.rfind("response ", 0) == 0) {
      try {
        const double value =
            evaluate(test.responses.at(name.substr(9)).function, curve, {variables});
        row = value > 0 ? std::log(value) : none;
      } catch (const ResponseError &) {
        row = none;
      }
      continue;
    }
    if (curve.rows() < 3) continue;
    if (load.empty()) load = load_of(curve);
    const auto peak =
        static_cast<std::size_t>(std::max_element(load.begin(), load.end()) - load.begin());
    if (peak < 2 || !(load[peak] > 0)) continue;
    const auto programme = programme_of(curve, load, peak);
    if (name == "log peak")
      row = std::log(load[peak]);
    else if (of_programmes(name) == !programme.empty())
      row = programme.empty() ? landmark({load, peak}, curve, name)
                              : of_programme(load, curve, programme, name);
  }
  return rows;
}

void scale_loads(Curve &curve, double factor) {
  for (std::size_t i = 0; i < curve.names.size(); ++i)
    if (curve.names[i].find("stress") != std::string::npos || curve.names[i].rfind("force", 0) == 0)
      for (double &value : curve.columns[i]) value *= factor;
}

}  // namespace bondlab::diagnose
