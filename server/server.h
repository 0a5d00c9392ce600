// The coordinator as one object: data folder, journal, store, state machine, services. The
// fjord-server program is a thin main round it; tests and `fjord farm` build the same object.
//
// Start returns when the port is bound and calls are answered. Stop (or the destructor) ends it
// cleanly; nothing that was answered needs it. Thread-safe.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "engine/animation/estimate.h"
#include "engine/base/result.h"
#include "server/journal.h"
#include "server/planner.h"
#include "server/state/machine.h"

namespace fjord::server {

struct ServerConfig {
  std::string listen = "127.0.0.1:7433";  // loopback only; port 0: a free one
  std::string data_dir;
  MachineConfig machine;
  int io_threads = 4;
  double frame_budget = kFrameBudget;  // of the engine's planner
  FramePlanner* planner = nullptr;     // null: the engine's. Must outlive the server.
  // The journal cannot be written any more, so nothing can be answered any more: end the program.
  std::function<void(const Error&)> on_failure;
};

class Server {
 public:
  static Result<std::unique_ptr<Server>> Start(ServerConfig config);
  virtual ~Server() = default;

  virtual int port() const = 0;
  // "127.0.0.1:PORT", as clients and workers want it.
  virtual std::string address() const = 0;
  virtual uint64_t epoch() const = 0;
  virtual JournalStats journal_stats() const = 0;
  virtual void Stop() = 0;
};

// Whether only this machine can reach HOST:PORT. kUsage: not an address.
Result<bool> IsLoopback(const std::string& address);

}  // namespace fjord::server
