// From the rows of the journal to the state they mean.
#include <algorithm>

#include "engine/base/check.h"
#include "server/state/machine.h"
#include "server/state/order.h"

namespace fjord::server {

Machine::Machine(const MachineConfig& config, Snapshot snapshot, Now now)
    : config_(config), leases_(snapshot.epoch, config.term_ms, config.stall_ms) {
  // The coordinator before may have granted what it could not write down.
  if (snapshot.epoch > 1) held_until_ms_ = now.mono_ms + config.term_ms;
  Recover(std::move(snapshot), now);
  Finish(now);
}

Job& Machine::AddJob(JobRow row) {
  const JobId id = row.id;
  last_job_ = std::max(last_job_, id);
  Job& job = jobs_[id];
  by_request_[row.spec.request_id] = id;
  job.row = std::move(row);
  const uint32_t total = job.row.spec.frames.size();
  job.order = CoarseToFine(total);
  job.frames.resize(total);
  for (uint32_t position = 0; position < total; ++position) {
    job.frames[job.order[position]].position = position;
  }
  job.counts.total = job.counts.waiting = total;
  if (job.row.spec.after != 0) followers_[job.row.spec.after].insert(id);
  touched_.insert(id);
  return job;
}

void Machine::Recover(Snapshot snapshot, Now now) {
  last_job_ = snapshot.last_job;
  for (WorkerRow& row : snapshot.workers) roster_.AddWorker(std::move(row));
  for (JobRow& row : snapshot.jobs) {
    Job& job = AddJob(std::move(row));
    job.recovered = true;
    if (job.row.ended_unix_ms == 0) {
      open_.insert(job.row.id);
      ++open_of_project_[job.row.spec.project];
      open_frames_ += job.counts.total;
    }
  }
  for (const FrameRow& row : snapshot.frames) {
    const auto place = jobs_.find(row.job);
    FJORD_CHECK(place != jobs_.end(), row.job, row.frame);
    Job& job = place->second;
    const std::optional<uint32_t> place_of_frame = job.IndexOf(row.frame);
    FJORD_CHECK(place_of_frame.has_value(), row.job, row.frame);
    const uint32_t index = *place_of_frame;
    if (row.key) {
      Key& key = AddKey(*row.key, job.row.spec.scene, row.frame);
      job.frames[index].key = &key;
      job.frames[index].cached = row.cached;
      AddWanter(key, {row.job, index});
      key.hold_until_ms = held_until_ms_;
    } else if (!row.error.empty()) {
      job.unkeyed_errors[index] = row.error;
    }
  }
  for (ResultRow& row : snapshot.results) {
    Key& key = AddKey(row.key, {}, 0);
    Worker& worker = roster_.AddWorker({row.worker});
    ++worker.frames_done;
    worker.render_ms += row.render_ms;
    IndexEvidence(key, row);
    key.evidence.push_back(std::move(row));
  }
  for (KeyRow& row : snapshot.keys) {
    Key& key = AddKey(row.key, {}, 0);
    key.row = std::move(row);
  }
  roster_.AllGoneSince(now.mono_ms);
  for (auto& [digest, key] : keys_) {
    key.verdict = Judge(key.evidence, 1);
    for (const FrameRef ref : key.wanters) {
      Job& job = jobs_.at(ref.job);
      Frame& frame = job.frames[ref.index];
      frame.cached = frame.cached && key.done();
      if (!frame.cached) RequireProof(key, job);
    }
    Settle(key, now);
    const FrameRef* payer = Payer(key);
    if (payer == nullptr) continue;
    Job& job = jobs_.at(payer->job);
    for (const ResultRow& result : key.evidence) {
      job.render_ms += result.render_ms;
      ++job.rendered;
    }
  }
  for (auto& [id, job] : jobs_) {
    for (uint32_t index = 0; index < job.frames.size(); ++index) {
      const bool unusable = !job.row.error.empty() && job.frames[index].key == nullptr;
      if (unusable || job.unkeyed_errors.contains(index)) SetFrame(job, index, FrameState::kFailed);
    }
  }
  effects_.changed.clear();
}

}  // namespace fjord::server
