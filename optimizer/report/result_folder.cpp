// SPDX-License-Identifier: GPL-2.0-or-later
#include "report/result_folder.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>
#include <utility>

#include "base/table_file.h"
#include "report/number_text.h"
#include "specimen/specimen.h"
#include "specimen/statistics.h"
#include "study/specimen_request.h"

namespace bondlab {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::json;

std::optional<Json> read_json(const fs::path &file) {
  std::error_code error;
  if (!fs::is_regular_file(file, error)) return std::nullopt;
  try {
    Json json = Json::parse(read_text_file(file), nullptr, false);
    if (json.is_object()) return json;
  } catch (const UserError &) {  // not readable: left out, see the header
  }
  return std::nullopt;
}

std::string size_text(const SpecimenEntry &s) {
  const auto mm = [](double metres) { return significant(1e3 * metres) + " mm"; };
  const Dimensions &d = s.size;
  const std::string notch =
      d.notch_depth > 0 ? ", notch " + mm(d.notch_depth) + " deep, " + mm(d.notch_width) + " wide"
                        : "";
  switch (s.shape) {
    case SpecimenShape::rectangle:
      return mm(d.width) + " \u00d7 " + mm(d.height) + notch;
    case SpecimenShape::prism:
      return mm(d.width) + " \u00d7 " + mm(d.height) + " \u00d7 " + mm(d.length) + notch;
    case SpecimenShape::cylinder:
      return "diameter " + mm(d.diameter) + ", length " + mm(d.height) + notch;
    case SpecimenShape::disc:
    case SpecimenShape::sphere:
      return "diameter " + mm(d.diameter);
  }
  return "";
}

void add_figures(ReportSpecimen &specimen, const Json &record) {
  const Json &found = record.at("statistics");
  specimen.particles = found.at("count");
  specimen.r_min = found.at("r_min"), specimen.r_max = found.at("r_max");
  specimen.porosity = found.at("porosity");
  for (const Json &at_gap : found.at("coordination"))
    if (at_gap.at("gap_over_r_mean") == bond_gap)
      specimen.coordination = at_gap.at("bonds_per_particle");
}

}  // namespace

std::vector<ReportRun> read_ledger(const fs::path &directory) {
  std::vector<std::pair<long, ReportRun>> found;
  std::error_code error;
  for (const fs::directory_entry &entry : fs::directory_iterator(directory / "runs", error)) {
    const std::optional<Json> manifest = read_json(entry.path() / "manifest.json");
    if (!manifest) continue;
    try {
      const std::string state = manifest->at("state");
      if (state != "done" && state != "failed") continue;
      ReportRun run;
      const long number = manifest->at("id");
      run.id = std::to_string(number);
      run.test = manifest->at("test"), run.packing = manifest->at("packing");
      run.ok = state == "done";
      run.cause = manifest->value("cause", ""), run.message = manifest->value("message", "");
      run.wall_seconds = manifest->value("wall_seconds", no_number);
      if (const auto cost = manifest->find("cost"); cost != manifest->end()) {
        run.steps = cost->at("steps"), run.particles = cost->at("particles");
        run.bonds = cost->at("bonds"), run.bond_step_ns = cost->at("ns_per_bond_and_step");
      }
      run.directory = "runs/" + entry.path().filename().string();
      found.emplace_back(number, std::move(run));
    } catch (const Json::exception &) {  // another program's file
    }
  }
  std::sort(found.begin(), found.end(), [](const auto &a, const auto &b) {
    return std::make_pair(a.first, a.second.directory) <
           std::make_pair(b.first, b.second.directory);
  });
  std::vector<ReportRun> runs;
  for (auto &run : found) runs.push_back(std::move(run.second));
  return runs;
}

std::vector<ReportSpecimen> read_specimens(const Study &study, const fs::path &directory) {
  std::vector<ReportSpecimen> specimens;
  for (const SpecimenEntry &s : study.specimens) {
    ReportSpecimen specimen;
    specimen.name = s.name, specimen.shape = shape_name(s.shape), specimen.size = size_text(s);
    specimen.r_min = s.r_min, specimen.r_max = s.r_min * s.r_ratio,
    specimen.seed = std::to_string(s.seed);
    const std::string file = specimen.shape + "-" + specimen_key(specimen_request(s, 0)) + ".json";
    if (const std::optional<Json> record = read_json(directory / "specimens" / file)) {
      try {
        ReportSpecimen with_figures = specimen;
        add_figures(with_figures, *record);
        specimen = with_figures;
      } catch (const Json::exception &) {  // a record of another version
      }
    }
    specimens.push_back(std::move(specimen));
  }
  return specimens;
}

}  // namespace bondlab
