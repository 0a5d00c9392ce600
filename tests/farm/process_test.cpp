// The programs themselves: coordinator and workers as processes, killed and restarted; and the
// crash sweep. What the farm delivers equals what the engine renders directly.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <thread>

#include "engine/animation/frame_key.h"
#include "engine/animation/inbetween.h"
#include "engine/render/frame_renderer.h"
#include "engine/scene/load.h"
#include "programs.h"
#include "talk.h"
#include "temp_dir.h"

namespace fjord::farm_test {
namespace {

// A scene and what the engine makes of it without any farm.
struct Truth {
  std::string scene;  // as on the wire
  std::map<uint32_t, std::string> key, pixels, pictures;
};

Truth RenderDirectly(int frames, int width, int height, int samples = 1) {
  Truth truth;
  const LoadResult loaded = LoadSceneText(SceneText(frames, width, height, samples), "test",
                                          [](const v1::File& file) -> Result<std::string> {
                                            return MakeError(ErrorCode::kNotFound, file.path());
                                          });
  EXPECT_TRUE(loaded.ok()) << (loaded.ok() ? "" : loaded.errors[0].ToString());
  truth.scene = SerializeScene(loaded.loaded.scene);
  const auto animation = Animation::Make(loaded.loaded);
  EXPECT_TRUE(animation.ok()) << (animation.ok() ? "" : animation.error().ToString());
  for (int frame = 1; frame <= frames; ++frame) {
    const auto scene = animation.value()->Inbetween(frame, nullptr);
    const auto rendered = RenderFrame(*scene, {});
    EXPECT_TRUE(rendered.ok());
    truth.key[frame] = FrameKey(*scene)->Hex();
    truth.pixels[frame] = PixelDigest(rendered->picture).Hex();
    truth.pictures[frame] = *EncodePicture(rendered->picture, *DescribeFrame(*scene));
  }
  return truth;
}

v1::SubmitRequest Request(const std::string& scene_digest) {
  v1::SubmitRequest request;
  request.set_protocol(kProtocol);
  request.set_request_id("one");
  request.set_scene_digest(scene_digest);
  return request;
}

void ExpectTruth(Talk& talk, const std::string& job, const Truth& truth) {
  const auto frames = talk.Frames(job);
  ASSERT_EQ(frames.value.frame_size(), static_cast<int>(truth.pixels.size()));
  for (const v1::Frame& frame : frames.value.frame()) {
    EXPECT_EQ(frame.state(), v1::FRAME_DONE) << frame.number();
    EXPECT_EQ(frame.key(), truth.key.at(frame.number())) << frame.number();
    EXPECT_EQ(frame.pixel_digest(), truth.pixels.at(frame.number())) << frame.number();
    EXPECT_EQ(talk.Get(frame.blob_digest()).value, truth.pictures.at(frame.number()))
        << frame.number();
  }
}

class FarmProcessTest : public testing::Test {
 protected:
  std::string Submit(Talk& talk, const Truth& truth) {
    const auto submitted = talk.Submit(Request(talk.PutBytes(truth.scene)));
    EXPECT_TRUE(submitted.ok()) << submitted.status.error_message();
    return submitted.value.job_id();
  }
  // Watches over restarts of the coordinator.
  bool WaitUntil(const std::function<bool(const v1::Job&)>& holds, const std::string& job,
                 int seconds = 60) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(seconds);
    while (std::chrono::steady_clock::now() < end) {
      grpc::ClientContext context;
      context.set_deadline(std::chrono::system_clock::now() + std::chrono::seconds(seconds));
      v1::WatchRequest request;
      request.set_job_id(job);
      Talk talk(coordinator_.address());
      const auto reader = talk.jobs().Watch(&context, request);
      v1::WatchResponse response;
      while (reader->Read(&response)) {
        if (!holds(response.job())) continue;
        context.TryCancel();
        reader->Finish();
        return true;
      }
      reader->Finish();
    }
    return false;
  }
  static bool Ended(const v1::Job& job) { return job.ended_unix_ms() != 0; }

