// SPDX-License-Identifier: GPL-2.0-or-later
#include "forward/curve.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <sstream>

#include "base/table_file.h"
#include "base/units.h"

namespace bondlab {

namespace {

// The first line names the format and its version: a later one may mean something else by the same
// columns.
TableFile open_table(const std::filesystem::path &file, const std::string &format) {
  TableFile table(file, '\t');
  const auto &header = table.header();
  if (header.empty() || header.front().line != 1 || header.front().key != format)
    throw UserError({file.string(), 1, 0},
                    "the first line must be '# " + format + "'" +
                        (header.empty() ? "" : ", it is '# " + header.front().key + "'"));
  if (table.units().empty())
    throw UserError(table.place(table.find("names")->line),
                    "a '# units:' line is needed below the names");
  for (const std::string &unit : table.units()) {
    Unit parsed;
    try {
      parsed = parse_unit(unit);
    } catch (const UnitError &error) {
      throw UserError(table.place(table.find("units")->line), error.text());
    }
    if (parsed.multiply != parsed.divide || parsed.offset != 0)
      throw UserError(table.place(table.find("units")->line),
                      "the engine's files are in SI, the unit '" + unit + "' isn't");
  }
  return table;
}

}  // namespace

bool Curve::has(const std::string &name) const {
  return std::find(names.begin(), names.end(), name) != names.end();
}

const std::vector<double> &Curve::column(const std::string &name) const {
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names[i] == name) return columns.at(i);
  throw UserError("the curve has no column '" + name + "'; columns: " + join(names));
}

Curve read_curve(const std::filesystem::path &file) {
  const TableFile table = open_table(file, "bondlab-curve 1");
  Curve curve;
  curve.names = table.names();
  curve.units = table.units();
  curve.columns.assign(curve.names.size(), {});
  for (auto &column : curve.columns) column.reserve(table.rows().size());
  for (const TableFile::Row &row : table.rows())
    for (std::size_t i = 0; i < curve.names.size(); ++i)
      curve.columns[i].push_back(table.number(row, i));
  if (const TableFile::HeaderLine *complete = table.find("complete")) {
    if (!table.header_line_is_last(*complete))
      throw UserError(table.place(complete->line), "'# complete:' must be the last line");
    if (complete->value.empty())
      throw UserError(table.place(complete->line), "'# complete:' doesn't say why the run ended");
    curve.complete = true;
    curve.completion = complete->value;
  }
  return curve;
}

std::vector<BrokenBond> read_broken_bonds(const std::filesystem::path &file) {
  const TableFile table = open_table(file, "bondlab-broken-bonds 1");
  enum { step, time, id1, id2, type, x, y, z, mode, sigma, tau, sigma_c, tau_c, count };
  const char *const names[count] = {"step", "time", "id1",   "id2", "type",    "x",    "y",
                                    "z",    "mode", "sigma", "tau", "sigma_c", "tau_c"};
  std::size_t at[count];
  for (int i = 0; i < count; ++i) at[i] = table.column_index(names[i]);
  std::vector<BrokenBond> bonds;
  bonds.reserve(table.rows().size());
  for (const TableFile::Row &row : table.rows()) {
    BrokenBond bond;
    bond.step = table.whole_number(row, at[step]);
    bond.time = table.number(row, at[time]);
    bond.id1 = static_cast<int>(table.whole_number(row, at[id1]));
    bond.id2 = static_cast<int>(table.whole_number(row, at[id2]));
    bond.type = static_cast<int>(table.whole_number(row, at[type]));
    bond.x = table.number(row, at[x]);
    bond.y = table.number(row, at[y]);
    bond.z = table.number(row, at[z]);
    bond.mode = table.word(row, at[mode]);
    if (bond.mode != "tension" && bond.mode != "shear")
      throw UserError(table.place(row, at[mode]),
                      "'" + bond.mode + "' isn't a mode of breaking; allowed: tension, shear");
    bond.sigma = table.number(row, at[sigma]);
    bond.tau = table.number(row, at[tau]);
    bond.sigma_c = table.number(row, at[sigma_c]);
    bond.tau_c = table.number(row, at[tau_c]);
    bonds.push_back(bond);
  }
  return bonds;
}

