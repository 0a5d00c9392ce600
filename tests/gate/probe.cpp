#include "tests/gate/probe.h"

#include <charconv>
#include <cstdio>
#include <cstring>

#include "engine/base/fpenv.h"
#include "engine/base/simd.h"

namespace fjord::gate {

void Report::Item(const std::string& name, const Digest& digest) {
  std::printf("%s %s\n", name.c_str(), digest.Hex().substr(0, 32).c_str());
}

void Report::Fail(const std::string& name, const std::string& why) {
  failed_ = true;
  std::printf("%s failed\n", name.c_str());
  std::fprintf(stderr, "%s: %s\n", name.c_str(), why.c_str());
}

namespace {

constexpr char kUsage[] =
    "fjord_probe [--threads N] [--tile N] [--patch N] [--simd LEVEL] [--shuffle] [--only PREFIX]\n"
    "            [--scenes FOLDER] [--levels]\n";

int Usage(const char* what) {
  std::fprintf(stderr, "fjord_probe: error: %s\n%s", what, kUsage);
  return 2;
}

int Run(int argc, char** argv) {
  Options options;
  options.scenes = std::string(FJORD_SOURCE_DIR) + "/tests/gate";
  for (int i = 1; i < argc; ++i) {
    const std::string_view word = argv[i];
    if (word == "--shuffle") {
      options.shuffle = true;
      continue;
    }
    if (word == "--levels") {
      for (const std::string& level : SimdLevels()) std::printf("%s\n", level.c_str());
      return 0;
    }
    if (++i == argc) return Usage("a value is missing");
    const std::string_view value = argv[i];
    int number = 0;
    std::from_chars(value.data(), value.data() + value.size(), number);
    if (word == "--threads") {
      options.threads = number;
    } else if (word == "--tile") {
      options.tile = number;
    } else if (word == "--patch") {
      options.patch = static_cast<size_t>(number);
    } else if (word == "--only") {
      options.only = value;
    } else if (word == "--scenes") {
      options.scenes = value;
    } else if (word == "--simd") {
      if (!SetSimdLevel(value)) return Usage("no such SIMD level here");
    } else {
      return Usage(argv[i - 1]);
    }
  }
  Report report(options.only);
  ProbeMath(report);
  ProbeLanes(report);
  ProbeFractals(options, report);
  ProbeScenes(options, report);
  return report.failed() ? 1 : 0;
}

}  // namespace
}  // namespace fjord::gate

int main(int argc, char** argv) {
  fjord::SetFloatEnvironment();
  return fjord::gate::Run(argc, argv);
}
