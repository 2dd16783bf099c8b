// SPDX-License-Identifier: GPL-2.0-or-later
#include "specimen/cache.h"

#include <fstream>
#include <iterator>
#include <optional>

#include "base/user_error.h"
#include "base/sha256.h"
#include "specimen/data_file.h"
#include "specimen/specimen_json.h"

namespace bondlab {

static std::optional<std::string> text_of(const std::filesystem::path &path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return std::nullopt;
  std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  if (file.bad()) return std::nullopt;
  return text;
}

bool specimen_is_intact(const std::filesystem::path &data_file, const std::string &key) {
  std::filesystem::path record_file = data_file;
  record_file.replace_extension(".json");
  const std::optional<std::string> record_text = text_of(record_file), data = text_of(data_file);
  if (!record_text || !data) return false;
  const std::optional<RecordHeader> record = parse_specimen_record(*record_text);
  return record && record->key == key && record->data_hash == sha256(*data);
}

std::filesystem::path ensure_specimen(const SpecimenRequest &request,
                                      const std::filesystem::path &directory,
                                      const SpecimenProgressCallback &progress) {
  const std::string key = specimen_key(request);
  const std::filesystem::path path = directory / (shape_name(request.shape) + "-" + key + ".data");
  if (specimen_is_intact(path, key)) return path;
  check_request(request);
  std::error_code problem;
  std::filesystem::create_directories(directory, problem);
  if (problem)
    throw UserError("can't make the directory " + directory.string() + ": " + problem.message());
  write_data_file(make_specimen(request, progress), path);
  return path;
}

}  // namespace bondlab
