// What clients ask for, and what the planner answers.
#include <algorithm>
#include <utility>

#include "engine/base/check.h"
#include "server/state/machine.h"

namespace fjord::server {

Answer<Machine::Submitted> Machine::Submit(JobSpec spec, Now now) {
  FJORD_CHECK(!spec.frames.empty(), spec.request_id);
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
  const uint32_t total = spec.frames.size();
  if (std::optional<Refusal> full = RefuseFrames(total)) return *std::move(full);
  JobRow row;
  row.id = last_job_ + 1;
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

// None: so many frames more may wait.
std::optional<Refusal> Machine::RefuseFrames(uint32_t more) const {
  if (open_frames_ + more <= config_.max_open_frames) return std::nullopt;
  return Refusal{Code::kLimit, "with these " + std::to_string(more) + " frames more than " +
                                   std::to_string(config_.max_open_frames) +
                                   " would wait: try again when others have ended"};
}

// None: the job can take this command.
std::optional<Refusal> Machine::RefuseCommand(const Job& job, JobCommand command) const {
  const std::string name = "job " + std::to_string(job.row.id);
  switch (command) {
    case JobCommand::kCancel:
      if (!job.ended() || job.row.cancelled) return std::nullopt;
      break;
    case JobCommand::kDelete:
      if (job.ended()) return std::nullopt;
      return Refusal{Code::kPrecondition, name + " has not ended: cancel it first"};
    case JobCommand::kRetry:
      if (const Job* before = FailedBefore(job); before != nullptr) {
        return Refusal{Code::kPrecondition, name + " runs after job " +
                                                std::to_string(before->row.id) +
                                                ", which did not succeed: retry that one first"};
      }
      if (job.ended()) return RefuseFrames(job.counts.total);
      return std::nullopt;
    case JobCommand::kPause:
    case JobCommand::kResume:
    case JobCommand::kPriority:
      if (!job.ended()) return std::nullopt;
      break;
  }
  return Refusal{Code::kPrecondition, name + " has ended"};
}

Answer<JobId> Machine::Command(JobId id, JobCommand command, int32_t priority, Now now) {
  const auto place = jobs_.find(id);
  if (place == jobs_.end()) {
    return Refusal{Code::kNotFound, "there is no job " + std::to_string(id)};
  }
  Job& job = place->second;
  if (std::optional<Refusal> refusal = RefuseCommand(job, command)) return *std::move(refusal);
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
    case JobCommand::kDelete:
      Forget(job, now);
      Finish(now);
      return id;
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

// Its keys stay, with what is known of them: the next job that wants them is served from the store.
// What it alone asked of them goes.
void Machine::Forget(Job& job, Now now) {
  const JobId id = job.row.id;
  std::set<Key*> keys;
  for (const Frame& frame : job.frames) {
    if (frame.key != nullptr) keys.insert(frame.key);
  }
  for (Key* key : keys) {
    std::erase_if(key->wanters, [id](const FrameRef ref) { return ref.job == id; });
    key->required = 1;
    for (const FrameRef ref : key->wanters) {
      const Job& other = jobs_.at(ref.job);
      if (!other.frames[ref.index].cached) RequireProof(*key, other);
    }
    Settle(*key, now);
  }
  if (const auto followers = followers_.find(id); followers != followers_.end()) {
    for (const JobId follower : followers->second) {
      JobRow& row = jobs_.at(follower).row;
      row.spec.after = 0;
      Write(row);
    }
    followers_.erase(followers);
  }
  if (const auto before = followers_.find(job.row.spec.after); before != followers_.end()) {
    before->second.erase(id);
  }
  by_request_.erase(job.row.spec.request_id);
  touched_.erase(id);
  effects_.changed[id].clear();  // who watches it hears that it is gone
  Write(DropJob{id});
  jobs_.erase(id);
}

// The job before this one in the order of --after, where it has ended without success.
const Job* Machine::FailedBefore(const Job& job) const {
  if (job.row.spec.after == 0) return nullptr;
  const Job& before = jobs_.at(job.row.spec.after);
  return before.ended() && before.state() != JobState::kDone ? &before : nullptr;
}

void Machine::AddWanter(Key& key, FrameRef ref) {
  key.wanters.push_back(ref);
  key.newest = std::max(key.newest, ref.job);
}

void Machine::Retry(Job& job, Now now) {
  job.row.error.clear();
  if (std::exchange(job.row.cancelled, false)) SettleKeysOf(job, now);
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
  const std::optional<uint32_t> index = job.IndexOf(number);
  if (!index || !job.frames[*index].planning) return nullptr;
  Frame& frame = job.frames[*index];
  frame.planning = false;
  --job.planning;
  touched_.insert(id);
  return job.ended() || frame.key != nullptr ? nullptr : &frame;
}

void Machine::Planned(JobId id, uint32_t number, const Digest& digest, Now now) {
  if (Frame* frame = TakePlan(id, number); frame != nullptr) {
    Job& job = jobs_.at(id);
    const uint32_t index = *job.IndexOf(number);
    Key& key = AddKey(digest, job.row.spec.scene, number);
    if (key.row.failed && id > key.newest) {
      // A new job, which may allow more time, tries anew what failed for those before it.
      key.row = KeyRow{key.digest};
      key.failed_by.clear();
      Write(key.row);
      Settle(key, now);
    }
    frame->key = &key;
    frame->cached = key.done();
    AddWanter(key, {id, index});
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
    const uint32_t index = *job.IndexOf(number);
    Write(FrameRow{id, number, std::nullopt, false, error});
    job.unkeyed_errors[index] = std::move(error);
    SetFrame(job, index, FrameState::kFailed);
  }
  Finish(now);
}

void Machine::SceneUnusable(JobId id, std::string error, Now now) {
  const auto place = jobs_.find(id);
  if (place == jobs_.end() || place->second.ended()) return;
  FailJob(place->second, error.empty() ? "the scene cannot be used" : std::move(error), now);
  Finish(now);
}

// For a reason that is no frame's.
void Machine::FailJob(Job& job, std::string error, Now now) {
  job.row.error = std::move(error);
  for (uint32_t index = 0; index < job.frames.size(); ++index) {
    Frame& frame = job.frames[index];
    if (frame.planning) --job.planning;
    frame.planning = false;
    if (frame.key == nullptr) SetFrame(job, index, FrameState::kFailed);
  }
  SettleKeysOf(job, now);
  Write(job.row);
  touched_.insert(job.row.id);
}

}  // namespace fjord::server
