// SPDX-License-Identifier: GPL-2.0-or-later
#include "base/sha256.h"

#include <gtest/gtest.h>

#include "base/test_folder.h"
#include "base/user_error.h"

namespace bondlab {
namespace {

TEST(Sha256, GivesTheDigestsOfTheStandard) {  // NIST's examples for FIPS 180-4
  EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(sha256(std::string(1000000, 'a')),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(Sha256, DoesNotDependOnHowTheBytesArrive) {
  const std::string text(333, 'x');
  for (const std::size_t cut : {1u, 63u, 64u, 65u, 200u}) {
    Sha256 hash;
    hash.add(text.substr(0, cut));
    hash.add(text.substr(cut));
    EXPECT_EQ(hash.hex(), sha256(text)) << cut;
  }
  const TestFolder folder;
  EXPECT_EQ(sha256_file(folder.write("a", std::string(100000, 'b'))),
            sha256(std::string(100000, 'b')));
  EXPECT_THROW(sha256_file(folder / "none"), UserError);
}

TEST(Sha256, FieldsDoNotRunIntoEachOther) {
  Sha256 one, other;
  one.add_field("ab", "c");
  other.add_field("a", "bc");
  EXPECT_NE(one.hex(), other.hex());
}

}  // namespace
}  // namespace bondlab
