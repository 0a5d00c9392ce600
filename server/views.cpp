#include "server/views.h"

#include <algorithm>

namespace fjord::server {
namespace {

std::string ErrorOf(const Job& job, uint32_t index) {
  const Frame& frame = job.frames[index];
  if (frame.state == FrameState::kDone) return {};
  if (frame.state != FrameState::kFailed && frame.key == nullptr) return {};
  if (const auto own = job.unkeyed_errors.find(index); own != job.unkeyed_errors.end()) {
    return own->second;
  }
  if (frame.key == nullptr) return job.row.error;
  const Key& key = *frame.key;
  if (!key.row.error.empty()) return key.row.error;
  const auto workers = [&] {
    std::set<std::string> names;
    for (const ResultRow& result : key.evidence) names.insert(result.worker);
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
    return text;
  };
  if (key.verdict.standing == Standing::kNoMajority) {
    return "INTEGRITY: workers " + workers() + " made different pictures and no two agree";
  }
  if (key.verdict.standing == Standing::kDisputed) {
    return "workers " + workers() + " made different pictures; waiting for another worker's word";
  }
  return {};
}

// Milliseconds until the job ends as things go; 0: unknown.
uint32_t Eta(const Machine& machine, const Job& job) {
  if (job.ended() || job.rendered == 0 || !machine.trouble().empty()) return 0;
  uint64_t usable = 0;
  for (const auto& [id, session] : machine.roster().sessions()) {
    usable += machine.roster().FindWorker(session.worker)->usable();
  }
  const uint64_t left = job.counts.waiting + job.counts.running;
  const uint64_t eta = left * job.render_ms / job.rendered / std::max<uint64_t>(usable, 1);
  return static_cast<uint32_t>(std::clamp<uint64_t>(eta, 1, UINT32_MAX));
}

}  // namespace

v1::Job ViewJob(const Machine& machine, const Job& job) {
  v1::Job view;
  view.set_id(std::to_string(job.row.id));
  view.set_name(job.row.spec.name);
  view.set_project(job.row.spec.project);
  view.set_state(static_cast<v1::JobState>(job.state()));
  view.set_priority(job.row.spec.priority);
  v1::FrameCounts& counts = *view.mutable_frames();
  counts.set_total(job.counts.total);
  counts.set_waiting(job.counts.waiting);
  counts.set_running(job.counts.running);
  counts.set_done(job.counts.done);
  counts.set_cached(job.counts.cached);
  counts.set_failed(job.counts.failed);
  view.set_scene_digest(job.row.spec.scene.Hex());
  view.set_first_frame(job.row.spec.frames.first());
  view.set_last_frame(job.row.spec.frames.last());
  for (const FrameSpan& span : job.row.spec.frames.spans()) {
    v1::FrameSpan& out = *view.add_span();
    out.set_first(span.first);
    out.set_last(span.last);
    out.set_step(span.step);
  }
  if (job.row.spec.after != 0) view.set_after_job(std::to_string(job.row.spec.after));
  view.set_frame_limit_ms(job.row.spec.frame_limit_ms);
  view.set_submitted_unix_ms(job.row.submitted_unix_ms);
  view.set_ended_unix_ms(job.row.ended_unix_ms);
  view.set_render_ms(job.render_ms);
  view.set_eta_ms(Eta(machine, job));
  if (!job.ended()) view.set_trouble(machine.trouble());
  if (!job.row.error.empty()) {
    view.set_error(job.row.error);
  } else if (!job.failed.empty()) {
    const uint32_t index = *job.failed.begin();
    view.set_error("frame " + std::to_string(job.FrameNumber(index)) + ": " + ErrorOf(job, index));
  }
  return view;
}

v1::Frame ViewFrame(const Machine& machine, const Job& job, uint32_t index) {
  const Frame& frame = job.frames[index];
  v1::Frame view;
  view.set_number(job.FrameNumber(index));
  view.set_state(static_cast<v1::FrameState>(frame.state));
  view.set_cached(frame.cached && frame.state == FrameState::kDone);
  view.set_error(ErrorOf(job, index));
  if (frame.key == nullptr) return view;
  const Key& key = *frame.key;
  view.set_key(key.digest.Hex());
  view.set_attempts(key.row.failures);
  view.set_lost_workers(key.row.lost);
  if (const ResultRow* result = key.result(); result != nullptr) {
    view.set_pixel_digest(result->pixel.Hex());
    view.set_blob_digest(result->blob.Hex());
    view.set_triangles(result->triangles);
    view.set_render_ms(result->render_ms);
    view.set_worker(result->worker);
  } else if (!key.live.empty()) {
    const Session* session =
        machine.roster().FindSession(machine.leases().Find(key.live.front())->session);
    if (session != nullptr) view.set_worker(session->worker);
  }
  return view;
}

v1::WorkerInfo ViewWorker(const Machine& machine, const Worker& worker) {
  v1::WorkerInfo view;
  view.set_id(worker.row.id);
  view.set_host(worker.host);
  view.set_version(worker.version);
  view.set_threads(worker.threads);
  for (const std::string& tag : worker.tags) view.add_tag(tag);
  view.set_state(worker.row.quarantined ? v1::WorkerInfo::QUARANTINED
                 : !worker.alive()      ? v1::WorkerInfo::GONE
                 : worker.row.draining  ? v1::WorkerInfo::DRAINING
                                        : v1::WorkerInfo::ALIVE);
  view.set_frames_done(worker.frames_done);
  view.set_render_ms(worker.render_ms);
  if (!worker.alive()) return view;
  for (const AttemptId id : machine.leases().HeldBy(worker.session)) {
    const Attempt& attempt = *machine.leases().Find(id);
    const Key* key = machine.FindKey(attempt.key);
    v1::Holding& holding = *view.add_holding();
    holding.set_frame(attempt.frame);
    for (const FrameRef ref : key->wanters) {
      if (machine.FindJob(ref.job)->ended()) continue;
      holding.set_job_id(std::to_string(ref.job));
      break;
    }
  }
  return view;
}

}  // namespace fjord::server
