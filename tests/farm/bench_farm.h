// A farm on a table: the state machine, a planner that answers at once, a clock that is turned by
// hand, workers as names. What the machine writes is kept as a journal would, so that it can be
// restarted from it.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "server/state/machine.h"

namespace fjord::server {

// The journal's rules in memory: rows replace rows of the same identity.
struct Rows {
  std::map<JobId, JobRow> jobs;
  std::map<std::pair<JobId, uint32_t>, FrameRow> frames;
  std::map<std::tuple<Digest, AttemptId, std::string, Digest>, ResultRow> results;
  std::map<Digest, KeyRow> keys;
  std::map<std::string, WorkerRow> workers;
  JobId last_job = 0;

  void Take(const Record& record) {
    struct Visitor {
      Rows& rows;
      void operator()(const JobRow& row) { rows.jobs[row.id] = row; }
      void operator()(const FrameRow& row) { rows.frames[{row.job, row.frame}] = row; }
      void operator()(const ResultRow& row) {
        rows.results[{row.key, row.attempt, row.worker, row.pixel}] = row;
      }
      void operator()(const DropResult& row) {
        rows.results.erase({row.key, row.attempt, row.worker, row.pixel});
      }
      void operator()(const KeyRow& row) { rows.keys[row.key] = row; }
      void operator()(const WorkerRow& row) { rows.workers[row.id] = row; }
      void operator()(const DropJob& row) {
        rows.jobs.erase(row.id);
        std::erase_if(rows.frames, [&](const auto& entry) { return entry.first.first == row.id; });
        rows.last_job = std::max(rows.last_job, row.id);
      }
    };
    std::visit(Visitor{*this}, record);
  }

  Snapshot Load(uint64_t epoch) const {
    Snapshot snapshot;
    snapshot.epoch = epoch;
    snapshot.last_job = last_job;
    for (const auto& [id, row] : jobs) snapshot.jobs.push_back(row);
    for (const auto& [id, row] : frames) snapshot.frames.push_back(row);
    for (const auto& [id, row] : results) snapshot.results.push_back(row);
    for (const auto& [id, row] : keys) snapshot.keys.push_back(row);
    for (const auto& [id, row] : workers) snapshot.workers.push_back(row);
    return snapshot;
  }
};

inline Digest Name(const std::string& text) { return Sha256Of(text); }

// The key of a frame of a scene, in all these tests.
inline Digest KeyOf(const std::string& scene, uint32_t frame) {
  return Name(scene + " " + std::to_string(frame));
}

class BenchFarm {
 public:
  explicit BenchFarm(MachineConfig config = {}) : config_(config) { Restart(); }

  // As after kill -9: what the machine knew beyond its records is gone.
  void Restart() {
    machine_.reset();
    answers_.clear();
    plans_.clear();
    machine_.emplace(config_, rows_.Load(++epoch_), now());
    Pump();
  }

  Machine& machine() { return *machine_; }
  Now now() const { return {clock_ms_, 1'000'000 + clock_ms_}; }
  void Pass(int64_t ms) {
    clock_ms_ += ms;
    machine_->Tick(now());
    Pump();
  }

  JobId Submit(const std::string& scene, uint32_t frames, JobSpec spec = {}) {
    scenes_[Name(scene)] = scene;
    spec.request_id = spec.request_id.empty() ? "r" + std::to_string(++requests_) : spec.request_id;
    spec.content = spec.content.empty() ? spec.request_id : spec.content;
    spec.scene = Name(scene);
    if (spec.frames.empty()) spec.frames = FrameSet(1, frames);
    const auto answer = machine_->Submit(spec, now());
    Pump();
    return std::holds_alternative<Machine::Submitted>(answer)
               ? std::get<Machine::Submitted>(answer).id
               : 0;
  }

  // A worker and its one session share a name; `process` tells restarts apart. The one before is
  // known to be over.
  std::vector<AttemptId> Join(const std::string& worker, std::vector<Holding> holdings = {},
                              const std::string& process = "") {
    JoinCall call;
    call.worker = worker;
    call.session = worker + process;
    call.holdings = std::move(holdings);
    const Worker* known = machine_->roster().FindWorker(worker);
    if (known != nullptr && known->alive()) call.ended = {known->session};
    return std::get<std::vector<AttemptId>>(Join(call));
  }
  Answer<std::vector<AttemptId>> Join(const JoinCall& call) {
    const auto answer = machine_->Join(call, now());
    Pump();
    return answer;
  }

