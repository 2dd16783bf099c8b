// SPDX-License-Identifier: GPL-2.0-or-later
#include "study/effect_definition.h"

#include <algorithm>
#include <fstream>
#include <sstream>

#include "study/study_sections.h"
#include "study/toml_table.h"

namespace bondlab {

namespace {

namespace fs = std::filesystem;

const std::vector<std::string> rules = {"add", "set", "inverse", "scale", "scale_inverse", "fixed"};

SetRule rule_from(const std::string &name) {
  if (name == "set") return SetRule::set;
  if (name == "inverse") return SetRule::inverse;
  if (name == "scale") return SetRule::scale;
  if (name == "scale_inverse") return SetRule::scale_inverse;
  if (name == "fixed") return SetRule::fixed;
  return SetRule::add;
}

void read_size(TomlTable &top, EffectDefinition &effect) {
  const toml::table *node = top.table("size", true);
  if (!node) return;
  TomlTable size(*node, "[size]", top.file(), top.errors());
  effect.size_name = size.text("name", true);
  const auto unit = read_unit(size, true);
  effect.unit = unit.value_or("");
  const auto on = size.quantity_if(unit, "switch_on", true);
  const auto low = size.quantity_if(unit, "lowest", true);
  const auto high = size.quantity_if(unit, "largest", true);
  size.finish();
  if (!on || !low || !high) return;
  effect.switch_on = *on, effect.lowest = *low, effect.largest = *high;
  if (*on <= 0)
    size.error("switch_on", "must be above 0: it is the size at which the trace is taken");
  if (*low > 0) size.error("lowest", "must not be above 0: size 0 is the model without the effect");
  if (*high < *on) size.error("largest", "must not be below switch_on");
}

void read_settings(TomlTable &top, EffectDefinition &effect) {
  for (const toml::table *node : top.tables("sets")) {
    TomlTable table(*node, "[[sets]]", top.file(), top.errors());
    EffectSetting setting;
    setting.place = table.place();
    setting.variable = table.text("variable", true);
    setting.unless = table.text("unless");
    if (table.has("word")) {
      setting.rule = SetRule::word;
      setting.word = table.text("word", true);
    } else {
      setting.rule = rule_from(table.choice("rule", rules));
      if (setting.rule == SetRule::fixed) {
        const auto unit = read_unit(table, false);
        setting.value = table.quantity_if(unit, "value", true).value_or(0);
      }
    }
    table.finish();
    effect.sets.push_back(setting);
  }
}

void read_measuring_errors(TomlTable &top, EffectDefinition &effect) {
  for (const toml::table *node : top.tables("measures")) {
    TomlTable table(*node, "[[measures]]", top.file(), top.errors());
    MeasuringError error;
    error.place = table.place();
    error.columns = table.text("columns", true);
    error.test = table.text("test");
    const std::string rule = table.choice("rule", {"scale", "saturate", "drift"}, true);
    error.rule = rule == "saturate" ? MeasuringRule::saturate
                 : rule == "drift"  ? MeasuringRule::drift
                                    : MeasuringRule::scale;
    table.finish();
    effect.measures.push_back(error);
  }
}

}  // namespace

EffectDefinition read_effect(const fs::path &file, ErrorCollector &errors) {
  EffectDefinition effect;
  effect.place = Place{file.string(), 1, 1};
  std::ifstream in(file);
  if (!in) {
    errors.add(Place{file.string(), 0, 0}, "can't be read");
    return effect;
  }
  std::ostringstream text;
  text << in.rdbuf();
  const toml::table parsed = parse_toml(text.str(), file.string());
  TomlTable top(parsed, "the effect", file.string(), errors);
  top.whole("schema", 1, 1, 1, true);
  effect.name = top.text("name", true);
  effect.title = top.text("title", true);
  effect.description = top.text("description");
  effect.kind = top.choice("kind", {"bond", "specimen", "machine", "conversion"}, true);
  effect.expected = top.words("expected", true);
  effect.confused_with = top.words("confused_with");
  effect.separating_test = top.text("separating_test", true);
  effect.scales_test = top.text("scales_test");
  read_size(top, effect);
  read_settings(top, effect);
  read_measuring_errors(top, effect);
  if (effect.sets.empty() && effect.scales_test.empty() && effect.measures.empty())
    errors.add(effect.place, "the effect changes nothing: give [[sets]], scales_test or [[measures]]");
  if (!effect.name.empty() && effect.name != file.stem().string())
    top.error("name", "the file must have the effect's name: '" + effect.name + ".toml'");
  top.finish();
  return effect;
}

std::vector<EffectDefinition> read_effects(const fs::path &folder) {
  if (!fs::is_directory(folder))
    throw UserError(Place{folder.string(), 0, 0}, "there is no such folder of effects");
  std::vector<fs::path> files;
  for (const auto &entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  ErrorCollector errors;
  std::vector<EffectDefinition> effects;
  for (const auto &file : files) effects.push_back(read_effect(file, errors));
  const auto names = names_of(effects);
  for (const auto &effect : effects)
    for (const auto &rival : effect.confused_with)
      if (!find_entry(effects, rival))
        errors.add(effect.place, unknown_name("confused_with: there is no effect", rival, names));
  errors.throw_if_any();
  return effects;
}

std::map<std::string, double> with_effect(const EffectDefinition &effect, double size,
                                          const std::map<std::string, double> &without,
                                          bool &touched) {
  auto out = without;
  touched = false;
  if (size == 0) return out;
  for (const auto &setting : effect.sets) {
    if (setting.rule == SetRule::word) continue;
    const auto it = out.find(setting.variable);
    if (it == out.end()) continue;
    const auto away = without.find(setting.unless);
    if (away != without.end() && away->second > 0) continue;
    touched = true;
    switch (setting.rule) {
      case SetRule::set:
        it->second = size;
        break;
      case SetRule::inverse:
        it->second = 1 / size;
        break;
      case SetRule::add:
        it->second += size;
        break;
      case SetRule::scale:
        it->second *= 1 + size;
        break;
      case SetRule::scale_inverse:
        it->second /= 1 + size;
        break;
      case SetRule::fixed:
        it->second = setting.value;
        break;
      case SetRule::word:
        break;
    }
  }
  return out;
}

}  // namespace bondlab
