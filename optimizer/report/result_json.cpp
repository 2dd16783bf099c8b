// SPDX-License-Identifier: GPL-2.0-or-later
#include "report/result_json.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <type_traits>

#include "base/table_file.h"
#include "base/user_error.h"
#include "report/atomic_file.h"

namespace bondlab {
namespace {

using Json = nlohmann::ordered_json;
constexpr const char *format_name = "bondlab-result 1";

// The two archives share one list of fields a struct (below), so that what is written and what is
// read can't differ.
class Writer {
 public:
  explicit Writer(Json &json) : json_(json) {}
  static constexpr bool reading = false;

  template <class T>
  void operator()(const char *key, T &value) {
    json_[key] = to(value);
  }
  template <class T>
  void since_later(const char *key, T &value) {
    (*this)(key, value);
  }
  template <class F>
  void group(const char *key, F &&body) {
    Json inner = Json::object();
    Writer writer(inner);
    body(writer);
    json_[key] = std::move(inner);
  }

 private:
  static Json to(const std::string &text) { return text; }
  static Json to(bool value) { return value; }
  static Json to(int value) { return value; }
  static Json to(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }
  template <class T>
  static Json to(const std::vector<T> &items) {
    Json list = Json::array();
    for (const T &item : items) list.push_back(to(item));
    return list;
  }
  static Json to(const std::map<std::string, double> &items) {
    Json object = Json::object();
    for (const auto &item : items) object[item.first] = to(item.second);
    return object;
  }
  template <class T>
  static auto to(const T &item)
      -> decltype(fields(std::declval<Writer &>(), const_cast<T &>(item)), Json()) {
    Json object = Json::object();
    Writer writer(object);
    fields(writer, const_cast<T &>(item));
    return object;
  }
  Json &json_;
};

class Reader {
 public:
  Reader(const Json &json, std::string file, std::string where)
      : json_(json), file_(std::move(file)), where_(std::move(where)) {}
  static constexpr bool reading = true;

  template <class T>
  void operator()(const char *key, T &value) {
    get(member(key), value, where_ + key);
  }
  // A member that results written before it was thought of don't have.
  template <class T>
  void since_later(const char *key, T &value) {
    if (json_.contains(key)) (*this)(key, value);
  }
  template <class F>
  void group(const char *key, F &&body) {
    const Json &inner = member(key);
    if (!inner.is_object()) wrong(where_ + key, "an object");
    Reader reader(inner, file_, where_ + key + ".");
    body(reader);
  }

