// SPDX-License-Identifier: GPL-2.0-or-later
#include "specimen/data_file.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>
#include <unordered_map>

#include "base/table_file.h"
#include "base/units.h"
#include "base/sha256.h"
#include "specimen/space_filling.h"
#include "specimen/specimen_json.h"
#include "specimen/whole_file.h"

namespace bondlab {

namespace {

constexpr const char *title = "# bondlab specimen 1 ";
constexpr std::size_t engine_line =
    255;  // characters of a line the engine keeps, the line break included

struct Word {
  std::string_view text;
  int column;  // from 1
};

std::vector<Word> words_of(std::string_view line) {
  line = line.substr(0, line.find('#'));
  std::vector<Word> words;
  for (std::size_t at = 0;;) {
    at = line.find_first_not_of(" \t\r", at);
    if (at == std::string_view::npos) return words;
    const std::size_t end = std::min(line.find_first_of(" \t\r", at), line.size());
    words.push_back({line.substr(at, end - at), static_cast<int>(at) + 1});
    at = end;
  }
}

// Hands out the lines of a file with their words and collects what is wrong with them.
class LineReader {
 public:
  explicit LineReader(const std::filesystem::path &path)
      : file_(path.string()), text_(read_text_file(path)), rest_(text_) {}

  bool next() {
    if (rest_.empty()) return false;
    const std::size_t end = std::min(rest_.find('\n'), rest_.size());
    line_ = rest_.substr(0, end);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    words_ = words_of(line_);
    ++number_;
    return true;
  }
  std::string_view line() const { return line_; }
  const std::vector<Word> &words() const { return words_; }
  int number() const { return number_; }
  const std::string &file() const { return file_; }

  template <class T>
  bool read(std::size_t word, const char *what, T &value) {
    const Word &w = words_[word];
    const auto result = std::from_chars(w.text.data(), w.text.data() + w.text.size(), value);
    bool good = result.ec == std::errc() && result.ptr == w.text.data() + w.text.size();
    if constexpr (std::is_floating_point_v<T>) good = good && std::isfinite(value);
    if (!good)
      wrong(w.column, std::string(what) + " is \"" + std::string(w.text) +
                          "\" (allowed: a finite " +
                          (std::is_floating_point_v<T> ? "number)" : "whole number)"));
    return good;
  }
  void wrong(int column, const std::string &text) {
    errors.add(Place{file_, number_, column}, text);
  }

  ErrorCollector errors;

