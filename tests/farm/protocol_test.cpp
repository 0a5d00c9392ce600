// The conversations of jobs.proto, leases.proto and blobs.proto with a real coordinator over real
// gRPC, in one process. Its planner is the test's; what workers render is text.
#include <gtest/gtest.h>

#include <array>
#include <thread>

#include "fjord/v1/leases.pb.h"
#include "server/server.h"
#include "server/state/types.h"
#include "talk.h"
#include "temp_dir.h"

namespace fjord::server {
namespace {

using farm_test::Said;
using farm_test::Talk;
using farm_test::TempDir;
using Outcome = v1::CompleteResponse;

class NamePlanner : public FramePlanner {
 public:
  Result<uint32_t> LastFrame(const Digest&) override { return 1'000u; }
  Result<Digest> KeyOf(const Digest& scene, uint32_t frame) override {
    return Sha256Of(scene.Hex() + std::to_string(frame));
  }
};

class ProtocolTest : public testing::Test {
 protected:
  void SetUp() override { StartServer(); }
  void StartServer() {
    ServerConfig config;
    config.listen = "127.0.0.1:" + std::to_string(port_);
    config.data_dir = data_.path();
    config.planner = &planner_;
    config.machine.term_ms = term_ms_;
    config.machine.renew_ms = 100;
    Result<std::unique_ptr<Server>> server = Server::Start(config);
    ASSERT_TRUE(server.ok()) << server.error().ToString();
    server_ = std::move(*server);
    talk_ = std::make_unique<Talk>(server_->address());
  }
  // Not a crash, but the machine is as new as after one.
  void Restart() {
    server_.reset();
    StartServer();
  }
  v1::Grant Take(const std::string& session, uint64_t number) {
    const auto said = talk_->Acquire(session, number);
    EXPECT_TRUE(said.ok()) << said.status.error_message();
    EXPECT_EQ(said.value.grant_size(), 1);
    return said.value.grant_size() > 0 ? said.value.grant(0) : v1::Grant();
  }
  Outcome::Outcome OutcomeOf(const Said<v1::CompleteResponse>& said) {
    EXPECT_TRUE(said.ok()) << said.status.error_message();
    return said.value.outcome_size() == 1 ? said.value.outcome(0) : Outcome::OUTCOME_UNSPECIFIED;
  }

