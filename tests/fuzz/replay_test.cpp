// Every fuzz target over its seed corpus and over mutations of it. A failure prints the seed; the
// same input comes again from Mutate(corpus, seed).
#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "engine/formats/par_file.h"
#include "engine/formats/shape_file.h"
#include "engine/image/codec.h"
#include "engine/scene/load.h"
#include "tests/fuzz/harness.h"
#include "tests/fuzz/mutate.h"

namespace fjord::fuzz {
namespace {

constexpr uint64_t kMutations = 2000;

std::map<std::string, std::string> CorpusByName(const std::string& target) {
  std::map<std::string, std::string> corpus;
  for (const auto& entry : std::filesystem::directory_iterator(std::string(FJORD_SOURCE_DIR) +
                                                               "/tests/fuzz/corpus/" + target)) {
    std::ifstream in(entry.path(), std::ios::binary);
    std::stringstream bytes;
    bytes << in.rdbuf();
    corpus[entry.path().filename()] = bytes.str();
  }
  return corpus;
}

std::vector<std::string> Corpus(const std::string& target) {
  std::vector<std::string> corpus;
  for (const auto& [name, bytes] : CorpusByName(target)) corpus.push_back(bytes);
  return corpus;
}

char g_running[64];

void SayWhatRan(int) {
  const char message[] = "fuzz target and seed: ";
  (void)!write(STDERR_FILENO, message, sizeof(message) - 1);
  (void)!write(STDERR_FILENO, g_running, std::strlen(g_running));
  (void)!write(STDERR_FILENO, "\n", 1);
  std::signal(SIGABRT, SIG_DFL);
  std::abort();
}

class ReplayTest : public testing::TestWithParam<Target> {
 protected:
  ReplayTest() { Prepare(); }
};

TEST_P(ReplayTest, SeedCorpus) {
  const std::vector<std::string> corpus = Corpus(GetParam().name);
  ASSERT_GE(corpus.size(), 2u);
  GetParam().run("");
  for (const std::string& bytes : corpus) {
    GetParam().run(bytes);
    for (size_t n = 0; n < bytes.size(); n += 1 + bytes.size() / 50) {
      GetParam().run(std::string_view(bytes).substr(0, n));
    }
  }
}

TEST_P(ReplayTest, SeededMutations) {
  const std::vector<std::string> corpus = Corpus(GetParam().name);
  ASSERT_FALSE(corpus.empty());
  std::signal(SIGABRT, &SayWhatRan);
  for (uint64_t seed = 0; seed < kMutations; ++seed) {
    const std::string bytes = Mutate(corpus, seed);
    // An abort ends the program, so what would be wanted then is noted beforehand.
    std::snprintf(g_running, sizeof(g_running), "%s %llu", GetParam().name,
                  static_cast<unsigned long long>(seed));
    GetParam().run(bytes);
  }
  g_running[0] = '\0';
}

INSTANTIATE_TEST_SUITE_P(AllTargets, ReplayTest,
                         testing::ValuesIn(Targets().begin(), Targets().end()),
                         [](const auto& target) { return std::string(target.param.name); });

// Seeds that are refused at the door would test nothing behind it.
TEST(CorpusTest, GoodSeedsAreTaken) {
  const AssetReader asset = [](const v1::File&) -> Result<std::string> {
    return std::string("data 4 2\n0 0 0\n1 0 0\n1 1 .5\n0 1 0\n3 1 2 3\n3 1 3 4\n");
  };
  for (const auto& [name, bytes] : CorpusByName("shape")) {
    const auto shape = ReadShape(bytes, name);
    EXPECT_EQ(shape.ok(), name != "animator.obj") << shape.error().ToString();
  }
  for (const auto& [name, bytes] : CorpusByName("par")) EXPECT_TRUE(ReadPar(bytes, name)) << name;
  for (const auto& [name, bytes] : CorpusByName("picture")) {
    EXPECT_TRUE(DecodePicture(bytes, name)) << name;
  }
  for (const auto& [name, bytes] : CorpusByName("scene_text")) {
    for (const Error& error : LoadSceneText(bytes, name, asset).errors) {
      ADD_FAILURE() << error.ToString();
    }
  }
  for (const auto& [name, bytes] : CorpusByName("scene_binary")) {
    for (const Error& error : LoadSceneBinary(bytes, name, asset).errors) {
      ADD_FAILURE() << error.ToString();
    }
  }
}

}  // namespace
}  // namespace fjord::fuzz
