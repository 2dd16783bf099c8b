// SPDX-License-Identifier: GPL-2.0-or-later
#include "response/envelope.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "base/table_file.h"
#include "base/test_folder.h"
#include "response/response.h"

namespace bondlab {
namespace {

constexpr double kDegrees = 180 / 3.14159265358979323846;

TEST(Envelope, points_of_a_coulomb_line_give_it_back_without_error) {
  const double c = 8e6, phi = 35 / kDegrees;
  std::vector<EnvelopePoint> points;
  for (const double sigma : {2e6, 5e6, 10e6, 15e6})
    points.push_back({"", sigma, c + sigma * std::tan(phi)});
  const EnvelopeLine line = envelope_line(points);
  EXPECT_NEAR(line.cohesion, c, 1e-9 * c);
  EXPECT_NEAR(line.friction_angle, 35, 1e-9);
  // what rounding leaves of the scatter: the square root of 1e-16 of the values
  EXPECT_LT(line.cohesion_error, 1e-7 * c);
  EXPECT_LT(line.friction_angle_error, 1e-5);
}

// By hand: x = 1, 2, 3, 4 and y = 3 + x + (1, -1, -1, 1)/2. The scatter is orthogonal to 1 and x, so
// that the line is y = 3 + x; its sum of squares is 1, s^2 = 1/2 with 2 degrees of freedom;
// sxx = 5, mean x 5/2: slope error sqrt(1/10), intercept error sqrt(1/2 (1/4 + 25/20)) = sqrt(3/4).
TEST(Envelope, errors_are_those_of_least_squares) {
  const EnvelopeLine line =
      envelope_line({{"a", 1, 4.5}, {"b", 2, 4.5}, {"c", 3, 5.5}, {"d", 4, 7.5}});
  EXPECT_NEAR(line.cohesion, 3, 1e-12);
  EXPECT_NEAR(line.friction_angle, 45, 1e-12);
  EXPECT_NEAR(line.cohesion_error, std::sqrt(0.75), 1e-12);
  EXPECT_NEAR(line.friction_angle_error, kDegrees * std::sqrt(0.1) / 2, 1e-12);
}

TEST(Envelope, needs_three_different_abscissae) {
  EXPECT_THROW(envelope_line({{"a", 1, 4}, {"b", 2, 5}}), ResponseError);
  EXPECT_THROW(envelope_line({{"a", 1, 4}, {"b", 2, 5}, {"c", 2, 5.1}}), ResponseError);
  EXPECT_NO_THROW(envelope_line({{"a", 1, 4}, {"b", 2, 5}, {"c", 3, 5.1}}));
}

// The sample study with four tests at different sizes of the deck variable sigma_c, which the line is over.
class EnvelopeOfAStudy : public testing::Test {
 protected:
  EnvelopeOfAStudy() {
    namespace fs = std::filesystem;
    fs::copy(fs::path(__FILE__).parent_path().parent_path() / "study" / "testdata", folder_ / "study",
             fs::copy_options::recursive);
    std::string text =
        "schema = 1\n[study]\nname = \"several\"\n[[specimens]]\nname = \"slab\"\nshape = \"rectangle\"\n"
        "width = \"50 mm\"\nheight = \"100 mm\"\nr_min = \"0.66 mm\"\n";
    for (const char *value : {"10", "20", "30", "40"})
      text += std::string("[[tests]]\nname = \"at_") + value +
              "\"\ntest = \"compression\"\nspecimen = \"slab\"\nvariables = { sigma_c = \"" + value + " MPa\" }\n";
    text += "[[envelopes]]\nname = \"peak\"\ntests = [\"at_10\", \"at_20\", \"at_30\", \"at_40\"]\n"
            "response = \"UCS\"\nover = \"sigma_c\"\nunit = \"MPa\"\n";
    setenv("BONDLAB_INPUTS", (folder_ / "study").c_str(), 1);
    std::ofstream(folder_ / "study" / "several.toml") << text;
    study = read_study(folder_ / "study" / "several.toml");
  }

  // A curve with this peak, which the load falls behind.
  ForwardOutcome outcome(double over, double peak) const {
    ForwardOutcome one;
    one.ok = true;
    one.curve.names = {"time", "axial_stress"};
    one.curve.units = {"s", "Pa"};
    one.curve.columns = {{0, 1, 2, 3}, {0, peak / 2, peak, peak / 2}};
    one.deck_variables = {{"sigma_c", over}};
    return one;
  }

  TestFolder folder_;
  Study study;
};

TEST_F(EnvelopeOfAStudy, takes_the_response_of_every_test) {
  const ForwardOutcome a = outcome(10e6, 60e6), b = outcome(20e6, 70e6), c = outcome(30e6, 80e6),
                       d = outcome(40e6, 90e6);
  const StrengthEnvelope envelope = envelope_of(study.envelopes.at(0), study,
                                        {{"at_10", &a}, {"at_20", &b}, {"at_30", &c}, {"at_40", &d}});
  ASSERT_TRUE(envelope.line) << envelope.why_none;
  EXPECT_NEAR(envelope.line->cohesion, 50e6, 1);
  EXPECT_NEAR(envelope.line->friction_angle, 45, 1e-9);
  EXPECT_EQ(envelope.points.size(), 4u);
  EXPECT_EQ(envelope_text(envelope).rfind("c 50 +- ", 0), 0u) << envelope_text(envelope);
  EXPECT_NEAR(envelope_figure(envelope, "cohesion"), 50e6, 1);
  EXPECT_NEAR(envelope_figure(envelope, "friction_angle"), std::atan(1.0), 1e-12);
}

TEST_F(EnvelopeOfAStudy, leaves_out_what_failed_and_says_so) {
  const ForwardOutcome a = outcome(10e6, 60e6), b = outcome(20e6, 70e6), c = outcome(30e6, 80e6);
  ForwardOutcome broken;
  broken.failure.message = "the engine crashed";
  StrengthEnvelope envelope = envelope_of(study.envelopes.at(0), study,
                                  {{"at_10", &a}, {"at_20", &b}, {"at_30", &c}, {"at_40", &broken}});
  ASSERT_TRUE(envelope.line);
  EXPECT_NEAR(envelope.line->friction_angle, 45, 1e-9);
  EXPECT_EQ(envelope.left_out, std::vector<std::string>{"at_40: the engine crashed"});
  try {  // to be seen, but not to be fitted: it isn't the line the study asks for
    envelope_figure(envelope, "cohesion");
    FAIL();
  } catch (const ResponseError &error) {
    EXPECT_STREQ(error.what(), "the envelope 'peak' lacks the point of at_40: the engine crashed");
  }
  envelope = envelope_of(study.envelopes.at(0), study, {{"at_10", &a}, {"at_20", &b}, {"at_40", &broken}});
  EXPECT_FALSE(envelope.line);
  EXPECT_EQ(envelope.left_out.size(), 2u);
  EXPECT_EQ(envelope_text(envelope), "none: 2 different abscissae, 3 needed for a line with its errors");
}

}  // namespace
}  // namespace bondlab
