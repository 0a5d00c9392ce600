#include "server/journal_writer.h"

#include <algorithm>
#include <utility>

#include "server/journal_format.h"

namespace fjord::server {

JournalWriter::JournalWriter(Journal& journal, std::function<void(const Error&)> on_failure,
                             std::function<void()> on_full, std::chrono::milliseconds pause)
    : journal_(journal),
      on_failure_(std::move(on_failure)),
      on_full_(std::move(on_full)),
      pause_(pause),
      thread_([this] { Run(); }) {}

JournalWriter::~JournalWriter() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

void JournalWriter::Append(std::vector<Record> records) {
  if (records.empty()) return;
  {
    const std::lock_guard lock(mutex_);
    appended_ += records.size();
    if (failure_) return;
    std::move(records.begin(), records.end(), std::back_inserter(records_));
  }
  wake_.notify_one();
}

void JournalWriter::After(Answer answer) {
  Result<> result;
  {
    const std::lock_guard lock(mutex_);
    if (failure_) {
      result = *failure_;
    } else if (full_ && appended_ > committed_) {
      result = *full_;
    } else if (appended_ > committed_) {
      answers_.emplace_back(appended_, std::move(answer));
      return;
    }
  }
  answer(result);
}

size_t JournalWriter::waiting() const {
  const std::lock_guard lock(mutex_);
  return records_.size() + answers_.size();
}

// Until it is written, for good or not at all. Called and left with the lock.
Result<> JournalWriter::Write(const std::vector<Record>& batch,
                              std::unique_lock<std::mutex>& lock) {
  while (true) {
    lock.unlock();
    Result<> written = journal_.Append(batch);
    const bool full = !written.ok() && written.error().code == ErrorCode::kLimit;
    if (full && on_full_) on_full_();
    lock.lock();
    if (!full || stop_) {
      full_.reset();
      return written;
    }
    full_ = written.error();
    const auto waiting = std::exchange(answers_, {});
    lock.unlock();
    for (const auto& [number, answer] : waiting) answer(written);
    lock.lock();
    wake_.wait_for(lock, pause_, [this] { return stop_; });
  }
}

void JournalWriter::Run() {
  std::unique_lock lock(mutex_);
  while (true) {
    wake_.wait(lock, [this] { return stop_ || !records_.empty(); });
    if (records_.empty()) return;
    std::vector<Record> batch;
    if (records_.size() <= kMaxBatchRecords) {
      batch.swap(records_);
    } else {
      const auto end = records_.begin() + kMaxBatchRecords;
      std::move(records_.begin(), end, std::back_inserter(batch));
      records_.erase(records_.begin(), end);
    }
    const Result<> written = Write(batch, lock);
    std::deque<std::pair<uint64_t, Answer>> ready;
    if (written.ok()) {
      committed_ += batch.size();
      while (!answers_.empty() && answers_.front().first <= committed_) {
        ready.push_back(std::move(answers_.front()));
        answers_.pop_front();
      }
    } else {
      failure_ = written.error();
      ready.swap(answers_);
      records_.clear();
    }
    lock.unlock();
    for (auto& [number, answer] : ready) answer(written);
    if (!written.ok()) on_failure_(written.error());
    lock.lock();
  }
}

}  // namespace fjord::server
