// How far a job of many frames is: a bar with rate and time left on a terminal, plain lines at
// intervals on a pipe. Thread-safe.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>

namespace fjord {

using MonotonicNow = std::function<std::chrono::steady_clock::time_point()>;

// "3 s", "4 min 10 s", "2 h 5 min".
std::string FormatDuration(double seconds);

// [#####.....] of `width` columns.
std::string FormatBar(double share, int width);

class FrameProgress {
 public:
  // Where lines go: live(line) replaces the line at the bottom of a terminal, plain(line) appends.
  // Exactly one of them is called.
  struct Outlet {
    bool terminal = false;
    int width = 80;
    std::function<void(const std::string&)> live;
    std::function<void(const std::string&)> plain;
  };
  static Outlet Console();

  FrameProgress(std::string name, uint64_t total, Outlet outlet,
                MonotonicNow now = std::chrono::steady_clock::now);
  ~FrameProgress();  // takes the live line away

  void FrameDone();         // made now
  void FrameKept();         // was there already; does not count for the rate
  void Share(double part);  // of the frame in work, 0..1

 private:
  void Show(bool last);  // with mutex_ held
  std::string Line(double elapsed) const;

  const std::string name_;
  const uint64_t total_;
  const Outlet outlet_;
  const MonotonicNow now_;
  const std::chrono::steady_clock::time_point start_;
  std::mutex mutex_;
  // Guarded by mutex_.
  uint64_t done_ = 0;
  uint64_t kept_ = 0;
  double share_ = 0;
  std::chrono::steady_clock::time_point shown_;
};

}  // namespace fjord
