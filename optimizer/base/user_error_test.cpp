// SPDX-License-Identifier: GPL-2.0-or-later
#include "base/user_error.h"

#include <gtest/gtest.h>

namespace bondlab {
namespace {

TEST(UserError, ShowsAsMuchOfThePlaceAsIsKnown) {
  EXPECT_STREQ(UserError({"a.toml", 3, 7}, "wrong").what(), "a.toml:3:7: wrong");
  EXPECT_STREQ(UserError({"a.toml", 3, 0}, "wrong").what(), "a.toml:3: wrong");
  EXPECT_STREQ(UserError({"a.toml", 0, 0}, "wrong").what(), "a.toml: wrong");
  EXPECT_STREQ(UserError("wrong").what(), "wrong");
}

TEST(ErrorCollector, ThrowsAllErrorsInTheOrderOfTheirPlaces) {
  ErrorCollector errors;
  EXPECT_NO_THROW(errors.throw_if_any());
  errors.add({"study.toml", 9, 1}, "late");
  errors.add({"test.toml", 1, 1}, "other file");
  errors.add({"study.toml", 2, 5}, "early");
  errors.add({"study.toml", 2, 1}, "earliest");
  try {
    errors.throw_if_any();
    FAIL();
  } catch (const UserErrors &all) {
    EXPECT_EQ(all.errors().size(), 4u);
    EXPECT_STREQ(all.what(),
                 "study.toml:2:1: earliest\nstudy.toml:2:5: early\nstudy.toml:9:1: "
                 "late\ntest.toml:1:1: other file");
    ErrorCollector outer;
    outer.add(all);
    EXPECT_EQ(outer.errors().size(), 4u) << "collected errors are taken apart";
  }
}

TEST(NearestWord, FindsSlipsAndNothingFarFetched) {
  const std::vector<std::string> known{"sigma_c", "sigma_c_sd", "tau_c", "lambda", "beta"};
  EXPECT_EQ(nearest_word("sigmac", known), "sigma_c");
  EXPECT_EQ(nearest_word("Sigma_C", known), "sigma_c");
  EXPECT_EQ(nearest_word("lamdba", known), "lambda");
  EXPECT_EQ(nearest_word("thickness", known), "");
  EXPECT_EQ(nearest_word("x", {}), "");
}

}  // namespace
}  // namespace bondlab
