// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/run_record.h"

#include <nlohmann/json.hpp>

#include "response/response.h"
#include "response/run_quality.h"

namespace bondlab {

namespace {

using Json = nlohmann::ordered_json;

Json responses_of(const TestEntry &test, const ForwardOutcome &outcome) {
  Json responses = Json::object();
  for (const auto &[name, response] : test.definition.responses) try {
      responses[name] = {
          {"value", evaluate(response.function, outcome.curve, {outcome.deck_variables})},
          {"unit", response.unit}};
    } catch (const ResponseError &error) {
      responses[name] = {{"value", nullptr}, {"unit", response.unit}, {"why", error.what()}};
    }
  return responses;
}

Json test_json(const TestEntry &test, const ForwardOutcome &outcome) {
  Json json;
  json["test"] = test.name;
  json["ok"] = outcome.ok;
  if (!outcome.ok) {
    json["cause"] = to_string(outcome.failure.cause);
    json["message"] = outcome.failure.message;
    json["directory"] = outcome.failure.run_directory;
    return json;
  }
  json["run"] = outcome.run_id;
  json["directory"] = outcome.run_directory;
  json["replay"] = outcome.replay_command;
  json["wall_seconds"] = outcome.wall_seconds;
  if (outcome.cost) {
    json["steps"] = outcome.cost->steps;
    json["particles"] = outcome.cost->particles;
    json["bonds"] = outcome.cost->bonds;
    json["ns_per_bond_and_step"] = outcome.cost->ns_per_bond_and_step();
  }
  json["responses"] = responses_of(test, outcome);
  json["quality"] = run_quality(test, outcome);
  return json;
}

Json envelope_json(const StrengthEnvelope &envelope, const Study &study) {
  Json json;
  json["name"] = envelope.name;
  json["response"] = envelope.response;
  json["over"] = envelope.over;
  if (envelope.line) {
    json["cohesion"] = envelope.line->cohesion;
    json["cohesion_error"] = envelope.line->cohesion_error;
    json["friction_angle"] = envelope.line->friction_angle;
    json["friction_angle_error"] = envelope.line->friction_angle_error;
  } else {
    json["cohesion"] = json["friction_angle"] = nullptr;
    json["why"] = envelope.why_none;
  }
  json["points"] = Json::array();
  for (const EnvelopePoint &point : envelope.points)
    json["points"].push_back({{"test", point.test}, {"over", point.over}, {"value", point.value}});
  json["left_out"] = envelope.left_out;
  if (!envelope.points.empty())
    json["unit"] = study.test(envelope.points.front().test)
                       .definition.responses.at(envelope.response)
                       .unit;
  return json;
}

}  // namespace

std::string run_record(const Study &study, const std::vector<double> &values,
                       const std::vector<std::string> &tests,
                       const std::vector<ForwardOutcome> &outcomes,
                       const std::vector<StrengthEnvelope> &envelopes) {
  Json json;
  json["format"] = "bondlab run 1";
  json["study"] = study.name;
  json["parameters"] = Json::object();
  for (std::size_t i = 0; i < study.parameters.size(); ++i)
    json["parameters"][study.parameters[i].name] = values[i];
  json["tests"] = Json::array();
  for (std::size_t i = 0; i < tests.size(); ++i)
    json["tests"].push_back(test_json(study.test(tests[i]), outcomes[i]));
  json["envelopes"] = Json::array();
  for (const StrengthEnvelope &envelope : envelopes) json["envelopes"].push_back(envelope_json(envelope, study));
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace bondlab
