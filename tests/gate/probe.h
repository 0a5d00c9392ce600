// The exactness probe: what it computes, one line "name digest" an item. The digests must be the
// same for every compiler, optimisation level, processor, SIMD level, thread count, tile and patch
// size and order of faces (design D4); tests/gate/golden.txt is the one list of them.
#pragma once

#include <bit>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/digest.h"

namespace fjord::gate {

struct Options {
  int threads = 1;
  int tile = 0;          // 0: the renderer's own choice
  size_t patch = 0;      // 0: 1024 leaves
  bool shuffle = false;  // coarse faces in another order
  std::string only;      // items whose name starts so; empty: all
  std::string scenes;    // folder of *.scene
};

// Prints items as they are made; says whether one is wanted at all.
class Report {
 public:
  explicit Report(std::string only) : only_(std::move(only)) {}
  bool Wants(std::string_view name) const { return name.starts_with(only_); }
  void Item(const std::string& name, const Digest& digest);
  void Fail(const std::string& name, const std::string& why);
  bool failed() const { return failed_; }

 private:
  std::string only_;
  bool failed_ = false;
};

// Digests values byte by byte, high byte first, so that byte order does not matter.
class Canon {
 public:
  void Add(uint64_t value, int bytes = 8) {
    for (int b = bytes - 1; b >= 0; --b) buffer_.push_back(static_cast<uint8_t>(value >> (8 * b)));
    if (buffer_.size() >= 4096) Flush();
  }
  void Add(double value) { Add(std::bit_cast<uint64_t>(value)); }
  Digest Finish() {
    Flush();
    return sha_.Finish();
  }

 private:
  void Flush() {
    sha_.Update(buffer_);
    buffer_.clear();
  }
  Sha256 sha_;
  std::vector<uint8_t> buffer_;
};

void ProbeMath(Report& report);
void ProbeLanes(Report& report);
void ProbeFractals(const Options& options, Report& report);
void ProbeScenes(const Options& options, Report& report);

}  // namespace fjord::gate
