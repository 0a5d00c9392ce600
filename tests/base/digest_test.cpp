#include "engine/base/digest.h"

#include <gtest/gtest.h>

#include <utility>

namespace fjord {
namespace {

// FIPS 180-2, appendix B.
TEST(DigestTest, KnownAnswers) {
  EXPECT_EQ(Sha256Of("").Hex(), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(Sha256Of("abc").Hex(),
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(Sha256Of(std::string(1000000, 'a')).Hex(),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(DigestTest, PiecesEqualTheWhole) {
  Sha256 sha;
  sha.Update("ab");
  Sha256 moved = std::move(sha);
  moved.Update(std::string_view());
  moved.Update("c");
  EXPECT_EQ(moved.Finish(), Sha256Of("abc"));
}

TEST(DigestTest, HexIsRecognised) {
  const std::string hex = Sha256Of("x").Hex();
  EXPECT_TRUE(IsDigestHex(hex));
  EXPECT_FALSE(IsDigestHex(hex.substr(1)));
  EXPECT_FALSE(IsDigestHex(hex + "0"));
  EXPECT_FALSE(IsDigestHex("E" + hex.substr(1)));
  EXPECT_FALSE(IsDigestHex(std::string(64, '\0')));
}

TEST(DigestDeathTest, NoUpdateAfterFinish) {
  Sha256 sha;
  (void)sha.Finish();
  EXPECT_DEATH(sha.Update("x"), "broken invariant");
}

}  // namespace
}  // namespace fjord
