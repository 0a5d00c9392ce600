#include "engine/base/result.h"

#include <gtest/gtest.h>

namespace fjord {
namespace {

Result<int> Half(int x) {
  if (x % 2 != 0) return Invalid("3 is odd; give an even number", {"a.scene", 4, 9});
  return x / 2;
}

TEST(ResultTest, HoldsAValueOrAnErrorWithItsPlace) {
  EXPECT_EQ(Half(4).value(), 2);
  const Result<int> bad = Half(3);
  ASSERT_FALSE(bad.ok());
  EXPECT_EQ(bad.error().code, ErrorCode::kInvalid);
  EXPECT_EQ(bad.error().ToString(), "a.scene:4:9: error: 3 is odd; give an even number");
  EXPECT_EQ(Invalid("no").ToString(), "error: no");
  EXPECT_EQ((Place{"f", 3, 0}).ToString(), "f:3");
  EXPECT_TRUE(Result<>().ok());
}

TEST(ResultDeathTest, ValueOfAnErrorStopsWithItsMessage) {
  EXPECT_DEATH((void)Half(3).value(), "3 is odd");
}

}  // namespace
}  // namespace fjord
