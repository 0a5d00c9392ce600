#include "server/state/lease_table.h"

#include <algorithm>

#include "engine/base/check.h"

namespace fjord::server {

int64_t LeaseTable::DueTime(const Attempt& attempt) const {
  if (attempt.count == 0) return attempt.deadline_ms;
  return std::min(attempt.deadline_ms, attempt.progress_ms + stall_ms_);
}

const Attempt& LeaseTable::Insert(Attempt attempt, int64_t now_ms) {
  attempt.deadline_ms = now_ms + term_ms_;
  attempt.progress_ms = now_ms;
  const auto [place, fresh] = attempts_.emplace(attempt.id, std::move(attempt));
  FJORD_CHECK(fresh, place->first.epoch, place->first.sequence);
  held_[place->second.session].push_back(place->first);
  due_.emplace(DueTime(place->second), place->first);
  return place->second;
}

const Attempt& LeaseTable::Grant(const std::string& session, Attempt unit, int64_t now_ms) {
  unit.id = {epoch_, next_sequence_++};
  unit.session = session;
  unit.count = 0;
  return Insert(std::move(unit), now_ms);
}

const Attempt& LeaseTable::Adopt(const std::string& session, Attempt attempt, int64_t now_ms) {
  if (Find(attempt.id) != nullptr) attempt = End(attempt.id);
  attempt.session = session;
  return Insert(std::move(attempt), now_ms);
}

bool LeaseTable::Renew(AttemptId id, const std::string& session, uint64_t count, int64_t now_ms) {
  const auto place = attempts_.find(id);
  if (place == attempts_.end() || place->second.session != session) return false;
  Attempt& attempt = place->second;
  due_.erase({DueTime(attempt), id});
  attempt.deadline_ms = now_ms + term_ms_;
  if (count > attempt.count) {
    attempt.count = count;
    attempt.progress_ms = now_ms;
  }
  due_.emplace(DueTime(attempt), id);
  return true;
}

const Attempt* LeaseTable::Find(AttemptId id) const {
  const auto place = attempts_.find(id);
  return place == attempts_.end() ? nullptr : &place->second;
}

Attempt LeaseTable::End(AttemptId id) {
  const auto place = attempts_.find(id);
  FJORD_CHECK(place != attempts_.end(), id.epoch, id.sequence);
  Attempt attempt = std::move(place->second);
  attempts_.erase(place);
  due_.erase({DueTime(attempt), id});
  const auto held = held_.find(attempt.session);
  std::erase(held->second, id);
  if (held->second.empty()) held_.erase(held);
  return attempt;
}

std::vector<AttemptId> LeaseTable::HeldBy(const std::string& session) const {
  const auto held = held_.find(session);
  return held == held_.end() ? std::vector<AttemptId>{} : held->second;
}

size_t LeaseTable::CountHeldBy(const std::string& session) const {
  const auto held = held_.find(session);
  return held == held_.end() ? 0 : held->second.size();
}

std::vector<LeaseTable::Due> LeaseTable::DueBy(int64_t now_ms) const {
  std::vector<Due> due;
  for (const auto& [time, id] : due_) {
    if (time > now_ms) break;
    due.push_back({id, attempts_.at(id).deadline_ms > now_ms});
  }
  return due;
}

std::optional<int64_t> LeaseTable::NextDue() const {
  if (due_.empty()) return std::nullopt;
  return due_.begin()->first;
}

std::vector<std::string> LeaseTable::Audit() const {
  std::vector<std::string> broken;
  size_t listed = 0;
  for (const auto& [session, ids] : held_) {
    listed += ids.size();
    for (const AttemptId id : ids) {
      const Attempt* attempt = Find(id);
      if (attempt == nullptr || attempt->session != session) {
        broken.push_back("L2: session " + session + " lists an attempt it does not hold");
      }
    }
  }
  if (listed != attempts_.size()) broken.push_back("L2: attempts and lists differ in number");
  if (due_.size() != attempts_.size()) broken.push_back("L3: attempts and dues differ in number");
  for (const auto& [id, attempt] : attempts_) {
    if (!due_.contains({DueTime(attempt), id})) broken.push_back("L3: an attempt is not due");
    if (id.epoch > epoch_ || (id.epoch == epoch_ && id.sequence >= next_sequence_)) {
      broken.push_back("L1: an attempt nobody granted");
    }
  }
  return broken;
}

}  // namespace fjord::server