 private:
  std::string file_, text_;
  std::string_view rest_, line_;
  std::vector<Word> words_;
  int number_ = 0;
};

void read_header_line(LineReader &in, PackingFile &packing, long &count) {
  const std::vector<Word> &words = in.words();
  const auto ends_with = [&](std::initializer_list<const char *> names) {
    if (words.size() < names.size()) return false;
    std::size_t at = words.size() - names.size();
    for (const char *name : names)
      if (words[at++].text != name) return false;
    return true;
  };
  const char *const bounds[3][2] = {{"xlo", "xhi"}, {"ylo", "yhi"}, {"zlo", "zhi"}};
  for (std::size_t k = 0; k < 3; ++k) {
    if (words.size() != 4 || !ends_with({bounds[k][0], bounds[k][1]})) continue;
    packing.box_line[k] = in.number();
    if (in.read(0, bounds[k][0], packing.box_lo[k]) &&
        in.read(1, bounds[k][1], packing.box_hi[k]) && packing.box_lo[k] >= packing.box_hi[k])
      in.wrong(words[0].column, std::string(bounds[k][0]) + " is not below " + bounds[k][1]);
    return;
  }
  if (words.size() == 2 && ends_with({"atoms"})) {
    in.read(0, "the number of atoms", count);
    return;
  }
  if (words.size() == 3 && (ends_with({"atom", "types"}) || ends_with({"bond", "types"}))) {
    long types = 0;
    in.read(0, "the number of types", types);
    return;
  }
  in.wrong(words[0].column,
           "not a line of a specimen file: \"" + std::string(in.line()) +
               "\" (allowed before Atoms: N atoms, N atom types, N bond types, box bounds)");
}

void read_row(LineReader &in, PackingFile &packing) {
  constexpr const char *names[7] = {"id", "type", "diameter", "density", "x", "y", "z"};
  const std::vector<Word> &words = in.words();
  if (words.size() != 7) {
    in.wrong(words[0].column, std::to_string(words.size()) +
                                  " columns (allowed: 7: id type diameter density x y z)");
    return;
  }
  PackingRow row;
  long type = 0;
  double diameter = 0;
  row.line = in.number();
  double *const numbers[] = {&diameter, &row.density, &row.particle.x, &row.particle.y,
                             &row.particle.z};
  bool good = in.read(0, names[0], row.id);
  good = in.read(1, names[1], type) && good;
  for (std::size_t k = 0; k < 5; ++k) good = in.read(k + 2, names[k + 2], *numbers[k]) && good;
  if (!good) return;
  row.particle.r = 0.5 * diameter;
  if (row.id < 1)
    in.wrong(words[0].column, "id is " + std::to_string(row.id) + " (allowed: 1 and up)");
  if (diameter <= 0)
    in.wrong(words[2].column, "diameter is " + canonical_number(diameter) + " m (allowed: > 0)");
  if (row.density <= 0)
    in.wrong(words[3].column,
             "density is " + canonical_number(row.density) + " kg/m3 (allowed: > 0)");
  packing.rows.push_back(row);
}

void check_ids(LineReader &in, const PackingFile &packing) {
  std::unordered_map<long, int> seen;
  for (const PackingRow &row : packing.rows) {
    const auto [place, is_new] = seen.emplace(row.id, row.line);
    if (!is_new)
      in.errors.add(Place{in.file(), row.line, 1}, "id " + std::to_string(row.id) +
                                                       " stands already in line " +
                                                       std::to_string(place->second));
  }
}

// The same figures for an imported or read packing as the generator gives.
void complete(Specimen &specimen) {
  specimen.statistics = measure_packing(specimen.request.container(), specimen.particles);
  specimen.request.r_min = specimen.statistics.r_min;
  specimen.request.r_ratio =
      specimen.statistics.r_min > 0 ? specimen.statistics.r_max / specimen.statistics.r_min : 1;
}

}  // namespace

std::string data_file_text(const Specimen &specimen) {
  const Container container = specimen.request.container();
  double lo[3], hi[3], r_max = 0;
  container.bounds(lo, hi);
  for (const Particle &p : specimen.particles) r_max = std::max(r_max, p.r);
  std::string text = title + metadata_line(specimen, engine_line - std::string_view(title).size());
  text +=
      "\n\n" + std::to_string(specimen.particles.size()) + " atoms\n1 atom types\n1 bond types\n\n";
  const char *const bounds[3] = {"xlo xhi", "ylo yhi", "zlo zhi"};
  for (int k = 0; k < 3; ++k) {
    const double margin = 0.5 * (hi[k] - lo[k]);
    const bool flat = k == 2 && container.dimension() == 2;
    text += canonical_number(flat ? -r_max : lo[k] - margin) + " " +
            canonical_number(flat ? r_max : hi[k] + margin) + " " + bounds[k] + "\n";
  }
  text += "\nAtoms\n\n";
  for (std::size_t i = 0; i < specimen.particles.size(); ++i) {
    const Particle &p = specimen.particles[i];
    text += std::to_string(i + 1) + " 1";
    for (const double value : {2 * p.r, specimen.densities[i], p.x, p.y, p.z})
      text += " " + canonical_number(value);
    text += "\n";
  }
  return text;
}

void write_data_file(const Specimen &specimen, const std::filesystem::path &path) {
  const std::string text = data_file_text(specimen);
  std::filesystem::path record = path;
  record.replace_extension(".json");
  if (record == path)
    throw UserError("specimen file " + path.string() +
                    " can't end in .json: its record has that name");
  // The data first: a record without its data would be believed, data without a record are made
  // again.
  write_specimen_file(path, text);
  write_specimen_file(record, specimen_record(specimen, sha256(text)));
}

PackingFile read_packing_file(const std::filesystem::path &path) {
  LineReader in(path);
  PackingFile packing;
  packing.path = path;
  long count = -1;
  bool in_atoms = false;
  while (in.next()) {
    if (in.number() == 1) {  // the engine skips it, whatever it is
      if (in.line().substr(0, std::string_view(title).size()) != title) continue;
      const auto metadata =
          parse_metadata_line(std::string(in.line().substr(std::string_view(title).size())));
      if (metadata) {
        packing.made_from = metadata->request;
        packing.key = metadata->key;
      } else {
        in.wrong(0,
                 "the specimen's description is damaged (allowed: the JSON that `bondlab specimen` "
                 "writes)");
      }
      continue;
    }
    if (in.words().empty()) continue;
    if (in_atoms)
      read_row(in, packing);
    else if (in.words()[0].text == "Atoms")
      in_atoms = true;
    else
      read_header_line(in, packing, count);
  }
  check_ids(in, packing);
  if (!in_atoms) {
    in.wrong(0, "the file ends before its Atoms section");
  } else if (in.errors.empty()) {
    const char *const names[3] = {"xlo xhi", "ylo yhi", "zlo zhi"};
    for (std::size_t k = 0; k < 3; ++k)
      if (packing.box_line[k] == 0)
        in.wrong(0, std::string("the box bounds ") + names[k] + " are missing");
    if (static_cast<long>(packing.rows.size()) != count)
      in.wrong(0, count < 0 ? std::string("the line `N atoms` is missing")
                            : "the header says " + std::to_string(count) + " atoms, the file has " +
                                  std::to_string(packing.rows.size()));
  }
  in.errors.throw_if_any();
  return packing;
}

Specimen read_data_file(const std::filesystem::path &path) {
  const PackingFile packing = read_packing_file(path);
  if (!packing.made_from)
    throw UserError(
        Place{path.string(), 1, 0},
        "no description of the specimen's shape (allowed: a file made by `bondlab specimen`)");
  std::vector<const PackingRow *> rows;
  for (const PackingRow &row : packing.rows) rows.push_back(&row);
  std::sort(rows.begin(), rows.end(),
            [](const PackingRow *a, const PackingRow *b) { return a->id < b->id; });
  if (!rows.empty() && rows.back()->id != static_cast<long>(rows.size()))
    throw UserError(Place{path.string(), rows.back()->line, 1},
                    "ids are not 1 to " + std::to_string(rows.size()) + ": the largest is " +
                        std::to_string(rows.back()->id));
  Specimen specimen;
  specimen.request = *packing.made_from;
  for (const PackingRow *row : rows) {
    specimen.particles.push_back(row->particle);
    specimen.densities.push_back(row->density);
  }
  if (!rows.empty()) specimen.request.density = rows.front()->density;
  complete(specimen);
  return specimen;
}

Specimen packing_in(const SpecimenRequest &request, const std::vector<Particle> &particles) {
  Specimen specimen;
  specimen.request = request;
  for (const std::size_t i : space_filling_order(particles))
    specimen.particles.push_back(particles[i]);
  specimen.densities.assign(particles.size(), request.density);
  complete(specimen);
  return specimen;
}

Specimen read_xyzr(const std::filesystem::path &path, const SpecimenRequest &request) {
  LineReader in(path);
  std::vector<Particle> particles;
  while (in.next()) {
    if (in.words().empty()) continue;
    if (in.words().size() != 4) {
      in.wrong(in.words()[0].column,
               std::to_string(in.words().size()) + " columns (allowed: 4: x y z r)");
      continue;
    }
    Particle p;
    const bool place = in.read(0, "x", p.x) & in.read(1, "y", p.y) & in.read(2, "z", p.z);
    if (in.read(3, "r", p.r) && p.r <= 0)
      in.wrong(in.words()[3].column, "r is " + canonical_number(p.r) + " m (allowed: > 0)");
    else if (place)
      particles.push_back(p);
  }
  if (particles.empty() && in.errors.empty()) in.wrong(0, "no particles in the file");
  in.errors.throw_if_any();
  return packing_in(request, particles);
}

}  // namespace bondlab
