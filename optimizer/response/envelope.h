// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: the strength envelope of a study: one response of several tests as a straight line over
//   another response or a deck variable of these tests, such as the shear strength over the normal
//   stress.
// Method: least squares, every test with the same weight: tau = c + sigma_n tan(phi) (Coulomb).
//   Standard errors from the scatter about the line with n - 2 degrees of freedom; that of the angle
//   is that of the slope over 1 + slope^2. They say how well a straight line fits the points (a
//   curved envelope makes them large), not how much another packing would give.
// Why not a weighted fit: one run a test says nothing of its own scatter.
// Units: SI; angles in degrees.
// Failure: a test whose run failed or that doesn't give the response is left out with a sentence; no
//   line (a sentence why) when fewer than three different abscissae are left. As a figure that is
//   compared with a measured one the line must go through every test the study names: with one
//   left out it would be another figure, and a fit would see it jump.
// Limits: a straight line; where the envelope is curved, c and phi hold for the range tested.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "forward/forward_model.h"
#include "study/study.h"

namespace bondlab {

struct EnvelopePoint {
  std::string test;
  double over = 0, value = 0;
};

struct EnvelopeLine {
  double cohesion = 0, cohesion_error = 0;              // in the response's unit
  double friction_angle = 0, friction_angle_error = 0;  // degrees
};

struct StrengthEnvelope {
  std::string name, unit;  // as in the study
  std::string response, over;
  std::vector<EnvelopePoint> points;  // in the order of the tests
  std::vector<std::string> left_out;  // "shear_5: why"
  std::optional<EnvelopeLine> line;
  std::string why_none;  // set when there is no line
};

// ResponseError (window_too_small) for fewer than three different abscissae.
EnvelopeLine envelope_line(const std::vector<EnvelopePoint> &points);

// `outcomes` by the name of a test; a test that isn't there counts as not run.
StrengthEnvelope envelope_of(const EnvelopeEntry &entry, const Study &study,
                     const std::map<std::string, const ForwardOutcome *> &outcomes);

// One of envelope_figures(), SI. ResponseError, the sentence naming the tests left out, when there is
// no line or not every test of the study gave a point.
double envelope_figure(const StrengthEnvelope &envelope, const std::string &figure);

// "c 8.31 +- 0.42 MPa, phi 34.2 +- 1.1 degrees (4 tests)", or "none: why".
std::string envelope_text(const StrengthEnvelope &envelope);

}  // namespace bondlab