  // One grant, or none at once.
  std::optional<Grant> Acquire(const std::string& session) {
    const AcquireAnswer answer = Ask(session, ++sequence_[session]);
    return answer.grants.empty() ? std::nullopt : std::optional<Grant>(answer.grants[0]);
  }
  AcquireAnswer Ask(const std::string& session, uint64_t request, int64_t wait_ms = 0) {
    machine_->Acquire(session, request, 1, wait_ms, now());
    Pump();
    return TakeAnswer(session);
  }
  AcquireAnswer TakeAnswer(const std::string& session) {
    const auto place = answers_.find(session);
    if (place == answers_.end()) return {};
    AcquireAnswer answer = place->second;
    answers_.erase(place);
    return answer;
  }

  static Delivery Picture(const Grant& grant, const std::string& picture) {
    Delivery delivery;
    delivery.attempt = grant.attempt;
    delivery.scene = grant.scene;
    delivery.frame = grant.frame;
    delivery.key = grant.key;
    delivery.pixel = Name(picture);
    delivery.blob = Name("blob of " + picture);
    delivery.render_ms = 100;
    delivery.blob_present = true;
    return delivery;
  }
  Answer<Outcome> Deliver(const std::string& session, const Delivery& delivery) {
    const auto answer = machine_->Complete(session, delivery, now());
    Pump();
    return answer;
  }
  // The right picture of the grant's frame.
  Outcome Complete(const std::string& session, const Grant& grant) {
    return Complete(session, grant, "picture of " + grant.key.Hex());
  }
  Outcome Complete(const std::string& session, const Grant& grant, const std::string& picture) {
    return std::get<Outcome>(Deliver(session, Picture(grant, picture)));
  }
  bool Fail(const std::string& session, const Grant& grant, bool final = false) {
    const auto answer = machine_->Fail(session, grant.attempt, "it broke", final, now());
    Pump();
    const bool* accepted = std::get_if<bool>(&answer);
    return accepted != nullptr && *accepted;
  }
  bool Renew(const std::string& session, const Grant& grant, uint64_t count = 0) {
    const auto answer = machine_->Renew(session, {{grant.attempt, count}}, now());
    Pump();
    const auto* renewed = std::get_if<Machine::Renewed>(&answer);
    return renewed != nullptr && renewed->go_on[0];
  }
  // False: refused.
  bool Command(JobId job, JobCommand command, int32_t priority = 0) {
    const auto answer = machine_->Command(job, command, priority, now());
    Pump();
    return std::holds_alternative<JobId>(answer);
  }

  void LoseBlob(const Digest& blob) {
    machine_->BlobsLost({blob}, now());
    Pump();
  }

  static Holding HoldingOf(const Grant& grant) {
    return {grant.attempt, grant.scene, grant.frame, grant.key};
  }

  Counts CountsOf(JobId job) const { return machine_->FindJob(job)->counts; }
  JobState StateOf(JobId job) const { return machine_->FindJob(job)->state(); }
  FrameState FrameOf(JobId job, uint32_t frame) const {
    const Job* found = machine_->FindJob(job);
    return found->frames[*found->IndexOf(frame)].state;
  }
  const Key& KeyAt(const Digest& digest) const { return *machine_->FindKey(digest); }
  const Rows& rows() const { return rows_; }
  const std::vector<Notice>& notices() const { return notices_; }

  void Planning(bool on) { planning_ = on; }
  // The planner answers what it was asked.
  void Plan() {
    for (const PlanRequest& request : std::exchange(plans_, {})) {
      const auto scene = scenes_.find(request.scene);
      if (scene == scenes_.end() || scene->second == "broken") {
        machine_->SceneUnusable(request.job, "this scene is broken", now());
        continue;
      }
      for (const uint32_t frame : request.frames) {
        if (scene->second == "gappy" && frame == 2) {
          machine_->FrameUnplannable(request.job, frame, "no such frame", now());
        } else {
          machine_->Planned(request.job, frame, KeyOf(scene->second, frame), now());
        }
      }
    }
  }

  void Pump() {
    for (bool more = true; more;) {
      Effects effects = machine_->TakeEffects();
      for (const Record& record : effects.records) rows_.Take(record);
      for (AcquireAnswer& answer : effects.answers) answers_[answer.session] = std::move(answer);
      for (Notice& notice : effects.notices) notices_.push_back(std::move(notice));
      for (PlanRequest& plan : effects.plans) plans_.push_back(std::move(plan));
      more = planning_ && !plans_.empty();
      if (more) Plan();
    }
    const std::vector<std::string> broken = machine_->Audit();
    EXPECT_EQ(broken, std::vector<std::string>{});
  }

 private:
  const MachineConfig config_;
  std::optional<Machine> machine_;
  Rows rows_;
  uint64_t epoch_ = 0;
  int64_t clock_ms_ = 1'000;
  int requests_ = 0;
  bool planning_ = true;
  std::map<Digest, std::string> scenes_;
  std::map<std::string, uint64_t> sequence_;
  std::map<std::string, AcquireAnswer> answers_;
  std::vector<PlanRequest> plans_;
  std::vector<Notice> notices_;
};

}  // namespace fjord::server
