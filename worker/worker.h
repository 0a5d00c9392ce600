// A worker: joins a coordinator, takes leases, renders, delivers. Built by the fjord-worker
// program, by `fjord farm` and by tests.
//
// Threads: one renders (the renderer may use more); lease_loop.h asks for work and stays one lease
// ahead; renewal.h renews, and stops what is past its deadline; delivery.h delivers. They talk to
// the coordinator through session.h and share the leases of held.h. Losing the worker at any moment
// loses nothing but its own work.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "worker/blobs.h"
#include "worker/lease_client.h"
#include "worker/unit_renderer.h"

namespace fjord::worker {

struct WorkerConfig {
  std::string server = "127.0.0.1:7433";
  int threads = 0;  // of one frame; 0: one a core
  std::vector<std::string> tags;
  std::string id;         // stable over restarts; empty: host name and a number
  std::string cache_dir;  // of scenes and assets; empty: none on disk
  uint64_t cache_bytes = uint64_t{1} << 30;
  std::string session;             // this process's; empty: a random one
  std::vector<std::string> ended;  // sessions of earlier processes, known to be over
  bool stay = false;               // drained: wait to be released instead of ending
  std::string program;             // for suspects' child processes; empty: rendered in this one

  // For tests; null: gRPC and the engine.
  std::function<std::unique_ptr<LeaseClient>()> make_leases;
  std::function<std::unique_ptr<Blobs>()> make_blobs;
  std::function<std::unique_ptr<UnitRenderer>(Blobs&)> make_renderer;
};

class Worker {
 public:
  // Returns at once; a coordinator that is not there yet is waited for, and said so.
  static std::unique_ptr<Worker> Start(WorkerConfig config);
  // Stop.
  virtual ~Worker() = default;

  // Gives everything back and leaves. True: the coordinator knows of no session of this worker any
  // more. Thread-safe.
  virtual bool Stop() = 0;
  // Until it has ended by itself: drained (no error), or refused by the coordinator.
  virtual Result<> Wait() = 0;
  // The same with an end to the waiting; none: still at work.
  virtual std::optional<Result<>> WaitFor(int milliseconds) = 0;
};

}  // namespace fjord::worker
