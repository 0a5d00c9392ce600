// Sessions come and go, leases are kept alive, fail and run out (F3, F5).
#include <algorithm>

#include "engine/base/check.h"
#include "server/state/machine.h"

namespace fjord::server {
namespace {

constexpr int64_t kLookForGoneEveryMs = 60'000;

Refusal NoSession() { return {Code::kNotFound, "session_id: no such session; join again"}; }

}  // namespace

Answer<std::vector<AttemptId>> Machine::Join(const JoinCall& call, Now now) {
  const auto too_many = [&] { return roster_.workers().size() >= config_.max_workers; };
  const bool stranger = roster_.FindWorker(call.worker) == nullptr;
  if (stranger && too_many()) roster_.ForgetGone(now.mono_ms);
  if (stranger && too_many()) {
    return Refusal{Code::kLimit, "the coordinator knows " + std::to_string(config_.max_workers) +
                                     " workers and takes no more"};
  }
  const Session* known = roster_.FindSession(call.session);
  if (known != nullptr && known->worker != call.worker) {
    return Refusal{Code::kInvalid, "session_id: belongs to worker \"" + known->worker + "\""};
  }
  if (std::optional<Refusal> twin = RefuseTwin(call, now)) return *std::move(twin);
  const bool known_before = known != nullptr;
  const Session before = known_before ? *known : Session{};
  Worker& worker = roster_.AddWorker({call.worker});

  // What an older process of this worker held and nobody names was lost with it.
  std::vector<Attempt> kept;
  if (worker.alive()) {
    const bool same_process = worker.session == call.session;
    CloseSession(worker.session, call.holdings, same_process ? Loss::kGivenBack : Loss::kWorkerLost,
                 now);
    for (const AttemptId id : leases_.HeldBy(worker.session)) kept.push_back(*leases_.Find(id));
    roster_.Close(worker.session, now.mono_ms);
  }
  worker.host = call.host;
  worker.version = call.version;
  worker.threads = call.threads;
  worker.tags = call.tags;
  Session& session = roster_.Open(worker, call.session, now.mono_ms);
  session.last_request = before.last_request;
  session.last_grants = before.last_grants;
  if (known_before) session.joined_ms = before.joined_ms;

  std::vector<AttemptId> adopted;
  for (Attempt& attempt : kept)
    adopted.push_back(leases_.Adopt(session.id, attempt, now.mono_ms).id);
  for (const Holding& holding : call.holdings) {
    if (worker.row.quarantined || holding.attempt.epoch >= leases_.epoch() ||
        leases_.Find(holding.attempt) != nullptr ||
        leases_.CountHeldBy(session.id) >= config_.max_held) {
      continue;
    }
    Key* key = KeyFor(holding.key, holding.scene, holding.frame);
    if (key == nullptr || !Wanted(*key) || key->live.size() >= key->slots()) continue;
    Attempt attempt{holding.attempt, {}, holding.key, holding.scene, holding.frame};
    leases_.Adopt(session.id, std::move(attempt), now.mono_ms);
    key->live.push_back(holding.attempt);
    Settle(*key, now);
    adopted.push_back(holding.attempt);
  }
  dispatch_ = true;
  Finish(now);
  return adopted;
}

// Frees what the session holds but for `kept`. The caller takes the session out of the roster.
void Machine::CloseSession(const std::string& id, const std::vector<Holding>& kept, Loss loss,
                           Now now) {
  bool first = true;
  for (const AttemptId attempt_id : leases_.HeldBy(id)) {
    const bool rendering = std::exchange(first, false);
    const bool stays = std::any_of(kept.begin(), kept.end(), [&](const Holding& holding) {
      return holding.attempt == attempt_id;
    });
    if (stays) continue;
    const Attempt attempt = EndAttempt(attempt_id);
    Key& key = keys_.at(attempt.key);
    // Of several leases a worker renders the oldest; the others were only prefetched.
    if (loss == Loss::kWorkerLost && (rendering || attempt.count > 0))
      LoseWorker(key, attempt, now);
    Settle(key, now);
  }
  Session& session = *roster_.FindSession(id);
  if (session.parked) {
    effects_.answers.push_back({id, session.parked->request, {}, false, NoSession()});
    session.parked.reset();
  }
}

void Machine::LoseWorker(Key& key, const Attempt& attempt, Now) {
  const Session* session = roster_.FindSession(attempt.session);
  const std::string worker = session == nullptr ? "" : session->worker;
  ++key.row.lost;
  if (attempt.alone) {
    key.row.failed = true;
    key.row.error = std::to_string(key.row.lost) +
                    " workers were lost while they rendered this frame, the last one (" + worker +
                    ") with nothing beside it";
  } else if (key.row.lost == config_.suspect_after) {
    Say(false, "frame " + std::to_string(key.frame) +
                   " is suspect: " + std::to_string(key.row.lost) +
                   " workers were lost while they rendered it; it will run alone");
  }
  Write(key.row);
}

void Machine::CountFailure(Key& key, const std::string& worker, const std::string& error,
                           bool final) {
  ++key.row.failures;
  key.failed_by.insert(worker);
  key.row.error = "worker " + worker + ": " + error;
  if (final || key.row.failures >= config_.retry_limit) key.row.failed = true;
  Write(key.row);
  for (const FrameRef ref : key.wanters) effects_.changed[ref.job].insert(ref.index);
}

Answer<Machine::Renewed> Machine::Renew(const std::string& session_id,
                                        const std::vector<Progress>& progress, Now now) {
  Session* session = roster_.FindSession(session_id);
  if (session == nullptr) return NoSession();
  session->heard_ms = now.mono_ms;
  Renewed renewed;
  for (const Progress& entry : progress) {
    renewed.go_on.push_back(leases_.Renew(entry.attempt, session_id, entry.count, now.mono_ms));
  }
  renewed.drain = !roster_.FindWorker(session->worker)->usable();
  return renewed;
}

Answer<bool> Machine::Fail(const std::string& session_id, AttemptId id, std::string error,
                           bool final, Now now) {
  Session* session = roster_.FindSession(session_id);
  if (session == nullptr) return NoSession();
  session->heard_ms = now.mono_ms;
  const Attempt* attempt = leases_.Find(id);
  if (attempt == nullptr || attempt->session != session_id) return false;
  Key& key = keys_.at(attempt->key);
  EndAttempt(id);
  CountFailure(key, session->worker, error, final);
  Settle(key, now);
  Finish(now);
  return true;
}

Answer<bool> Machine::Leave(const std::string& session_id, Now now) {
  if (roster_.FindSession(session_id) == nullptr) return false;
  CloseSession(session_id, {}, Loss::kGivenBack, now);
  roster_.Close(session_id, now.mono_ms);
  dispatch_ = true;
  Finish(now);
  return true;
}

void Machine::Tick(Now now) {
  for (const std::string& id : roster_.SilentSince(now.mono_ms - config_.term_ms)) {
    Say(false, "worker " + roster_.FindSession(id)->worker + " is not heard of any more");
    CloseSession(id, {}, Loss::kWorkerLost, now);
    roster_.Close(id, now.mono_ms);
    dispatch_ = true;
  }
  for (const LeaseTable::Due& due : leases_.DueBy(now.mono_ms)) {
    if (leases_.Find(due.id) == nullptr) continue;  // ended with another of the same key
    const Attempt attempt = EndAttempt(due.id);
    Key& key = keys_.at(attempt.key);
    if (due.stalled) {
      CountFailure(key, roster_.FindSession(attempt.session)->worker,
                   "no progress for " + std::to_string(config_.stall_ms / 1000) + " s", false);
    }
    Settle(key, now);
  }
  if (now.mono_ms >= look_for_gone_ms_) {
    look_for_gone_ms_ = now.mono_ms + kLookForGoneEveryMs;
    roster_.ForgetGone(now.mono_ms - config_.forget_ms);
  }
  if (held_until_ms_ != 0 && now.mono_ms >= held_until_ms_) {
    held_until_ms_ = 0;
    dispatch_ = true;
  }
  for (auto& [id, session] : roster_.sessions()) {
    if (!session.parked || session.parked->until_ms > now.mono_ms) continue;
    AnswerParked(session, {}, false);
  }
  Finish(now);
}

std::optional<int64_t> Machine::NextWake() const {
  std::optional<int64_t> wake = leases_.NextDue();
  const auto at_latest = [&](int64_t time) { wake = std::min(wake.value_or(time), time); };
  if (const auto heard = roster_.OldestHeard()) at_latest(*heard + config_.term_ms);
  if (held_until_ms_ != 0) at_latest(held_until_ms_);
  if (!roster_.workers().empty()) at_latest(look_for_gone_ms_);
  for (const auto& [id, session] : roster_.sessions()) {
    if (session.parked) at_latest(session.parked->until_ms);
  }
  return wake;
}

}  // namespace fjord::server
