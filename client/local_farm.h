// A coordinator and workers as child processes of this one: started, started again when they die,
// and stopped in order. They die with this process, however it ends.
#pragma once

#include <functional>
#include <string>

#include "engine/base/result.h"

namespace fjord {

struct LocalFarmOptions {
  int workers = 0;   // 0: one for every two cores, at least one
  int threads = 0;   // of each worker; 0: the cores shared out
  std::string data;  // the coordinator's folder; worker caches are beside it
  std::string listen;
  std::string budget;        // the coordinator's --budget; empty: its default
  bool with_parent = false;  // end when the process that started this one ends
};

// Runs until SIGINT, SIGTERM or SIGHUP. on_ready gets the address once, when the coordinator
// listens. Call from the main thread, with no other thread running. An error where a program is
// missing or keeps dying.
Result<> RunLocalFarm(const LocalFarmOptions& options,
                      const std::function<void(const std::string& address)>& on_ready);

}  // namespace fjord
