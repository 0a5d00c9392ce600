// The worker's parts by themselves: what each status code means, the leases it holds; and the whole
// worker against a coordinator made of a few lines.
#include "worker/worker.h"

#include <gtest/gtest.h>

#include <condition_variable>
#include <deque>
#include <map>
#include <mutex>
#include <set>

#include "temp_dir.h"
#include "worker/held.h"
#include "worker/identity.h"
#include "worker/retry.h"

namespace fjord::worker {
namespace {

using grpc::StatusCode;
using std::chrono::milliseconds;

TEST(RetryTest, F3_EveryCodeOfEveryCallHasItsMeaning) {
  // docs/wire.md, in the order of gRPC's numbers 0..16.
  const std::map<Rpc, std::string> table = {
      {Rpc::kJoin, "OrrxrSxxrSrxSrrxS"},  {Rpc::kAcquire, "OrrxrjxxrSnxSrrxS"},
      {Rpc::kRenew, "OrrxrjxxrSrxSrrxS"}, {Rpc::kComplete, "OrrdrjddrSrdSrrdS"},
      {Rpc::kFail, "OrrdrjddrSrdSrrdS"},  {Rpc::kLeave, "OrrxrjxxrSrxSrrxS"},
      {Rpc::kPut, "OrrdrdddrSrdSrrdS"},   {Rpc::kGet, "OrrdrdddrSrdSrrdS"},
  };
  const std::map<char, Act> acts = {{'O', Act::kDone}, {'r', Act::kRetry}, {'j', Act::kJoinAgain},
                                    {'n', Act::kNext}, {'d', Act::kDrop},  {'S', Act::kStop},
                                    {'x', Act::kStop}};
  for (const auto& [rpc, row] : table) {
    ASSERT_EQ(row.size(), 17u);
    for (int code = 0; code <= 16; ++code) {
      EXPECT_EQ(ActOn(rpc, static_cast<StatusCode>(code)), acts.at(row[code]))
          << "call " << static_cast<int>(rpc) << ", code " << code;
    }
  }
}

TEST(RetryTest, F9_PausesGrowToABoundAndDiffer) {
  Backoff a(milliseconds(100), milliseconds(1'000), 1),
      b(milliseconds(100), milliseconds(1'000), 2);
  int different = 0;
  for (int i = 0; i < 20; ++i) {
    const auto pause = a.Next(), other = b.Next();
    const auto most = milliseconds(std::min(1'000, 100 << std::min(i, 4)));
    EXPECT_GE(pause, most / 2);
    EXPECT_LE(pause, most);
    different += pause != other;
  }
  EXPECT_GT(different, 10);
}

// The scripted coordinator's term: no machine is so busy that it lapses during a test.
constexpr uint32_t kScriptTermMs = 60'000;

v1::AcquireResponse GrantOf(uint64_t sequence, bool alone = false) {
  v1::AcquireResponse response;
  v1::Grant& grant = *response.add_grant();
  grant.mutable_attempt()->set_epoch(1);
  grant.mutable_attempt()->set_sequence(sequence);
  grant.add_unit()->set_frame(static_cast<uint32_t>(sequence));
  grant.set_term_ms(1'000);
  grant.set_alone(alone);
  return response;
}

TEST(HeldTest, F5_H1_StopsBeforeTheDeadlineCountedFromTheSend) {
  HeldLeases held(milliseconds(50));
  const Time sent{};
  held.Add(GrantOf(1), sent);
  const auto lease = held.Next();
  EXPECT_EQ(held.CancelOverdue(sent + milliseconds(949)), sent + milliseconds(950));
  EXPECT_FALSE(lease->cancel);
  held.Extend(lease->grant.attempt(), sent + milliseconds(500), milliseconds(1'000));
  EXPECT_EQ(held.CancelOverdue(sent + milliseconds(950)), sent + milliseconds(1'450));
  EXPECT_EQ(held.CancelOverdue(sent + milliseconds(1'450)), std::nullopt);
  EXPECT_TRUE(lease->cancel);
  EXPECT_TRUE(held.empty());
}

TEST(HeldTest, F5_AFrameOverItsTimeIsStoppedAndStaysHeldToBeReported) {
  HeldLeases held(milliseconds(50));
  v1::AcquireResponse response = GrantOf(1);
  response.mutable_grant(0)->set_limit_ms(300);
  const Time sent{};
  held.Add(response, sent);
  const auto lease = held.Next();
  EXPECT_EQ(held.CancelOverdue(sent), sent + milliseconds(950)) << "not before it is rendered";
  held.Begin(lease, sent + milliseconds(100));
  EXPECT_EQ(held.CancelOverdue(sent + milliseconds(399)), sent + milliseconds(400));
  EXPECT_FALSE(lease->cancel);
  held.CancelOverdue(sent + milliseconds(400));
  EXPECT_TRUE(lease->cancel);
  EXPECT_TRUE(lease->over);
  EXPECT_EQ(held.All().size(), 1u);
}

TEST(HeldTest, F3_H1_AMadePictureIsDeliveredWhateverTheClockSays) {
  HeldLeases held(milliseconds(50));
  held.Add(GrantOf(1), Time{});
  const auto lease = held.Next();
  held.MarkMade(lease);
  held.CancelOverdue(Time{} + milliseconds(5'000));
  held.Lose(lease->grant.attempt());
  EXPECT_FALSE(lease->cancel);
  EXPECT_EQ(held.All().size(), 1u) << "still re-announced";
}

TEST(HeldTest, F3_AGrantAnsweredTwiceIsHeldOnce) {
  HeldLeases held(milliseconds(50));
  held.Add(GrantOf(1), Time{});
  held.Add(GrantOf(1), Time{});
  const auto lease = held.Next();
  held.Remove(lease);
  EXPECT_TRUE(held.empty());
}

// A coordinator of a few lines: frames 1..N, each granted once, with faults on order.
struct Script {
  std::mutex mutex;
  std::condition_variable changed;
  uint64_t next = 1, last = 0;
  std::map<uint64_t, std::string> done;
  std::set<uint64_t> failed, stored, held_at_join;
  std::vector<std::string> ended;  // as Join names them
  std::vector<uint32_t> waited;    // by each Join
  int joins = 0, leaves = 0, renewals = 0;
  std::deque<StatusCode> acquire_faults, complete_faults, put_faults, join_faults;
  bool forget_session = false;
  bool refuse_renewals = false;
  uint32_t limit_ms = 0;
  std::string error;  // of the last failure

  grpc::Status Fault(std::deque<StatusCode>& faults) {
    if (faults.empty()) return grpc::Status::OK;
    const StatusCode code = faults.front();
    faults.pop_front();
    return {code, "on order"};
  }
  bool WaitUntil(const std::function<bool()>& holds) {
    std::unique_lock lock(mutex);
    return changed.wait_for(lock, std::chrono::seconds(20), holds);
  }
};

class ScriptLeases : public LeaseClient {
 public:
  explicit ScriptLeases(Script& script) : script_(script) {}
  Reply<v1::JoinResponse> Join(const v1::JoinRequest& request) override {
    const std::lock_guard lock(script_.mutex);
    script_.ended.assign(request.ended().begin(), request.ended().end());
    script_.waited.push_back(request.waited_ms());
    if (const auto fault = script_.Fault(script_.join_faults); !fault.ok()) return {fault, {}};
    ++script_.joins;
    script_.forget_session = false;
    Reply<v1::JoinResponse> reply;
    reply.value.set_term_ms(kScriptTermMs);
    reply.value.set_renew_every_ms(20);
    for (const auto& holding : request.holding()) {
      script_.held_at_join.insert(holding.attempt().sequence());
      *reply.value.add_adopted() = holding.attempt();
    }
    script_.changed.notify_all();
    return reply;
  }
  Reply<v1::AcquireResponse> Acquire(const v1::AcquireRequest&) override {
    std::unique_lock lock(script_.mutex);
    if (const auto fault = script_.Fault(script_.acquire_faults); !fault.ok()) return {fault, {}};
    if (script_.forget_session) return {{StatusCode::NOT_FOUND, "join again"}, {}};
    if (script_.next > script_.last) {
      script_.changed.wait_for(lock, milliseconds(20),
                               [&] { return shut_ || script_.next <= script_.last; });
      if (script_.next > script_.last) return {};
    }
    v1::AcquireResponse response = GrantOf(script_.next++);
    response.mutable_grant(0)->set_term_ms(kScriptTermMs);
    response.mutable_grant(0)->set_limit_ms(script_.limit_ms);
    return {grpc::Status::OK, response};
  }
  Reply<v1::RenewResponse> Renew(const v1::RenewRequest& request) override {
    const std::lock_guard lock(script_.mutex);
    ++script_.renewals;
    script_.changed.notify_all();
    if (script_.forget_session) return {{StatusCode::NOT_FOUND, "join again"}, {}};
    Reply<v1::RenewResponse> reply;
    for (const auto& entry : request.progress()) {
      auto& verdict = *reply.value.add_verdict();
      *verdict.mutable_attempt() = entry.attempt();
      verdict.set_go_on(!script_.refuse_renewals);
      verdict.set_term_ms(kScriptTermMs);
    }
    return reply;
  }
  Reply<v1::CompleteResponse> Complete(const v1::CompleteRequest& request) override {
    const std::lock_guard lock(script_.mutex);
    if (const auto fault = script_.Fault(script_.complete_faults); !fault.ok()) return {fault, {}};
    Reply<v1::CompleteResponse> reply;
    const uint64_t sequence = request.attempt().sequence();
    if (!script_.stored.contains(sequence)) {
      reply.value.add_outcome(v1::CompleteResponse::MISSING_BLOB);
      return reply;
    }
    script_.done[sequence] = request.result(0).pixel_digest();
    reply.value.add_outcome(v1::CompleteResponse::COMMITTED);
    script_.changed.notify_all();
    return reply;
  }
  Reply<v1::FailResponse> Fail(const v1::FailRequest& request) override {
    const std::lock_guard lock(script_.mutex);
    script_.error = request.error();
    script_.failed.insert(request.attempt().sequence());
    script_.changed.notify_all();
    return {};
  }
  Reply<v1::LeaveResponse> Leave(const v1::LeaveRequest&) override {
    const std::lock_guard lock(script_.mutex);
    ++script_.leaves;
    return {};
  }
  void Shutdown() override {
    const std::lock_guard lock(script_.mutex);
    shut_ = true;
    script_.changed.notify_all();
  }

 private:
  Script& script_;
  bool shut_ = false;
};

class ScriptBlobs : public Blobs {
 public:
  explicit ScriptBlobs(Script& script) : script_(script) {}
  grpc::Status Get(const std::string&, std::string*) override { return grpc::Status::OK; }
  grpc::Status Put(const std::string& digest, const std::string&, std::atomic<uint64_t>*) override {
    const std::lock_guard lock(script_.mutex);
    if (const auto fault = script_.Fault(script_.put_faults); !fault.ok()) return fault;
    script_.stored.insert(std::stoull(digest));
    return grpc::Status::OK;
  }

 private:
  Script& script_;
};

// Frame 13 fails; frame 99 lasts until it is cancelled.
class ScriptRenderer : public UnitRenderer {
 public:
  Result<RenderedUnit> Render(const UnitOrder& order, std::atomic<uint64_t>& progress,
                              const std::atomic<bool>& cancel) override {
    progress.fetch_add(1);
    if (order.frame == 13) return Invalid("thirteen");
    while (order.frame == 99) {
      if (cancel) return MakeError(ErrorCode::kCancelled, "cancelled");
      std::this_thread::yield();
    }
    RenderedUnit unit;
    unit.pixel_digest = "p" + std::to_string(order.frame);
    unit.blob_digest = std::to_string(order.frame);
    unit.picture = "x";
    return unit;
  }
};

class WorkerTest : public testing::Test {
 protected:
  void Start(uint64_t first, uint64_t last) {
    script_.next = first;
    script_.last = last;
    WorkerConfig config;
    config.id = "w";
    config.make_leases = [this] { return std::make_unique<ScriptLeases>(script_); };
    config.make_blobs = [this] { return std::make_unique<ScriptBlobs>(script_); };
    config.make_renderer = [](Blobs&) { return std::make_unique<ScriptRenderer>(); };
    worker_ = Worker::Start(config);
  }
  Script script_;
  std::unique_ptr<Worker> worker_;
};

TEST_F(WorkerTest, F2_RendersDeliversAndLeaves) {
  Start(1, 10);
  EXPECT_TRUE(script_.WaitUntil([&] { return script_.done.size() == 10; }));
  EXPECT_EQ(script_.done[7], "p7");
  worker_->Stop();
  EXPECT_EQ(script_.leaves, 1);
}

TEST_F(WorkerTest, F4_GoesOnThroughFaultsUntilAnswered) {
  script_.join_faults = {StatusCode::UNAVAILABLE, StatusCode::UNAVAILABLE};
  script_.acquire_faults = {StatusCode::UNAVAILABLE, StatusCode::ABORTED,
                            StatusCode::DEADLINE_EXCEEDED};
  script_.put_faults = {StatusCode::UNAVAILABLE, StatusCode::RESOURCE_EXHAUSTED};
  script_.complete_faults = {StatusCode::UNAVAILABLE, StatusCode::NOT_FOUND, StatusCode::INTERNAL};
  Start(1, 5);
  EXPECT_TRUE(script_.WaitUntil([&] { return script_.done.size() == 5; }));
  EXPECT_GE(script_.joins, 2);
}

TEST_F(WorkerTest, F5_AFailedFrameIsToldAndTheRestGoesOn) {
  Start(12, 14);
  EXPECT_TRUE(
      script_.WaitUntil([&] { return script_.done.size() == 2 && script_.failed.contains(13); }));
}

TEST_F(WorkerTest, F5_AFrameOverItsLimitHasFailedAndTheRestGoesOn) {
  script_.limit_ms = 30;
  Start(98, 101);
  EXPECT_TRUE(
      script_.WaitUntil([&] { return script_.done.size() == 3 && script_.failed.contains(99); }));
  EXPECT_NE(script_.error.find("took longer than its 0.03 s (--frame-limit)"), std::string::npos)
      << script_.error;
}

TEST_F(WorkerTest, F4_ReannouncesWhatItHolds) {
  Start(99, 99);
  EXPECT_TRUE(script_.WaitUntil([&] { return script_.renewals > 1; }));
  {
    const std::lock_guard lock(script_.mutex);
    script_.forget_session = true;
  }
  EXPECT_TRUE(script_.WaitUntil([&] { return script_.held_at_join.contains(99); }));
}

TEST_F(WorkerTest, F5_ALostLeaseEndsItsRender) {
  Start(99, 100);
  EXPECT_TRUE(script_.WaitUntil([&] { return script_.renewals > 1; }));
  {
    const std::lock_guard lock(script_.mutex);
    script_.refuse_renewals = true;
  }
  EXPECT_TRUE(script_.WaitUntil([&] { return script_.renewals > 3; }));
  {
    const std::lock_guard lock(script_.mutex);
    script_.refuse_renewals = false;
    script_.last = 103;
  }
  EXPECT_TRUE(script_.WaitUntil([&] { return script_.done.contains(103); }));
  EXPECT_FALSE(script_.done.contains(99));
}

TEST_F(WorkerTest, F3_ARefusalEndsTheWorkerWithItsMessage) {
  script_.join_faults = {StatusCode::FAILED_PRECONDITION};
  Start(1, 1);
  const Result<> ended = worker_->Wait();
  ASSERT_FALSE(ended.ok());
  EXPECT_NE(ended.error().message.find("on order"), std::string::npos);
}

TEST_F(WorkerTest, F5_ANameInUseIsWaitedForAndGivenUpOnceItsHolderIsHeardOf) {
  script_.join_faults = {StatusCode::ABORTED, StatusCode::ABORTED, StatusCode::ALREADY_EXISTS};
  Start(1, 1);
  ASSERT_FALSE(worker_->Wait().ok());
  ASSERT_EQ(script_.waited.size(), 3u);
  EXPECT_EQ(script_.waited[0], 0u);
  EXPECT_GE(script_.waited[1], 25u) << "counted from the first try";
  EXPECT_GE(script_.waited[2], script_.waited[1] + 50);
  EXPECT_TRUE(worker_->Stop()) << "no session of its own is left behind";
}

TEST(SessionNoteTest, F5_KnowsTheSessionsThatAreOverAndOnlyThose) {
  farm_test::TempDir folder;
  setenv("XDG_RUNTIME_DIR", folder.path().c_str(), 1);
  const std::string one = NewSessionName(), two = NewSessionName(), three = NewSessionName();
  EXPECT_NE(one, two);
  auto note = SessionNote::Take("w", "host:1", one);
  ASSERT_NE(note, nullptr);
  EXPECT_TRUE(note->ended().empty());
  EXPECT_EQ(SessionNote::Take("w", "host:1", two), nullptr) << "its holder is alive";
  EXPECT_TRUE(SessionNote::Take("w", "host:2", two)->ended().empty()) << "of another farm";
  EXPECT_TRUE(SessionNote::Take("v", "host:1", two)->ended().empty());
  note.reset();
  note = SessionNote::Take("w", "host:1", two);
  EXPECT_EQ(note->ended(), (std::vector<std::string>{one}));
  note.reset();
  note = SessionNote::Take("w", "host:1", three);
  EXPECT_EQ(note->ended(), (std::vector<std::string>{one, two}));
  note->Forget();
  note.reset();
  EXPECT_TRUE(SessionNote::Take("w", "host:1", one)->ended().empty());
  for (int i = 0; i < 40; ++i) SessionNote::Take("x", "host:1", NewSessionName());
  EXPECT_EQ(SessionNote::Take("x", "host:1", one)->ended().size(), 15u);
  unsetenv("XDG_RUNTIME_DIR");
}

TEST(ChildRendererTest, F5_ACrashIsTheFramesAndNamed) {
  std::atomic<uint64_t> progress{0};
  std::atomic<bool> cancel{false};
  const auto missing = MakeChildRenderer("/nonexistent/program", "x", 1);
  EXPECT_EQ(missing->Render({"s", 1, "k"}, progress, cancel).error().code, ErrorCode::kUnavailable);
  const auto silent = MakeChildRenderer("/bin/true", "x", 1);
  EXPECT_EQ(silent->Render({"s", 1, "k"}, progress, cancel).error().code, ErrorCode::kInternal);
}

}  // namespace
}  // namespace fjord::worker
