// Checks of errors (their place as "file:line:column" and words of their message) and notes.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/formats/shape_file.h"

namespace fjord {

template <typename T>
void ExpectError(const Result<T>& result, const std::string& place, const std::string& words) {
  ASSERT_FALSE(result.ok()) << "no error; wanted: " << words;
  EXPECT_EQ(result.error().place.ToString(), place) << result.error().message;
  EXPECT_THAT(result.error().message, testing::HasSubstr(words));
}

inline std::vector<std::string> NotesOf(const ShapeFile& shape) {
  std::vector<std::string> notes;
  for (const ShapeNote& note : shape.notes) {
    notes.push_back(note.place.ToString() + ": " + note.message);
  }
  return notes;
}

inline std::string ReadTestFile(const std::string& path) {
  std::ifstream in(std::string(FJORD_SOURCE_DIR) + "/" + path, std::ios::binary);
  EXPECT_TRUE(in.good()) << path;
  std::stringstream bytes;
  bytes << in.rdbuf();
  return bytes.str();
}

}  // namespace fjord
