// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/model_with_effect.h"

#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "base/units.h"
#include "forward/run_plan.h"

namespace bondlab::diagnose {

namespace {

std::vector<std::string> lines_of(const std::string &text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

// What the effects make of a test's variables, as TOML values.
std::map<std::string, std::string> settings_for(const Study &study, const TestEntry &test,
                                                const std::vector<SizedEffect> &effects,
                                                const std::vector<double> &parameters) {
  std::map<std::string, std::string> out;
  auto numeric =
      plan_run(study, {test.name, deck_variables(study, test.name, parameters), 0}).numeric;
  for (const auto &sized : effects) {
    const auto before = numeric;
    bool touched = false;
    numeric = with_effect(sized.effect, sized.size, numeric, touched);
    for (const auto &setting : sized.effect.sets) {
      const auto found = test.definition.variables.find(setting.variable);
      if (found == test.definition.variables.end()) continue;
      if (setting.rule == SetRule::word)
        out[setting.variable] = "\"" + setting.word + "\"";
      else if (numeric[setting.variable] != before.at(setting.variable))
        out[setting.variable] = fmt::format(
            "\"{}\"", format_quantity(numeric[setting.variable], found->second.unit, 9));
    }
  }
  return out;
}

std::string with_entry(const std::string &line, const std::string &name, const std::string &value) {
  const std::regex entry("([{,]\\s*" + name + "\\s*=\\s*)(\"[^\"]*\"|[^,}]*[^,}\\s])");
  std::smatch match;
  if (std::regex_search(line, match, entry))
    return match.prefix().str() + match[1].str() + value + match.suffix().str();
  const auto end = line.rfind('}');
  if (end == std::string::npos) return line;
  auto last = line.find_last_not_of(" ", end - 1);
  const std::string comma = line[last] == '{' ? " " : ", ";
  return line.substr(0, last + 1) + comma + name + " = " + value + " " + line.substr(end);
}

std::string without_element(const std::string &line, const std::string &name) {
  return std::regex_replace(line, std::regex("\"" + name + "\"\\s*,\\s*|\\s*,\\s*\"" + name + "\""),
                            "");
}

std::string key_of_line(const std::string &line) {
  static const std::regex key("^\\s*([A-Za-z_]+)\\s*=");
  std::smatch match;
  return std::regex_search(line, match, key) ? match[1].str() : "";
}

std::string quoted_value(const std::string &line) {
  const auto first = line.find('"'), last = line.find('"', first + 1);
  return first == std::string::npos || last == std::string::npos
             ? ""
             : line.substr(first + 1, last - first - 1);
}

struct Block {
  std::string kind;  // "tests", "parameters"
  std::size_t first = 0, last = 0;
};

std::vector<Block> blocks_of(const std::vector<std::string> &lines) {
  std::vector<Block> blocks;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (lines[i].rfind('[', 0) != 0) continue;
    if (!blocks.empty()) blocks.back().last = i;
    const auto from = lines[i].find_first_not_of('['), to = lines[i].find(']');
    blocks.push_back({lines[i].substr(from, to - from), i, lines.size()});
  }
  return blocks;
}

// Cuts what two long lines have in common at their front, but for the key and a little before they
// part: a table of a dozen variables in which one is new.
void cut_common_front(std::string &a, std::string &b) {
  constexpr std::size_t shown = 30, worth = 90;
  std::size_t same = 0;
  while (same < a.size() && same < b.size() && a[same] == b[same]) ++same;
  const auto brace = a.find('{');
  if (same < worth || brace == std::string::npos || brace + shown > same) return;
  const auto from = a.rfind(", ", same - shown);
  if (from == std::string::npos || from <= brace) return;
  for (auto *line : {&a, &b}) line->replace(brace + 1, from - brace, " ...");
}

}  // namespace

std::string moved_study(const std::string &text, const std::filesystem::path &study_file,
                        const std::filesystem::path &folder) {
  namespace fs = std::filesystem;
  auto lines = lines_of(text);
  for (const auto &block : blocks_of(lines)) {
    const std::string key = block.kind == "data" ? "folder" : block.kind == "tests" ? "test" : "";
    for (std::size_t i = block.first + 1; i < block.last && !key.empty(); ++i) {
      const std::string path = quoted_value(lines[i]);
      const bool is_path = key == "folder" || path.find('/') != std::string::npos;
      if (key_of_line(lines[i]) != key || !is_path || fs::path(path).is_absolute()) continue;
      const auto now = fs::weakly_canonical(fs::absolute(study_file).parent_path() / path);
      lines[i].replace(lines[i].find('"') + 1, path.size(),
                       now.lexically_relative(fs::weakly_canonical(fs::absolute(folder))).string());
    }
  }
  std::string out;
  for (const auto &line : lines) out += line + "\n";
  return out;
}

std::string study_with_effects(const Study &study, const std::vector<SizedEffect> &effects,
                               const std::vector<double> &parameters) {
  auto lines = lines_of(study.source_text);
  auto blocks = blocks_of(lines);
  std::set<std::string> taken;  // variables that the effects set: a parameter can't set them too
  for (const auto &test : study.tests)
    for (const auto &[variable, value] : settings_for(study, test, effects, parameters))
      taken.insert(variable);
  std::reverse(blocks.begin(), blocks.end());  // from the end: insertions don't move what follows
  for (const auto &block : blocks) {
    std::size_t name_line = 0, wanted_line = 0, sets_line = 0;
    const std::string wanted = block.kind == "tests" ? "variables" : "start";
    for (std::size_t i = block.first + 1; i < block.last; ++i) {
      if (key_of_line(lines[i]) == "name") name_line = i;
      if (key_of_line(lines[i]) == wanted) wanted_line = i;
      if (key_of_line(lines[i]) == "sets") sets_line = i;
    }
    if (name_line == 0) continue;
    const std::string name = quoted_value(lines[name_line]);
    const auto below = lines.begin() + static_cast<std::ptrdiff_t>(name_line) + 1;
    if (block.kind == "tests") {
      const auto settings = settings_for(study, study.test(name), effects, parameters);
      if (settings.empty()) continue;
      std::string line = wanted_line > 0 ? lines[wanted_line] : "variables = { }";
      for (const auto &[variable, value] : settings) line = with_entry(line, variable, value);
      if (wanted_line > 0)
        lines[wanted_line] = line;
      else
        lines.insert(below, line);
    } else if (block.kind == "parameters") {
      for (std::size_t k = 0; k < study.parameters.size(); ++k) {
        if (study.parameters[k].name != name) continue;
        for (const auto &variable : study.parameters[k].sets)
          if (sets_line > 0 && taken.count(variable) > 0)
            lines[sets_line] = without_element(lines[sets_line], variable);
        const std::string line = fmt::format(
            "start = \"{}\"", format_quantity(parameters[k], study.parameters[k].unit, 9));
        if (wanted_line > 0)
          lines[wanted_line] = line;
        else
          lines.insert(below, line);
      }
    }
  }
  std::string out;
  for (const auto &line : lines) out += line + "\n";
  for (const auto &sized : effects)
    if (!sized.effect.scales_test.empty())
      out += fmt::format(
          "# {}: measured stresses of '{}' look too large by a share of {:.4g}; mend the data, not "
          "the model\n",
          sized.effect.title, sized.effect.scales_test, sized.size);
  return out;
}

std::string readable_diff(const std::string &before, const std::string &after) {
  auto a = lines_of(before), b = lines_of(after);
  std::vector<std::vector<int>> common(a.size() + 1, std::vector<int>(b.size() + 1, 0));
  for (std::size_t i = a.size(); i-- > 0;)
    for (std::size_t j = b.size(); j-- > 0;)
      common[i][j] = a[i] == b[j] ? common[i + 1][j + 1] + 1
                                  : std::max(common[i + 1][j], common[i][j + 1]);
  std::string out;
  std::size_t i = 0, j = 0;
  while (i < a.size() || j < b.size()) {
    const bool replaced = i < a.size() && j < b.size() && a[i] != b[j] &&
                          common[i + 1][j + 1] == common[i][j];
    if (replaced) cut_common_front(a[i], b[j]);
    if (i < a.size() && j < b.size() && a[i] == b[j]) {
      ++i, ++j;
    } else if (i < a.size() && (j == b.size() || common[i + 1][j] >= common[i][j + 1])) {
      out += fmt::format("{:>5} - {}\n", i + 1, a[i]);
      ++i;
    } else {
      out += fmt::format("      + {}\n", b[j]);
      ++j;
    }
  }
  return out;
}

}  // namespace bondlab::diagnose
