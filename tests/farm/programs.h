// Coordinator and workers as processes, as tests of the programs start them.
#pragma once

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "process.h"

namespace fjord::farm_test {

// FJORD_TEST_LOG=debug shows what the programs say.
inline const std::string kLog =
    std::getenv("FJORD_TEST_LOG") != nullptr ? std::getenv("FJORD_TEST_LOG") : "err";

inline std::string SceneText(int frames, int width, int height, int samples) {
  return "name: \"farm\"\n"
         "output { frames: " +
         std::to_string(frames) + " width: " + std::to_string(width) +
         " height: " + std::to_string(height) + " samples: " + std::to_string(samples) +
         " }\n"
         "sea { level: 0 }\n"
         "objects {\n"
         "  name: \"island\"\n"
         "  key { frame: 1 shape { primitive { kind: GRID size { x: 2 y: 2 } segments: 2 rings: 2 "
         "} } }\n"
         "  key { frame: " +
         std::to_string(std::max(frames, 2)) +
         " shape { primitive { kind: GRID size { x: 3 y: 1 } segments: 2 rings: 2 } } }\n"
         "  fractal { method: \"surface\" seed: 5 H: 0.7 }\n"
         "}\n";
}

using Environment = std::vector<std::pair<std::string, std::string>>;

class Coordinator {
 public:
  explicit Coordinator(std::string data) : data_(std::move(data)) {}

  // False: it ended before it listened.
  bool Start(const Environment& environment = {}) {
    process_.emplace(
        std::vector<std::string>{FJORD_SERVER_PROGRAM, "--listen", "127.0.0.1:" + port_, "--data",
                                 data_, "--log", log_.empty() ? kLog : "info", "--lease-term-ms",
                                 term_, "--renew-ms", "100"},
        environment, log_);
    const std::string line = process_->ReadLine();
    const size_t colon = line.rfind(':');
    if (line.rfind("listening on 127.0.0.1:", 0) != 0) return false;
    port_ = line.substr(colon + 1);
    return true;
  }
  void Term(int ms) { term_ = std::to_string(ms); }
  // What it says goes into that file.
  void LogTo(const std::string& path) { log_ = path; }
  std::string address() const { return "127.0.0.1:" + port_; }
  Process& process() { return *process_; }

 private:
  const std::string data_;
  std::string log_;
  std::string port_ = "0";
  std::string term_ = "1000";
  std::optional<Process> process_;
};

// log: what it says goes into that file.
inline std::unique_ptr<Process> StartWorker(const std::string& address, const std::string& id,
                                            const Environment& environment = {},
                                            const std::string& log = "") {
  return std::make_unique<Process>(
      std::vector<std::string>{FJORD_WORKER_PROGRAM, "--server", address, "--threads", "1", "--id",
                               id, "--log", log.empty() ? kLog : "info"},
      environment, log);
}

inline std::string FileText(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace fjord::farm_test
