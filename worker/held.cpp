#include "worker/held.h"

#include <algorithm>

namespace fjord::worker {

void HeldLeases::Add(const v1::AcquireResponse& response, Time sent) {
  {
    const std::lock_guard lock(mutex_);
    for (const v1::Grant& grant : response.grant()) {
      auto& slot = leases_[KeyOf(grant.attempt())];
      if (slot != nullptr) continue;  // asked again after a lost answer
      slot = std::make_shared<Lease>();
      slot->grant = grant;
      slot->deadline = sent + std::chrono::milliseconds(grant.term_ms());
      queue_.push_back(slot);
    }
  }
  changed_.notify_all();
}

std::shared_ptr<Lease> HeldLeases::Next() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return stopped_ || !queue_.empty(); });
  if (stopped_) return nullptr;
  std::shared_ptr<Lease> lease = std::move(queue_.front());
  queue_.pop_front();
  lease->progress.store(1, std::memory_order_relaxed);
  changed_.notify_all();
  return lease;
}

void HeldLeases::Begin(const std::shared_ptr<Lease>& lease, Time now) {
  const std::lock_guard lock(mutex_);
  const uint32_t limit_ms = lease->grant.limit_ms();
  if (limit_ms > 0) lease->stop_at = now + std::chrono::milliseconds(limit_ms);
}

bool HeldLeases::WaitForRoom(size_t most) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] {
    return stopped_ || (queue_.size() < most &&
                        std::none_of(leases_.begin(), leases_.end(), [](const auto& entry) {
                          return entry.second->grant.alone();
                        }));
  });
  return !stopped_;
}

void HeldLeases::MarkMade(const std::shared_ptr<Lease>& lease) {
  const std::lock_guard lock(mutex_);
  lease->made = true;
}

void HeldLeases::Drop(const std::shared_ptr<Lease>& lease) {
  leases_.erase(KeyOf(lease->grant.attempt()));
  std::erase(queue_, lease);
}

void HeldLeases::Remove(const std::shared_ptr<Lease>& lease) {
  {
    const std::lock_guard lock(mutex_);
    Drop(lease);
  }
  changed_.notify_all();
}

std::vector<std::shared_ptr<Lease>> HeldLeases::All() const {
  const std::lock_guard lock(mutex_);
  std::vector<std::shared_ptr<Lease>> all;
  for (const auto& [key, lease] : leases_) all.push_back(lease);
  return all;
}

bool HeldLeases::empty() const {
  const std::lock_guard lock(mutex_);
  return leases_.empty();
}

void HeldLeases::Extend(const v1::Attempt& attempt, Time sent, std::chrono::milliseconds term) {
  const std::lock_guard lock(mutex_);
  const auto place = leases_.find(KeyOf(attempt));
  if (place == leases_.end()) return;
  place->second->deadline = std::max(place->second->deadline, sent + term);
}

void HeldLeases::Lose(const v1::Attempt& attempt) {
  {
    const std::lock_guard lock(mutex_);
    const auto place = leases_.find(KeyOf(attempt));
    if (place == leases_.end() || place->second->made) return;
    const std::shared_ptr<Lease> lease = place->second;
    lease->cancel = true;
    Drop(lease);
  }
  changed_.notify_all();
}

std::optional<Time> HeldLeases::CancelOverdue(Time now) {
  std::optional<Time> next;
  {
    const std::lock_guard lock(mutex_);
    std::vector<std::shared_ptr<Lease>> overdue;
    for (const auto& [key, lease] : leases_) {
      if (lease->made) continue;
      if (lease->stop_at && !lease->over) {
        if (*lease->stop_at <= now) {
          lease->over = true;
          lease->cancel = true;
        } else if (!next || *lease->stop_at < *next) {
          next = *lease->stop_at;
        }
      }
      const Time stop = lease->deadline - margin_;
      if (stop <= now) {
        overdue.push_back(lease);
      } else if (!next || stop < *next) {
        next = stop;
      }
    }
    for (const std::shared_ptr<Lease>& lease : overdue) {
      lease->cancel = true;
      Drop(lease);
    }
  }
  changed_.notify_all();
  return next;
}

void HeldLeases::Stop() {
  {
    const std::lock_guard lock(mutex_);
    stopped_ = true;
    for (const auto& [key, lease] : leases_) lease->cancel = true;
  }
  changed_.notify_all();
}

}  // namespace fjord::worker
