// What clients ask for, and what the planner answers.
#include <algorithm>

#include "engine/base/check.h"
#include "server/state/machine.h"

namespace fjord::server {

Answer<Machine::Submitted> Machine::Submit(JobSpec spec, Now now) {
  FJORD_CHECK(spec.first >= 1 && spec.first <= spec.last, spec.first, spec.last);
  if (const auto place = by_request_.find(spec.request_id); place != by_request_.end()) {
    const Job& known = jobs_.at(place->second);
    if (known.row.spec.content == spec.content) return Submitted{known.row.id, true};
    return Refusal{Code::kExists, "request_id: \"" + spec.request_id + "\" is job " +
                                      std::to_string(known.row.id) +
                                      ", which asks for something else"};
  }
  if (spec.after != 0 && !jobs_.contains(spec.after)) {
    return Refusal{Code::kNotFound, "after_job: there is no job " + std::to_string(spec.after)};
  }
  if (jobs_.size() >= config_.max_jobs) {
    return Refusal{Code::kLimit, "the coordinator holds " + std::to_string(jobs_.size()) +
                                     " jobs and takes no more"};
  }
  const uint64_t total = uint64_t{spec.last} - spec.first + 1;
  if (open_frames_ + total > config_.max_open_frames) {
    return Refusal{Code::kLimit, "with these " + std::to_string(total) + " frames more than " +
                                     std::to_string(config_.max_open_frames) +
                                     " would wait: submit again when others have ended"};
  }
  JobRow row;
  row.id = jobs_.empty() ? 1 : jobs_.rbegin()->first + 1;
  row.spec = std::move(spec);
  row.submitted_unix_ms = now.unix_ms;
  Job& job = AddJob(row);
  Write(row);
  open_.insert(row.id);
  open_frames_ += total;
  OpenProject(job.row.spec.project);
  Finish(now);
  return Submitted{row.id, false};
}

Answer<JobId> Machine::Command(JobId id, JobCommand command, int32_t priority, Now now) {
  const auto place = jobs_.find(id);
  if (place == jobs_.end()) {
    return Refusal{Code::kNotFound, "there is no job " + std::to_string(id)};
  }
  Job& job = place->second;
  if (command == JobCommand::kCancel
          ? job.ended() && !job.row.cancelled
          : job.row.cancelled || (job.ended() && command != JobCommand::kRetry)) {
    return Refusal{Code::kPrecondition, "job " + std::to_string(id) + " has ended"};
  }
  switch (command) {
    case JobCommand::kCancel:
      job.row.cancelled = true;
      SettleKeysOf(job, now);
      break;
    case JobCommand::kPause:
    case JobCommand::kResume:
      job.row.paused = command == JobCommand::kPause;
      break;
    case JobCommand::kRetry:
      Retry(job, now);
      break;
    case JobCommand::kPriority:
      job.row.spec.priority = priority;
      break;
  }
  Write(job.row);
  effects_.changed[id];
  touched_.insert(id);
  dispatch_ = true;
  Finish(now);
  return id;
}

// Once each key, of which many frames may be. What is done or has failed stays as it is.
void Machine::SettleKeysOf(const Job& job, Now now) {
  std::set<Digest> settled;
  for (const Frame& frame : job.frames) {
    if (frame.key == nullptr || frame.key->done() || frame.key->failed()) continue;
    if (settled.insert(frame.key->digest).second) Settle(*frame.key, now);
  }
}

void Machine::Retry(Job& job, Now now) {
  job.row.error.clear();
  const std::set<uint32_t> failed = job.failed;
  for (const uint32_t index : failed) {
    Key* key = job.frames[index].key;
    if (job.frames[index].state != FrameState::kFailed) continue;  // by another frame of its key
    if (key == nullptr) {
      job.unkeyed_errors.erase(index);
      Write(FrameRow{job.row.id, job.FrameNumber(index), std::nullopt, false, {}});
      SetFrame(job, index, FrameState::kWaiting);
      continue;
    }
    key->row = KeyRow{key->digest};
    key->failed_by.clear();
    Write(key->row);
    if (key->verdict.standing == Standing::kNoMajority) {
      DropAllEvidence(*key);
    }
    Settle(*key, now);
  }
  job.next_plan = 0;
}

bool Machine::Runnable(const Job& job) const {
  if (job.ended() || job.row.paused) return false;
  return job.row.spec.after == 0 || jobs_.at(job.row.spec.after).state() == JobState::kDone;
}

void Machine::PlanAhead(Job& job) {
  if (!Runnable(job)) return;
  const size_t ahead = job.ready.size() + job.counts.running + job.planning;
  // In batches: asking frame by frame would cost a sync a frame.
  if (ahead > config_.plan_window - config_.plan_window / 4) return;
  PlanRequest request{job.row.id, job.row.spec.scene, {}};
  while (ahead + request.frames.size() < config_.plan_window && job.next_plan < job.order.size()) {
    const uint32_t index = job.order[job.next_plan++];
    Frame& frame = job.frames[index];
    if (frame.key != nullptr || frame.planning || job.unkeyed_errors.contains(index)) continue;
    frame.planning = true;
    ++job.planning;
    request.frames.push_back(job.FrameNumber(index));
  }
  if (!request.frames.empty()) effects_.plans.push_back(std::move(request));
}

Key& Machine::AddKey(const Digest& digest, const Digest& scene, uint32_t frame) {
  Key& key = keys_[digest];
  if (key.frame == 0) {  // known by its results alone, or new
    key.digest = digest;
    key.row.key = digest;
    key.scene = scene;
    key.frame = frame;
  }
  return key;
}

void Machine::RequireProof(Key& key, const Job& job) {
  // The choice is the key's own, so it is the same after a restart.
  uint64_t draw = 0;
  for (int i = 0; i < 6; ++i) draw = draw << 8 | key.digest.bytes[i];
  const double share = static_cast<double>(draw) / static_cast<double>(uint64_t{1} << 48);
  if (share < job.row.spec.verify_share) key.required = 2;
}

// The answer for one frame; null where it is wanted no more.
Frame* Machine::TakePlan(JobId id, uint32_t number) {
  const auto place = jobs_.find(id);
  if (place == jobs_.end()) return nullptr;
  Job& job = place->second;
  const uint32_t index = number - job.row.spec.first;
  if (index >= job.frames.size() || !job.frames[index].planning) return nullptr;
  Frame& frame = job.frames[index];
  frame.planning = false;
  --job.planning;
  touched_.insert(id);
  return job.ended() || frame.key != nullptr ? nullptr : &frame;
}

void Machine::Planned(JobId id, uint32_t number, const Digest& digest, Now now) {
  if (Frame* frame = TakePlan(id, number); frame != nullptr) {
    Job& job = jobs_.at(id);
    const uint32_t index = number - job.row.spec.first;
    Key& key = AddKey(digest, job.row.spec.scene, number);
    frame->key = &key;
    frame->cached = key.done();
    key.wanters.push_back({id, index});
    Write(FrameRow{id, number, digest, frame->cached, {}});
    const uint32_t required = key.required;
    if (!key.done()) RequireProof(key, job);
    if (job.recovered) key.hold_until_ms = held_until_ms_;
    if (key.wanters.size() == 1 || key.required != required) {
      Settle(key, now);
    } else {  // of the frames that want this key, the new one alone has something to learn
      SettleFrame(key, key.wanters.back());
    }
  }
  Finish(now);
}

void Machine::FrameUnplannable(JobId id, uint32_t number, std::string error, Now now) {
  if (TakePlan(id, number) != nullptr) {
    Job& job = jobs_.at(id);
    const uint32_t index = number - job.row.spec.first;
    Write(FrameRow{id, number, std::nullopt, false, error});
    job.unkeyed_errors[index] = std::move(error);
    SetFrame(job, index, FrameState::kFailed);
  }
  Finish(now);
}

void Machine::SceneUnusable(JobId id, std::string error, Now now) {
  const auto place = jobs_.find(id);
  if (place == jobs_.end() || place->second.ended()) return;
  Job& job = place->second;
  job.row.error = error.empty() ? "the scene cannot be used" : std::move(error);
  for (uint32_t index = 0; index < job.frames.size(); ++index) {
    Frame& frame = job.frames[index];
    if (frame.planning) --job.planning;
    frame.planning = false;
    if (frame.key == nullptr) SetFrame(job, index, FrameState::kFailed);
  }
  SettleKeysOf(job, now);
  Write(job.row);
  touched_.insert(id);
  Finish(now);
}

}  // namespace fjord::server
