// Farm commands against servers that are down, strange, of another version, or go away.
#include <gmock/gmock.h>
#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>

#include <atomic>
#include <nlohmann/json.hpp>

#include "client/exit_code.h"
#include "client/farm_client.h"
#include "fjord/v1/jobs.grpc.pb.h"
#include "tests/client/run_program.h"

namespace fjord::testing {
namespace {

using ::testing::HasSubstr;

// A coordinator of the test's own.
class FakeJobs : public v1::Jobs::Service {
 public:
  grpc::Status GetJob(grpc::ServerContext*, const v1::GetJobRequest* request,
                      v1::Job* job) override {
    if (request->job_id() != "7")
      return {grpc::StatusCode::NOT_FOUND, "there is no job '" + request->job_id() + "'"};
    *job = Job(v1::RUNNING);
    return grpc::Status::OK;
  }

  grpc::Status Submit(grpc::ServerContext*, const v1::SubmitRequest*,
                      v1::SubmitResponse* response) override {
    response->set_job_id("7");
    if (takes_jobs) return grpc::Status::OK;
    return {grpc::StatusCode::FAILED_PRECONDITION, "protocol 2.0 is spoken here"};
  }

  grpc::Status ListFrames(grpc::ServerContext*, const v1::ListFramesRequest*,
                          v1::ListFramesResponse*) override {
    return grpc::Status::OK;
  }

  // The first stream breaks off in the middle, the next ones go on to `end`.
  grpc::Status Watch(grpc::ServerContext*, const v1::WatchRequest*,
                     grpc::ServerWriter<v1::WatchResponse>* writer) override {
    v1::WatchResponse message;
    *message.mutable_job() = Job(v1::RUNNING);
    writer->Write(message);
    if (streams_++ == 0 || end == v1::JOB_STATE_UNSPECIFIED)
      return {grpc::StatusCode::UNAVAILABLE, "going down"};
    *message.mutable_job() = Job(end);
    writer->Write(message);
    return grpc::Status::OK;
  }

  v1::JobState end = v1::DONE;
  bool takes_jobs = false;

 private:
  static v1::Job Job(v1::JobState state) {
    v1::Job job;
    job.set_id("7");
    job.set_name("hill");
    job.set_state(state);
    job.set_first_frame(1);
    job.set_last_frame(10);
    job.mutable_frames()->set_total(10);
    job.mutable_frames()->set_done(state == v1::DONE ? 10 : 4);
    job.mutable_frames()->set_failed(state == v1::FAILED ? 6 : 0);
    job.mutable_frames()->set_waiting(state == v1::RUNNING ? 6 : 0);
    if (state == v1::FAILED) job.set_error("frame 5: too deep");
    return job;
  }

  std::atomic<int> streams_{0};
};

class FakeBlobs : public v1::Blobs::Service {
 public:
  grpc::Status Missing(grpc::ServerContext*, const v1::MissingRequest*,
                       v1::MissingResponse*) override {
    if (has_all) return grpc::Status::OK;
    return {grpc::StatusCode::UNIMPLEMENTED, ""};
  }
  bool has_all = false;
};

class FarmCliTest : public ::testing::Test {
 protected:
  // Starts a server with that service (may be null); its address.
  std::string Serve(grpc::Service* service) {
    grpc::ServerBuilder builder;
    int port = 0;
    builder.AddListeningPort("127.0.0.1:0", grpc::InsecureServerCredentials(), &port);
    if (service != nullptr) builder.RegisterService(service);
    builder.RegisterService(&blobs_);
    server_ = builder.BuildAndStart();
    return "127.0.0.1:" + std::to_string(port);
  }

  void TearDown() override {
    if (server_) server_->Shutdown();
  }

  FakeBlobs blobs_;
  FakeJobs jobs_;
  std::unique_ptr<grpc::Server> server_;
  const ScratchFolder folder_;
};

TEST_F(FarmCliTest, AServerThatIsDownIsCode3WithTheRemedy) {
  const std::string scene = folder_.Write("tiny.scene", TinyScene(2));
  const std::vector<std::vector<std::string>> commands = {{"submit", scene},
                                                          {"status", "7"},
                                                          {"watch", "7"},
                                                          {"jobs"},
                                                          {"workers"},
                                                          {"fetch", "7", "-o", folder_ / "out"},
                                                          {"cancel", "7"},
                                                          {"priority", "7", "3"},
                                                          {"workers", "drain", "w"},
                                                          {"movie", "7", "-o", folder_ / "m.mp4"}};
  for (std::vector<std::string> command : commands) {
    command.push_back("--server");
    command.push_back("127.0.0.1:1");
    const bool waits = command[0] == "submit" || command[0] == "status" || command[0] == "fetch" ||
                       command[0] == "watch";
    if (waits) command.insert(command.end(), {"--patience", "0"});
    const ProgramRun run = RunFjord(command);  // no gRPC runs here in this test
    EXPECT_EQ(run.code, 3) << command[0] << run.err;
    EXPECT_EQ(run.out, "") << command[0];
    EXPECT_THAT(run.err, HasSubstr("127.0.0.1:1")) << command[0];
    EXPECT_THAT(run.err, HasSubstr("fjord farm")) << command[0];
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  }
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "m.mp4"));
}

