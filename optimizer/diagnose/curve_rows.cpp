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
    return std::log(std::max(least_strain, between(channel, from, to)) / ((to - from) * load[peak]));
  }
  double toe(const Column &channel, double share) const {
    return between(channel, 0, share) / std::max(least_strain, between(channel, 0.3, 0.6));
  }
  // Way from the peak until the load has fallen to a share, over the way to the peak; a curve that
  // ends before has none.
  double fall(const Column &channel, double share) const {
    std::size_t i = peak;
    while (i + 1 < load.size() && load[i] > share * load[peak]) ++i;
    if (load[i] > share * load[peak]) return none;
    return (channel[i] - channel[peak]) / std::max(least_strain, channel[peak] - channel.front());
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

double landmark(const Landmarks &at, const Curve &curve, const std::string &name) {
  const auto gauge = [&]() -> const Column & { return curve.column("strain_axial"); };
  const auto platen = [&]() -> const Column & {
    return curve.column(curve.has("strain_platen") ? "strain_platen" : "displacement");
  };
  const auto poisson = [&](double from, double to) {
    return at.between(curve.column("strain_lateral"), from, to) /
           std::max(least_strain, at.between(gauge(), from, to));
  };
  if (name == "log peak") return std::log(at.load[at.peak]);
  if (name == "platen strain to 0.2") return at.toe(platen(), 0.2);
  if (name == "gauge strain to 0.2") return at.toe(gauge(), 0.2);
  if (name == "platen compliance 0.3 to 0.6") return at.log_compliance(platen(), 0.3, 0.6);
  if (name == "gauge compliance 0.3 to 0.6") return at.log_compliance(gauge(), 0.3, 0.6);
  if (name == "Poisson's ratio 0.3 to 0.6") return poisson(0.3, 0.6);
  if (name == "platen compliance 0.6 to 0.9") return at.log_compliance(platen(), 0.6, 0.9);
  if (name == "gauge compliance 0.6 to 0.9") return at.log_compliance(gauge(), 0.6, 0.9);
  if (name == "Poisson's ratio 0.6 to 0.9") return poisson(0.6, 0.9);
  if (name == "fall to 0.8") return at.fall(platen(), 0.8);
  return none;
}

}  // namespace

std::vector<CurveQuantity> quantities_of(const std::vector<std::string> &columns,
                                         const std::vector<std::string> &responses) {
  using P = CurvePart;
  std::vector<CurveQuantity> out;
  const bool stress = has(columns, "axial_stress");
  const bool platen = has(columns, stress ? "strain_platen" : "displacement");
  const bool gauge = stress && has(columns, "strain_axial");
  const bool lateral = gauge && has(columns, "strain_lateral");
  if ((!stress && !has(columns, "force_top")) || !(platen || gauge)) {
    for (const auto &name : responses) out.push_back({P::slope, "response " + name});
    return out;
  }
  if (platen) out.push_back({P::toe, "platen strain to 0.2"});
  if (gauge) out.push_back({P::toe, "gauge strain to 0.2"});
  if (platen) out.push_back({P::slope, "platen compliance 0.3 to 0.6"});
  if (gauge) out.push_back({P::slope, "gauge compliance 0.3 to 0.6"});
  if (lateral) out.push_back({P::slope, "Poisson's ratio 0.3 to 0.6"});
  if (platen && !gauge) out.push_back({P::pre_peak, "platen compliance 0.6 to 0.9"});
  if (gauge) out.push_back({P::pre_peak, "gauge compliance 0.6 to 0.9"});
  if (lateral) out.push_back({P::pre_peak, "Poisson's ratio 0.6 to 0.9"});
  out.push_back({P::peak, "log peak"});
  if (platen) out.push_back({P::post_peak, "fall to 0.8"});
  return out;
}

Eigen::VectorXd rows_of_curve(const Curve &curve, const std::vector<CurveQuantity> &quantities,
                              const TestDefinition &test,
                              const std::map<std::string, double> &variables) {
  Eigen::VectorXd rows = Eigen::VectorXd::Constant(static_cast<Eigen::Index>(quantities.size()), none);
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
    row = landmark({load, peak}, curve, name);
  }
  return rows;
}

void scale_loads(Curve &curve, double factor) {
  for (std::size_t i = 0; i < curve.names.size(); ++i)
    if (curve.names[i].find("stress") != std::string::npos || curve.names[i].rfind("force", 0) == 0)
      for (double &value : curve.columns[i]) value *= factor;
}

}  // namespace bondlab::diagnose
