#include "client/progress.h"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "client/console.h"
#include "engine/base/printable.h"

namespace fjord {
namespace {

constexpr std::chrono::milliseconds kLiveInterval{100};
constexpr std::chrono::seconds kPlainInterval{5};

std::string Format(const char* format, double value) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, format, value);
  return buffer;
}

}  // namespace

std::string FormatDuration(double seconds) {
  const auto whole = static_cast<int64_t>(std::clamp(seconds, 0., 1e9) + .5);
  if (whole < 60) return std::to_string(whole) + " s";
  if (whole < 3600) return std::to_string(whole / 60) + " min " + std::to_string(whole % 60) + " s";
  return std::to_string(whole / 3600) + " h " + std::to_string(whole / 60 % 60) + " min";
}

std::string FormatBar(double share, int width) {
  const int inside = std::max(1, width - 2);
  const int full = std::clamp(static_cast<int>(share * inside), 0, inside);
  std::string bar = "[";
  bar.append(static_cast<size_t>(full), '#').append(static_cast<size_t>(inside - full), '.');
  return bar + "]";
}

FrameProgress::Outlet FrameProgress::Console() {
  return {console::StderrIsTerminal(), console::TerminalWidth(),
          [](const std::string& line) {
            console::SetLive(line.empty() ? std::vector<std::string>{}
                                          : std::vector<std::string>{line});
          },
          console::Note};
}

FrameProgress::FrameProgress(std::string name, uint64_t total, Outlet outlet, MonotonicNow now)
    : name_(Printable(name)),
      total_(total),
      outlet_(std::move(outlet)),
      now_(std::move(now)),
      start_(now_()),
      shown_(start_) {}

FrameProgress::~FrameProgress() {
  if (outlet_.terminal) outlet_.live("");
}

void FrameProgress::FrameDone() {
  const std::lock_guard lock(mutex_);
  ++done_;
  share_ = 0;
  Show(done_ + kept_ >= total_);
}

void FrameProgress::FrameKept() {
  const std::lock_guard lock(mutex_);
  ++kept_;
  Show(done_ + kept_ >= total_);
}

void FrameProgress::Share(double part) {
  const std::lock_guard lock(mutex_);
  share_ = std::clamp(part, 0., 1.);
  Show(false);
}

void FrameProgress::Show(bool last) {
  const auto now = now_();
  const auto interval = outlet_.terminal ? std::chrono::milliseconds(kLiveInterval)
                                         : std::chrono::milliseconds(kPlainInterval);
  if (!last && now - shown_ < interval) return;
  shown_ = now;
  const std::string line = Line(std::chrono::duration<double>(now - start_).count());
  (outlet_.terminal ? outlet_.live : outlet_.plain)(line);
}

std::string FrameProgress::Line(double elapsed) const {
  const double made = static_cast<double>(done_) + share_;
  const uint64_t finished = done_ + kept_;
  std::string text = std::to_string(finished) + " of " + std::to_string(total_) + " frames";
  if (kept_ > 0) text += " (" + std::to_string(kept_) + " were there)";
  if (made > 0 && elapsed > 0) {
    const double rate = made / elapsed;
    text += rate >= 1 ? ", " + Format("%.1f frames/s", rate)
                      : ", " + Format("%.1f s a frame", 1 / rate);
    const double left = static_cast<double>(total_ - finished) - share_;
    text += finished < total_ ? ", " + FormatDuration(left / rate) + " left"
                              : ", " + FormatDuration(elapsed);
  }
  if (!outlet_.terminal) return name_ + ": " + text;
  const double share =
      total_ == 0 ? 1 : (static_cast<double>(finished) + share_) / static_cast<double>(total_);
  const int room = outlet_.width - 1 - static_cast<int>(CharactersIn(name_) + text.size()) - 4;
  std::string line = name_ + "  ";
  if (room >= 10) line += FormatBar(share, std::min(room, 40)) + "  ";
  line += text;
  return FirstCharacters(line, static_cast<size_t>(std::max(1, outlet_.width - 1)));
}

}  // namespace fjord