  TempDir data_;
  Coordinator coordinator_{data_.path()};
};

class WorkersTest : public FarmProcessTest, public testing::WithParamInterface<int> {};

TEST_P(WorkersTest, F2_FarmEqualsDirectRender) {
  const Truth truth = RenderDirectly(5, 64, 36);
  ASSERT_TRUE(coordinator_.Start());
  std::vector<std::unique_ptr<Process>> workers;
  for (int i = 0; i < GetParam(); ++i) {
    workers.push_back(StartWorker(coordinator_.address(), "w" + std::to_string(i)));
  }
  Talk talk(coordinator_.address());
  while (talk.Workers().value.worker_size() < GetParam()) std::this_thread::yield();
  const std::string job = Submit(talk, truth);
  ASSERT_TRUE(WaitUntil(Ended, job));
  ExpectTruth(talk, job, truth);
  for (auto& worker : workers) worker->Kill(SIGTERM);
  for (auto& worker : workers) EXPECT_EQ(worker->Wait(), 0);
  EXPECT_EQ(talk.Workers().value.worker(0).state(), v1::WorkerInfo::GONE) << "it took its leave";
  coordinator_.process().Kill(SIGTERM);
  EXPECT_EQ(coordinator_.process().Wait(), 0);
}
INSTANTIATE_TEST_SUITE_P(Counts, WorkersTest, testing::Values(1, 2, 5));

TEST_F(FarmProcessTest, F5_KilledWorkerCostsNothingButTime) {
  const Truth truth = RenderDirectly(12, 160, 90, 4);
  ASSERT_TRUE(coordinator_.Start());
  auto doomed = StartWorker(coordinator_.address(), "doomed");
  Talk talk(coordinator_.address());
  const std::string job = Submit(talk, truth);
  ASSERT_TRUE(WaitUntil([](const v1::Job& now) { return now.frames().done() >= 2; }, job));
  doomed->Kill(SIGKILL);
  const auto heir = StartWorker(coordinator_.address(), "heir");
  ASSERT_TRUE(WaitUntil(Ended, job));
  ExpectTruth(talk, job, truth);
  const auto frames = talk.Frames(job);
  for (const v1::Frame& frame : frames.value.frame()) EXPECT_EQ(frame.attempts(), 0u);
}

TEST_F(FarmProcessTest, F4_KilledCoordinatorComesBackAndTheWorkersGoOn) {
  const Truth truth = RenderDirectly(12, 160, 90, 4);
  ASSERT_TRUE(coordinator_.Start());
  std::vector<std::unique_ptr<Process>> workers;
  for (const char* id : {"a", "b"}) workers.push_back(StartWorker(coordinator_.address(), id));
  Talk talk(coordinator_.address());
  const std::string job = Submit(talk, truth);
  for (uint32_t done : {2u, 6u}) {
    ASSERT_TRUE(WaitUntil([done](const v1::Job& now) { return now.frames().done() >= done; }, job));
    coordinator_.process().Kill(SIGKILL);
    coordinator_.process().Wait();
    ASSERT_TRUE(coordinator_.Start());
    EXPECT_GE(Talk(coordinator_.address()).GetJob(job).value.frames().done(), done);
  }
  ASSERT_TRUE(WaitUntil(Ended, job));
  Talk again(coordinator_.address());
  ExpectTruth(again, job, truth);
}

TEST_F(FarmProcessTest, F4_EverythingKilledAndRestartedEndsTheSame) {
  const Truth truth = RenderDirectly(8, 160, 90, 4);
  ASSERT_TRUE(coordinator_.Start());
  auto worker = StartWorker(coordinator_.address(), "w");
  Talk talk(coordinator_.address());
  const std::string job = Submit(talk, truth);
  ASSERT_TRUE(WaitUntil([](const v1::Job& now) { return now.frames().done() >= 2; }, job));
  coordinator_.process().Kill(SIGKILL);
  worker->Kill(SIGKILL);
  coordinator_.process().Wait();
  worker->Wait();
  ASSERT_TRUE(coordinator_.Start());
  worker = StartWorker(coordinator_.address(), "w");
  ASSERT_TRUE(WaitUntil(Ended, job));
  Talk again(coordinator_.address());
  ExpectTruth(again, job, truth);
}

TEST_F(FarmProcessTest, F3_OtherProtocolIsRefusedAndUsageIsNamed) {
  const auto run = [](const std::vector<std::string>& words) {
    Process process(words);
    return WEXITSTATUS(process.Wait());
  };
  EXPECT_EQ(run({FJORD_SERVER_PROGRAM, "--listen", "0.0.0.0:0", "--data", data_.path()}), 2);
  EXPECT_EQ(run({FJORD_SERVER_PROGRAM, "--nonsense"}), 2);
  EXPECT_EQ(run({FJORD_SERVER_PROGRAM, "--listen", "127.0.0.1:0", "--data", "/dev/null/x"}), 1);
  EXPECT_EQ(run({FJORD_WORKER_PROGRAM, "--threads", "-1"}), 2);
}

// --- the crash sweep ---

// A client and a worker in one, that never give up: after each death of the coordinator it is
// started again without faults, and whatever was answered before must still be so.
class Sweep {
 public:
  Sweep(const Truth& truth, const std::string& data, long crash_after)
      : truth_(truth), data_(data), coordinator_(data) {
    coordinator_.Term(150);
    // By name: the list of LD_PRELOAD is split at spaces, which a path may hold.
    const std::string shim = FJORD_CRASH_SHIM;
    const size_t slash = shim.rfind('/');
    Start({{"LD_PRELOAD", shim.substr(slash + 1)},
           {"LD_LIBRARY_PATH", shim.substr(0, slash)},
           {"FJORD_CRASH_DIR", data},
           {"FJORD_CRASH_AFTER", std::to_string(crash_after)}});
  }

