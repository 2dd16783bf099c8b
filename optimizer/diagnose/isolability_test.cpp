// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/isolability.h"

#include <gtest/gtest.h>

namespace bondlab::diagnose {
namespace {

std::vector<Confusable> all_of(const std::vector<std::string> &names, double chance) {
  std::vector<Confusable> out;
  for (std::size_t i = 0; i < names.size(); ++i)
    for (std::size_t j = i + 1; j < names.size(); ++j)
      out.push_back({names[i], names[j], 1, chance});
  return out;
}

TEST(Isolability, PairsStandAloneAndNoMoreThanADozen) {
  EXPECT_TRUE(isolability_lines({}).empty());
  EXPECT_EQ(isolability_lines({{"tilt", "frame", -0.97, 0.41}}),
            (std::vector<std::string>{"tilt / frame: cosine -0.97, confused 41 %"}));
  const auto lines = isolability_lines(all_of({"a", "b", "c", "d", "e", "f", "g"}, 0.5));  // 21
  ASSERT_EQ(lines.size(), most_pairs_told + 1);
  EXPECT_EQ(lines.back(), "and 9 pairs more");
}

TEST(Isolability, EffectsThatAreAllAlikeAreOneLine) {
  auto pairs = all_of({"d", "a", "c", "b"}, 0.95);
  pairs.push_back({"a", "e", 1, 0.95});  // not with the others: no member
  pairs.push_back({"f", "g", 0.9, 0.3});
  const auto lines = isolability_lines(pairs);
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(lines[0], "any two of 4 effects, confused 90 % and more: a, b, c, d");
  EXPECT_EQ(lines[1], "a / e: cosine 1.00, confused 95 %");
  EXPECT_EQ(lines[2], "f / g: cosine 0.90, confused 30 %");
  EXPECT_EQ(isolability_lines(all_of({"a", "b", "c"}, 1)).size(), 3u) << "too few for a group";
}

}  // namespace
}  // namespace bondlab::diagnose
