// SPDX-License-Identifier: GPL-2.0-or-later
#include "specimen/specimen_json.h"

#include <charconv>
#include <nlohmann/json.hpp>

#include "base/units.h"
#include "base/user_error.h"

namespace bondlab {

namespace {

using Json = nlohmann::ordered_json;

// Through text, so that the number written is the short one: 0.1631 and not 0.16310000000000002.
double rounded(double value, int digits) {
  const std::string text = format_quantity(value, "", digits);
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

void put_container(Json &json, const SpecimenRequest &request) {
  json["shape"] = shape_name(request.shape);
  const Dimensions size = request.dimensions();
  for (const NamedDimension &dimension : dimensions_of(request.shape))
    json[dimension.name] = size.*dimension.value;
  if (!request.container().has_notch()) return;
  json["notch_depth"] = request.notch_depth;
  json["notch_width"] = request.notch_width;
}

}  // namespace

std::string metadata_line(const Specimen &specimen, std::size_t most) {
  const SpecimenStatistics &s = specimen.statistics;
  Json json;
  put_container(json, specimen.request);
  json["seed"] = specimen.request.seed;
  json["method"] = specimen.request.method;
  json["r_min"] = rounded(s.r_min, 6);
  json["r_max"] = rounded(s.r_max, 6);
  json["count"] = s.count;
  json["porosity"] = rounded(s.porosity, 4);
  json["coordination"] = rounded(s.coordination[bond_gap_index], 4);
  json["key"] = specimen_key(specimen.request);
  for (const char *spare : {"method", "porosity", "coordination"}) {
    if (json.dump().size() < most) break;
    json.erase(spare);
  }
  return json.dump();
}

std::optional<MetadataLine> parse_metadata_line(const std::string &text) {
  const Json json = Json::parse(text, nullptr, false);
  if (!json.is_object()) return std::nullopt;
  try {
    MetadataLine line;
    SpecimenRequest &request = line.request;
    request.shape = shape_from_name(json.at("shape"));
    Dimensions size;
    for (const NamedDimension &dimension : dimensions_of(request.shape))
      size.*dimension.value = json.at(dimension.name);
    if (json.contains("notch_depth")) {
      size.notch_depth = json.at("notch_depth");
      size.notch_width = json.at("notch_width");
    }
    request.set_dimensions(size);
    request.seed = json.at("seed");
    line.key = json.at("key");
    return line;
  } catch (const Json::exception &) {
    return std::nullopt;
  } catch (const UserError &) {  // a shape that doesn't exist
    return std::nullopt;
  }
}

std::string specimen_record(const Specimen &specimen, const std::string &data_hash) {
  const SpecimenRequest &request = specimen.request;
  const SpecimenStatistics &s = specimen.statistics;
  Json json;
  json["format"] = "bondlab specimen record 1";
  json["key"] = specimen_key(request);
  json["data_hash"] = data_hash;
  Json &asked = json["request"];
  put_container(asked, request);
  if (request.method != "expansion") asked["method"] = request.method;
  if (request.method == "insertion") asked["tries"] = request.tries;
  if (request.sizes == "log-normal") {
    asked["r_median"] = request.r_median;
    asked["r_spread"] = request.r_spread;
  } else if (request.sizes == "discrete") {
    for (const SizeClass &c : request.classes)
      asked["classes"].push_back({{"r", c.r}, {"share", c.share}});
  } else if (request.sizes == "d10-d50-d90") {
    asked["d10"] = request.d10;
    asked["d50"] = request.d50;
    asked["d90"] = request.d90;
  } else {
    asked["r_min"] = request.r_min;
    asked["r_ratio"] = request.r_ratio;
  }
  asked["sizes"] = request.sizes;
  asked["seed"] = request.seed;
  asked["density_kg_m3"] = request.density;
  asked["overlap"] = request.overlap;
  Json &found = json["statistics"];
  found["count"] = s.count;
  found["r_min"] = s.r_min;
  found["r_max"] = s.r_max;
  found["r_mean"] = s.r_mean;
  found["size_factor"] = s.size_factor;
  found["porosity"] = s.porosity;
  found["porosity_inner"] = s.porosity_inner;
  Json &coordination = found["coordination"];
  for (std::size_t g = 0; g < coordination_gaps.size(); ++g)
    coordination.push_back(
        {{"gap_over_r_mean", coordination_gaps[g]}, {"bonds_per_particle", s.coordination[g]}});
  found["fewest_bonds"] = s.fewest_bonds;
  found["clusters"] = s.clusters;
  found["mean_overlap"] = s.mean_overlap;
  found["max_overlap"] = s.max_overlap;
  found["stick_out"] = s.stick_out;
  found["fabric_ratio"] = s.fabric_ratio;
  found["stress_ratio"] = s.stress_ratio;
  found["stress_over_modulus"] = s.stress_over_modulus;
  found["floaters"] = s.floaters;
  found["floaters_grown"] = s.floaters_grown;
  found["on_bottom"] = s.on_bottom;
  found["on_top"] = s.on_top;
  return json.dump(1) + "\n";
}

std::optional<RecordHeader> parse_specimen_record(const std::string &text) {
  const Json json = Json::parse(text, nullptr, false);
  if (!json.is_object()) return std::nullopt;
  try {
    return RecordHeader{json.at("key"), json.at("data_hash")};
  } catch (const Json::exception &) {
    return std::nullopt;
  }
}

}  // namespace bondlab
