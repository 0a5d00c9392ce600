// Deliveries, judged by content (F3), and workers that are not trusted.
#include <algorithm>

#include "engine/base/check.h"
#include "server/state/machine.h"

namespace fjord::server {

bool Machine::SceneWants(const Digest& scene, uint32_t frame) const {
  for (const JobId id : open_) {
    const Job& job = jobs_.at(id);
    if (job.row.spec.scene != scene) continue;
    const std::optional<uint32_t> index = job.IndexOf(frame);
    if (index && job.frames[*index].key == nullptr &&
        job.frames[*index].state == FrameState::kWaiting) {
      return true;
    }
  }
  return false;
}

bool Machine::Wanted(const Key& key) const {
  for (const FrameRef ref : key.wanters) {
    const JobRow& row = jobs_.at(ref.job).row;
    if (!row.cancelled && row.error.empty()) return true;
  }
  // After a restart workers may know the key of a frame before it is planned again.
  return key.wanters.empty() && key.frame != 0 && SceneWants(key.scene, key.frame);
}

Key* Machine::KeyFor(const Digest& digest, const Digest& scene, uint32_t frame) {
  const auto place = keys_.find(digest);
  if (place != keys_.end() && place->second.frame != 0) return &place->second;
  return SceneWants(scene, frame) ? &AddKey(digest, scene, frame)
                                  : (place == keys_.end() ? nullptr : &place->second);
}

// Whose job pays for the deliveries of a key.
const FrameRef* Machine::Payer(const Key& key) const {
  for (const FrameRef& ref : key.wanters) {
    const Job& job = jobs_.at(ref.job);
    if (!job.row.cancelled && !job.frames[ref.index].cached) return &ref;
  }
  return nullptr;
}

Answer<Outcome> Machine::Complete(const std::string& session_id, const Delivery& delivery,
                                  Now now) {
  Session* session = roster_.FindSession(session_id);
  if (session == nullptr)
    return Refusal{Code::kNotFound, "session_id: no such session; join again"};
  session->heard_ms = now.mono_ms;
  Worker& worker = *roster_.FindWorker(session->worker);
  if (worker.row.quarantined) {
    return Refusal{Code::kDenied,
                   "worker " + worker.row.id + " is quarantined: its pictures are not trusted"};
  }
  const auto end_attempt = [&] {
    const Attempt* attempt = leases_.Find(delivery.attempt);
    if (attempt == nullptr || attempt->session != session_id || attempt->key != delivery.key)
      return;
    EndAttempt(delivery.attempt);
  };
  Key* key = KeyFor(delivery.key, delivery.scene, delivery.frame);
  if (key == nullptr || (!Wanted(*key) && key->evidence.empty())) {
    end_attempt();
    Finish(now);
    return Outcome::kUnknownUnit;
  }
  const bool agrees = key->done() && key->result()->pixel == delivery.pixel;
  bool known = agrees && (!delivery.blob_present || key->evidence.size() >= kEnoughEvidence);
  for (const ResultRow& result : key->evidence) {
    known |= result.pixel == delivery.pixel && result.worker == worker.row.id &&
             (agrees || result.attempt == delivery.attempt);
  }
  if (!known && !delivery.blob_present) return Outcome::kMissingBlob;
  end_attempt();
  if (!known) {
    AddEvidence(*key, {delivery.key, delivery.attempt, worker.row.id, delivery.pixel, delivery.blob,
                       delivery.triangles, delivery.render_ms, delivery.blob_bytes});
    Charge(*key, worker, delivery.render_ms);
  }
  Settle(*key, now);
  if (key->done() && key->row.failed) {  // came after all
    key->row = KeyRow{key->digest};
    Write(key->row);
  }
  const Standing before = key->verdict.standing;
  if (before == Standing::kDisputed || before == Standing::kNoMajority ||
      !key->verdict.liars.empty()) {
    AlarmOver(*key);
  }
  RejectLiars(*key, now);
  Finish(now);

  if (worker.row.quarantined) return Outcome::kConflict;
  switch (key->verdict.standing) {
    case Standing::kOpen:
      return Outcome::kCommitted;
    case Standing::kDone:
      if (key->result()->pixel != delivery.pixel) return Outcome::kConflict;
      return agrees || known ? Outcome::kDuplicate : Outcome::kCommitted;
    case Standing::kDisputed:
    case Standing::kNoMajority:
      break;
  }
  return Outcome::kConflict;
}

void Machine::Charge(const Key& key, Worker& worker, uint32_t render_ms) {
  ++worker.frames_done;
  worker.render_ms += render_ms;
  const FrameRef* payer = Payer(key);
  if (payer == nullptr) return;
  Job& job = jobs_.at(payer->job);
  job.render_ms += render_ms;
  ++job.rendered;
  project_ms_[job.row.spec.project] += std::max<uint32_t>(render_ms, 1);
}

void Machine::AlarmOver(const Key& key) {
  std::string text = "integrity alarm: frame " + std::to_string(key.frame) + ", key " +
                     key.digest.Hex() + ", was delivered as different pictures:";
  for (const ResultRow& result : key.evidence) {
    text += " " + result.worker + " " + result.pixel.Hex().substr(0, 16);
  }
  Say(true, std::move(text));
}

void Machine::RejectLiars(Key& key, Now now) {
  while (!key.verdict.liars.empty()) {
    Quarantine(roster_.AddWorker({key.verdict.liars.front()}),
               "delivered another picture than the others for key " + key.digest.Hex(), now);
  }
}

void Machine::Quarantine(Worker& worker, const std::string& why, Now now) {
  worker.row.quarantined = true;
  Write(worker.row);
  Say(true, "worker " + worker.row.id + " is quarantined: " + why);
  if (worker.alive()) {
    for (const AttemptId id : leases_.HeldBy(worker.session)) {
      Key& key = keys_.at(EndAttempt(id).key);
      Settle(key, now);
    }
    Session& session = *roster_.FindSession(worker.session);
    if (session.parked) AnswerParked(session, {}, true);
  }
  // Whatever rests on its word alone is made again (M7).
  const std::set<Digest> keys = evidence_of_[worker.row.id];
  for (const Digest& digest : keys) {
    Key& key = keys_.at(digest);
    DropEvidenceOf(key, worker.row.id);
    Settle(key, now);
  }
  for (const Digest& digest : keys) RejectLiars(keys_.at(digest), now);
  dispatch_ = true;
}

Answer<std::string> Machine::CommandWorker(const std::string& id, WorkerCommand command, Now now) {
  Worker* worker = roster_.FindWorker(id);
  if (worker == nullptr) return Refusal{Code::kNotFound, "there is no worker \"" + id + "\""};
  switch (command) {
    case WorkerCommand::kDrain:
      worker->row.draining = true;
      if (worker->alive()) {
        Session& session = *roster_.FindSession(worker->session);
        if (session.parked) AnswerParked(session, {}, true);
      }
      Write(worker->row);
      break;
    case WorkerCommand::kQuarantine:
      if (!worker->row.quarantined) Quarantine(*worker, "by command", now);
      break;
    case WorkerCommand::kRelease:
      worker->row.draining = worker->row.quarantined = false;
      Write(worker->row);
      break;
  }
  dispatch_ = true;
  Finish(now);
  return id;
}

}  // namespace fjord::server
