// Checks of one error: its place as "file:line:column" and words of its message.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>

#include "engine/base/result.h"

namespace fjord {

template <typename T>
void ExpectError(const Result<T>& result, const std::string& place, const std::string& words) {
  ASSERT_FALSE(result.ok()) << "no error; wanted: " << words;
  EXPECT_EQ(result.error().place.ToString(), place) << result.error().message;
  EXPECT_THAT(result.error().message, testing::HasSubstr(words));
}

inline std::string ReadTestFile(const std::string& path) {
  std::ifstream in(std::string(FJORD_SOURCE_DIR) + "/" + path, std::ios::binary);
  EXPECT_TRUE(in.good()) << path;
  std::stringstream bytes;
  bytes << in.rdbuf();
  return bytes.str();
}

}  // namespace fjord
