// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/hidden_set.h"

#include <algorithm>
#include <set>

#include "base/table_file.h"
#include "study/toml_table.h"

namespace bondlab::diagnose {

HiddenSet read_hidden_set(const std::filesystem::path &file) {
  const toml::table parsed = parse_toml(read_text_file(file), file.string());
  ErrorCollector errors;
  TomlTable top(parsed, "the set", file.string(), errors);
  top.whole("schema", 1, 1, 1, true);
  HiddenSet set;
  set.laboratory = file.parent_path() / top.text("laboratory", true);
  set.replicates = static_cast<int>(top.whole("replicates", 4, 2, 99, true));
  std::set<std::string> ids;
  std::set<std::uint64_t> seeds;
  for (const toml::table *node : top.tables("cases", true)) {
    TomlTable table(*node, "[[cases]]", top.file(), errors);
    HiddenCase one;
    one.place = table.place();
    one.id = table.text("id", true);
    one.kind = table.choice("kind", {"effect", "outside", "left_out", "pair", "null"}, true);
    one.seed = static_cast<std::uint64_t>(table.whole("seed", 0, 0, 9999, true));
    one.effects = table.words("effects");
    const std::size_t wanted = one.kind == "null" ? 0 : one.kind == "pair" ? 2 : 1;
    if (one.effects.size() != wanted)
      table.error("effects", "a case of kind '" + one.kind + "' has " + std::to_string(wanted));
    one.units = table.quantity("units", "1", wanted > 0).value_or(0);
    if (wanted > 0 && !(one.units > 0)) table.error("units", "must be above 0");
    if (!ids.insert(one.id).second) table.error("id", "is used twice");
    if (!seeds.insert(one.seed).second) table.error("seed", "is used twice");
    table.finish();
    set.cases.push_back(one);
  }
  top.finish();
  errors.throw_if_any();
  return set;
}

}  // namespace bondlab::diagnose
