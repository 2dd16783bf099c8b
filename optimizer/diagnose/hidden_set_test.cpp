// SPDX-License-Identifier: GPL-2.0-or-later
#include "diagnose/hidden_set.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <set>

#include "base/sha256.h"
#include "base/test_folder.h"
#include "diagnose/forward_prober.h"

namespace bondlab::diagnose {
namespace {

namespace fs = std::filesystem;

const fs::path inputs = fs::path(BONDLAB_SOURCE_DIR) / "inputs";
const fs::path frozen = inputs / "hidden" / "set.toml";
const fs::path second = inputs / "hidden" / "set_weak.toml";
const fs::path third = inputs / "hidden" / "set_pairs.toml";

// Cases are not to be chosen by what a diagnosis makes of them. Who changes them says so here.
TEST(HiddenSet, IsTheOneThatWasFrozen) {
  EXPECT_EQ(sha256_file(frozen),
            "433083079892b04a019d921a2457ba560f1ae8f7343452d2e7796788eadba775");
  EXPECT_EQ(sha256_file(second),
            "14585caf8ad00b2956dfae3911ba52bca0e1982d1f467b771942623445446486");
  EXPECT_EQ(sha256_file(third), "9ec9b213cd67f8430d870b1426efd1c00397ab0e710659036e54196b42a4867b");
  EXPECT_EQ(sha256_file(read_hidden_set(frozen).laboratory),
            "66a6bb0d4990e9cd37d87e97003c98d0382ea8b55287fdf45551d4d12c47c8c5");
  EXPECT_EQ(sha256_file(read_hidden_set(second).laboratory),
            "0db8ac5d1b36776817e0d134b1049da6a7bcf986a55e62b0327a204c7d494f18");
}

TEST(HiddenSet, SecondHasEffectsLeftOutOfTheCatalogueAndTenNulls) {
  std::map<std::string, int> kinds;
  std::map<std::string, std::set<double>> sizes;
  for (const auto &one : read_hidden_set(second).cases) {
    ++kinds[one.kind];
    if (one.kind == "effect") sizes[one.effects[0]].insert(one.units);
  }
  EXPECT_EQ(kinds,
            (std::map<std::string, int>{
                {"effect", 28}, {"outside", 6}, {"left_out", 4}, {"pair", 4}, {"null", 10}}));
  EXPECT_EQ(sizes.size(), 14u);
  for (const auto &[name, units] : sizes) EXPECT_EQ(units, (std::set<double>{10, 20})) << name;
}

TEST(HiddenSet, ThirdIsForPairsAndForWhatTheCatalogueLacks) {
  std::map<std::string, int> kinds;
  for (const auto &one : read_hidden_set(third).cases) {
    ++kinds[one.kind];
    if (one.kind == "pair") {
      EXPECT_EQ(one.effects.size(), 2u) << one.id;
    }
  }
  EXPECT_EQ(kinds, (std::map<std::string, int>{
                       {"effect", 8}, {"outside", 5}, {"left_out", 5}, {"pair", 10}, {"null", 6}}));
  EXPECT_EQ(read_hidden_set(third).laboratory, read_hidden_set(second).laboratory);
}

TEST(HiddenSet, HasFourteenEffectsInTwoSizesFiveFromOutsideThreePairsAndFourNulls) {
  const auto set = read_hidden_set(frozen);
  std::map<std::string, int> kinds;
  std::map<std::string, std::set<double>> sizes;
  for (const auto &one : set.cases) {
    ++kinds[one.kind];
    if (one.kind == "effect") sizes[one.effects[0]].insert(one.units);
  }
  EXPECT_EQ(kinds,
            (std::map<std::string, int>{{"effect", 28}, {"outside", 5}, {"pair", 3}, {"null", 4}}));
  EXPECT_EQ(sizes.size(), 14u);
  for (const auto &[name, units] : sizes) EXPECT_EQ(units, (std::set<double>{10, 20})) << name;
}

TEST(HiddenSet, NamesEffectsThatItsLaboratoryShowsInsideAndOutsideTheCatalogue) {
  const auto names = [](const std::vector<EffectDefinition> &effects) {
    std::set<std::string> out;
    for (const auto &effect : effects) out.insert(effect.name);
    return out;
  };
  const auto outside = names(read_effects(inputs / "hidden" / "outside"));
  for (const auto &file : {frozen, second, third}) {
    const auto set = read_hidden_set(file);
    const auto inside =
        names(effects_of_study(read_study(set.laboratory), read_effects(inputs / "effects")));
    for (const auto &one : set.cases)
      for (const auto &effect : one.effects)
        EXPECT_TRUE((one.kind == "outside" ? outside : inside).count(effect)) << one.id;
  }
}

TEST(HiddenSet, EverySeriesOfTheLaboratoryHasItsOwnSpecimens) {
  std::set<std::uint64_t> seeds;
  for (const auto &file : {frozen, second}) {
    const Study study = read_study(read_hidden_set(file).laboratory);
    std::set<std::string> specimens;
    for (const auto &test : study.tests) {
      EXPECT_TRUE(specimens.insert(test.specimen).second) << test.name;
      // Packings of hidden cases go up to a million above the seed.
      EXPECT_TRUE(seeds.insert(study.specimen(test.specimen).seed / 1000000).second) << test.name;
    }
  }
}

TEST(HiddenSet, ErrorsNameTheLine) {
  const TestFolder folder;
  const auto complaint = [&](const std::string &text) -> std::string {
    std::ofstream(folder.path() / "set.toml")
        << "schema = 1\nlaboratory = \"l.toml\"\nreplicates = 4\n[[cases]]\nid = \"a\"\n"
        << text;
    try {
      read_hidden_set(folder.path() / "set.toml");
    } catch (const std::exception &error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(complaint("kind = \"null\"\nseed = 1\n"), "");
  EXPECT_NE(complaint("kind = \"magic\"\nseed = 1\n").find("set.toml:6"), std::string::npos);
  EXPECT_NE(complaint("kind = \"pair\"\nseed = 1\neffects = [\"a\"]\nunits = 10\n").find(":8"),
            std::string::npos);
  EXPECT_NE(complaint("kind = \"effect\"\nseed = 1\neffects = [\"a\"]\n").find("units"),
            std::string::npos);
  EXPECT_NE(
      complaint("kind = \"null\"\nseed = 1\n[[cases]]\nid = \"a\"\nkind = \"null\"\nseed = 2\n")
          .find("twice"),
      std::string::npos);
}

}  // namespace
}  // namespace bondlab::diagnose
