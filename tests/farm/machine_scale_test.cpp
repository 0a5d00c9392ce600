// What one job may cost the coordinator's thread, at the sizes that a stranger may submit.
#include <gtest/gtest.h>

#include <ctime>
#include <functional>

#include "server/state/machine.h"

namespace fjord::server {
namespace {

Digest Name(const std::string& text) { return Sha256Of(text); }

// Processor time, so that a busy machine fails nobody.
double Seconds(const std::function<void()>& work) {
  const std::clock_t start = std::clock();
  work();
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

JobSpec Spec(uint32_t frames) {
  JobSpec spec;
  spec.request_id = "r";
  spec.scene = Name("scene");
  spec.frames = FrameSet(1, frames);
  return spec;
}

class MachineScaleTest : public testing::Test {
 protected:
  JobId Submit(uint32_t frames) {
    const auto answer = machine_.Submit(Spec(frames), {1, 1});
    return std::get<Machine::Submitted>(answer).id;
  }

  // Answers what the planner is asked until nothing is asked: every frame has `key`.
  uint32_t PlanAll(JobId job, const Digest& key) {
    uint32_t planned = 0;
    while (true) {
      const Effects effects = machine_.TakeEffects();
      if (effects.plans.empty()) return planned;
      for (const PlanRequest& request : effects.plans) {
        for (const uint32_t frame : request.frames) {
          machine_.Planned(job, frame, key, {2, 2});
          ++planned;
        }
      }
    }
  }

  void RenderOne(const Digest& key) {
    JoinCall join;
    join.worker = join.session = "w";
    machine_.Join(join, {2, 2});
    machine_.Acquire("w", 1, 1, 0, {2, 2});
    const Effects effects = machine_.TakeEffects();
    ASSERT_EQ(effects.answers.size(), 1u);
    ASSERT_EQ(effects.answers[0].grants.size(), 1u);
    const Grant& grant = effects.answers[0].grants[0];
    Delivery delivery{grant.attempt, grant.scene, grant.frame, key, Name("pixel"), Name("blob")};
    delivery.blob_present = true;
    const auto outcome = machine_.Complete("w", delivery, {3, 3});
    ASSERT_EQ(std::get<Outcome>(outcome), Outcome::kCommitted);
    pending_ = machine_.TakeEffects();
  }

  // Goes on planning after RenderOne, whose effects may hold requests.
  uint32_t PlanRest(JobId job, const Digest& key) {
    uint32_t planned = 0;
    for (const PlanRequest& request : pending_.plans) {
      for (const uint32_t frame : request.frames) {
        machine_.Planned(job, frame, key, {4, 4});
        ++planned;
      }
    }
    return planned + PlanAll(job, key);
  }

  Machine machine_{MachineConfig(), Snapshot(), {1, 1}};
  Effects pending_;
};

// Case: a long still shot, every frame the same picture. Planning it and cancelling it took the
// square of its frames.
TEST_F(MachineScaleTest, EqualFramesCostTheirNumberToPlanAndNothingToCancel) {
  constexpr uint32_t kFrames = 200'000;
  const Digest key = Name("key");
  const JobId job = Submit(kFrames);
  uint32_t planned = PlanAll(job, key);
  RenderOne(key);
  const double planning = Seconds([&] { planned += PlanRest(job, key); });
  EXPECT_EQ(planned, kFrames);
  EXPECT_EQ(machine_.FindJob(job)->counts.done, kFrames);
  EXPECT_LT(planning, 5);
  // its frames are made again once their worker is not trusted: then it is cancelled
  machine_.CommandWorker("w", WorkerCommand::kQuarantine, {5, 5});
  EXPECT_EQ(machine_.FindJob(job)->counts.waiting, kFrames);
  (void)machine_.TakeEffects();
  const uint64_t before = machine_.work();
  machine_.Command(job, JobCommand::kCancel, 0, {6, 6});
  EXPECT_EQ(machine_.FindJob(job)->state(), JobState::kCancelled);
  EXPECT_LE(machine_.work() - before, kFrames + 10) << "one look at each frame";
  EXPECT_LE(machine_.TakeEffects().records.size(), 3u) << "the job's row alone goes to the journal";
  EXPECT_TRUE(machine_.Audit().empty());
}

// Case: as many jobs want one picture. The delivery that ends them all took the square of them.
TEST_F(MachineScaleTest, APictureEndsManyJobsInAsManySteps) {
  constexpr uint32_t kJobs = 5'000;
  const Digest key = Name("key");
  for (uint32_t i = 0; i < kJobs; ++i) {
    JobSpec spec = Spec(1);
    spec.request_id = std::to_string(i);
    spec.after = i % 2 == 0 ? 0 : i;  // the job before
    const auto answer = machine_.Submit(spec, {1, 1});
    (void)machine_.TakeEffects();
    const JobId id = std::get<Machine::Submitted>(answer).id;
    if (spec.after == 0) machine_.Planned(id, 1, key, {2, 2});
  }
  (void)machine_.TakeEffects();
  const uint64_t before = machine_.work();
  RenderOne(key);
  EXPECT_EQ(pending_.plans.size(), kJobs / 2) << "those that waited for another may begin";
  EXPECT_EQ(machine_.FindJob(kJobs - 1)->state(), JobState::kDone);
  EXPECT_LE(machine_.work() - before, 8 * kJobs);
}

TEST_F(MachineScaleTest, AMillionFramesAreTakenAndGivenUpSoon) {
  constexpr uint32_t kFrames = 1'000'000;
  JobId job = 0;
  EXPECT_LT(Seconds([&] { job = Submit(kFrames); }), 1);
  EXPECT_LT(Seconds([&] { machine_.SceneUnusable(job, "too much", {2, 2}); }), 2);
  EXPECT_EQ(machine_.FindJob(job)->counts.failed, kFrames);
  RecordProperty("frames", static_cast<int>(kFrames));
}

}  // namespace
}  // namespace fjord::server
