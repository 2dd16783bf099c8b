// SPDX-License-Identifier: GPL-2.0-or-later
//
// Job: generated_specimens(): packings from the specimen room as files with their hashes. Asked for the
//   same packing by several threads, it makes it once.
#include <memory>
#include <mutex>
#include <optional>

#include "base/sha256.h"
#include "forward/engine_forward_model.h"
#include "specimen/cache.h"
#include "study/specimen_request.h"

namespace bondlab {

namespace {

struct Packing {
  std::mutex making;
  std::optional<SpecimenFile> file;
};

// Hashes are remembered by path: a batch of a thousand runs reads its specimen once.
struct Packings {
  std::mutex lock;
  std::map<std::string, std::shared_ptr<Packing>> by_key;
  std::shared_ptr<Packing> of(const std::string &key) {
    const std::lock_guard<std::mutex> guard(lock);
    auto &packing = by_key[key];
    if (!packing) packing = std::make_shared<Packing>();
    return packing;
  }
};

}  // namespace

SpecimenSource generated_specimens(const std::filesystem::path &folder) {
  const auto known = std::make_shared<Packings>();
  return [folder, known](const SpecimenEntry &entry, int packing) {
    const SpecimenRequest request = specimen_request(entry, packing);
    const auto made = known->of(specimen_key(request));
    const std::lock_guard<std::mutex> guard(made->making);
    if (!made->file) {
      SpecimenFile file;
      file.path = std::filesystem::absolute(ensure_specimen(request, folder));
      file.hash = sha256_file(file.path);
      made->file = file;
    }
    return *made->file;
  };
}

}  // namespace bondlab
