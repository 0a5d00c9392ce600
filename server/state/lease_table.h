// The table of live leases, as plain verbs. Soft state: nothing here is journalled; a restarted
// coordinator starts empty and adopts what workers announce. Time is passed in; single-threaded.
//
// L1 An attempt id is granted at most once: the epoch is this start's, the sequence only grows.
// L2 A live attempt belongs to exactly one session and stands in that session's list once, in the
//    order it was granted.
// L3 A live attempt is due once: at its deadline (last renewal + term), or earlier when its
// progress
//    count, once begun, has stood still for the stall time.
// L4 Ended is ended: no renewal brings an attempt back.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "server/state/types.h"

namespace fjord::server {

struct Attempt {
  AttemptId id;
  std::string session;
  Digest key;
  Digest scene;
  uint32_t frame = 0;
  bool alone = false;  // suspect: in a child process, with nothing beside it
  int64_t deadline_ms = 0;
  uint64_t count = 0;       // progress; 0: not begun
  int64_t progress_ms = 0;  // when count last grew
};

class LeaseTable {
 public:
  LeaseTable(uint64_t epoch, int64_t term_ms, int64_t stall_ms)
      : epoch_(epoch), term_ms_(term_ms), stall_ms_(stall_ms) {}

  uint64_t epoch() const { return epoch_; }
  size_t size() const { return attempts_.size(); }

  // `unit` has key, scene, frame and alone filled in; the rest is set here.
  const Attempt& Grant(const std::string& session, Attempt unit, int64_t now_ms);
  // Brings an attempt of an earlier epoch back under its old id, or gives a live one to another
  // session of its worker.
  const Attempt& Adopt(const std::string& session, Attempt attempt, int64_t now_ms);
  // False: not live, or not this session's.
  bool Renew(AttemptId id, const std::string& session, uint64_t count, int64_t now_ms);
  // Null: not live.
  const Attempt* Find(AttemptId id) const;
  // Ends it; it must be live.
  Attempt End(AttemptId id);

  // In the order of their grants.
  std::vector<AttemptId> HeldBy(const std::string& session) const;
  size_t CountHeldBy(const std::string& session) const;

  struct Due {
    AttemptId id;
    bool stalled;  // else past its deadline
  };
  std::vector<Due> DueBy(int64_t now_ms) const;
  std::optional<int64_t> NextDue() const;

  // Broken invariants, in words; empty when all is well.
  std::vector<std::string> Audit() const;

 private:
  int64_t DueTime(const Attempt& attempt) const;
  const Attempt& Insert(Attempt attempt, int64_t now_ms);

  const uint64_t epoch_;
  const int64_t term_ms_;
  const int64_t stall_ms_;
  uint64_t next_sequence_ = 1;
  std::map<AttemptId, Attempt> attempts_;
  std::map<std::string, std::vector<AttemptId>> held_;
  std::set<std::pair<int64_t, AttemptId>> due_;
};

}  // namespace fjord::server