 private:
  const Json &member(const char *key) const {
    const auto found = json_.find(key);
    if (found == json_.end()) throw UserError(Place{file_}, "'" + where_ + key + "' is missing");
    return *found;
  }
  [[noreturn]] void wrong(const std::string &where, const char *expected) const {
    throw UserError(Place{file_}, "'" + where + "' is not " + expected);
  }
  void get(const Json &json, std::string &value, const std::string &where) const {
    if (!json.is_string()) wrong(where, "a text");
    value = json.get<std::string>();
  }
  void get(const Json &json, bool &value, const std::string &where) const {
    if (!json.is_boolean()) wrong(where, "true or false");
    value = json.get<bool>();
  }
  void get(const Json &json, int &value, const std::string &where) const {
    if (!json.is_number_integer()) wrong(where, "an integer");
    value = json.get<int>();
  }
  void get(const Json &json, double &value, const std::string &where) const {
    if (json.is_null())
      value = no_number;
    else if (json.is_number())
      value = json.get<double>();
    else
      wrong(where, "a number or null");
  }
  template <class T>
  void get(const Json &json, std::vector<T> &items, const std::string &where) const {
    if (!json.is_array()) wrong(where, "a list");
    items.clear();
    for (const Json &item : json) {
      const std::string here = where + "[" + std::to_string(items.size()) + "]";
      T value{};
      get(item, value, here);
      items.push_back(std::move(value));
    }
  }
  void get(const Json &json, std::map<std::string, double> &items, const std::string &where) const {
    if (!json.is_object()) wrong(where, "an object");
    items.clear();
    for (const auto &item : json.items())
      get(item.value(), items[item.key()], where + "." + item.key());
  }
  template <class T>
  auto get(const Json &json, T &item, const std::string &where) const
      -> decltype(fields(std::declval<Reader &>(), item), void()) {
    if (!json.is_object()) wrong(where, "an object");
    Reader reader(json, file_, where + ".");
    fields(reader, item);
  }
  const Json &json_;
  std::string file_, where_;
};

template <class A>
void fields(A &a, ReportTarget &t) {
  a("name", t.name), a("unit", t.unit), a("measured", t.measured), a("sd", t.sd);
  a("simulated", t.simulated), a("met", t.met), a("in_fit", t.in_fit), a("tolerance", t.tolerance);
  a("noise_sd", t.noise_sd), a("why_missing", t.why_missing), a("test", t.test);
  a("function", t.function), a("source", t.source), a("sd_source", t.sd_source);
  a.since_later("envelope", t.envelope);
}

template <class A>
void fields(A &a, ReportParameter &p) {
  a("name", p.name), a("unit", p.unit), a("value", p.value), a("sd", p.sd);
  a("at_bound", p.at_bound), a("identifiable", p.identifiable), a("reason", p.reason);
  a("interval_lower", p.interval_lower), a("interval_upper", p.interval_upper);
  a("lower", p.lower), a("upper", p.upper), a("logarithmic", p.logarithmic), a("sets", p.sets);
}

template <class A>
void fields(A &a, ReportStep &s) {
  a("runs", s.runs), a("phase", s.phase), a("misfit", s.misfit), a("best_misfit", s.best_misfit);
  a("accepted", s.accepted), a("parameters", s.parameters);
}

template <class A>
void fields(A &a, ReportFinding &f) {
  a("kind", f.kind), a("text", f.text), a("targets", f.targets);
  a("measured", f.measured), a("low", f.low), a("high", f.high), a("points", f.points);
}

template <class A>
void fields(A &a, ReportRunFiles &r) {
  a("test", r.test), a("kind", r.kind), a("run_id", r.run_id), a("directory", r.directory);
  a("curve", r.curve), a("events", r.events), a("particles", r.particles);
  a("variables", r.variables), a("quality", r.quality), a("ok", r.ok), a("failure", r.failure);
  a("wall_seconds", r.wall_seconds), a("replay", r.replay);
}

template <class A>
void fields(A &a, ReportEnvelope &e) {
  a("name", e.name), a("response", e.response), a("over", e.over), a("unit", e.unit);
  a("tests", e.tests), a("over_values", e.over_values), a("values", e.values);
  a("cohesion", e.cohesion), a("cohesion_error", e.cohesion_error);
  a("friction_angle", e.friction_angle), a("friction_angle_error", e.friction_angle_error);
  a("measured_cohesion", e.measured_cohesion), a("measured_cohesion_sd", e.measured_cohesion_sd);
  a("measured_friction_angle", e.measured_friction_angle);
  a("measured_friction_angle_sd", e.measured_friction_angle_sd);
  a("left_out", e.left_out), a("why_none", e.why_none);
}

template <class A>
void fields(A &a, ReportPacking &p) {
  a("name", p.name), a("unit", p.unit), a("measured", p.measured), a("used", p.used);
  a("mean", p.mean), a("sd", p.sd), a("values", p.values), a("failed", p.failed);
}

template <class A>
void fields(A &a, ReportPoint &p) {
  a("phase", p.phase), a("parameters", p.parameters), a("responses", p.responses);
}

template <class A>
void fields(A &a, ReportSpecimen &s) {
  a("name", s.name), a("shape", s.shape), a("size", s.size), a("particles", s.particles);
  a("r_min", s.r_min), a("r_max", s.r_max), a("porosity", s.porosity);
  a("coordination", s.coordination), a("seed", s.seed);
}

template <class A>
void fields(A &a, ReportMeasuredCurve &c) {
  a("test", c.test), a("label", c.label), a("source", c.source);
  a("names", c.names), a("columns", c.columns);
}

template <class A>
void fields(A &a, ReportAssumption &s) {
  a("text", s.text), a("source", s.source);
}

template <class A>
void fields(A &a, ReportRun &r) {
  a("id", r.id), a("test", r.test), a("packing", r.packing), a("ok", r.ok), a("cause", r.cause);
  a("message", r.message), a("wall_seconds", r.wall_seconds), a("directory", r.directory);
  a("replay", r.replay);
  a.since_later("steps", r.steps), a.since_later("particles", r.particles);
  a.since_later("bonds", r.bonds), a.since_later("ns_per_bond_and_step", r.bond_step_ns);
}

template <class A>
void fields(A &a, ReportFit &f) {
  a("fit", f.name), a("verdict", f.verdict), a("converged", f.converged), a("misfit", f.misfit);
  a("degrees_of_freedom", f.degrees_of_freedom), a("targets", f.targets),
      a("parameters", f.parameters);
  a.group("runs", [&](A &runs) {
    runs("forward", f.forward_runs), runs("wall_seconds", f.wall_seconds);
    runs("from_store", f.from_store), runs("failed", f.failed_runs),
        runs("run_seconds", f.run_seconds);
  });
  a("replay", f.replay), a("packings", f.packings), a("findings", f.findings), a("notes", f.notes);
  a("correlation", f.correlation), a("best_runs", f.best_runs), a("history", f.history);
  a.since_later("envelopes", f.envelopes);
}

// All of ReportInput but its fits, which don't stand in a plain list.
template <class A>
void rest(A &a, ReportInput &r) {
  a.group("study", [&](A &study) {
    study("name", r.study_name), study("title", r.study_title), study("file", r.study_file);
  });
  a("tolerance", r.tolerance_text), a("replay_all", r.replay);
  a("assumptions", r.assumptions), a("specimens", r.specimens), a("resolution", r.resolution_note);
  a("confirm", r.confirm_command), a("measured_curves", r.measured_curves);
  a("points", r.points), a("ledger", r.ledger);
}

}  // namespace

std::string to_json(const ReportInput &input) {
  ReportInput copy = input;  // the field lists want something they could write to
  Json json = Json::object();
  json["format"] = format_name;
  Writer writer(json);
  if (!copy.fits.empty()) fields(writer, copy.fits.front());
  if (copy.fits.size() > 1) writer("tradeoff", copy.fits[1]);
  if (copy.fits.size() > 2) {
    std::vector<ReportFit> more(copy.fits.begin() + 2, copy.fits.end());
    writer("more_fits", more);
  }
  rest(writer, copy);
  // Text that isn't UTF-8 (an engine's last words, say) is replaced rather than refused.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

ReportInput from_json(const std::string &text, const std::string &file) {
  Json json;
  try {
    json = Json::parse(text);
  } catch (const Json::parse_error &error) {
    throw UserError(Place{file}, std::string("is not JSON: ") + error.what());
  }
  const auto format = json.is_object() ? json.find("format") : json.end();
  if (!json.is_object() || format == json.end() || *format != format_name)
    throw UserError(
        Place{file},
        std::string("is not a result of this version; 'format' must be \"") + format_name + "\"");
  ReportInput input;
  Reader reader(json, file, "");
  if (json.contains("fit")) fields(reader, input.fits.emplace_back());
  if (json.contains("tradeoff")) reader("tradeoff", input.fits.emplace_back());
  if (json.contains("more_fits")) {
    std::vector<ReportFit> more;
    reader("more_fits", more);
    for (ReportFit &fit : more) input.fits.push_back(std::move(fit));
  }
  rest(reader, input);
  return input;
}

std::filesystem::path write_result(const ReportInput &input,
                                   const std::filesystem::path &directory) {
  const std::filesystem::path path = directory / "result.json";
  write_whole_file(path, to_json(input));
  return path;
}

ReportInput read_result(const std::filesystem::path &directory) {
  const std::filesystem::path path = directory / "result.json";
  if (!std::filesystem::exists(path))
    throw UserError(
        Place{directory.string()},
        "has no result.json: give the directory that `bondlab fit` wrote its result to");
  return from_json(read_text_file(path), path.string());
}

}  // namespace bondlab
