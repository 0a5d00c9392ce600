// The coordinator's one state machine: jobs, frames, keys, workers, sessions, attempts (F1-F7).
// Pure and single-threaded: no I/O and no clock; time comes in, records, answers and requests come
// out as Effects. Whoever runs it must let an answer leave only after the records before it are on
// disk.
//
// M1 waiting + running + done + failed = total in every job; cached is a part of done.
// M2 A frame's state is that of its key: done when the key is settled, failed when the key failed,
//    running while an attempt lives, else waiting. Only SetFrame assigns it.
// M3 A settled key has no live attempt and is never granted again (F6).
// M4 A key has at most as many live attempts as deliveries it still needs.
// M5 A position is in `ready` exactly when its key needs an attempt and its job is not ended.
// M6 An attempt marked alone is the only one its session holds.
// M7 What is settled rests on evidence of workers that are not quarantined.
#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "server/state/lease_table.h"
#include "server/state/roster.h"
#include "server/state/tables.h"

namespace fjord::server {

struct MachineConfig {
  int64_t term_ms = 10'000;
  int64_t renew_ms = 3'000;
  int64_t stall_ms = 120'000;  // a progress count that stands still ends the attempt
  uint32_t retry_limit = 3;    // own failures until a frame fails
  uint32_t suspect_after = 3;  // workers lost until a frame runs alone
  uint32_t plan_window = 64;   // frames planned ahead in each job
  size_t max_jobs = 100'000;
  uint64_t max_open_frames = 4'000'000;
  size_t max_workers = 10'000;
  size_t max_held = 16;            // leases of one session
  int64_t forget_ms = 86'400'000;  // a worker that is gone for so long is listed no more
};

struct PlanRequest {
  JobId job = 0;
  Digest scene;
  std::vector<uint32_t> frames;
};

struct AcquireAnswer {
  std::string session;
  uint64_t request = 0;
  std::vector<Grant> grants;
  bool drain = false;
  std::optional<Refusal> refusal;
};

struct Notice {
  bool alarm = false;
  std::string text;
};

// What is to be done outside, in order.
struct Effects {
  std::vector<Record> records;
  std::vector<PlanRequest> plans;
  std::vector<AcquireAnswer> answers;
  std::map<JobId, std::set<uint32_t>> changed;  // job -> indexes of frames that changed
  std::vector<Notice> notices;
};

enum class JobCommand : uint8_t { kCancel = 1, kPause, kResume, kRetry, kPriority, kDelete };
enum class WorkerCommand : uint8_t { kDrain = 1, kQuarantine, kRelease };
enum class Outcome : uint8_t { kCommitted = 1, kDuplicate, kConflict, kUnknownUnit, kMissingBlob };

struct Holding {
  AttemptId attempt;
  Digest scene;
  uint32_t frame = 0;
  Digest key;
};

struct JoinCall {
  std::string worker, session, host, version;
  uint32_t threads = 1;
  std::vector<std::string> tags;
  std::vector<Holding> holdings;
  std::vector<std::string> ended;  // sessions of this worker that are known to be over
  int64_t waited_ms = 0;           // since this process first asked
};

struct Delivery {
  AttemptId attempt;
  Digest scene;
  uint32_t frame = 0;
  Digest key, pixel, blob;
  uint64_t triangles = 0;
  uint32_t render_ms = 0;
  bool blob_present = false;
  uint64_t blob_bytes = 0;
};

// The state a frame has by its key (M2), and whether its job could use another attempt at it (M5).
FrameState StateFor(const Job& job, const Key& key);
bool NeedsAttempt(const Job& job, const Key& key);

inline constexpr size_t kEnoughEvidence = 3;  // agreeing deliveries beyond these are not noted

class Machine {
 public:
  Machine(const MachineConfig& config, Snapshot snapshot, Now now);
  Machine(const Machine&) = delete;
  Machine& operator=(const Machine&) = delete;

  // --- clients ---
  struct Submitted {
    JobId id = 0;
    bool existed = false;
  };
  Answer<Submitted> Submit(JobSpec spec, Now now);
  Answer<JobId> Command(JobId id, JobCommand command, int32_t priority, Now now);
  Answer<std::string> CommandWorker(const std::string& id, WorkerCommand command, Now now);

  // --- the planner ---
  void Planned(JobId job, uint32_t frame, const Digest& key, Now now);
  void FrameUnplannable(JobId job, uint32_t frame, std::string error, Now now);
  void SceneUnusable(JobId job, std::string error, Now now);

  // --- the store ---
  // Pictures that are gone: their frames are made again, their keys are known no more (F2).
  void BlobsLost(const std::vector<Digest>& blobs, Now now);
  // What stands in everybody's way and people should know; empty: nothing any more.
  void Trouble(std::string trouble);

  // --- workers ---
  Answer<std::vector<AttemptId>> Join(const JoinCall& call, Now now);
  // Answered through Effects, now or later.
  void Acquire(const std::string& session, uint64_t request, uint32_t want, int64_t wait_ms,
               Now now);
  void AbandonAcquire(const std::string& session, uint64_t request);
  struct Progress {
    AttemptId attempt;
    uint64_t count = 0;
  };
  struct Renewed {
    std::vector<bool> go_on;  // one a progress
    bool drain = false;
  };
  Answer<Renewed> Renew(const std::string& session, const std::vector<Progress>& progress, Now now);
  Answer<Outcome> Complete(const std::string& session, const Delivery& delivery, Now now);
  Answer<bool> Fail(const std::string& session, AttemptId attempt, std::string error, bool final,
                    Now now);
  Answer<bool> Leave(const std::string& session, Now now);

