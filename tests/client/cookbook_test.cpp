// docs/cookbook.md is true: the scenes that it shows are the files that it names, its commands work
// where those lie, and it has the pictures that it shows.
#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "tests/client/run_program.h"

namespace fjord::testing {
namespace {

namespace fs = std::filesystem;

const char* const kFolder = "examples/cookbook/";

std::string Source(const std::string& path) { return std::string(FJORD_SOURCE_DIR) + "/" + path; }

struct Block {
  std::string language;  // after the fence
  std::string before;    // the line before it
  std::string text;
};

std::vector<Block> Blocks(const std::string& page) {
  std::vector<Block> blocks;
  std::istringstream lines(page);
  std::string line, before;
  bool inside = false;
  while (std::getline(lines, line)) {
    if (line.substr(0, 3) == "```") {
      if (!inside) blocks.push_back({line.substr(3), before, ""});
      inside = !inside;
    } else if (inside) {
      blocks.back().text += line + "\n";
    }
    before = line;
  }
  EXPECT_FALSE(inside) << "a block has no end";
  return blocks;
}

std::vector<std::string> Words(const std::string& command) {
  std::vector<std::string> words;
  std::istringstream in(command);
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

TEST(CookbookTest, ScenesAreTheFilesThatTheyNameAndCommandsWork) {
  const ScratchFolder folder;
  for (const auto& entry : fs::directory_iterator(Source(kFolder))) {
    fs::copy(entry.path(), folder / entry.path().filename().string());
  }
  int scenes = 0, commands = 0;
  for (const Block& block : Blocks(ReadAll(Source("docs/cookbook.md")))) {
    if (block.before.substr(0, 1 + std::string(kFolder).size()) == "`" + std::string(kFolder)) {
      EXPECT_EQ(block.text, ReadAll(Source(block.before.substr(1, block.before.size() - 2))));
      ++scenes;
    }
    if (block.language != "sh") continue;
    std::istringstream lines(block.text);
    for (std::string line; std::getline(lines, line); ++commands) {
      std::vector<std::string> words = Words(line);
      ASSERT_EQ(words.at(0), "fjord") << line;
      words.erase(words.begin());
      if (words.at(0) == "render") words.insert(words.end(), {"--size", "64x36"});
      const ProgramRun run = RunFjord(words, {.folder = folder.path()});
      EXPECT_EQ(run.code, 0) << line << "\n" << run.err;
    }
  }
  EXPECT_EQ(scenes, 5);
  EXPECT_EQ(commands, 14);
}

TEST(CookbookTest, PicturesAreThere) {
  int pictures = 0;
  for (const char* page : {"docs/cookbook.md", "docs/gallery/README.md", "README.md"}) {
    const std::string text = ReadAll(Source(page));
    const fs::path base = fs::path(Source(page)).parent_path();
    for (size_t at = text.find("!["); at != text.npos; at = text.find("![", at + 2)) {
      const size_t from = text.find("](", at) + 2;
      const std::string name = text.substr(from, text.find(')', from) - from);
      EXPECT_TRUE(fs::exists(base / name)) << page << " shows " << name;
      ++pictures;
    }
  }
  EXPECT_GT(pictures, 20);
}

}  // namespace
}  // namespace fjord::testing