  TempDir data_;
  NamePlanner planner_;
  int64_t term_ms_ = 10'000;
  int port_ = 0;
  std::unique_ptr<Server> server_;
  std::unique_ptr<Talk> talk_;
};

TEST_F(ProtocolTest, F2_AJobFromSubmitToTheEnd) {
  const auto submitted = talk_->SubmitFrames(5);
  ASSERT_TRUE(submitted.ok()) << submitted.status.error_message();
  const std::string job = submitted.value.job_id();
  std::thread watcher_thread;
  Said<std::vector<v1::WatchResponse>> watched;
  watcher_thread = std::thread([&] { watched = Talk(server_->address()).WatchToTheEnd(job); });
  const auto joined = talk_->Join("w", "s");
  ASSERT_TRUE(joined.ok());
  EXPECT_EQ(joined.value.epoch(), 1u);
  EXPECT_EQ(joined.value.term_ms(), 10'000u);
  std::vector<uint32_t> frames;
  for (uint64_t number = 1; number <= 5; ++number) {
    const v1::Grant grant = Take("s", number);
    frames.push_back(grant.unit(0).frame());
    EXPECT_EQ(OutcomeOf(talk_->Complete("s", grant, "picture " + std::to_string(number))),
              Outcome::COMMITTED);
  }
  watcher_thread.join();
  EXPECT_EQ(frames, (std::vector<uint32_t>{1, 5, 3, 2, 4}));
  ASSERT_TRUE(watched.ok()) << watched.status.error_message();
  ASSERT_FALSE(watched.value.empty());
  EXPECT_EQ(watched.value.back().job().state(), v1::DONE);
  EXPECT_EQ(watched.value.back().job().frames().done(), 5u);
  std::map<uint32_t, v1::FrameState> last;
  for (const auto& message : watched.value) {
    for (const v1::Frame& frame : message.changed()) last[frame.number()] = frame.state();
  }
  EXPECT_EQ(last.size(), 5u);
  for (const auto& [number, state] : last) EXPECT_EQ(state, v1::FRAME_DONE) << number;

  const auto listed = talk_->Frames(job, 0, 3);
  ASSERT_EQ(listed.value.frame_size(), 3);
  EXPECT_EQ(listed.value.next_frame(), 4u);
  EXPECT_EQ(listed.value.frame(0).pixel_digest(), Sha256Of("picture 1").Hex());
  EXPECT_EQ(talk_->Get(listed.value.frame(0).blob_digest()).value, "picture 1");
  EXPECT_EQ(listed.value.frame(0).worker(), "w");
  EXPECT_EQ(talk_->Frames(job, 4).value.frame_size(), 2);
  // A second watch of an ended job: how it is, and the end.
  EXPECT_EQ(talk_->WatchToTheEnd(job).value.size(), 1u);
}

TEST_F(ProtocolTest, F1_SubmitIsIdempotent) {
  const auto first = talk_->SubmitFrames(5), again = talk_->SubmitFrames(5);
  EXPECT_FALSE(first.value.existed());
  EXPECT_TRUE(again.value.existed());
  EXPECT_EQ(first.value.job_id(), again.value.job_id());
  EXPECT_EQ(talk_->SubmitFrames(6).code(), grpc::StatusCode::ALREADY_EXISTS);
  Restart();
  EXPECT_TRUE(talk_->SubmitFrames(5).value.existed());
}

TEST_F(ProtocolTest, F1_SubmitNamesWhatIsWrong) {
  v1::SubmitRequest request;
  request.set_protocol(kProtocol);
  request.set_request_id("r");
  request.set_scene_digest(Sha256Of("nothing").Hex());
  EXPECT_EQ(talk_->Submit(request).code(), grpc::StatusCode::NOT_FOUND);
  request.set_scene_digest(talk_->PutBytes("\xff\xff not a scene"));
  const auto said = talk_->Submit(request);
  EXPECT_EQ(said.code(), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_NE(said.status.error_message().find("not a scene"), std::string::npos);
  v1::Scene scene;
  scene.mutable_output()->set_frames(10);
  request.set_scene_digest(talk_->PutBytes(scene.SerializeAsString()));
  request.set_first_frame(5);
  request.set_last_frame(11);
  const auto outside = talk_->Submit(request);
  EXPECT_EQ(outside.code(), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_NE(outside.status.error_message().find("frames 1-10"), std::string::npos);
  request.set_last_frame(0);
  request.set_first_frame(0);
  const auto spans = [&](std::vector<std::array<uint32_t, 3>> all) {
    request.clear_span();
    for (const auto& [first, last, step] : all) {
      v1::FrameSpan& span = *request.add_span();
      span.set_first(first);
      span.set_last(last);
      span.set_step(step);
    }
    return talk_->Submit(request);
  };
  for (const auto& wrong : std::vector<std::vector<std::array<uint32_t, 3>>>{
           {{0, 3, 1}}, {{3, 2, 1}}, {{1, 5, 1}, {5, 6, 1}}, {{5, 6, 1}, {1, 2, 1}}, {{1, 4, 2}}}) {
    const auto refused = spans(wrong);
    EXPECT_EQ(refused.code(), grpc::StatusCode::INVALID_ARGUMENT);
    EXPECT_EQ(refused.status.error_message().substr(0, 5), "span:");
  }
  EXPECT_NE(spans({{1, 11, 2}}).status.error_message().find("frames 1-10"), std::string::npos);
  request.clear_span();
  request.set_last_frame(10);
  request.set_protocol("9.1");
  EXPECT_EQ(talk_->Submit(request).code(), grpc::StatusCode::FAILED_PRECONDITION);
  request.set_protocol("1.7");
  request.set_after_job("77");
  EXPECT_EQ(talk_->Submit(request).code(), grpc::StatusCode::NOT_FOUND);
  request.clear_after_job();
  EXPECT_TRUE(talk_->Submit(request).ok()) << "another minor number is fine";
  scene.add_objects()->mutable_shape()->mutable_file()->set_digest(Sha256Of("lost").Hex());
  request.set_request_id("r2");
  request.set_scene_digest(talk_->PutBytes(scene.SerializeAsString()));
  EXPECT_EQ(talk_->Submit(request).code(), grpc::StatusCode::NOT_FOUND);
}

TEST_F(ProtocolTest, F1_AJobHasTheFramesOfItsSpansAfterARestartToo) {
  v1::SubmitRequest request;
  request.set_protocol(kProtocol);
  request.set_request_id("spans");
  v1::Scene scene;
  scene.set_name("\x1b[31m spans");
  scene.mutable_output()->set_frames(40);
  request.set_scene_digest(talk_->PutBytes(scene.SerializeAsString()));
  v1::FrameSpan* span = request.add_span();
  span->set_first(3);
  span->set_last(3);
  span = request.add_span();
  span->set_first(20);
  span->set_last(40);
  span->set_step(10);
  request.set_frame_limit_ms(2'500);
  const auto submitted = talk_->Submit(request);
  ASSERT_TRUE(submitted.ok()) << submitted.status.error_message();
  for (int start = 0; start < 2; ++start) {
    const v1::Job job = talk_->GetJob(submitted.value.job_id()).value;
    EXPECT_EQ(job.frames().total(), 4u);
    ASSERT_EQ(job.span_size(), 2);
    EXPECT_EQ(job.span(1).step(), 10u);
    EXPECT_EQ(job.frame_limit_ms(), 2'500u);
    std::vector<uint32_t> numbers;
    for (uint32_t from = 0;;) {
      const auto page = talk_->Frames(job.id(), from, 3);
      for (const v1::Frame& frame : page.value.frame()) numbers.push_back(frame.number());
      if (page.value.next_frame() == 0) break;
      from = page.value.next_frame();
    }
    EXPECT_EQ(numbers, (std::vector<uint32_t>{3, 20, 30, 40}));
    Restart();
  }
  scene.set_name(std::string(201, 'n'));
  request.set_request_id("long");
  request.set_scene_digest(talk_->PutBytes(scene.SerializeAsString()));
  EXPECT_EQ(talk_->Submit(request).status.error_message(),
            "name: the scene's has 201 bytes; at most 200");
}

TEST_F(ProtocolTest, F2_ADeletedJobIsGoneForWatchersAndAfterARestart) {
  const std::string job = talk_->SubmitFrames(1).value.job_id();
  EXPECT_EQ(talk_->Command(job, v1::CommandRequest::DELETE).code(),
            grpc::StatusCode::FAILED_PRECONDITION);
  ASSERT_TRUE(talk_->Command(job, v1::CommandRequest::CANCEL).ok());
  EXPECT_EQ(talk_->Command(job, v1::CommandRequest::DELETE).value.id(), job);
  for (int start = 0; start < 2; ++start) {
    EXPECT_EQ(talk_->GetJob(job).code(), grpc::StatusCode::NOT_FOUND);
    EXPECT_EQ(talk_->WatchToTheEnd(job).code(), grpc::StatusCode::NOT_FOUND);
    EXPECT_EQ(talk_->Command(job, v1::CommandRequest::DELETE).code(), grpc::StatusCode::NOT_FOUND);
    Restart();
  }
  EXPECT_NE(talk_->SubmitFrames(1).value.job_id(), job);
}

TEST_F(ProtocolTest, F3_DuplicateConflictAndThirdWorker) {
  const std::string job = talk_->SubmitFrames(1).value.job_id();
  for (const char* name : {"x", "y", "z"}) ASSERT_TRUE(talk_->Join(name, name).ok());
  const v1::Grant grant = Take("x", 1);
  EXPECT_EQ(OutcomeOf(talk_->CompleteWith("x", grant, Sha256Of("a").Hex(), Sha256Of("a").Hex())),
            Outcome::MISSING_BLOB);
  EXPECT_EQ(OutcomeOf(talk_->Complete("x", grant, "a")), Outcome::COMMITTED);
  EXPECT_EQ(OutcomeOf(talk_->Complete("x", grant, "a")), Outcome::DUPLICATE);
  EXPECT_EQ(talk_->GetJob(job).value.state(), v1::DONE);
  EXPECT_EQ(OutcomeOf(talk_->Complete("y", grant, "b")), Outcome::CONFLICT);
  EXPECT_EQ(talk_->GetJob(job).value.frames().done(), 0u);
  Restart();  // the alarm outlives the coordinator
  for (const char* name : {"x", "y", "z"}) ASSERT_TRUE(talk_->Join(name, name).ok());
  EXPECT_EQ(talk_->GetJob(job).value.frames().done(), 0u);
  EXPECT_EQ(OutcomeOf(talk_->Complete("z", grant, "b")), Outcome::COMMITTED);
  const auto frames = talk_->Frames(job);
  EXPECT_EQ(frames.value.frame(0).pixel_digest(), Sha256Of("b").Hex());
  EXPECT_EQ(talk_->Complete("x", grant, "a").code(), grpc::StatusCode::PERMISSION_DENIED);
  const auto workers = talk_->Workers();
  for (const v1::WorkerInfo& worker : workers.value.worker()) {
    EXPECT_EQ(worker.state() == v1::WorkerInfo::QUARANTINED, worker.id() == "x") << worker.id();
  }
}

TEST_F(ProtocolTest, F3_AskingAgainGivesTheSameGrant) {
  talk_->SubmitFrames(5);
  talk_->Join("w", "s");
  const v1::Grant grant = Take("s", 1), again = Take("s", 1), next = Take("s", 2);
  EXPECT_EQ(grant.attempt().sequence(), again.attempt().sequence());
  EXPECT_NE(grant.attempt().sequence(), next.attempt().sequence());
  EXPECT_EQ(talk_->Acquire("s", 1).code(), grpc::StatusCode::ABORTED);
}

TEST_F(ProtocolTest, F3_UnknownSessionMustJoin) {
  EXPECT_EQ(talk_->Acquire("nobody", 1).code(), grpc::StatusCode::NOT_FOUND);
  v1::Grant grant;
  grant.mutable_attempt()->set_epoch(1);
  grant.mutable_attempt()->set_sequence(1);
  EXPECT_EQ(talk_->Renew("nobody", grant).code(), grpc::StatusCode::NOT_FOUND);
  EXPECT_TRUE(talk_->Leave("nobody").ok());
}

TEST_F(ProtocolTest, F4_RestartedCoordinatorAdoptsAndTakesLateResults) {
  const std::string job = talk_->SubmitFrames(3).value.job_id();
  talk_->Join("w", "s");
  const v1::Grant done = Take("s", 1), held = Take("s", 2), dropped = Take("s", 3);
  EXPECT_EQ(OutcomeOf(talk_->Complete("s", done, "one")), Outcome::COMMITTED);
  Restart();
  EXPECT_EQ(server_->epoch(), 2u);
  EXPECT_EQ(talk_->GetJob(job).value.frames().done(), 1u) << "nothing that was answered is lost";
  EXPECT_EQ(talk_->Renew("s", held).code(), grpc::StatusCode::NOT_FOUND);
  const auto joined = talk_->Join("w", "s", {held});
  ASSERT_EQ(joined.value.adopted_size(), 1);
  EXPECT_EQ(joined.value.adopted(0).epoch(), 1u);
  EXPECT_TRUE(talk_->Renew("s", held).value.verdict(0).go_on());
  EXPECT_FALSE(talk_->Renew("s", dropped).value.verdict(0).go_on());
  EXPECT_EQ(talk_->Acquire("s", 4, 50).value.grant_size(), 0) << "one term of patience";
  EXPECT_EQ(OutcomeOf(talk_->Complete("s", held, "two")), Outcome::COMMITTED);
  EXPECT_EQ(OutcomeOf(talk_->Complete("s", dropped, "three")), Outcome::COMMITTED);
  EXPECT_EQ(talk_->GetJob(job).value.state(), v1::DONE);
}

TEST_F(ProtocolTest, F5_FailuresAreFencedAndShown) {
  const std::string job = talk_->SubmitFrames(1).value.job_id();
  talk_->Join("w", "s");
  for (uint64_t number = 1; number <= 3; ++number) {
    const v1::Grant grant = Take("s", number);
    EXPECT_TRUE(talk_->Fail("s", grant).value.accepted());
    EXPECT_FALSE(talk_->Fail("s", grant).value.accepted()) << "once";
  }
  const v1::Job failed = talk_->GetJob(job).value;
  EXPECT_EQ(failed.state(), v1::FAILED);
  EXPECT_NE(failed.error().find("frame 1: worker w: it broke"), std::string::npos)
      << failed.error();
  EXPECT_EQ(talk_->Frames(job).value.frame(0).attempts(), 3u);
  EXPECT_EQ(talk_->Command(job, v1::CommandRequest::RETRY).value.state(), v1::QUEUED);
  EXPECT_EQ(OutcomeOf(talk_->Complete("s", Take("s", 4), "x")), Outcome::COMMITTED);
  EXPECT_EQ(talk_->Command(job, v1::CommandRequest::PAUSE).code(),
            grpc::StatusCode::FAILED_PRECONDITION);
}

TEST_F(ProtocolTest, F8_StrangeRequestsAreNamedAndChangeNothing) {
  v1::JoinRequest join;
  join.set_protocol("2.0");
  EXPECT_EQ(talk_->Join(join).code(), grpc::StatusCode::FAILED_PRECONDITION);
  join.set_protocol(kProtocol);
  const auto said = talk_->Join(join);
  EXPECT_EQ(said.code(), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_EQ(said.status.error_message(), "worker_id: is empty");
  EXPECT_EQ(talk_->GetJob("1; DROP TABLE job").code(), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_EQ(talk_->GetJob("12").code(), grpc::StatusCode::NOT_FOUND);
  EXPECT_EQ(talk_->WatchToTheEnd("12").code(), grpc::StatusCode::NOT_FOUND);
  EXPECT_EQ(talk_->WatchToTheEnd("x").code(), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_EQ(talk_->Missing({"zz"}).code(), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_EQ(talk_->Jobs(5'000).code(), grpc::StatusCode::INVALID_ARGUMENT);
}

TEST_F(ProtocolTest, F8_BlobsAreCheckedAgainstTheirDigests) {
  const std::string bytes(3'000'000, 'x'), digest = Sha256Of(bytes).Hex();
  const std::string a = bytes.substr(0, 1 << 20), b = bytes.substr(0, bytes.size() - (2 << 20));
  EXPECT_EQ(talk_->Get(digest).code(), grpc::StatusCode::NOT_FOUND);
  EXPECT_EQ(talk_->Missing({digest}).value.digest_size(), 1);
  EXPECT_EQ(talk_->Put(digest, bytes.size(), {a, b}).error_code(),
            grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_EQ(talk_->Put(digest, bytes.size(), {a, a, b, "y"}).error_code(),
            grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_EQ(talk_->Put(Sha256Of("other").Hex(), bytes.size(), {a, a, b}).error_code(),
            grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_EQ(talk_->Put(digest, kMaxBlob + 1, {a}).error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_EQ(talk_->Missing({digest}).value.digest_size(), 1) << "nothing of it is there";
  bool existed = true;
  EXPECT_TRUE(talk_->Put(digest, bytes.size(), {a, a, b}, &existed).ok());
  EXPECT_FALSE(existed);
  EXPECT_TRUE(talk_->Put(digest, bytes.size(), {a, a, b}, &existed).ok());
  EXPECT_TRUE(existed);
  EXPECT_EQ(talk_->Get(digest).value, bytes);
  EXPECT_EQ(talk_->Missing({digest}).value.digest_size(), 0);
  EXPECT_EQ(talk_->PutBytes(""), Sha256Of("").Hex());
  EXPECT_EQ(talk_->Get(Sha256Of("").Hex()).value, "");
}

TEST_F(ProtocolTest, F9_AWaiterThatDiesIsGivenNothing) {
  talk_->Join("w", "s");
  talk_->Join("v", "t");
  std::thread waiter([&] {
    grpc::ClientContext context;
    context.set_deadline(std::chrono::system_clock::now() + std::chrono::milliseconds(100));
    v1::AcquireRequest request;
    request.set_session_id("s");
    request.set_request(1);
    request.set_want(1);
    request.set_wait_ms(5'000);
    v1::AcquireResponse response;
    EXPECT_EQ(
        v1::Leases::NewStub(talk_->channel())->Acquire(&context, request, &response).error_code(),
        grpc::StatusCode::DEADLINE_EXCEEDED);
  });
  waiter.join();
  // Heard after the cancel, on the same connection.
  talk_->Workers();
  talk_->SubmitFrames(1);
  EXPECT_EQ(Take("t", 1).unit(0).frame(), 1u);
}

TEST_F(ProtocolTest, F2_JobsAreListedInPages) {
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(talk_->SubmitFrames(2, "r" + std::to_string(i)).ok());
  const auto first = talk_->Jobs(3);
  ASSERT_EQ(first.value.job_size(), 3);
  const auto second = talk_->Jobs(3, first.value.next_page_token());
  ASSERT_EQ(second.value.job_size(), 2);
  EXPECT_EQ(second.value.next_page_token(), "");
}

TEST(ServerStartTest, F10_OnlyLoopbackWithoutSecrets) {
  for (const char* address : {"127.0.0.1:0", "localhost:7433", "[::1]:80", "127.1.2.3:1"}) {
    EXPECT_TRUE(*IsLoopback(address)) << address;
  }
  for (const char* address : {"0.0.0.0:0", "10.0.0.1:7433", "127.evil.example.org:1", "[::]:0",
                              "host:1", "127.0.0.1.example:1"}) {
    EXPECT_FALSE(*IsLoopback(address)) << address;
  }
  for (const char* address :
       {"", "7433", ":7433", "127.0.0.1", "127.0.0.1:", "127.0.0.1:99999", "a:b"}) {
    EXPECT_FALSE(IsLoopback(address).ok()) << address;
  }
  TempDir data;
  ServerConfig config;
  config.listen = "0.0.0.0:0";
  config.data_dir = data.path();
  const auto server = Server::Start(config);
  ASSERT_FALSE(server.ok());
  EXPECT_EQ(server.error().code, ErrorCode::kUsage);
  EXPECT_NE(server.error().message.find("TLS and tokens"), std::string::npos);
}

TEST(ServerStartTest, F4_OneCoordinatorADataFolderAndAPort) {
  TempDir data, other;
  NamePlanner planner;
  ServerConfig config;
  config.listen = "127.0.0.1:0";
  config.data_dir = data.path();
  config.planner = &planner;
  const auto first = Server::Start(config);
  ASSERT_TRUE(first.ok());
  const auto second = Server::Start(config);
  ASSERT_FALSE(second.ok());
  EXPECT_NE(second.error().message.find("another coordinator (process"), std::string::npos)
      << second.error().message;
  config.data_dir = other.path();
  config.listen = first.value()->address();
  const auto third = Server::Start(config);
  ASSERT_FALSE(third.ok());
  EXPECT_NE(third.error().message.find("cannot listen"), std::string::npos);
}

}  // namespace
}  // namespace fjord::server
