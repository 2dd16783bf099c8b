// SPDX-License-Identifier: GPL-2.0-or-later
#include "response/cantilever.h"

#include <fmt/format.h>

#include <cmath>

#include "response/beam_section.h"
#include "response/loading_branch.h"

namespace bondlab::cantilever {

namespace {

struct Branch {
  const std::vector<double> &load;
  std::size_t peak;
  SampleWindow window() const { return loading_window(load, peak); }
};

Branch branch_of(const Curve &curve) {
  require_monotonic_time(curve);
  const auto &load = finite_column(curve, "force_top");
  return {load, find_peak(load)};
}

}  // namespace

double compliance(const Curve &curve, const ResponseContext &) {
  const Branch b = branch_of(curve);
  const double slope = fit_line(b.load, finite_column(curve, "deflection"), b.window()).slope;
  if (!(slope > 0))
    throw ResponseError(ResponseCause::implausible,
                        fmt::format("the deflection falls with the load, by {:g} m/N", slope));
  return slope;
}

double modulus_slender(const Curve &curve, const ResponseContext &context) {
  const double arm = context.positive("arm");
  return arm * arm * arm / (3 * beam_section(context).inertia()) / compliance(curve, context);
}

double modulus(const Curve &curve, const ResponseContext &context) {
  const BeamSection s = beam_section(context);
  const double arm = context.positive("arm"), nu = context.positive("poisson");
  const double shear = arm * 2 * (1 + nu) / (s.shear_factor(nu) * s.area());
  return (arm * arm * arm / (3 * s.inertia()) + shear) / compliance(curve, context);
}

double strength(const Curve &curve, const ResponseContext &context) {
  const BeamSection s = beam_section(context);
  const Branch b = branch_of(curve);
  return b.load[b.peak] * context.positive("arm") * s.depth / 2 / s.inertia();
}

double platen_imbalance(const Curve &curve, const ResponseContext &) {
  return relative_imbalance(finite_column(curve, "force_top"), finite_column(curve, "force_bottom"),
                            branch_of(curve).window());
}

double kinetic_share(const Curve &curve, const ResponseContext &) {
  return bondlab::kinetic_share(curve, branch_of(curve).window());
}

}  // namespace bondlab::cantilever
