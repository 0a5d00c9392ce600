// The one door through which the states of keys, frames and jobs change.
#include <algorithm>

#include "engine/base/check.h"
#include "server/state/machine.h"

namespace fjord::server {
namespace {

uint32_t& Counter(Counts& counts, FrameState state) {
  switch (state) {
    case FrameState::kWaiting:
      return counts.waiting;
    case FrameState::kRunning:
      return counts.running;
    case FrameState::kDone:
      return counts.done;
    case FrameState::kFailed:
      break;
  }
  return counts.failed;
}

}  // namespace

JobState Job::state() const {
  if (row.cancelled) return JobState::kCancelled;
  if (!row.error.empty()) return JobState::kFailed;
  if (counts.done == counts.total) return JobState::kDone;
  if (counts.done + counts.failed == counts.total) return JobState::kFailed;
  if (row.paused) return JobState::kPaused;
  return counts.waiting == counts.total ? JobState::kQueued : JobState::kRunning;
}

FrameState StateFor(const Job& job, const Key& key) {
  if (key.done()) return FrameState::kDone;
  if (key.failed() || !job.row.error.empty()) return FrameState::kFailed;
  if (job.row.cancelled || key.live.empty()) return FrameState::kWaiting;
  return FrameState::kRunning;
}

bool NeedsAttempt(const Job& job, const Key& key) {
  return key.live.size() < key.slots() && !job.row.cancelled && job.row.error.empty();
}

void Machine::SetFrame(Job& job, uint32_t index, FrameState state) {
  Frame& frame = job.frames[index];
  if (frame.state == state) return;
  --Counter(job.counts, frame.state);
  ++Counter(job.counts, state);
  if (state == FrameState::kDone && frame.cached) ++job.counts.cached;
  if (frame.state == FrameState::kDone && frame.cached) {
    // What is made again was not served from the store after all.
    --job.counts.cached;
    frame.cached = false;
    Write(FrameRow{job.row.id, job.FrameNumber(index), frame.key->digest, false, {}});
  }
  if (state == FrameState::kFailed) {
    job.failed.emplace_hint(job.failed.end(), index);  // mostly in rising order
  } else {
    job.failed.erase(index);
  }
  frame.state = state;
  touched_.insert(job.row.id);
  std::set<uint32_t>& changed = effects_.changed[job.row.id];
  changed.emplace_hint(changed.end(), index);
}

Attempt Machine::EndAttempt(AttemptId id) {
  Attempt attempt = leases_.End(id);
  std::erase(keys_.at(attempt.key).live, id);
  dispatch_ = true;
  return attempt;
}

void Machine::Settle(Key& key, Now) {
  key.verdict = Judge(key.evidence, key.required);
  if (!key.done()) {
    // Frames that were served from the store are made for their own jobs now, as a restart sees it.
    for (const FrameRef ref : key.wanters) {
      const Job& job = jobs_.at(ref.job);
      if (job.frames[ref.index].cached) RequireProof(key, job);
    }
    key.verdict = Judge(key.evidence, key.required);
  }
  const size_t sensible = Wanted(key) ? key.slots() : 0;
  while (key.live.size() > sensible) EndAttempt(key.live.back());
  for (const FrameRef ref : key.wanters) SettleFrame(key, ref);
}

void Machine::SettleFrame(const Key& key, FrameRef ref) {
  ++work_;
  Job& job = jobs_.at(ref.job);
  SetFrame(job, ref.index, StateFor(job, key));
  const uint32_t position = job.frames[ref.index].position;
  if (!NeedsAttempt(job, key)) {
    job.ready.erase(position);
  } else if (job.ready.insert(position).second) {
    dispatch_ = true;
  }
}

void Machine::SettleJobs(Now now) {
  while (!touched_.empty()) {
    Job& job = jobs_.at(*touched_.begin());
    touched_.erase(touched_.begin());
    ++work_;
    const JobId id = job.row.id;
    if (const Job* before = FailedBefore(job); before != nullptr && !job.ended()) {
      FailJob(job,
              "job " + std::to_string(before->row.id) +
                  (before->row.cancelled ? " was cancelled" : " failed") +
                  ", and this one was to run after it",
              now);
    }
    if (job.ended() != (job.row.ended_unix_ms != 0)) {
      job.row.ended_unix_ms = job.ended() ? std::max<int64_t>(now.unix_ms, 1) : 0;
      Write(job.row);
      effects_.changed[id];
      dispatch_ = true;
    }
    if (job.ended() && open_.erase(id) > 0) {
      open_frames_ -= job.counts.total;
      --open_of_project_[job.row.spec.project];
      // Jobs that wait for this one may be planned now, or end, too.
      if (const auto place = followers_.find(id); place != followers_.end()) {
        touched_.insert(place->second.begin(), place->second.end());
      }
    } else if (!job.ended() && open_.insert(id).second) {
      open_frames_ += job.counts.total;
      OpenProject(job.row.spec.project);
    }
    PlanAhead(job);
  }
}

void Machine::OpenProject(const std::string& project) {
  if (open_of_project_[project]++ > 0) return;
  // A project that comes back does not make up for the time it was away.
  std::optional<double> least;
  for (const auto& [other, count] : open_of_project_) {
    if (count > 0 && other != project) {
      least = std::min(least.value_or(project_ms_[other]), project_ms_[other]);
    }
  }
  if (least) project_ms_[project] = std::max(project_ms_[project], *least);
}

void Machine::Finish(Now now) {
  SettleJobs(now);
  if (dispatch_) Dispatch(now);
  // Granting touches jobs, too: frames begin to run.
  SettleJobs(now);
}

void Machine::Trouble(std::string trouble) {
  if (trouble == trouble_) return;
  Say(!trouble.empty(), trouble.empty() ? "over: " + trouble_ : trouble);
  trouble_ = std::move(trouble);
  for (const JobId id : open_) effects_.changed[id];
}

Effects Machine::TakeEffects() {
  Effects effects = std::move(effects_);
  effects_ = {};
  return effects;
}

const Job* Machine::FindJob(JobId id) const {
  const auto place = jobs_.find(id);
  return place == jobs_.end() ? nullptr : &place->second;
}

const Key* Machine::FindKey(const Digest& key) const {
  const auto place = keys_.find(key);
  return place == keys_.end() ? nullptr : &place->second;
}

}  // namespace fjord::server
