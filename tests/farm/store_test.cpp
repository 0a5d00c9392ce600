// The journal and the blob store: what is in them after they were closed, cut, filled or damaged.
#include <gtest/gtest.h>
#include <soci/soci-config.h>
#undef SOCI_HAVE_BOOST
#include <soci/soci.h>
#include <soci/sqlite3/soci-sqlite3.h>
#include <sys/resource.h>

#include <atomic>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>
#include <future>

#include "server/blob_store.h"
#include "server/data_dir.h"
#include "server/journal.h"
#include "server/journal_format.h"
#include "server/journal_writer.h"
#include "temp_dir.h"

namespace fjord::server {
namespace {

namespace fs = std::filesystem;
using farm_test::TempDir;

std::unique_ptr<Journal> OpenIn(const TempDir& dir) {
  Result<std::unique_ptr<Journal>> journal = OpenSqliteJournal(dir.path(), "test");
  EXPECT_TRUE(journal.ok()) << journal.error().ToString();
  return std::move(*journal);
}

JobRow SomeJob(JobId id) {
  JobRow row;
  row.id = id;
  row.spec = {"r" + std::to_string(id),
              "content",
              "näme",
              "it's \"a\" project",
              Sha256Of("scene"),
              *FrameSet::Parse("3-7,20-40x4"),
              -5,
              .25,
              0,
              5'000};
  row.submitted_unix_ms = 1'700'000'000'123;
  return row;
}

TEST(JournalTest, F1_RowsComeBackAsTheyWere) {
  TempDir dir;
  ResultRow result{Sha256Of("k"), {3, 4}, "w", Sha256Of("p"), Sha256Of("b"), 1ull << 40, 17};
  {
    const auto journal = OpenIn(dir);
    JobRow ended = SomeJob(2);
    ended.paused = ended.cancelled = true;
    ended.ended_unix_ms = 5;
    ended.error = "bad";
    ResultRow dropped = result;
    dropped.attempt = {3, 5};
    const std::vector<Record> records = {
        SomeJob(1),
        ended,
        FrameRow{1, 3, Sha256Of("k"), true, ""},
        FrameRow{1, 4, std::nullopt, false, "no"},
        result,
        dropped,
        DropResult{dropped.key, dropped.attempt, dropped.worker, dropped.pixel},
        KeyRow{Sha256Of("k"), 1, 2, true, "why"},
        WorkerRow{"w", true, false},
        WorkerRow{"w", false, true}};
    ASSERT_TRUE(journal->Append(records).ok());
    EXPECT_EQ(journal->stats().batches, 1u);
    EXPECT_EQ(journal->stats().records, records.size());
    EXPECT_GT(journal->stats().bytes, 500u);
  }
  const Result<Snapshot> loaded = OpenIn(dir)->Load();
  ASSERT_TRUE(loaded.ok()) << loaded.error().ToString();
  EXPECT_EQ(loaded->epoch, 2u);
  ASSERT_EQ(loaded->jobs.size(), 2u);
  EXPECT_EQ(loaded->jobs[0].spec.name, "näme");
  EXPECT_EQ(loaded->jobs[0].spec.project, "it's \"a\" project");
  EXPECT_EQ(loaded->jobs[0].spec.scene, Sha256Of("scene"));
  EXPECT_EQ(loaded->jobs[0].spec.frames.ToString(), "3-7,20-40x4");
  EXPECT_EQ(loaded->jobs[0].spec.frame_limit_ms, 5'000u);
  EXPECT_EQ(loaded->jobs[0].spec.priority, -5);
  EXPECT_EQ(loaded->jobs[0].spec.verify_share, .25);
  EXPECT_EQ(loaded->jobs[0].submitted_unix_ms, 1'700'000'000'123);
  EXPECT_TRUE(loaded->jobs[1].paused && loaded->jobs[1].cancelled);
  EXPECT_EQ(loaded->jobs[1].error, "bad");
  ASSERT_EQ(loaded->frames.size(), 2u);
  EXPECT_EQ(loaded->frames[0].key, Sha256Of("k"));
  EXPECT_TRUE(loaded->frames[0].cached);
  EXPECT_EQ(loaded->frames[1].key, std::nullopt);
  EXPECT_EQ(loaded->frames[1].error, "no");
  ASSERT_EQ(loaded->results.size(), 1u);
  EXPECT_EQ(loaded->results[0].attempt, result.attempt);
  EXPECT_EQ(loaded->results[0].triangles, 1ull << 40);
  ASSERT_EQ(loaded->keys.size(), 1u);
  EXPECT_EQ(loaded->keys[0].lost, 2u);
  ASSERT_EQ(loaded->workers.size(), 1u);
  EXPECT_TRUE(loaded->workers[0].quarantined && !loaded->workers[0].draining);
}

TEST(JournalTest, F4_ATakenOverCoordinatorWritesNothingMore) {
  TempDir dir;
  const auto old = OpenIn(dir);
  const auto young = OpenIn(dir);
  const std::vector<Record> records = {SomeJob(1)};
  const Result<> refused = old->Append(records);
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(refused.error().message.find("taken over"), std::string::npos)
      << refused.error().message;
  EXPECT_TRUE(young->Append(records).ok());
  EXPECT_EQ(young->Load()->jobs.size(), 1u);
}

TEST(JournalTest, F8_DamageAndOtherVersionsAreNamed) {
  TempDir dir;
  const std::string path = dir.path() + "/" + kJournalFile;
  std::ofstream(path)
      << "this is not a database, but it is long enough to look like something else";
  const auto damaged = OpenSqliteJournal(dir.path(), "test");
  ASSERT_FALSE(damaged.ok());
  EXPECT_NE(damaged.error().ToString().find(path), std::string::npos);
  EXPECT_NE(damaged.error().message.find("not a database"), std::string::npos);
  EXPECT_NE(damaged.error().message.find("move it aside"), std::string::npos) << "what to do";
}

TEST(JournalTest, F1_ADroppedJobIsGoneAndItsIdIsNeverGivenAgain) {
  TempDir dir;
  {
    const auto journal = OpenIn(dir);
    const std::vector<Record> records = {SomeJob(8), SomeJob(9), FrameRow{8, 3, Sha256Of("k")},
                                         FrameRow{9, 3, Sha256Of("k")}};
    ASSERT_TRUE(journal->Append(records).ok());
    const std::vector<Record> drops = {DropJob{9}, DropJob{8}};
    ASSERT_TRUE(journal->Append({&drops[0], 1}).ok());
    EXPECT_EQ(journal->Load()->jobs.size(), 1u);
    ASSERT_TRUE(journal->Append({&drops[1], 1}).ok());
  }
  const auto journal = OpenIn(dir);
  const Result<Snapshot> snapshot = journal->Load();
  ASSERT_TRUE(snapshot.ok()) << snapshot.error().ToString();
  EXPECT_TRUE(snapshot->jobs.empty());
  EXPECT_TRUE(snapshot->frames.empty());
  EXPECT_EQ(snapshot->last_job, 9u);
}

// As the first version left it: the columns that came later get their defaults.
TEST(JournalTest, F4_AJournalOfVersion1IsTakenOver) {
  TempDir dir;
  {
    const auto journal = OpenIn(dir);
    ResultRow result{Sha256Of("k"), {3, 4}, "w", Sha256Of("p"), Sha256Of("b"), 5, 17, 99};
    const std::vector<Record> records = {SomeJob(1), result};
    ASSERT_TRUE(journal->Append(records).ok());
  }
  {
    soci::session sql(soci::sqlite3, "dbname=\"" + dir.path() + "/" + kJournalFile + "\"");
    for (const char* statement :
         {"ALTER TABLE result DROP COLUMN bytes", "ALTER TABLE job DROP COLUMN frames",
          "ALTER TABLE job DROP COLUMN frame_limit_ms",
          "UPDATE meta SET value = '1' WHERE name = 'schema'"}) {
      sql << statement;
    }
  }
  for (int start = 0; start < 2; ++start) {
    const auto journal = OpenIn(dir);
    const Result<Snapshot> snapshot = journal->Load();
    ASSERT_TRUE(snapshot.ok()) << snapshot.error().ToString();
    ASSERT_EQ(snapshot->jobs.size(), 1u);
    EXPECT_EQ(snapshot->jobs[0].spec.name, "näme");
    EXPECT_EQ(snapshot->jobs[0].spec.frames.ToString(), "3-40") << "first and last are all it had";
    EXPECT_EQ(snapshot->jobs[0].spec.frame_limit_ms, 0u);
    ASSERT_EQ(snapshot->results.size(), 1u);
    EXPECT_EQ(snapshot->results[0].render_ms, 17u);
    EXPECT_EQ(snapshot->results[0].bytes, 0u);
  }
}

class CountingJournal : public Journal {
 public:
  Result<Snapshot> Load() override { return Snapshot{}; }
  Result<> Append(std::span<const Record> records) override {
    gate.get_future().wait();
    gate = std::promise<void>();
    ++batches;
    rows += records.size();
    if (fail) return MakeError(ErrorCode::kIo, "the disk is full");
    return {};
  }
  JournalStats stats() const override { return {}; }

  std::promise<void> gate;
  std::atomic<int> batches{0};
  std::atomic<size_t> rows{0};
  bool fail = false;
};

TEST(JournalWriterTest, F9_GathersWhatComesWhileItWritesAndAnswersAfterwards) {
  CountingJournal journal;
  std::vector<int> answered;
  std::promise<void> first, all;
  JournalWriter writer(journal, [](const Error&) {});
  writer.Append({SomeJob(1)});
  writer.After([&](const Result<>& result) {
    EXPECT_TRUE(result.ok());
    answered.push_back(1);
    first.set_value();
  });
  EXPECT_TRUE(answered.empty()) << "not on disk yet";
  journal.gate.set_value();
  first.get_future().wait();
  for (int i = 2; i <= 50; ++i) {
    writer.Append({SomeJob(static_cast<JobId>(i))});
    writer.After([&answered, &all, i](const Result<>&) {
      answered.push_back(i);
      if (i == 50) all.set_value();
    });
  }
  std::future<void> done = all.get_future();
  while (done.wait_for(std::chrono::milliseconds(1)) != std::future_status::ready) {
    try {
      journal.gate.set_value();
    } catch (const std::future_error&) {  // it has not taken the last one yet
    }
  }
  EXPECT_EQ(journal.rows, 50u);
  EXPECT_LT(journal.batches, 50);
  EXPECT_EQ(answered.size(), 50u);
  EXPECT_TRUE(std::is_sorted(answered.begin(), answered.end()));
}

TEST(JournalWriterTest, F1_NothingIsAnsweredWellOnceTheDiskFails) {
  CountingJournal journal;
  journal.fail = true;
  std::promise<Error> failure, answer;
  JournalWriter writer(journal, [&](const Error& error) { failure.set_value(error); });
  writer.Append({SomeJob(1)});
  writer.After([&](const Result<>& result) { answer.set_value(result.error()); });
  journal.gate.set_value();
  EXPECT_EQ(answer.get_future().get().message, "the disk is full");
  EXPECT_EQ(failure.get_future().get().message, "the disk is full");
  bool later = false;
  writer.Append({SomeJob(2)});
  writer.After([&](const Result<>& result) { later = !result.ok(); });
  EXPECT_TRUE(later);
}

size_t FilesIn(const std::string& dir) {
  size_t count = 0;
  for (const auto& entry : fs::recursive_directory_iterator(dir)) count += entry.is_regular_file();
  return count;
}

TEST(BlobStoreTest, F2_PutIfAbsentAndThereAfterARestart) {
  TempDir dir;
  {
    const auto store = BlobStore::Open(dir.path(), 1'000);
    ASSERT_TRUE(store.ok());
    EXPECT_EQ(*store.value()->Put(Sha256Of("a"), "a"), false);
    EXPECT_EQ(*store.value()->Put(Sha256Of("a"), "a"), true);
  }
  const auto store = BlobStore::Open(dir.path(), 1'000);
  EXPECT_TRUE(store.value()->Has(Sha256Of("a")));
  EXPECT_EQ(*store.value()->Get(Sha256Of("a"), 10), "a");
  EXPECT_EQ(store.value()->Get(Sha256Of("a"), 0).error().code, ErrorCode::kLimit);
  EXPECT_EQ(store.value()->Get(Sha256Of("b"), 10).error().code, ErrorCode::kNotFound);
  EXPECT_EQ(store.value()->count(), 1u);
}

TEST(BlobStoreTest, F2_B3_WhatIsRefusedLeavesNothing) {
  TempDir dir;
  const auto opened = BlobStore::Open(dir.path(), 10);
  BlobStore& store = *opened.value();
  EXPECT_EQ(store.Put(Sha256Of("a"), "b").error().code, ErrorCode::kInvalid);
  EXPECT_EQ(store.Put(Sha256Of("long"), "longer than ten").error().code, ErrorCode::kLimit);
  {
    auto writer = store.Begin(Sha256Of("abc"), 3);
    EXPECT_TRUE(writer.value()->Append("ab").ok());
    EXPECT_EQ(writer.value()->Commit().error().code, ErrorCode::kInvalid) << "too few bytes";
  }
  {
    auto writer = store.Begin(Sha256Of("abc"), 3);
    EXPECT_EQ(writer.value()->Append("abcd").error().code, ErrorCode::kInvalid) << "too many";
  }
  EXPECT_EQ(FilesIn(dir.path()), 0u);
}

TEST(BlobStoreTest, F4_B2_StartRemovesWhatACrashLeft) {
  TempDir dir;
  fs::create_directories(dir.path() + "/tmp");
  std::ofstream(dir.path() + "/tmp/17") << "half a pict";
  const auto store = BlobStore::Open(dir.path(), 10);
  ASSERT_TRUE(store.ok());
  EXPECT_EQ(FilesIn(dir.path()), 0u);
}

TEST(BlobStoreTest, F8_FullDiskIsAClearErrorAndLeavesNothing) {
  TempDir dir;
  const auto opened = BlobStore::Open(dir.path(), 1 << 20);
  // A limit on the size of files stands for a full disk: the write fails in the middle.
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small{4'096, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  const std::string bytes(10'000, 'x');
  const Result<bool> put = opened.value()->Put(Sha256Of(bytes), bytes);
  setrlimit(RLIMIT_FSIZE, &before);
  ASSERT_FALSE(put.ok());
  EXPECT_EQ(put.error().code, ErrorCode::kIo);
  EXPECT_NE(put.error().message.find("cannot store blob"), std::string::npos);
  EXPECT_EQ(FilesIn(dir.path()), 0u);
  EXPECT_TRUE(opened.value()->Put(Sha256Of(bytes), bytes).ok()) << "and works again with room";
}

TEST(BlobStoreTest, F2_B4_WhatIsDamagedOrGoneIsNoticedAndCanBePutAgain) {
  TempDir dir;
  const std::string bytes = "the bytes of a picture";
  const Digest digest = Sha256Of(bytes), other = Sha256Of("another's");
  const auto path = [&](const Digest& blob) {
    return dir.path() + "/blobs/" + blob.Hex().substr(0, 2) + "/" + blob.Hex().substr(2);
  };
  const std::vector<std::function<void()>> harms = {
      [&] { fs::resize_file(path(digest), 0); },
      [&] { fs::resize_file(path(digest), 5); },
      [&] { std::ofstream(path(digest)) << "the bytes of a PICTURE"; },
      [&] { fs::remove(path(digest)); },
  };
  for (const bool after_restart : {false, true}) {
    for (size_t harm = 0; harm < harms.size(); ++harm) {
      SCOPED_TRACE(harm);
      auto store = std::move(BlobStore::Open(dir.path(), 1000)).value();
      ASSERT_TRUE(store->Put(digest, bytes).ok());
      ASSERT_TRUE(store->Put(other, "another's").ok());
      EXPECT_TRUE(store->Check(digest));
      if (after_restart) store.reset();
      harms[harm]();
      if (after_restart) store = std::move(BlobStore::Open(dir.path(), 1000)).value();
      std::vector<Digest> lost;
      store->OnLost([&](const Digest& blob) { lost.push_back(blob); });
      if (harm % 2 == 0) {
        EXPECT_FALSE(store->Check(digest));
      } else {
        const auto got = store->Get(digest, 1000);
        ASSERT_FALSE(got.ok());
        EXPECT_EQ(got.error().code, ErrorCode::kNotFound);
      }
      EXPECT_FALSE(store->Has(digest));
      EXPECT_EQ(lost.size(), after_restart && harm == 3 ? 0u : 1u);
      EXPECT_TRUE(store->Check(other));
      EXPECT_EQ(store->Put(digest, bytes).value(), false) << "it was not there";
      EXPECT_EQ(store->Get(digest, 1000).value(), bytes);
      EXPECT_TRUE(store->Check(digest, BlobStore::Reading::kAnew));
      EXPECT_EQ(store->SizeOf(digest), bytes.size());
    }
  }
}

TEST(BlobStoreTest, F2_ManyAtOncePutOneBlob) {
  TempDir dir;
  const auto opened = BlobStore::Open(dir.path(), 1 << 20);
  const std::string bytes(100'000, 'y');
  std::vector<std::future<bool>> puts;
  for (int i = 0; i < 8; ++i) {
    puts.push_back(std::async(std::launch::async, [&] {
      const Result<bool> put = opened.value()->Put(Sha256Of(bytes), bytes);
      return put.ok();
    }));
  }
  for (auto& put : puts) EXPECT_TRUE(put.get());
  EXPECT_EQ(FilesIn(dir.path()), 1u);
  EXPECT_EQ(*opened.value()->Get(Sha256Of(bytes), 1 << 20), bytes);
}

TEST(DataDirTest, F4_OneHolderAtATime) {
  TempDir dir;
  {
    const auto first = DataDir::Open(dir.path());
    ASSERT_TRUE(first.ok());
    EXPECT_EQ(DataDir::Open(dir.path()).error().code, ErrorCode::kUnavailable);
  }
  EXPECT_TRUE(DataDir::Open(dir.path()).ok());
  EXPECT_EQ(DataDir::Open("/dev/null/x").error().code, ErrorCode::kIo);
}

}  // namespace
}  // namespace fjord::server
