// The only place with SQL. SQLite in write-ahead mode with full syncs: one sync a transaction.
// SOCI's headers use Boost for types that are not bound here; without it, Boost need not be there.
#include <soci/soci-config.h>
#undef SOCI_HAVE_BOOST

#include <soci/soci.h>
#include <soci/sqlite3/soci-sqlite3.h>
#include <sqlite3.h>

#include <atomic>
#include <chrono>
#include <mutex>

#include "server/journal.h"
#include "server/journal_format.h"

namespace fjord::server {
namespace {

// BIGINT and not INTEGER: SOCI reads columns declared INTEGER as 32 bits.
constexpr const char* kSchema[] = {
    "CREATE TABLE meta (name TEXT PRIMARY KEY, value TEXT NOT NULL)",
    "CREATE TABLE coordinator (id BIGINT PRIMARY KEY CHECK (id = 1), epoch BIGINT NOT NULL,"
    " holder TEXT NOT NULL)",
    "CREATE TABLE job (id BIGINT PRIMARY KEY, request_id TEXT NOT NULL UNIQUE, content TEXT NOT "
    "NULL,"
    " name TEXT NOT NULL, project TEXT NOT NULL, scene TEXT NOT NULL, first BIGINT NOT NULL,"
    " last BIGINT NOT NULL, priority BIGINT NOT NULL, verify_share REAL NOT NULL,"
    " after_job BIGINT NOT NULL, paused BIGINT NOT NULL, cancelled BIGINT NOT NULL,"
    " submitted_unix_ms BIGINT NOT NULL, ended_unix_ms BIGINT NOT NULL, error TEXT NOT NULL,"
    " frames TEXT NOT NULL DEFAULT '', frame_limit_ms BIGINT NOT NULL DEFAULT 0)",
    "CREATE TABLE frame (job BIGINT NOT NULL, number BIGINT NOT NULL, key TEXT NOT NULL,"
    " cached BIGINT NOT NULL, error TEXT NOT NULL, PRIMARY KEY (job, number)) WITHOUT ROWID",
    "CREATE TABLE result (key TEXT NOT NULL, epoch BIGINT NOT NULL, sequence BIGINT NOT NULL,"
    " worker TEXT NOT NULL, pixel TEXT NOT NULL, blob TEXT NOT NULL, triangles BIGINT NOT NULL,"
    " render_ms BIGINT NOT NULL, bytes BIGINT NOT NULL DEFAULT 0,"
    " PRIMARY KEY (key, epoch, sequence, worker, pixel)) WITHOUT ROWID",
    "CREATE TABLE key (key TEXT PRIMARY KEY, failures BIGINT NOT NULL, lost BIGINT NOT NULL,"
    " failed BIGINT NOT NULL, error TEXT NOT NULL) WITHOUT ROWID",
    "CREATE TABLE worker (id TEXT PRIMARY KEY, draining BIGINT NOT NULL,"
    " quarantined BIGINT NOT NULL) WITHOUT ROWID",
};

// What version 1 did not have.
constexpr const char* kFromVersion1[] = {
    "ALTER TABLE job ADD COLUMN frames TEXT NOT NULL DEFAULT ''",
    "ALTER TABLE job ADD COLUMN frame_limit_ms BIGINT NOT NULL DEFAULT 0",
    "ALTER TABLE result ADD COLUMN bytes BIGINT NOT NULL DEFAULT 0",
};

int64_t MicrosNow() {
  return std::chrono::duration_cast<std::chrono::microseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

// A statement with places for values, run again and again.
class Statement {
 public:
  Statement(soci::session& sql, std::string text) : sql_(sql), text_(std::move(text)) {}

  // Values are long long, double or std::string.
  template <typename... Values>
  void Run(const Values&... values) {
    soci::statement statement(sql_);
    (statement.exchange(soci::use(values)), ...);
    statement.alloc();
    statement.prepare(text_);
    statement.define_and_bind();
    statement.execute(true);
  }

 private:
  soci::session& sql_;
  const std::string text_;
};

class SqliteJournal : public Journal {
 public:
  Result<> Open(const std::string& dir, const std::string& holder);
  Result<Snapshot> Load() override;
  Result<> Append(std::span<const Record> records) override;
  JournalStats stats() const override {
    const std::lock_guard lock(stats_mutex_);
    return stats_;
  }

 private:
  void Migrate();
  void TakeEpoch(const std::string& holder);
  void Write(const JobRow& row);
  void Write(const FrameRow& row);
  void Write(const ResultRow& row);
  void Write(const DropResult& row);
  void Write(const KeyRow& row);
  void Write(const WorkerRow& row);
  void Write(const DropJob& row);
  template <typename... Values>
  void Run(Statement& statement, const Values&... values) {
    bytes_ += (Bytes(values) + ...);
    statement.Run(values...);
  }
  static uint64_t Bytes(const std::string& text) { return text.size(); }
  static uint64_t Bytes(long long) { return sizeof(long long); }
  static uint64_t Bytes(double) { return sizeof(double); }
  Error Failure(const std::string& doing, const std::exception& cause,
                const std::string& remedy = {}) const {
    const auto* sqlite = dynamic_cast<const soci::sqlite3_soci_error*>(&cause);
    const bool full = sqlite != nullptr && sqlite->result() == SQLITE_FULL;
    return MakeError(full ? ErrorCode::kLimit : ErrorCode::kIo,
                     doing + ": " + cause.what() + remedy, {path_});
  }

  std::string path_;
  soci::session sql_;
  long long epoch_ = 0;
  uint64_t bytes_ = 0;
  mutable std::mutex stats_mutex_;
  JournalStats stats_;

  Statement put_job_{sql_,
                     "INSERT OR REPLACE INTO job VALUES (:a, :b, :c, :d, :e, :f, :g, :h, :i, :j,"
                     " :k, :l, :m, :n, :o, :p, :q, :r)"};
  Statement put_frame_{sql_, "INSERT OR REPLACE INTO frame VALUES (:a, :b, :c, :d, :e)"};
  Statement put_result_{
      sql_, "INSERT OR REPLACE INTO result VALUES (:a, :b, :c, :d, :e, :f, :g, :h, :i)"};
  Statement drop_result_{sql_,
                         "DELETE FROM result WHERE key = :a AND epoch = :b AND sequence = :c AND "
                         "worker = :d AND pixel = :e"};
  Statement put_key_{sql_, "INSERT OR REPLACE INTO key VALUES (:a, :b, :c, :d, :e)"};
  Statement drop_frames_{sql_, "DELETE FROM frame WHERE job = :a"};
  Statement drop_job_{sql_, "DELETE FROM job WHERE id = :a"};
  // As a text of digits; the id that was given last is never given again.
  Statement note_last_job_{
      sql_,
      "INSERT INTO meta VALUES ('last_job', :a) ON CONFLICT (name) DO UPDATE "
      "SET value = max(CAST(value AS INTEGER), CAST(excluded.value AS INTEGER))"};
  Statement put_worker_{sql_, "INSERT OR REPLACE INTO worker VALUES (:a, :b, :c)"};
};

// For people whose journal does not open: nothing else in the folder needs it.
constexpr char kUnreadable[] =
    "; see that the file is this coordinator's and that it may read and write it. Where it is "
    "damaged, move it aside (with its -wal and -shm), or put a copy of it back: without it the "
    "coordinator starts with no jobs, and the pictures in blobs/ stay";

long long Number(auto value) { return static_cast<long long>(value); }

void SqliteJournal::Write(const JobRow& row) {
  const JobSpec& spec = row.spec;
  Run(put_job_, Number(row.id), spec.request_id, spec.content, spec.name, spec.project,
      spec.scene.Hex(), Number(spec.frames.first()), Number(spec.frames.last()),
      Number(spec.priority), spec.verify_share, Number(spec.after), Number(row.paused),
      Number(row.cancelled), Number(row.submitted_unix_ms), Number(row.ended_unix_ms), row.error,
      spec.frames.ToString(), Number(spec.frame_limit_ms));
}

void SqliteJournal::Write(const FrameRow& row) {
  Run(put_frame_, Number(row.job), Number(row.frame), row.key ? row.key->Hex() : std::string(),
      Number(row.cached), row.error);
}

void SqliteJournal::Write(const ResultRow& row) {
  Run(put_result_, row.key.Hex(), Number(row.attempt.epoch), Number(row.attempt.sequence),
      row.worker, row.pixel.Hex(), row.blob.Hex(), Number(row.triangles), Number(row.render_ms),
      Number(row.bytes));
}

void SqliteJournal::Write(const DropResult& row) {
  Run(drop_result_, row.key.Hex(), Number(row.attempt.epoch), Number(row.attempt.sequence),
      row.worker, row.pixel.Hex());
}

void SqliteJournal::Write(const KeyRow& row) {
  Run(put_key_, row.key.Hex(), Number(row.failures), Number(row.lost), Number(row.failed),
      row.error);
}

void SqliteJournal::Write(const WorkerRow& row) {
  Run(put_worker_, row.id, Number(row.draining), Number(row.quarantined));
}

void SqliteJournal::Write(const DropJob& row) {
  Run(drop_frames_, Number(row.id));
  Run(drop_job_, Number(row.id));
  Run(note_last_job_, Number(row.id));
}

void SqliteJournal::Migrate() {
  int tables = 0;
  sql_ << "SELECT count(*) FROM sqlite_master WHERE name = 'meta'", soci::into(tables);
  if (tables == 0) {
    sql_ << "BEGIN IMMEDIATE";
    for (const char* statement : kSchema) sql_ << statement;
    sql_ << "INSERT INTO meta VALUES ('schema', '" << kSchemaVersion << "')";
    sql_ << "INSERT INTO coordinator VALUES (1, 0, '')";
    sql_ << "COMMIT";
  }
  std::string version;
  sql_ << "SELECT value FROM meta WHERE name = 'schema'", soci::into(version);
  if (version == "1") {
    sql_ << "BEGIN IMMEDIATE";
    for (const char* statement : kFromVersion1) sql_ << statement;
    version = std::to_string(kSchemaVersion);
    sql_ << "UPDATE meta SET value = :v WHERE name = 'schema'", soci::use(version);
    sql_ << "COMMIT";
  }
  if (version != std::to_string(kSchemaVersion)) {
    throw std::runtime_error("its format is version " + version + ", this program knows version " +
                             std::to_string(kSchemaVersion) +
                             ": use the version that wrote it or a later one");
  }
}

void SqliteJournal::TakeEpoch(const std::string& holder) {
  long long before = 0;
  sql_ << "SELECT epoch FROM coordinator WHERE id = 1", soci::into(before);
  epoch_ = before + 1;
  soci::statement take =
      (sql_.prepare << "UPDATE coordinator SET epoch = :n, holder = :h WHERE id = 1 AND epoch = :b",
       soci::use(epoch_), soci::use(holder), soci::use(before));
  take.execute(true);
  if (take.get_affected_rows() != 1) {
    throw std::runtime_error("another coordinator took over at this moment; start again");
  }
}

Result<> SqliteJournal::Open(const std::string& dir, const std::string& holder) {
  path_ = dir + "/" + kJournalFile;
  try {
    sql_.open(soci::sqlite3, "dbname=\"" + path_ + "\" timeout=5");
    std::string mode;
    sql_ << "PRAGMA journal_mode = WAL", soci::into(mode);
    sql_ << "PRAGMA synchronous = FULL";
    sql_ << "PRAGMA journal_size_limit = 16777216";
    Migrate();
    TakeEpoch(holder);
  } catch (const std::exception& cause) {
    return Failure("the journal cannot be opened", cause, kUnreadable);
  }
  return {};
}

Result<> SqliteJournal::Append(std::span<const Record> records) {
  const int64_t begin = MicrosNow();
  bytes_ = 0;
  try {
    sql_ << "BEGIN IMMEDIATE";
    try {
      long long epoch = 0;
      sql_ << "SELECT epoch FROM coordinator WHERE id = 1", soci::into(epoch);
      if (epoch != epoch_) {
        throw std::runtime_error("a newer coordinator (epoch " + std::to_string(epoch) +
                                 ") has taken over from this one (epoch " + std::to_string(epoch_) +
                                 ")");
      }
      for (const Record& record : records) {
        std::visit([this](const auto& row) { Write(row); }, record);
      }
      sql_ << "COMMIT";
    } catch (const std::exception&) {
      try {
        sql_ << "ROLLBACK";
      } catch (const std::exception&) {  // SQLite rolled back by itself; the first error tells
      }
      throw;
    }
  } catch (const std::exception& cause) {
    return Failure("the journal cannot be written", cause);
  }
  const std::lock_guard lock(stats_mutex_);
  ++stats_.batches;
  stats_.records += records.size();
  stats_.bytes += bytes_;
  stats_.largest_batch = std::max<uint64_t>(stats_.largest_batch, records.size());
  stats_.commit_us += static_cast<uint64_t>(MicrosNow() - begin);
  return {};
}

// One row at a time, columns by their place.
class Row {
 public:
  explicit Row(const soci::row& row) : row_(row) {}
  std::string Text(size_t i) const { return row_.get<std::string>(i); }
  long long Int(size_t i) const {
    switch (row_.get_properties(i).get_data_type()) {
      case soci::dt_integer:
        return row_.get<int>(i);
      case soci::dt_unsigned_long_long:
        return static_cast<long long>(row_.get<unsigned long long>(i));
      case soci::dt_string:
        return std::stoll(row_.get<std::string>(i));
      default:
        return row_.get<long long>(i);
    }
  }
  double Real(size_t i) const { return row_.get<double>(i); }
  // A text, or, where that is empty, as version 1 left it, a first and a last number.
  FrameSet Frames(size_t text, size_t first, size_t last) const {
    const std::string spans = Text(text).empty()
                                  ? std::to_string(Int(first)) + "-" + std::to_string(Int(last))
                                  : Text(text);
    const Result<FrameSet> frames = FrameSet::Parse(spans);
    if (!frames.ok()) throw std::runtime_error("damaged frames: " + frames.error().message);
    return frames.value();
  }
  Digest Hash(size_t i) const {
    const std::optional<Digest> digest = ParseDigest(Text(i));
    if (!digest) throw std::runtime_error("a damaged digest: \"" + Text(i) + "\"");
    return *digest;
  }

 private:
  const soci::row& row_;
};

Result<Snapshot> SqliteJournal::Load() {
  Snapshot snapshot;
  snapshot.epoch = static_cast<uint64_t>(epoch_);
  const auto each = [this](const char* query, auto take) {
    const soci::rowset<soci::row> rows = (sql_.prepare << query);
    for (const soci::row& row : rows) take(Row(row));
  };
  try {
    each("SELECT value FROM meta WHERE name = 'last_job'",
         [&](const Row& row) { snapshot.last_job = std::stoull(row.Text(0)); });
    each("SELECT * FROM job ORDER BY id", [&](const Row& row) {
      JobSpec spec{row.Text(1),
                   row.Text(2),
                   row.Text(3),
                   row.Text(4),
                   row.Hash(5),
                   row.Frames(16, 6, 7),
                   static_cast<int32_t>(row.Int(8)),
                   row.Real(9),
                   static_cast<JobId>(row.Int(10)),
                   static_cast<uint32_t>(row.Int(17))};
      snapshot.jobs.push_back({static_cast<JobId>(row.Int(0)), std::move(spec), row.Int(11) != 0,
                               row.Int(12) != 0, row.Int(13), row.Int(14), row.Text(15)});
    });
    each("SELECT * FROM frame", [&](const Row& row) {
      std::optional<Digest> key;
      if (!row.Text(2).empty()) key = row.Hash(2);
      snapshot.frames.push_back({static_cast<JobId>(row.Int(0)), static_cast<uint32_t>(row.Int(1)),
                                 key, row.Int(3) != 0, row.Text(4)});
    });
    each("SELECT * FROM result ORDER BY key, epoch, sequence, worker, pixel", [&](const Row& row) {
      snapshot.results.push_back(
          {row.Hash(0),
           {static_cast<uint64_t>(row.Int(1)), static_cast<uint64_t>(row.Int(2))},
           row.Text(3),
           row.Hash(4),
           row.Hash(5),
           static_cast<uint64_t>(row.Int(6)),
           static_cast<uint32_t>(row.Int(7)),
           static_cast<uint64_t>(row.Int(8))});
    });
    each("SELECT * FROM key", [&](const Row& row) {
      snapshot.keys.push_back({row.Hash(0), static_cast<uint32_t>(row.Int(1)),
                               static_cast<uint32_t>(row.Int(2)), row.Int(3) != 0, row.Text(4)});
    });
    each("SELECT * FROM worker", [&](const Row& row) {
      snapshot.workers.push_back({row.Text(0), row.Int(1) != 0, row.Int(2) != 0});
    });
  } catch (const std::exception& cause) {
    return Failure("the journal cannot be read", cause, kUnreadable);
  }
  return snapshot;
}

}  // namespace

Result<std::unique_ptr<Journal>> OpenSqliteJournal(const std::string& dir,
                                                   const std::string& holder) {
  auto journal = std::make_unique<SqliteJournal>();
  if (const Result<> opened = journal->Open(dir, holder); !opened.ok()) return opened.error();
  return std::unique_ptr<Journal>(std::move(journal));
}

}  // namespace fjord::server
