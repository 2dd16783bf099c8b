// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: generated_specimens(): packings from the specimen room as files with their hashes.
#include <memory>
#include <mutex>

#include "base/sha256.h"
#include "forward/engine_forward_model.h"
#include "specimen/cache.h"
#include "study/specimen_request.h"

namespace bondlab {

SpecimenSource generated_specimens(const std::filesystem::path &folder) {
  // Hashes are remembered by path: a batch of a thousand runs reads its specimen once.
  const auto known = std::make_shared<std::map<std::string, SpecimenFile>>();
  const auto lock = std::make_shared<std::mutex>();
  return [folder, known, lock](const SpecimenEntry &entry, int packing) {
    const SpecimenRequest request = specimen_request(entry, packing);
    const std::string key = specimen_key(request);
    {
      const std::lock_guard<std::mutex> guard(*lock);
      const auto found = known->find(key);
      if (found != known->end()) return found->second;
    }
    SpecimenFile file;
    file.path = std::filesystem::absolute(ensure_specimen(request, folder));
    file.hash = sha256_file(file.path);
    const std::lock_guard<std::mutex> guard(*lock);
    known->emplace(key, file);
    return file;
  };
}

}  // namespace bondlab