TEST_F(FarmCliTest, TheServerComesFromTheEnvironment) {
  ProgramOptions options;
  options.environment = {"FJORD_SERVER=" + Serve(&jobs_)};
  const ProgramRun run = RunFjordAnew({"status", "7", "--json"}, options);
  EXPECT_EQ(run.code, 0) << run.err;
  const auto json = nlohmann::json::parse(run.out);
  EXPECT_EQ(json["state"], "running");
  EXPECT_EQ(json["frames"]["waiting"], 6);
  EXPECT_EQ(json["frames"]["total"], 10);
}

TEST_F(FarmCliTest, AnotherVersionIsCode3) {
  const std::string scene = folder_.Write("tiny.scene", TinyScene(2));
  const std::string nothing = Serve(nullptr);
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"status", "7"}, {"submit", scene}}) {
    std::vector<std::string> arguments = command;
    arguments.insert(arguments.end(), {"--server", nothing});
    const ProgramRun run = RunFjordAnew(arguments);
    EXPECT_EQ(run.code, 3) << run.err;
    EXPECT_THAT(run.err, HasSubstr("another version"));
  }
}

TEST_F(FarmCliTest, AnUnknownJobIsCode1) {
  const ProgramRun run = RunFjordAnew({"status", "8", "--server", Serve(&jobs_)});
  EXPECT_EQ(run.code, 1);
  EXPECT_THAT(run.err, HasSubstr("there is no job '8'"));
}

TEST_F(FarmCliTest, WatchGoesOnWhenTheServerComesBack) {
  const ProgramRun run = RunFjordAnew({"watch", "7", "--server", Serve(&jobs_)});
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("trying again"));
  EXPECT_THAT(run.err, HasSubstr("10 of 10 frames"));
  EXPECT_EQ(run.out, "");
}

TEST_F(FarmCliTest, WatchOfAServerThatStaysAwayIsCode3) {
  jobs_.end = v1::JOB_STATE_UNSPECIFIED;
  const ProgramRun run = RunFjordAnew({"watch", "7", "--patience", "0", "--server", Serve(&jobs_)});
  EXPECT_EQ(run.code, 3) << run.err;
}

TEST_F(FarmCliTest, SubmitOfAServerThatGoesAwayStillSaysTheJob) {
  jobs_.takes_jobs = blobs_.has_all = true;
  jobs_.end = v1::JOB_STATE_UNSPECIFIED;
  const std::string scene = folder_.Write("tiny.scene", TinyScene(2));
  const ProgramRun run = RunFjordAnew(
      {"submit", scene, "--wait", "--json", "--patience", "0", "--server", Serve(&jobs_)});
  EXPECT_EQ(run.code, 3) << run.err;
  EXPECT_THAT(run.err, HasSubstr("fjord watch 7 follows it"));
  EXPECT_EQ(nlohmann::json::parse(run.out)["id"], "7");
}

TEST_F(FarmCliTest, WhatIsNoAddressIsRefusedWithItsPlace) {
  const std::string scene = folder_.Write("tiny.scene", TinyScene(2));
  const std::vector<std::vector<std::string>> commands = {{"submit", scene},
                                                          {"status", "7"},
                                                          {"watch", "7"},
                                                          {"jobs"},
                                                          {"workers"},
                                                          {"cancel", "7"},
                                                          {"fetch", "7", "-o", folder_ / "out"}};
  for (const auto& [address, what] :
       {std::pair<std::string, std::string>{"localhost", "has no port"},
        {"127.0.0.1:", "has no port"},
        {"127.0.0.1:65536", "has a port above 65535"},
        {"127.0.0.1:0", "has port 0"},
        {"127.0.0.1:http", "has a port that is no number"},
        {":7433", "has no host"},
        {"::1:7433", "has more than one colon"}}) {
    for (std::vector<std::string> command : commands) {
      command.insert(command.end(), {"--server", address});
      const ProgramRun run = RunFjord(command);
      EXPECT_EQ(run.code, 2) << command[0] << run.err;
      EXPECT_THAT(run.err, HasSubstr("--server \"" + address + "\" " + what)) << command[0];
      EXPECT_THAT(run.err, HasSubstr("write HOST:PORT, as 127.0.0.1:7433"));
    }
    const ProgramRun farm = RunFjord({"farm", "--listen", address, "--data", folder_ / "data"});
    if (address == "127.0.0.1:0") continue;  // takes a free one
    EXPECT_EQ(farm.code, 2) << farm.err;
    EXPECT_THAT(farm.err, HasSubstr("--listen \"" + address + "\" " + what));
    const ProgramRun server =
        RunProgram({FJORD_SERVER_PROGRAM, "--listen", address, "--data", folder_ / "data"});
    EXPECT_EQ(server.code, 2) << server.err;
    EXPECT_THAT(server.err, HasSubstr("--listen \"" + address + "\" " + what));
    const ProgramRun worker = RunProgram({FJORD_WORKER_PROGRAM, "--server", address});
    EXPECT_EQ(worker.code, 2) << worker.err;
    EXPECT_THAT(worker.err, HasSubstr("\"" + address + "\" " + what));
  }
  ProgramOptions options;
  options.environment = {"FJORD_SERVER=localhost:99999"};
  const ProgramRun run = RunFjord({"jobs"}, options);
  EXPECT_EQ(run.code, 2);
  EXPECT_THAT(run.err, HasSubstr("$FJORD_SERVER \"localhost:99999\" has a port above 65535"));
}