  bool crashed() const { return crashes_ > 0; }

  void Run() {
    std::string scene;
    Must([&] { return Put(truth_.scene, &scene); });
    Must([&] {
      const auto said = talk_->Submit(Request(scene));
      if (said.ok()) job_ = said.value.job_id();
      return said.status;
    });
    for (int rounds = 0; done_.size() < truth_.pixels.size(); ++rounds) {
      ASSERT_LT(rounds, 1'000);
      v1::Grant grant;
      Must([&] {
        const auto said = talk_->Acquire(session_, ++number_, 2'000);
        if (said.ok() && said.value.grant_size() > 0) grant = said.value.grant(0);
        return said.status;
      });
      if (testing::Test::HasFatalFailure()) return;
      if (grant.unit_size() == 0) continue;
      held_ = {grant};
      const uint32_t frame = grant.unit(0).frame();
      EXPECT_EQ(grant.unit(0).frame_key(), truth_.key.at(frame));
      std::string blob;
      Must([&] { return Put(truth_.pictures.at(frame), &blob); });
      Must([&] {
        const auto said = talk_->CompleteWith(session_, grant, truth_.pixels.at(frame), blob);
        if (said.ok()) {
          EXPECT_LE(said.value.outcome(0), v1::CompleteResponse::DUPLICATE);
        }
        return said.status;
      });
      if (testing::Test::HasFatalFailure()) return;
      held_.clear();
      done_.insert(frame);
    }
    DeleteAnother();
    if (testing::Test::HasFatalFailure()) return;
    ExpectAllIsThere();
    coordinator_.process().Kill(SIGTERM);
    const int status = coordinator_.process().Wait();
    if (!WIFSIGNALED(status)) {
      EXPECT_EQ(status, 0);
      if (crashed()) return;
    } else {
      ++crashes_;
    }
    Start({});
    if (!testing::Test::HasFatalFailure()) ExpectAllIsThere();
  }

 private:
  void Start(const std::vector<std::pair<std::string, std::string>>& environment) {
    for (int tries = 0; !coordinator_.Start(tries == 0 ? environment : decltype(environment){});
         ++tries) {
      ASSERT_LT(tries, 3) << "the coordinator does not start again";
      ExpectKilled();
    }
    talk_ = std::make_unique<Talk>(coordinator_.address());
    CheckAnswered();
    JoinAnew();
  }

  void ExpectAllIsThere() {
    Must([&] { return talk_->GetJob(job_).status; });
    if (testing::Test::HasFatalFailure()) return;
    EXPECT_EQ(talk_->GetJob(job_).value.state(), v1::DONE);
    ExpectTruth(*talk_, job_, truth_);
  }
  // A job of some of the frames comes and goes; the first one's pictures stay.
  void DeleteAnother() {
    const auto even = [](grpc::Status status, grpc::StatusCode expected) {
      return status.error_code() == expected ? grpc::Status::OK : status;
    };
    std::string other;
    Must([&] {
      v1::SubmitRequest request = Request(Sha256Of(truth_.scene).Hex());
      request.set_request_id("two");
      v1::FrameSpan& span = *request.add_span();
      span.set_first(2);
      span.set_last(4);
      span.set_step(2);
      const auto said = talk_->Submit(request);
      other = said.value.job_id();
      return said.status;
    });
    if (testing::Test::HasFatalFailure()) return;
    EXPECT_NE(other, job_);
    // It may have ended by itself, or be gone by an answer that never came.
    Must([&] {
      const auto status = talk_->Command(other, v1::CommandRequest::CANCEL).status;
      return even(status, grpc::StatusCode::FAILED_PRECONDITION);
    });
    if (testing::Test::HasFatalFailure()) return;
    Must([&] {
      const auto status = talk_->Command(other, v1::CommandRequest::DELETE).status;
      return even(status, grpc::StatusCode::NOT_FOUND);
    });
    deleted_ = other;
  }
  void JoinAnew() {
    session_ = "s" + std::to_string(++sessions_);
    number_ = 0;
    if (!talk_->Join("w", session_, held_).ok()) Recover();
  }
  grpc::Status Put(const std::string& bytes, std::string* digest) {
    *digest = Sha256Of(bytes).Hex();
    const grpc::Status status = talk_->Put(*digest, bytes.size(), {bytes});
    if (status.ok()) blobs_.insert(*digest);
    return status;
  }
  void ExpectKilled() {
    const int status = coordinator_.process().Wait();
    ASSERT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL) << "status " << status;
    ++crashes_;
  }
  void Recover() {
    ExpectKilled();
    if (!testing::Test::HasFatalFailure()) Start({});
  }
  // Asks until it is answered.
  void Must(const std::function<grpc::Status()>& step) {
    for (int tries = 0; !testing::Test::HasFatalFailure(); ++tries) {
      const grpc::Status status = step();
      if (status.ok()) return;
      ASSERT_LT(tries, 50) << status.error_message();
      if (status.error_code() == grpc::StatusCode::NOT_FOUND) {
        JoinAnew();  // silent for longer than its term
      } else {
        ASSERT_EQ(status.error_code(), grpc::StatusCode::UNAVAILABLE) << status.error_message();
        Recover();
      }
    }
  }

  void CheckAnswered() {
    const auto missing = talk_->Missing({blobs_.begin(), blobs_.end()});
    if (!missing.ok()) return;
    EXPECT_EQ(missing.value.digest_size(), 0) << "a blob that was answered is gone";
    if (!deleted_.empty()) {
      EXPECT_NE(talk_->GetJob(deleted_).code(), grpc::StatusCode::OK) << "a deleted job is back";
    }
    if (job_.empty()) return;
    const auto frames = talk_->Frames(job_);
    if (!frames.ok()) {
      EXPECT_NE(frames.code(), grpc::StatusCode::NOT_FOUND) << "a job that was answered is gone";
      return;
    }
    for (const v1::Frame& frame : frames.value.frame()) {
      if (!done_.contains(frame.number())) continue;
      EXPECT_EQ(frame.state(), v1::FRAME_DONE) << "a frame that was answered is gone";
      EXPECT_EQ(frame.pixel_digest(), truth_.pixels.at(frame.number()));
    }
  }

  const Truth& truth_;
  const std::string data_;
  Coordinator coordinator_;
  std::unique_ptr<Talk> talk_;
  int crashes_ = 0, sessions_ = 0;
  std::string session_, job_, deleted_;
  uint64_t number_ = 0;
  std::vector<v1::Grant> held_;
  std::set<std::string> blobs_;
  std::set<uint32_t> done_;
};

// Every N belongs to one of these, so that they run side by side.
class CrashSweepTest : public testing::TestWithParam<int> {
 protected:
  static constexpr int kParts = 4;
};

TEST_P(CrashSweepTest, F1_F2_F4_KilledAfterEveryWritingCallLosesNothing) {
  const Truth truth = RenderDirectly(5, 64, 36);
  long crash_after = GetParam() + 1;
  for (bool crashed = true; crashed; crash_after += kParts) {
    SCOPED_TRACE("killed after writing call " + std::to_string(crash_after));
    TempDir data;
    Sweep sweep(truth, data.path() + "/data", crash_after);
    sweep.Run();
    crashed = sweep.crashed();
    if (HasFailure()) return;
  }
  RecordProperty("writing_calls", static_cast<int>(crash_after));
  EXPECT_GT(crash_after, 40) << "the shim saw too few calls to be believed";
}
INSTANTIATE_TEST_SUITE_P(Parts, CrashSweepTest, testing::Values(0, 1, 2, 3));

}  // namespace
}  // namespace fjord::farm_test
