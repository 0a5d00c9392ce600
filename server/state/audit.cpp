// Checks the invariants of machine.h over the whole state. For tests.
#include <algorithm>

#include "server/state/machine.h"

namespace fjord::server {

std::vector<std::string> Machine::Audit() const {
  std::vector<std::string> broken = leases_.Audit();
  for (std::string& text : roster_.Audit()) broken.push_back(std::move(text));
  const auto expect = [&](bool holds, const char* what, uint64_t where) {
    if (!holds) broken.push_back(std::string(what) + " at " + std::to_string(where));
  };
  for (const auto& [id, job] : jobs_) {
    Counts counts;
    counts.total = static_cast<uint32_t>(job.frames.size());
    for (uint32_t index = 0; index < job.frames.size(); ++index) {
      const Frame& frame = job.frames[index];
      counts.waiting += frame.state == FrameState::kWaiting;
      counts.running += frame.state == FrameState::kRunning;
      counts.done += frame.state == FrameState::kDone;
      counts.failed += frame.state == FrameState::kFailed;
      counts.cached += frame.state == FrameState::kDone && frame.cached;
      if (frame.key == nullptr) {
        const bool failed = !job.row.error.empty() || job.unkeyed_errors.contains(index);
        expect(frame.state == (failed ? FrameState::kFailed : FrameState::kWaiting),
               "M2: an unplanned frame", index);
        expect(!job.ready.contains(frame.position), "M5: an unplanned frame is ready", index);
        continue;
      }
      expect(frame.state == StateFor(job, *frame.key), "M2: frame and key disagree", index);
      expect(job.ready.contains(frame.position) == NeedsAttempt(job, *frame.key),
             "M5: ready and need disagree", index);
    }
    expect(counts == job.counts, "M1: counts are wrong in job", id);
    expect(counts.waiting + counts.running + counts.done + counts.failed == counts.total,
           "M1: counts do not add up in job", id);
    expect(open_.contains(id) == !job.ended(), "an ended job is open, or the other way, job", id);
    expect((job.row.ended_unix_ms != 0) == job.ended(), "the end of a job is not noted, job", id);
  }
  size_t live = 0;
  for (const auto& [digest, key] : keys_) {
    live += key.live.size();
    expect(!key.done() || key.live.empty(), "M3: a settled key is leased, frame", key.frame);
    expect(key.live.size() <= key.slots(), "M4: too many attempts, frame", key.frame);
    for (const AttemptId id : key.live) {
      const Attempt* attempt = leases_.Find(id);
      expect(attempt != nullptr && attempt->key == digest, "M4: a key lists a stranger's attempt",
             id.sequence);
    }
    for (const ResultRow& result : key.evidence) {
      const Worker* worker = roster_.FindWorker(result.worker);
      expect(worker == nullptr || !worker->row.quarantined, "M7: evidence of a liar, frame",
             key.frame);
    }
  }
  expect(live == leases_.size(), "M4: attempts without a key", live);
  for (const auto& [id, session] : roster_.sessions()) {
    const std::vector<AttemptId> held = leases_.HeldBy(id);
    const bool alone = std::any_of(held.begin(), held.end(),
                                   [&](AttemptId attempt) { return leases_.Find(attempt)->alone; });
    expect(!alone || held.size() == 1, "M6: something beside an attempt that runs alone",
           held.size());
  }
  return broken;
}

}  // namespace fjord::server