// A coordinator that goes away in the middle of a command and comes back is waited for.
class RestartingJobs : public FakeJobs {
 public:
  grpc::Status ListFrames(grpc::ServerContext* context, const v1::ListFramesRequest* request,
                          v1::ListFramesResponse* response) override {
    if (away-- > 0) return {grpc::StatusCode::UNAVAILABLE, "starting"};
    return FakeJobs::ListFrames(context, request, response);
  }
  grpc::Status Submit(grpc::ServerContext* context, const v1::SubmitRequest* request,
                      v1::SubmitResponse* response) override {
    if (away-- > 0) return {grpc::StatusCode::UNAVAILABLE, "starting"};
    return FakeJobs::Submit(context, request, response);
  }
  std::atomic<int> away{3};
};

TEST_F(FarmCliTest, ACoordinatorThatIsStartedAgainIsWaitedFor) {
  RestartingJobs jobs;
  jobs.takes_jobs = blobs_.has_all = true;
  const std::string server = Serve(&jobs);
  const ProgramRun status = RunFjordAnew({"status", "7", "--frames", "--json", "--server", server});
  EXPECT_EQ(status.code, 0) << status.err;
  EXPECT_THAT(status.err, HasSubstr("does not answer; trying again for 20 s"));
  jobs.away = 3;
  const std::string scene = folder_.Write("tiny.scene", TinyScene(2));
  const ProgramRun submit = RunFjordAnew({"submit", scene, "--server", server});
  EXPECT_EQ(submit.code, 0) << submit.err;
  EXPECT_EQ(submit.out, "7\n");
  EXPECT_THAT(submit.err, HasSubstr("trying again for 20 s"));
  jobs.away = 1'000'000;
  const ProgramRun given_up =
      RunFjordAnew({"status", "7", "--frames", "--patience", "0.5", "--server", server});
  EXPECT_EQ(given_up.code, 3) << given_up.err;
  EXPECT_THAT(given_up.err, HasSubstr("trying again for 0.5 s"));
}

TEST_F(FarmCliTest, AServerThatNeverAnsweredIsGivenUpSoon) {
  const ProgramRun run = RunFjordAnew({"status", "7", "--server", "127.0.0.1:1"});
  EXPECT_EQ(run.code, 3);
  EXPECT_THAT(run.err, HasSubstr("does not answer; trying again for 2 s"));
}

TEST_F(FarmCliTest, WatchOfAFailedJobIsCode1WithItsError) {
  jobs_.end = v1::FAILED;
  const ProgramRun run = RunFjordAnew({"watch", "7", "--json", "--server", Serve(&jobs_)});
  EXPECT_EQ(run.code, 1);
  EXPECT_THAT(run.err, HasSubstr("frame 5: too deep"));
  EXPECT_EQ(nlohmann::json::parse(run.out)["state"], "failed");
}

TEST(ErrorOfStatusTest, EveryCodeHasAnExitCode) {
  for (int code = 1; code <= 16; ++code) {
    const Error error =
        ErrorOfStatus(grpc::Status(static_cast<grpc::StatusCode>(code), "said"), "host:1");
    const bool unreachable = code == grpc::StatusCode::UNAVAILABLE ||
                             code == grpc::StatusCode::DEADLINE_EXCEEDED ||
                             code == grpc::StatusCode::UNIMPLEMENTED;
    EXPECT_EQ(ExitCodeOf(error), unreachable ? kExitUnreachable : kExitFailed) << code;
    EXPECT_THAT(error.message, HasSubstr("host:1"));
  }
}

}  // namespace
}  // namespace fjord::testing
