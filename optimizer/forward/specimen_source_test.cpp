// SPDX-License-Identifier: GPL-2.0-or-later
#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <vector>

#include "base/test_folder.h"
#include "forward/engine_forward_model.h"
#include "study/study.h"

namespace bondlab {
namespace {

// Requests that differ in the bond gap alone ask for one packing from several threads.
TEST(GeneratedSpecimens, OnePackingAskedForByManyThreadsIsMadeOnce) {
  const TestFolder folder;
  SpecimenEntry entry;
  entry.name = "block";
  entry.size.width = entry.size.height = 0.010;
  entry.r_min = 0.0006, entry.r_ratio = 1.66;
  entry.seed = 5;
  for (int round = 0; round < 5; ++round) {
    const auto source = generated_specimens(folder.path() / std::to_string(round));
    constexpr int count = 8;
    std::vector<SpecimenFile> files(count);
    std::atomic<int> ready{0}, failed{0};
    std::vector<std::thread> threads;
    for (int i = 0; i < count; ++i)
      threads.emplace_back([&, i] {
        for (++ready; ready < count;) std::this_thread::yield();
        try {
          files[static_cast<std::size_t>(i)] = source(entry, 0);
        } catch (const std::exception &error) {
          ++failed;
          ADD_FAILURE() << error.what();
        }
      });
    for (auto &thread : threads) thread.join();
    ASSERT_EQ(failed, 0);
    for (const auto &file : files) {
      EXPECT_EQ(file.path, files.front().path);
      EXPECT_EQ(file.hash, files.front().hash);
    }
    EXPECT_FALSE(files.front().hash.empty());
  }
}

}  // namespace
}  // namespace bondlab