  // --- time ---
  void Tick(Now now);
  // On the monotonic clock; none: nothing is due.
  std::optional<int64_t> NextWake() const;

  Effects TakeEffects();
  // The records alone, where something rests on them before the rest is looked at.
  std::vector<Record> TakeRecords() { return std::exchange(effects_.records, {}); }

  // --- reading ---
  const MachineConfig& config() const { return config_; }
  uint64_t epoch() const { return leases_.epoch(); }
  const std::map<JobId, Job>& jobs() const { return jobs_; }
  const Job* FindJob(JobId id) const;
  const Key* FindKey(const Digest& key) const;
  const std::string& trouble() const { return trouble_; }
  const Roster& roster() const { return roster_; }
  const LeaseTable& leases() const { return leases_; }
  // Frames and jobs looked at so far: what an event costs, whatever the machine's speed. For tests.
  uint64_t work() const { return work_; }
  // Broken invariants, in words; empty when all is well. Slow: for tests.
  std::vector<std::string> Audit() const;

 private:
  // recover.cpp
  void Recover(Snapshot snapshot, Now now);
  Job& AddJob(JobRow row);
  // jobs.cpp
  bool Runnable(const Job& job) const;
  std::optional<Refusal> RefuseFrames(uint32_t more) const;
  std::optional<Refusal> RefuseCommand(const Job& job, JobCommand command) const;
  const Job* FailedBefore(const Job& job) const;
  void FailJob(Job& job, std::string error, Now now);
  void Forget(Job& job, Now now);
  void AddWanter(Key& key, FrameRef ref);
  void PlanAhead(Job& job);
  void Retry(Job& job, Now now);
  void SettleKeysOf(const Job& job, Now now);
  Frame* TakePlan(JobId id, uint32_t number);
  void RequireProof(Key& key, const Job& job);
  Key& AddKey(const Digest& key, const Digest& scene, uint32_t frame);
  // settle.cpp: the one door through which states change
  void SetFrame(Job& job, uint32_t index, FrameState state);
  void Settle(Key& key, Now now);
  void SettleFrame(const Key& key, FrameRef ref);
  void SettleJobs(Now now);
  void OpenProject(const std::string& project);
  void Finish(Now now);  // after every event
  Attempt EndAttempt(AttemptId id);
  // twins.cpp
  std::optional<Refusal> RefuseTwin(const JoinCall& call, Now now);
  // leases.cpp
  enum class Loss : uint8_t { kGivenBack, kWorkerLost };
  void CloseSession(const std::string& session, const std::vector<Holding>& kept, Loss loss,
                    Now now);
  void LoseWorker(Key& key, const Attempt& attempt, Now now);
  void CountFailure(Key& key, const std::string& worker, const std::string& error, bool final);
  // evidence.cpp
  void AddEvidence(Key& key, ResultRow row);
  template <typename Predicate>
  void DropEvidence(Key& key, Predicate drops);
  void DropAllEvidence(Key& key);
  void DropEvidenceOf(Key& key, const std::string& worker);
  void IndexEvidence(const Key& key, const ResultRow& row);
  // results.cpp
  bool SceneWants(const Digest& scene, uint32_t frame) const;
  bool Wanted(const Key& key) const;
  Key* KeyFor(const Digest& key, const Digest& scene, uint32_t frame);
  const FrameRef* Payer(const Key& key) const;
  void Charge(const Key& key, Worker& worker, uint32_t render_ms);
  void AlarmOver(const Key& key);
  void Quarantine(Worker& worker, const std::string& why, Now now);
  void RejectLiars(Key& key, Now now);
  // schedule.cpp
  void Dispatch(Now now);
  std::vector<Job*> Candidates();
  bool Eligible(const Key& key, const Worker& worker, Now now) const;
  std::optional<Grant> GrantOne(const Session& session, Now now);
  uint32_t LimitOf(const Key& key) const;
  void AnswerParked(Session& session, std::vector<Grant> grants, bool drain);

  void Write(Record record) { effects_.records.push_back(std::move(record)); }
  void Say(bool alarm, std::string text) { effects_.notices.push_back({alarm, std::move(text)}); }

  const MachineConfig config_;
  LeaseTable leases_;
  Roster roster_;
  std::map<JobId, Job> jobs_;
  std::map<std::string, JobId> by_request_;
  std::map<Digest, Key> keys_;
  std::map<std::string, std::set<Digest>> evidence_of_;  // worker -> keys
  std::map<Digest, std::set<Digest>> keys_of_blob_;      // blob -> keys with evidence of it
  std::map<JobId, std::set<JobId>> followers_;           // job -> those submitted to run after it
  std::set<JobId> open_;                                 // not ended
  std::set<JobId> touched_;                              // since the last Finish
  std::map<std::string, double> project_ms_;             // render time charged (F7)
  std::map<std::string, uint32_t> open_of_project_;
  uint64_t open_frames_ = 0;
  int64_t held_until_ms_ = 0;  // recovered frames wait until then
  JobId last_job_ = 0;         // the highest id given
  int64_t look_for_gone_ms_ = 0;
  uint64_t arrivals_ = 0;
  uint64_t work_ = 0;
  bool dispatch_ = false;  // something happened that may let a parked call have work
  std::string trouble_;
  Effects effects_;
};

}  // namespace fjord::server
