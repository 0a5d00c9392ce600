// The actor that owns the state machine: one thread runs every task in order, hands the machine's
// records to the journal's writer, its plan requests to the planner, its grants to the calls that
// wait, its changes to the watchers. Everyone else talks to it by posting tasks.
//
// The queue of tasks from outside is bounded; at the bound Post says no and the caller answers
// RESOURCE_EXHAUSTED (F8). Tasks of calls that were taken already (a cancel, a write that ended) go
// in by PostInner; there are at most a few of these for each call.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "server/clock.h"
#include "server/journal_writer.h"
#include "server/planner.h"
#include "server/state/machine.h"

namespace fjord::server {

// Told of changes, on the actor's thread; must not block.
class Watcher {
 public:
  virtual ~Watcher() = default;
  // frames: indexes that changed. The job may have been deleted.
  virtual void Changed(const Machine& machine, const std::set<uint32_t>& frames) = 0;
  // The coordinator stops: end the stream.
  virtual void Closed() = 0;
};

class Coordinator {
 public:
  using Task = std::function<void(Machine& machine, Now now)>;
  using AcquireReply = std::function<void(const AcquireAnswer& answer)>;

  // What the coordinator asks of the disk beside the journal.
  struct Store {
    // Whether a picture can be given out; false: its loss was told (BlobsLost). Any thread.
    std::function<bool(const Digest& blob)> has_picture;
    std::function<void()> on_full;  // there is no room for the journal. From the writer's thread
  };
  Coordinator(const MachineConfig& config, Snapshot snapshot, Journal& journal,
              FramePlanner& frames, const Clock& clock, Store store,
              std::function<void(const Error&)> on_failure);
  // Answers all that waits with UNAVAILABLE, writes what is left.
  ~Coordinator();
  Coordinator(const Coordinator&) = delete;
  Coordinator& operator=(const Coordinator&) = delete;

  [[nodiscard]] bool Post(Task task);
  void PostInner(Task task);
  // Refuses outer tasks from now on and ends all calls that wait.
  void Close();

  // --- within a task only ---
  // Calls `answer` once all that the machine has recorded so far is on disk. From the writer's
  // thread.
  void AfterCommit(JournalWriter::Answer answer);
  // Replaces the session's waiting call, which is answered ABORTED.
  void Park(const std::string& session, uint64_t request, const void* caller, AcquireReply reply);
  // The caller is gone. Nothing happens where another waits by now.
  void Abandon(const std::string& session, const void* caller);
  // False: too many watch already.
  [[nodiscard]] bool Watch(JobId job, Watcher* watcher);
  void Unwatch(JobId job, Watcher* watcher);

 private:
  void CheckPictures(const Planner::Answer& answer);
  void Run();
  void Apply();
  void Deliver(const AcquireAnswer& answer);

  const Clock& clock_;
  const Store store_;
  Machine machine_;
  JournalWriter writer_;
  std::optional<Planner> planner_;

  std::mutex mutex_;
  std::condition_variable wake_;
  // guarded by mutex_
  std::deque<Task> queue_;
  bool closed_ = false;
  bool stop_ = false;

  // the actor's own
  struct Waiting {
    uint64_t request;
    const void* caller;
    AcquireReply reply;
  };
  std::map<std::string, Waiting> parked_;
  std::map<JobId, std::set<Watcher*>> watchers_;
  size_t watching_ = 0;

  std::thread thread_;
};

}  // namespace fjord::server
