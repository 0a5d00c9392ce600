// Time, injected: the server runs on SystemClock, tests on their own.
#pragma once

#include <chrono>

#include "server/state/types.h"

namespace fjord::server {

class Clock {
 public:
  virtual ~Clock() = default;
  virtual Now Read() const = 0;
};

class SystemClock : public Clock {
 public:
  Now Read() const override {
    using std::chrono::duration_cast;
    using std::chrono::milliseconds;
    return {
        duration_cast<milliseconds>(std::chrono::steady_clock::now().time_since_epoch()).count(),
        duration_cast<milliseconds>(std::chrono::system_clock::now().time_since_epoch()).count()};
  }
};

}  // namespace fjord::server
