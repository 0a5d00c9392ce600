// The journal: what survives a kill -9 at any instruction (F1, F4). Rows replace rows of the same
// identity (state/types.h), so its size follows the number of jobs, frames and pictures, not of
// events.
//
// K1 Append returns after the rows are synced to disk, all of them or none.
// K2 Every Append checks its epoch first: a coordinator that was taken over writes nothing more.
// K3 The epoch is taken at Open by compare-and-set and is higher than every one before.
// One thread at a time.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "engine/base/result.h"
#include "server/state/types.h"

namespace fjord::server {

struct JournalStats {
  uint64_t batches = 0;  // transactions; each is one sync of the log
  uint64_t records = 0;
  uint64_t bytes = 0;  // of the rows' values
  uint64_t largest_batch = 0;
  uint64_t commit_us = 0;  // time spent in transactions
};

class Journal {
 public:
  virtual ~Journal() = default;

  // Everything in it, with the epoch taken.
  virtual Result<Snapshot> Load() = 0;
  // kLimit: no room on the disk; nothing was written, and the same may be tried again.
  virtual Result<> Append(std::span<const Record> records) = 0;
  virtual JournalStats stats() const = 0;
};

// Opens or makes DIR/journal.sqlite and takes the next epoch. `holder` names this coordinator to
// people.
Result<std::unique_ptr<Journal>> OpenSqliteJournal(const std::string& dir,
                                                   const std::string& holder);

}  // namespace fjord::server
