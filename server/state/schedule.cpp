// Who gets what (F7): priority, then fair share between projects by render time, then coarse to
// fine.
#include <algorithm>

#include "engine/base/check.h"
#include "server/state/machine.h"

namespace fjord::server {
namespace {

constexpr double kUnknownFrameMs = 1000;  // charged for a frame under way before any has ended

}  // namespace

void Machine::Acquire(const std::string& session_id, uint64_t request, uint32_t want,
                      int64_t wait_ms, Now now) {
  const auto refuse = [&](Code code, std::string message) {
    effects_.answers.push_back({session_id, request, {}, false, Refusal{code, std::move(message)}});
  };
  Session* session = roster_.FindSession(session_id);
  if (session == nullptr) return refuse(Code::kNotFound, "session_id: no such session; join again");
  session->heard_ms = now.mono_ms;
  const Worker& worker = *roster_.FindWorker(session->worker);
  const bool drain = !worker.usable();
  if (request < session->last_request) {
    return refuse(Code::kAborted,
                  "request: " + std::to_string(session->last_request) + " was answered already");
  }
  if (request == session->last_request) {
    std::vector<Grant> live;
    for (const Grant& grant : session->last_grants) {
      const Attempt* attempt = leases_.Find(grant.attempt);
      if (attempt != nullptr && attempt->session == session_id) live.push_back(grant);
    }
    effects_.answers.push_back({session_id, request, std::move(live), drain, std::nullopt});
    return;
  }
  // Half a term at most: the lease counts from when the worker sent the call.
  const int64_t wait = std::min(wait_ms, config_.term_ms / 2);
  session->parked = Parked{request, want, now.mono_ms + wait, ++arrivals_};
  if (drain) {
    AnswerParked(*session, {}, true);
  } else {
    dispatch_ = true;
  }
  Finish(now);
  session = roster_.FindSession(session_id);
  if (wait == 0 && session->parked) AnswerParked(*session, {}, false);
}

void Machine::AbandonAcquire(const std::string& session_id, uint64_t request) {
  Session* session = roster_.FindSession(session_id);
  if (session != nullptr && session->parked && session->parked->request == request) {
    session->parked.reset();
  }
}

void Machine::AnswerParked(Session& session, std::vector<Grant> grants, bool drain) {
  FJORD_CHECK(session.parked.has_value(), session.id);
  session.last_request = session.parked->request;
  session.last_grants = grants;
  effects_.answers.push_back(
      {session.id, session.parked->request, std::move(grants), drain, std::nullopt});
  session.parked.reset();
}

void Machine::Dispatch(Now now) {
  dispatch_ = false;
  // Idle workers before those that only fetch ahead, then first come first served.
  std::vector<std::pair<std::pair<size_t, uint64_t>, std::string>> waiting;
  for (const auto& [id, session] : roster_.sessions()) {
    if (session.parked) waiting.push_back({{leases_.CountHeldBy(id), session.parked->arrival}, id});
  }
  std::sort(waiting.begin(), waiting.end());
  for (const auto& [rank, id] : waiting) {
    Session& session = *roster_.FindSession(id);
    std::vector<Grant> grants;
    while (grants.size() < session.parked->want) {
      const std::optional<Grant> grant = GrantOne(session, now);
      if (!grant) break;
      grants.push_back(*grant);
    }
    if (!grants.empty()) AnswerParked(session, std::move(grants), false);
  }
}

std::vector<Job*> Machine::Candidates() {
  std::map<std::string, double> under_way;
  for (const JobId id : open_) {
    const Job& job = jobs_.at(id);
    const double frame_ms =
        job.rendered == 0 ? kUnknownFrameMs : static_cast<double>(job.render_ms) / job.rendered;
    under_way[job.row.spec.project] += job.counts.running * frame_ms;
  }
  std::vector<std::pair<double, Job*>> ranked;
  for (const JobId id : open_) {
    Job& job = jobs_.at(id);
    if (job.ready.empty() || !Runnable(job)) continue;
    const std::string& project = job.row.spec.project;
    ranked.emplace_back(project_ms_[project] + under_way[project], &job);
  }
  std::sort(ranked.begin(), ranked.end(), [](const auto& a, const auto& b) {
    const JobRow &left = a.second->row, &right = b.second->row;
    if (left.spec.priority != right.spec.priority) return left.spec.priority > right.spec.priority;
    if (a.first != b.first) return a.first < b.first;
    return left.id < right.id;
  });
  std::vector<Job*> jobs;
  for (const auto& [share, job] : ranked) jobs.push_back(job);
  return jobs;
}

bool Machine::Eligible(const Key& key, const Worker& worker, Now now) const {
  if (key.hold_until_ms > now.mono_ms) return false;
  const auto voted = [&](const std::string& id) {
    return std::any_of(key.evidence.begin(), key.evidence.end(),
                       [&](const ResultRow& result) { return result.worker == id; });
  };
  const auto renders = [&](const std::string& session) {
    return std::any_of(key.live.begin(), key.live.end(),
                       [&](AttemptId id) { return leases_.Find(id)->session == session; });
  };
  if (renders(worker.session)) return false;
  const bool spoiled = voted(worker.row.id) || key.failed_by.contains(worker.row.id);
  if (!spoiled) return true;
  // Only another worker's word decides between two pictures.
  if (voted(worker.row.id) && key.verdict.standing == Standing::kDisputed) return false;
  // A second look, or another try, goes to another worker where there is one.
  for (const auto& [id, other] : roster_.workers()) {
    if (other.usable() && !voted(id) && !key.failed_by.contains(id)) return false;
  }
  return true;
}

// The longest time that any job which wants the key allows it; 0: any.
uint32_t Machine::LimitOf(const Key& key) const {
  uint32_t limit = 0;
  JobId seen = 0;
  for (const FrameRef ref : key.wanters) {
    if (ref.job == seen) continue;
    seen = ref.job;
    const JobRow& row = jobs_.at(ref.job).row;
    if (row.cancelled || !row.error.empty()) continue;
    if (row.spec.frame_limit_ms == 0) return 0;
    limit = std::max(limit, row.spec.frame_limit_ms);
  }
  return limit;
}

std::optional<Grant> Machine::GrantOne(const Session& session, Now now) {
  const Worker& worker = *roster_.FindWorker(session.worker);
  const std::vector<AttemptId> held = leases_.HeldBy(session.id);
  if (!worker.usable() || held.size() >= config_.max_held) return std::nullopt;
  if (!held.empty() && leases_.Find(held.front())->alone) return std::nullopt;
  for (Job* job : Candidates()) {
    for (const uint32_t position : job->ready) {
      const uint32_t index = job->order[position];
      Key& key = *job->frames[index].key;
      const bool alone = key.row.lost >= config_.suspect_after;
      if ((alone && !held.empty()) || !Eligible(key, worker, now)) continue;
      Attempt unit;
      unit.key = key.digest;
      unit.scene = job->row.spec.scene;
      unit.frame = job->FrameNumber(index);
      unit.alone = alone;
      const Attempt& attempt = leases_.Grant(session.id, std::move(unit), now.mono_ms);
      key.live.push_back(attempt.id);
      Settle(key, now);
      return Grant{attempt.id, attempt.scene, attempt.frame, attempt.key,
                   alone,      LimitOf(key),  job->row.id,   job->row.spec.name};
    }
  }
  return std::nullopt;
}

}  // namespace fjord::server
