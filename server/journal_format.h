// The journal on disk: constants. docs/journal_format.md says what the tables mean.
#pragma once

namespace fjord::server {

inline constexpr char kJournalFile[] = "journal.sqlite";
inline constexpr int kSchemaVersion = 2;  // raised with a migration in journal_sqlite.cpp
inline constexpr char kLockFile[] = "lock";
inline constexpr int kMaxBatchRecords = 10'000;  // of one transaction

}  // namespace fjord::server