std::vector<EndParticle> read_particles(const std::filesystem::path &file) {
  std::istringstream lines(read_text_file(file));
  std::vector<EndParticle> particles;
  std::string line;
  int number = 0;
  const auto next = [&] {
    ++number;
    return static_cast<bool>(std::getline(lines, line));
  };
  const auto fail = [&](const std::string &text) {
    throw UserError({file.string(), number, 0}, text);
  };
  bool found = false;
  while (next()) {
    if (line.rfind("ITEM: NUMBER OF ATOMS", 0) != 0) continue;
    if (!next()) fail("the number of particles is missing");
    const long count = std::strtol(line.c_str(), nullptr, 10);
    if (count <= 0) fail("'" + line + "' isn't a number of particles");
    while (next() && line.rfind("ITEM: ATOMS", 0) != 0)
      if (line.rfind("ITEM:", 0) == 0 && line.rfind("ITEM: BOX BOUNDS", 0) != 0)
        fail("'" + line + "' where 'ITEM: ATOMS' is expected");
    std::istringstream words(line.substr(std::min<std::size_t>(line.size(), 11)));
    std::vector<std::string> names;
    for (std::string word; words >> word;) names.push_back(word);
    const auto index_of = [&](const std::string &name) {
      const auto at = std::find(names.begin(), names.end(), name);
      if (at == names.end()) fail("the dump has no column '" + name + "'; columns: " + join(names));
      return static_cast<std::size_t>(at - names.begin());
    };
    const std::size_t id = index_of("id"), type = index_of("type"), radius = index_of("radius"),
                      x = index_of("x"), y = index_of("y"), z = index_of("z");
    std::array<std::size_t, 6> stress{};
    bool has_stress = true;
    for (std::size_t k = 0; k < 6; ++k) {
      const auto at = std::find(names.begin(), names.end(), "c_stress[" + std::to_string(k + 1) + "]");
      has_stress = has_stress && at != names.end();
      stress[k] = static_cast<std::size_t>(at - names.begin());
    }
    found = true;
    particles.clear();  // only the last frame counts
    particles.reserve(static_cast<std::size_t>(count));
    for (long i = 0; i < count; ++i) {
      if (!next())
        fail("the dump ends after " + std::to_string(i) + " of " + std::to_string(count) +
             " particles");
      std::vector<double> values;
      const char *at = line.data(), *const end = line.data() + line.size();
      for (;;) {
        while (at != end && (*at == ' ' || *at == '\t' || *at == '\r')) ++at;
        if (at == end) break;
        double value = 0;
        const auto result = std::from_chars(at, end, value);
        if (result.ec != std::errc() || !std::isfinite(value))
          fail("column " + std::to_string(values.size() + 1) + " isn't a finite number: '" + line +
               "'");
        values.push_back(value);
        at = result.ptr;
      }
      if (values.size() != names.size())
        fail(std::to_string(values.size()) + " numbers in a row of " +
             std::to_string(names.size()) + " columns");
      particles.push_back({static_cast<int>(values[id]), static_cast<int>(values[type]),
                           values[radius], values[x], values[y], values[z], {}, has_stress});
      for (std::size_t k = 0; has_stress && k < 6; ++k)
        particles.back().stress[k] = values[stress[k]];
    }
  }
  if (!found)
    throw UserError({file.string(), 0, 0},
                    "this isn't a dump: there is no 'ITEM: NUMBER OF ATOMS' line");
  std::sort(particles.begin(), particles.end(),
            [](const EndParticle &a, const EndParticle &b) { return a.id < b.id; });
  return particles;
}

}  // namespace bondlab
