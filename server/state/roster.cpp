#include "server/state/roster.h"

#include <algorithm>

#include "engine/base/check.h"

namespace fjord::server {
namespace {

template <typename Map>
auto* FindIn(Map& map, const std::string& id) {
  const auto place = map.find(id);
  return place == map.end() ? nullptr : &place->second;
}

}  // namespace

Worker* Roster::FindWorker(const std::string& id) { return FindIn(workers_, id); }
const Worker* Roster::FindWorker(const std::string& id) const { return FindIn(workers_, id); }
Session* Roster::FindSession(const std::string& id) { return FindIn(sessions_, id); }
const Session* Roster::FindSession(const std::string& id) const { return FindIn(sessions_, id); }

Worker& Roster::AddWorker(WorkerRow row) {
  Worker& worker = workers_[row.id];
  if (worker.row.id.empty()) worker.row = std::move(row);
  return worker;
}

Session& Roster::Open(Worker& worker, const std::string& session, int64_t now_ms) {
  FJORD_CHECK(worker.session.empty() && !sessions_.contains(session), worker.row.id, session);
  worker.session = session;
  Session& opened = sessions_[session];
  opened.id = session;
  opened.worker = worker.row.id;
  opened.joined_ms = opened.heard_ms = now_ms;
  return opened;
}

void Roster::Close(const std::string& session, int64_t now_ms) {
  const auto place = sessions_.find(session);
  FJORD_CHECK(place != sessions_.end(), session);
  Worker& worker = workers_.at(place->second.worker);
  worker.session.clear();
  worker.gone_ms = now_ms;
  sessions_.erase(place);
}

void Roster::AllGoneSince(int64_t now_ms) {
  for (auto& [id, worker] : workers_) worker.gone_ms = now_ms;
}

void Roster::ForgetGone(int64_t since_ms) {
  std::erase_if(workers_, [since_ms](const auto& entry) {
    const Worker& worker = entry.second;
    return !worker.alive() && worker.gone_ms <= since_ms && !worker.row.draining &&
           !worker.row.quarantined;
  });
}

std::vector<std::string> Roster::SilentSince(int64_t before_ms) const {
  std::vector<std::string> silent;
  for (const auto& [id, session] : sessions_) {
    if (session.heard_ms <= before_ms) silent.push_back(id);
  }
  return silent;
}

std::optional<int64_t> Roster::OldestHeard() const {
  std::optional<int64_t> oldest;
  for (const auto& [id, session] : sessions_) {
    oldest = std::min(oldest.value_or(session.heard_ms), session.heard_ms);
  }
  return oldest;
}

std::vector<std::string> Roster::Audit() const {
  std::vector<std::string> broken;
  size_t alive = 0;
  for (const auto& [id, worker] : workers_) {
    if (!worker.alive()) continue;
    ++alive;
    const Session* session = FindSession(worker.session);
    if (session == nullptr || session->worker != id) {
      broken.push_back("R1: worker " + id + " and its session disagree");
    }
  }
  if (alive != sessions_.size()) broken.push_back("R1: sessions without a worker");
  return broken;
}

}  // namespace fjord::server
