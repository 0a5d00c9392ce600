// Jobs, frames and keys as the state machine holds them (machine.h owns and changes them; views
// read).
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "server/state/judge.h"
#include "server/state/types.h"

namespace fjord::server {

struct FrameRef {
  JobId job = 0;
  uint32_t index = 0;  // frame number - first frame
};

// A picture to be made: what frames of any number of jobs wait for. Made once (F6).
struct Key {
  Digest digest;
  Digest scene;  // one way to reach it
  uint32_t frame = 0;
  KeyRow row;
  std::vector<ResultRow> evidence;
  uint32_t required = 1;  // deliveries until it is settled
  Verdict verdict;        // of the evidence
  std::vector<FrameRef> wanters;
  JobId newest = 0;  // of all jobs that ever wanted it
  std::vector<AttemptId> live;
  std::set<std::string> failed_by;
  int64_t hold_until_ms = 0;  // after a restart somebody may still be rendering it

  bool done() const { return verdict.standing == Standing::kDone; }
  bool failed() const {
    return !done() && (row.failed || verdict.standing == Standing::kNoMajority);
  }
  const ResultRow* result() const { return done() ? &evidence[verdict.winner] : nullptr; }
  // Attempts that make sense at one time.
  uint32_t slots() const {
    if (done() || failed()) return 0;
    return verdict.more;
  }
};

struct Frame {
  Key* key = nullptr;     // null: not planned yet
  uint32_t position = 0;  // in the coarse-to-fine order
  FrameState state = FrameState::kWaiting;
  bool cached = false;  // done without a render for this job
  bool planning = false;
};

struct Job {
  JobRow row;
  std::vector<uint32_t> order;                     // position -> index
  std::vector<Frame> frames;                       // by index
  std::map<uint32_t, std::string> unkeyed_errors;  // index -> why it has no key
  std::set<uint32_t> ready;                        // positions whose key could use an attempt
  std::set<uint32_t> failed;                       // indexes
  uint32_t next_plan = 0;                          // position
  uint32_t planning = 0;                           // asked for, not answered
  Counts counts;
  uint64_t render_ms = 0;
  uint32_t rendered = 0;   // results behind render_ms
  bool recovered = false;  // was there when this coordinator started

  uint32_t FrameNumber(uint32_t index) const { return row.spec.frames[index]; }
  // The job's own frames alone: none for others.
  std::optional<uint32_t> IndexOf(uint32_t number) const { return row.spec.frames.IndexOf(number); }
  bool ended() const {
    return row.cancelled || !row.error.empty() || counts.done + counts.failed == counts.total;
  }
  JobState state() const;
};

}  // namespace fjord::server
