// Plain values of the coordinator's state machine and of the journal below it. No Protobuf, no
// clock, no I/O: the services translate to and from these.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "engine/base/digest.h"
#include "engine/base/frame_set.h"

namespace fjord::server {

// Both clocks at one instant: deadlines use `mono_ms`, what people read uses `unix_ms`.
struct Now {
  int64_t mono_ms = 0;
  int64_t unix_ms = 0;
};

using JobId = uint64_t;  // from 1, in the order of submission; 0: none

// Never reused: the epoch changes with every start of a coordinator, the sequence with every grant.
struct AttemptId {
  uint64_t epoch = 0;
  uint64_t sequence = 0;
  friend auto operator<=>(const AttemptId&, const AttemptId&) = default;
};

enum class FrameState : uint8_t { kWaiting = 1, kRunning, kDone, kFailed };
enum class JobState : uint8_t { kQueued = 1, kRunning, kPaused, kDone, kFailed, kCancelled };

struct Counts {
  uint32_t total = 0, waiting = 0, running = 0, done = 0, cached = 0, failed = 0;
  friend bool operator==(const Counts&, const Counts&) = default;
};

// What a client asked for. `content` digests all of it but the request id.
struct JobSpec {
  std::string request_id;
  std::string content;
  std::string name;
  std::string project;
  Digest scene;
  FrameSet frames;
  int32_t priority = 0;
  double verify_share = 0;
  JobId after = 0;
  uint32_t frame_limit_ms = 0;  // that one try may take; 0: any time
};

// --- what the journal holds; each row replaces the one with the same identity ---

struct JobRow {
  JobId id = 0;
  JobSpec spec;
  bool paused = false;
  bool cancelled = false;
  int64_t submitted_unix_ms = 0;
  int64_t ended_unix_ms = 0;  // 0: not ended
  std::string error;          // the scene cannot be used at all
};

struct FrameRow {
  JobId job = 0;
  uint32_t frame = 0;
  std::optional<Digest> key;  // none: the frame has no key, and `error` says why
  bool cached = false;
  std::string error;
};

// One picture that was delivered for a key: a piece of evidence. Its identity is (key,
// attempt, worker, pixel).
struct ResultRow {
  Digest key;
  AttemptId attempt;
  std::string worker;
  Digest pixel;
  Digest blob;
  uint64_t triangles = 0;
  uint32_t render_ms = 0;
  uint64_t bytes = 0;  // of the blob; 0: not known
};

struct KeyRow {
  Digest key;
  uint32_t failures = 0;  // tries that failed on the frame's own merits
  uint32_t lost = 0;      // workers lost while they rendered it
  bool failed = false;
  std::string error;
};

struct WorkerRow {
  std::string id;
  bool draining = false;
  bool quarantined = false;
};

// A result that counts no more: its worker is not trusted.
struct DropResult {
  Digest key;
  AttemptId attempt;
  std::string worker;
  Digest pixel;
};

// A job that is forgotten, with its frames. Its id is never given again.
struct DropJob {
  JobId id = 0;
};

using Record = std::variant<JobRow, FrameRow, ResultRow, DropResult, KeyRow, WorkerRow, DropJob>;

// All that a coordinator knows when it starts.
struct Snapshot {
  uint64_t epoch = 1;  // of this start; 1: a fresh journal
  JobId last_job = 0;  // the highest id that was dropped
  std::vector<JobRow> jobs;
  std::vector<FrameRow> frames;
  std::vector<ResultRow> results;
  std::vector<KeyRow> keys;
  std::vector<WorkerRow> workers;
};

// --- answers ---

enum class Code : uint8_t {
  kInvalid,       // INVALID_ARGUMENT
  kNotFound,      // NOT_FOUND: also a session that must join again
  kExists,        // ALREADY_EXISTS
  kPrecondition,  // FAILED_PRECONDITION
  kDenied,        // PERMISSION_DENIED: a worker that is not trusted
  kAborted,       // ABORTED: overtaken by a newer call
  kLimit,         // RESOURCE_EXHAUSTED
  kUnavailable,   // UNAVAILABLE
};

struct Refusal {
  Code code;
  std::string message;
};

template <typename T>
using Answer = std::variant<T, Refusal>;

}  // namespace fjord::server
