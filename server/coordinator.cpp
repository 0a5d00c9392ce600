#include "server/coordinator.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <future>

#include "engine/base/printable.h"

namespace fjord::server {
namespace {

constexpr size_t kMaxTasks = 10'000;
constexpr size_t kMaxUncommitted = 200'000;  // records and answers that wait for the disk
constexpr size_t kMaxWatchers = 10'000;
constexpr int64_t kLongestSleepMs = 1'000;

const Refusal kStopping{Code::kUnavailable, "the coordinator is stopping"};

}  // namespace

Coordinator::Coordinator(const MachineConfig& config, Snapshot snapshot, Journal& journal,
                         FramePlanner& frames, const Clock& clock, Store store,
                         std::function<void(const Error&)> on_failure)
    : clock_(clock),
      store_(std::move(store)),
      machine_(config, std::move(snapshot), clock.Read()),
      writer_(journal, std::move(on_failure), store_.on_full) {
  planner_.emplace(frames, [this](Planner::Answer answer) {
    CheckPictures(answer);
    PostInner([answer = std::move(answer)](Machine& machine, Now now) {
      if (answer.unusable) machine.SceneUnusable(answer.job, answer.unusable->message, now);
      for (const auto& [frame, key] : answer.keys) {
        if (key.ok()) {
          machine.Planned(answer.job, frame, key.value(), now);
        } else {
          machine.FrameUnplannable(answer.job, frame, key.error().ToString(), now);
        }
      }
    });
  });
  thread_ = std::thread([this] { Run(); });
}

Coordinator::~Coordinator() {
  Close();
  planner_.reset();
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

void Coordinator::Close() {
  {
    const std::lock_guard lock(mutex_);
    if (closed_) return;
    closed_ = true;
    queue_.push_back([this](Machine&, Now) {
      for (auto& [session, waiting] : std::exchange(parked_, {})) {
        waiting.reply({session, waiting.request, {}, false, kStopping});
      }
      for (auto& [job, watchers] : std::exchange(watchers_, {})) {
        for (Watcher* watcher : watchers) watcher->Closed();
      }
    });
  }
  wake_.notify_one();
}

bool Coordinator::Post(Task task) {
  const size_t uncommitted = writer_.waiting();
  {
    const std::lock_guard lock(mutex_);
    if (closed_ || queue_.size() >= kMaxTasks || uncommitted > kMaxUncommitted) return false;
    queue_.push_back(std::move(task));
  }
  wake_.notify_one();
  return true;
}

void Coordinator::PostInner(Task task) {
  {
    const std::lock_guard lock(mutex_);
    queue_.push_back(std::move(task));
  }
  wake_.notify_one();
}

void Coordinator::AfterCommit(JournalWriter::Answer answer) {
  // The task's own records first.
  writer_.Append(machine_.TakeRecords());
  writer_.After(std::move(answer));
}

void Coordinator::Park(const std::string& session, uint64_t request, const void* caller,
                       AcquireReply reply) {
  const auto before = parked_.find(session);
  if (before != parked_.end()) {
    const Waiting waiting = std::move(before->second);
    parked_.erase(before);
    waiting.reply({session,
                   waiting.request,
                   {},
                   false,
                   Refusal{Code::kAborted, "request: overtaken by a newer call of this session"}});
  }
  parked_[session] = {request, caller, std::move(reply)};
}

void Coordinator::Abandon(const std::string& session, const void* caller) {
  const auto place = parked_.find(session);
  if (place == parked_.end() || place->second.caller != caller) return;
  const Waiting waiting = std::move(place->second);
  parked_.erase(place);
  machine_.AbandonAcquire(session, waiting.request);
  waiting.reply(
      {session, waiting.request, {}, false, Refusal{Code::kAborted, "the caller is gone"}});
}

bool Coordinator::Watch(JobId job, Watcher* watcher) {
  if (watching_ >= kMaxWatchers) return false;
  ++watching_;
  watchers_[job].insert(watcher);
  return true;
}

void Coordinator::Unwatch(JobId job, Watcher* watcher) {
  const auto place = watchers_.find(job);
  if (place == watchers_.end()) return;
  watching_ -= place->second.erase(watcher);
  if (place->second.empty()) watchers_.erase(place);
}

void Coordinator::Deliver(const AcquireAnswer& answer) {
  const auto place = parked_.find(answer.session);
  if (place == parked_.end() || place->second.request != answer.request) return;
  const Waiting waiting = std::move(place->second);
  parked_.erase(place);
  waiting.reply(answer);
}

void Coordinator::Apply() {
  Effects effects = machine_.TakeEffects();
  writer_.Append(std::move(effects.records));
  for (PlanRequest& plan : effects.plans) planner_->Ask(std::move(plan));
  for (const AcquireAnswer& answer : effects.answers) Deliver(answer);
  for (const auto& [job, frames] : effects.changed) {
    const auto place = watchers_.find(job);
    if (place == watchers_.end()) continue;
    const std::set<Watcher*> watchers = place->second;  // Changed may unwatch
    for (Watcher* watcher : watchers) watcher->Changed(machine_, frames);
  }
  for (const Notice& notice : effects.notices) {
    spdlog::log(notice.alarm ? spdlog::level::err : spdlog::level::warn, "{}",
                Printable(notice.text));
  }
}

// On the planner's thread: a frame whose key is known is done at once, if its picture can be given
// out. What is lost is told to the machine before it hears of these keys.
void Coordinator::CheckPictures(const Planner::Answer& answer) {
  std::promise<std::set<Digest>> asked;
  PostInner([&](const Machine& machine, Now) {
    std::set<Digest> blobs;
    for (const auto& [frame, digest] : answer.keys) {
      const Key* key = digest.ok() ? machine.FindKey(digest.value()) : nullptr;
      if (key != nullptr && key->done()) blobs.insert(key->result()->blob);
    }
    asked.set_value(std::move(blobs));
  });
  for (const Digest& blob : asked.get_future().get()) (void)store_.has_picture(blob);
}

void Coordinator::Run() {
  Apply();
  std::unique_lock lock(mutex_);
  while (!stop_ || !queue_.empty()) {
    if (queue_.empty()) {
      lock.unlock();
      const std::optional<int64_t> due = machine_.NextWake();
      const int64_t now = clock_.Read().mono_ms;
      const int64_t sleep =
          std::clamp<int64_t>(due.value_or(now + kLongestSleepMs) - now, 0, kLongestSleepMs);
      lock.lock();
      wake_.wait_for(lock, std::chrono::milliseconds(sleep),
                     [this] { return stop_ || !queue_.empty(); });
    }
    std::deque<Task> tasks;
    tasks.swap(queue_);
    lock.unlock();
    for (const Task& task : tasks) {
      task(machine_, clock_.Read());
      Apply();
    }
    const Now now = clock_.Read();
    const std::optional<int64_t> due = machine_.NextWake();
    if (due && *due <= now.mono_ms) {
      machine_.Tick(now);
      Apply();
    }
    lock.lock();
  }
}

}  // namespace fjord::server
