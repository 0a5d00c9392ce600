// The state machine by tables and stories. Times are virtual; BenchFarm audits M1-M7, L1-L4 and R1
// after every step.
#include "bench_farm.h"

namespace fjord::server {
namespace {

using S = FrameState;

class MachineTest : public testing::Test {
 protected:
  BenchFarm farm_;
};

TEST_F(MachineTest, F2_FrameWaitsRunsAndIsDone) {
  const JobId job = farm_.Submit("a", 2);
  EXPECT_EQ(farm_.StateOf(job), JobState::kQueued);
  farm_.Join("w");
  const auto grant = farm_.Acquire("w");
  ASSERT_TRUE(grant);
  // F: waiting > running  --J: queued > running
  EXPECT_EQ(farm_.FrameOf(job, 1), S::kRunning);
  EXPECT_EQ(farm_.StateOf(job), JobState::kRunning);
  EXPECT_EQ(farm_.Complete("w", *grant), Outcome::kCommitted);
  EXPECT_EQ(farm_.FrameOf(job, 1), S::kDone);
  // F: running > done  --J: running > done
  EXPECT_EQ(farm_.Complete("w", *farm_.Acquire("w")), Outcome::kCommitted);
  EXPECT_EQ(farm_.StateOf(job), JobState::kDone);
  EXPECT_EQ(farm_.CountsOf(job), (Counts{2, 0, 0, 2, 0, 0}));
  EXPECT_NE(farm_.machine().FindJob(job)->row.ended_unix_ms, 0);
}

TEST_F(MachineTest, F1_SameRequestIdIsOneJobAndOtherContentIsRefused) {
  JobSpec spec;
  spec.request_id = "r";
  spec.content = "x";
  const JobId job = farm_.Submit("a", 2, spec);
  EXPECT_EQ(farm_.Submit("a", 2, spec), job);
  spec.content = "y";
  EXPECT_EQ(farm_.Submit("a", 2, spec), 0u);
  EXPECT_EQ(farm_.machine().jobs().size(), 1u);
  farm_.Restart();
  spec.content = "x";
  EXPECT_EQ(farm_.Submit("a", 2, spec), job);
}

TEST_F(MachineTest, F3_DuplicateIsWelcomeAndUnknownIsNamed) {
  farm_.Submit("a", 1);
  farm_.Join("w");
  const Grant grant = *farm_.Acquire("w");
  EXPECT_EQ(farm_.Complete("w", grant), Outcome::kCommitted);
  EXPECT_EQ(farm_.Complete("w", grant), Outcome::kDuplicate);
  Grant stranger = grant;
  stranger.key = Name("nobody's");
  EXPECT_EQ(farm_.Complete("w", stranger), Outcome::kUnknownUnit);
}

TEST_F(MachineTest, F2_PictureMustBeInTheStoreFirst) {
  const JobId job = farm_.Submit("a", 1);
  farm_.Join("w");
  const Grant grant = *farm_.Acquire("w");
  Delivery delivery = BenchFarm::Picture(grant, "p");
  delivery.blob_present = false;
  EXPECT_EQ(std::get<Outcome>(farm_.Deliver("w", delivery)), Outcome::kMissingBlob);
  EXPECT_EQ(farm_.FrameOf(job, 1), S::kRunning);
  delivery.blob_present = true;
  EXPECT_EQ(std::get<Outcome>(farm_.Deliver("w", delivery)), Outcome::kCommitted);
}

TEST_F(MachineTest, F3_LateResultOfAnExpiredAttemptCounts) {
  const JobId job = farm_.Submit("a", 1);
  farm_.Join("w");
  farm_.Join("v");
  const Grant late = *farm_.Acquire("w");
  farm_.Pass(10'000);  // both silent for a term
  EXPECT_EQ(farm_.FrameOf(job, 1), S::kWaiting);
  farm_.Join("v");
  const Grant second = *farm_.Acquire("v");
  EXPECT_NE(second.attempt, late.attempt);
  farm_.Join("w");
  EXPECT_FALSE(farm_.Renew("w", late));
  EXPECT_FALSE(farm_.Fail("w", late)) << "failures are fenced by the attempt";
  EXPECT_EQ(farm_.Complete("w", late), Outcome::kCommitted) << "results are not";
  EXPECT_FALSE(farm_.Renew("v", second)) << "nobody needs the second try any more";
  EXPECT_EQ(farm_.Complete("v", second), Outcome::kDuplicate);
}

TEST_F(MachineTest, F5_FailureOnItsOwnMeritsHasALimitAndTheJobGoesOn) {
  const JobId job = farm_.Submit("a", 2);
  farm_.Join("w");
  uint32_t failed = 0;
  while (const auto grant = farm_.Acquire("w")) {
    if (grant->frame == 1) {
      EXPECT_TRUE(farm_.Fail("w", *grant));
      ++failed;
    } else {
      farm_.Complete("w", *grant);
    }
  }
  EXPECT_EQ(failed, 3u);
  EXPECT_EQ(farm_.StateOf(job), JobState::kFailed);
  EXPECT_EQ(farm_.CountsOf(job), (Counts{2, 0, 0, 1, 0, 1}));
  farm_.Command(job, JobCommand::kRetry);
  EXPECT_EQ(farm_.StateOf(job), JobState::kRunning);
  EXPECT_EQ(farm_.Complete("w", *farm_.Acquire("w")), Outcome::kCommitted);
  EXPECT_EQ(farm_.StateOf(job), JobState::kDone);
}

TEST_F(MachineTest, F5_FinalFailureIsNotTriedAgain) {
  const JobId job = farm_.Submit("a", 1);
  farm_.Join("w");
  farm_.Fail("w", *farm_.Acquire("w"), true);
  EXPECT_EQ(farm_.StateOf(job), JobState::kFailed);
}

TEST_F(MachineTest, F5_AnotherTryGoesToAnotherWorker) {
  farm_.Submit("a", 1);
  farm_.Join("bad");
  farm_.Join("good");
  farm_.Fail("bad", *farm_.Acquire("bad"));
  EXPECT_FALSE(farm_.Acquire("bad")) << "one bad worker must not use up the tries";
  EXPECT_TRUE(farm_.Acquire("good"));
}

TEST_F(MachineTest, F5_LosingAWorkerCostsNoTryAndThreeMakeASuspectThatRunsAlone) {
  const JobId job = farm_.Submit("a", 3);
  const Digest culprit = KeyOf("a", 1);
  for (int i = 1; i <= 3; ++i) {
    farm_.Join("w", {}, std::to_string(i));
    const std::string session = "w" + std::to_string(i);
    const Grant first = *farm_.Acquire(session);
    EXPECT_EQ(first.key, culprit);
    EXPECT_FALSE(first.alone);
    const Grant ahead = *farm_.Acquire(session);  // prefetched
    EXPECT_NE(ahead.key, culprit);
    farm_.Pass(1);
  }
  farm_.Join("w", {}, "4");
  EXPECT_EQ(farm_.KeyAt(culprit).row.lost, 3u);
  EXPECT_EQ(farm_.KeyAt(culprit).row.failures, 0u);
  EXPECT_EQ(farm_.KeyAt(KeyOf("a", 3)).row.lost, 0u) << "only fetched ahead";
  const Grant alone = *farm_.Acquire("w4");
  EXPECT_EQ(alone.key, culprit);
  EXPECT_TRUE(alone.alone);
  EXPECT_FALSE(farm_.Acquire("w4")) << "nothing beside it";
  farm_.Restart();
  farm_.Pass(10'000);
  EXPECT_EQ(farm_.KeyAt(culprit).row.lost, 3u) << "a restart forgets no suspect";
  farm_.Join("w", {}, "5");
  ASSERT_TRUE(farm_.Acquire("w5")->alone);
  farm_.Join("w", {}, "6");
  EXPECT_EQ(farm_.FrameOf(job, 1), S::kFailed);
  EXPECT_NE(farm_.KeyAt(culprit).row.error.find("4 workers were lost"), std::string::npos);
  EXPECT_NE(farm_.StateOf(job), JobState::kFailed) << "the job goes on";
}

TEST_F(MachineTest, F5_StandingStillCountsAsAFailure) {
  farm_.Submit("a", 1);
  farm_.Join("w");
  const Grant grant = *farm_.Acquire("w");
  int renewed = 0;
  while (farm_.Renew("w", grant, 1)) {
    farm_.Pass(5'000);
    ++renewed;
  }
  EXPECT_EQ(renewed, 24) << "two minutes";
  EXPECT_EQ(farm_.KeyAt(grant.key).row.failures, 1u);
}

TEST_F(MachineTest, F5_AWorkerIdHasOneLivingSession) {
  farm_.Submit("a", 2);
  farm_.Join("twin", {}, "1");
  const Grant held = *farm_.Acquire("twin1");
  JoinCall second;
  second.worker = "twin";
  second.session = "twin2";
  second.host = "b";
  const auto refusal = [&](int64_t waited_ms) {
    second.waited_ms = waited_ms;
    const auto answer = farm_.Join(second);
    const Refusal* refused = std::get_if<Refusal>(&answer);
    return refused == nullptr ? std::optional<Code>() : refused->code;
  };
  EXPECT_EQ(refusal(0), Code::kAborted) << "nobody knows yet whether the first lives";
  farm_.Pass(3'000);
  EXPECT_EQ(refusal(3'000), Code::kAborted) << "it was heard of when the second first asked";
  EXPECT_TRUE(farm_.Renew("twin1", held)) << "nothing is taken from it";
  farm_.Pass(100);
  const size_t notices = farm_.notices().size();
  for (int i = 0; i < 3; ++i) EXPECT_EQ(refusal(3'100), Code::kExists) << "it is alive";
  EXPECT_EQ(farm_.notices().size(), notices + 1) << "said once a minute";
  // The first dies: its name is free after a term, or at once for who knows that it is dead.
  farm_.Pass(9'800);
  EXPECT_EQ(refusal(9'800), Code::kAborted);
  second.ended = {"nobody", "twin1"};
  EXPECT_EQ(refusal(9'800), std::nullopt);
  EXPECT_FALSE(farm_.Renew("twin1", held));
  EXPECT_EQ(farm_.KeyAt(held.key).row.lost, 1u);
  second.ended.clear();
  second.session = "twin3";
  farm_.Pass(10'000);
  EXPECT_EQ(refusal(0), std::nullopt);
}

TEST_F(MachineTest, F2_AJobHasTheFramesOfItsSpans) {
  JobSpec spec;
  spec.frames = *FrameSet::Parse("2-8x3,12");
  const JobId job = farm_.Submit("a", 0, spec);
  farm_.Join("w");
  std::set<uint32_t> made;
  while (const auto grant = farm_.Acquire("w")) {
    made.insert(grant->frame);
    EXPECT_EQ(grant->job, job);
    farm_.Complete("w", *grant);
  }
  EXPECT_EQ(made, (std::set<uint32_t>{2, 5, 8, 12}));
  EXPECT_EQ(farm_.CountsOf(job), (Counts{4, 0, 0, 4, 0, 0}));
  farm_.Restart();
  EXPECT_EQ(farm_.FrameOf(job, 12), S::kDone);
  EXPECT_EQ(farm_.CountsOf(farm_.Submit("a", 12)).cached, 4u);
}

TEST_F(MachineTest, F5_AFrameHasTheTimeThatTheMostGenerousJobAllows) {
  const auto limit = [&](std::vector<uint32_t> limits) {
    const std::string scene = "scene " + std::to_string(farm_.machine().jobs().size());
    for (const uint32_t each : limits) {
      JobSpec spec;
      spec.frame_limit_ms = each;
      farm_.Submit(scene, 1, spec);
    }
    const Grant grant = *farm_.Acquire("w");
    farm_.Complete("w", grant);
    return grant.limit_ms;
  };
  farm_.Join("w");
  EXPECT_EQ(limit({0}), 0u);
  EXPECT_EQ(limit({5'000}), 5'000u);
  EXPECT_EQ(limit({5'000, 9'000, 2'000}), 9'000u);
  EXPECT_EQ(limit({5'000, 0}), 0u) << "any time";
}

TEST_F(MachineTest, F5_ANewJobTriesAnewWhatFailedForThoseBeforeIt) {
  const JobId job = farm_.Submit("a", 1);
  farm_.Join("w");
  while (const auto grant = farm_.Acquire("w")) farm_.Fail("w", *grant);
  EXPECT_EQ(farm_.StateOf(job), JobState::kFailed);
  const JobId again = farm_.Submit("a", 1);
  EXPECT_EQ(farm_.StateOf(again), JobState::kQueued);
  uint32_t tries = 0;
  while (const auto grant = farm_.Acquire("w")) tries += farm_.Fail("w", *grant);
  EXPECT_EQ(tries, 3u) << "and no more than the usual";
  EXPECT_EQ(farm_.StateOf(again), JobState::kFailed);
  farm_.Restart();
  EXPECT_EQ(farm_.StateOf(again), JobState::kFailed) << "a restart is no new job";
}

TEST_F(MachineTest, F7_WhatWasToRunAfterAJobThatDidNotSucceedEndsWithTheReason) {
  const JobId first = farm_.Submit("a", 2);
  JobSpec follows;
  follows.after = first;
  const JobId second = farm_.Submit("b", 3, follows);
  follows.request_id.clear();
  follows.after = second;
  const JobId third = farm_.Submit("c", 1, follows);
  EXPECT_EQ(farm_.StateOf(third), JobState::kQueued);
  farm_.Command(first, JobCommand::kCancel);
  EXPECT_EQ(farm_.StateOf(second), JobState::kFailed);
  EXPECT_EQ(farm_.machine().FindJob(second)->row.error,
            "job 1 was cancelled, and this one was to run after it");
  EXPECT_EQ(farm_.CountsOf(second), (Counts{3, 0, 0, 0, 0, 3}));
  EXPECT_EQ(farm_.StateOf(third), JobState::kFailed);
  EXPECT_EQ(farm_.machine().FindJob(third)->row.error,
            "job 2 failed, and this one was to run after it");
  follows.after = first;
  EXPECT_EQ(farm_.StateOf(farm_.Submit("d", 1, follows)), JobState::kFailed) << "at once";
  farm_.Restart();
  EXPECT_EQ(farm_.StateOf(third), JobState::kFailed);
  EXPECT_FALSE(farm_.Command(second, JobCommand::kRetry)) << "the first one first";
  // A cancelled job goes on, and those after it can.
  EXPECT_TRUE(farm_.Command(first, JobCommand::kRetry));
  EXPECT_TRUE(farm_.Command(second, JobCommand::kRetry));
  EXPECT_EQ(farm_.StateOf(second), JobState::kQueued);
  farm_.Pass(10'000);
  farm_.Join("w");
  while (const auto grant = farm_.Acquire("w")) farm_.Complete("w", *grant);
  EXPECT_EQ(farm_.StateOf(first), JobState::kDone);
  EXPECT_EQ(farm_.StateOf(second), JobState::kDone);
}

TEST_F(MachineTest, F2_ADeletedJobIsForgottenAndItsPicturesAreNot) {
  const JobId job = farm_.Submit("a", 2);
  JobSpec follows;
  follows.after = job;
  const JobId follower = farm_.Submit("b", 1, follows);
  EXPECT_FALSE(farm_.Command(job, JobCommand::kDelete)) << "it has not ended";
  farm_.Join("w");
  while (const auto grant = farm_.Acquire("w")) farm_.Complete("w", *grant);
  EXPECT_TRUE(farm_.Command(job, JobCommand::kDelete));
  EXPECT_EQ(farm_.machine().FindJob(job), nullptr);
  EXPECT_EQ(farm_.StateOf(follower), JobState::kDone);
  EXPECT_FALSE(farm_.Command(job, JobCommand::kRetry));
  EXPECT_TRUE(farm_.rows().frames.lower_bound({job, 0})->first.first != job);
  farm_.Restart();
  EXPECT_EQ(farm_.machine().FindJob(job), nullptr);
  EXPECT_TRUE(farm_.Command(follower, JobCommand::kDelete));
  farm_.Restart();
  const JobId again = farm_.Submit("a", 2);
  EXPECT_GT(again, follower) << "no id is given twice";
  EXPECT_EQ(farm_.CountsOf(again).cached, 2u);
}

TEST_F(MachineTest, F8_WorkersThatAreGoneForADayAreForgotten) {
  for (const char* worker : {"gone", "drained", "alive"}) farm_.Join(worker);
  (void)farm_.machine().CommandWorker("drained", WorkerCommand::kDrain, farm_.now());
  const auto hours = [&](int count) {
    for (int i = 0; i < count * 360; ++i) {
      farm_.Pass(10'000 - 1);
      JoinCall call;
      call.worker = call.session = "alive";
      (void)farm_.Join(call);
    }
  };
  hours(23);
  EXPECT_NE(farm_.machine().roster().FindWorker("gone"), nullptr);
  hours(2);
  EXPECT_EQ(farm_.machine().roster().FindWorker("gone"), nullptr);
  EXPECT_NE(farm_.machine().roster().FindWorker("drained"), nullptr) << "somebody's wish";
  EXPECT_NE(farm_.machine().roster().FindWorker("alive"), nullptr);
}

TEST_F(MachineTest, F2_ALostPictureIsMadeAgain) {
  const JobId job = farm_.Submit("a", 2), other = farm_.Submit("b", 1);
  farm_.Join("w");
  while (const auto grant = farm_.Acquire("w")) farm_.Complete("w", *grant);
  const JobId again = farm_.Submit("a", 2), cancelled = farm_.Submit("a", 3);
  farm_.Command(cancelled, JobCommand::kCancel);
  EXPECT_EQ(farm_.CountsOf(again), (Counts{2, 0, 0, 2, 2, 0}));
  const Digest blob = farm_.KeyAt(KeyOf("a", 2)).result()->blob;
  farm_.LoseBlob(Name("nobody's"));
  EXPECT_EQ(farm_.StateOf(job), JobState::kDone);
  farm_.LoseBlob(blob);
  farm_.LoseBlob(blob);
  for (const JobId id : {job, again}) {
    EXPECT_EQ(farm_.StateOf(id), JobState::kRunning);
    EXPECT_EQ(farm_.FrameOf(id, 2), S::kWaiting);
    EXPECT_EQ(farm_.FrameOf(id, 1), S::kDone);
  }
  EXPECT_EQ(farm_.StateOf(other), JobState::kDone);
  EXPECT_EQ(farm_.StateOf(cancelled), JobState::kCancelled);
  farm_.Restart();
  farm_.Pass(10'000);
  EXPECT_EQ(farm_.FrameOf(job, 2), S::kWaiting) << "the journal does not bring it back";
  EXPECT_EQ(farm_.CountsOf(again).cached, 1u) << "what is made again was not served from the store";
  EXPECT_EQ(farm_.CountsOf(farm_.Submit("a", 2)).cached, 1u) << "nor for a new job";
  farm_.Join("w");
  EXPECT_EQ(farm_.Complete("w", *farm_.Acquire("w")), Outcome::kCommitted);
  EXPECT_EQ(farm_.StateOf(job), JobState::kDone);
  EXPECT_EQ(farm_.StateOf(again), JobState::kDone);
}

TEST_F(MachineTest, F3_DisputeIsDecidedByAThirdWorker) {
  const JobId job = farm_.Submit("a", 3);
  for (const char* worker : {"liar", "x", "y"}) farm_.Join(worker);
  const Grant own = *farm_.Acquire("liar");
  EXPECT_EQ(farm_.Complete("liar", own, "wrong"), Outcome::kCommitted);
  const Grant other = *farm_.Acquire("liar");
  EXPECT_EQ(farm_.Complete("liar", other, "wrong, too"), Outcome::kCommitted);
  // x makes the first frame, too: by an attempt of long ago.
  EXPECT_EQ(farm_.Complete("x", own, "right"), Outcome::kConflict);
  EXPECT_EQ(farm_.FrameOf(job, 1), S::kWaiting) << "disputed is not done";
  EXPECT_TRUE(farm_.notices().back().alarm);
  // Only the one who has not voted may decide.
  while (const auto grant = farm_.Acquire("x")) EXPECT_NE(grant->key, own.key);
  const Grant decider = *farm_.Acquire("y");
  EXPECT_EQ(decider.key, own.key);
  EXPECT_EQ(farm_.Complete("y", decider, "right"), Outcome::kCommitted);
  EXPECT_EQ(farm_.FrameOf(job, 1), S::kDone);
  EXPECT_EQ(farm_.KeyAt(own.key).result()->pixel, Name("right"));
  EXPECT_TRUE(farm_.machine().roster().FindWorker("liar")->row.quarantined);
  EXPECT_FALSE(farm_.KeyAt(other.key).done()) << "its unconfirmed keys are made again";
  EXPECT_TRUE(
      std::holds_alternative<Refusal>(farm_.Deliver("liar", BenchFarm::Picture(other, "z"))));
  EXPECT_TRUE(farm_.Ask("liar", 99).drain);
  farm_.Restart();
  EXPECT_TRUE(farm_.machine().roster().FindWorker("liar")->row.quarantined);
  EXPECT_EQ(farm_.KeyAt(own.key).result()->pixel, Name("right"));
}

TEST_F(MachineTest, F3_NoMajorityFailsTheFrameAsIntegrity) {
  const JobId job = farm_.Submit("a", 1);
  for (const char* worker : {"x", "y", "z"}) farm_.Join(worker);
  const Grant first = *farm_.Acquire("x");
  farm_.Complete("x", first, "1");
  EXPECT_EQ(farm_.Complete("y", first, "2"), Outcome::kConflict);
  EXPECT_EQ(farm_.StateOf(job),
            JobState::kRunning == farm_.StateOf(job) ? JobState::kRunning : JobState::kQueued);
  EXPECT_EQ(farm_.Complete("z", *farm_.Acquire("z"), "3"), Outcome::kConflict);
  EXPECT_EQ(farm_.StateOf(job), JobState::kFailed);
  farm_.Command(job, JobCommand::kRetry);
  EXPECT_EQ(farm_.Complete("x", *farm_.Acquire("x"), "1"), Outcome::kCommitted);
  EXPECT_EQ(farm_.StateOf(job), JobState::kDone);
}

TEST_F(MachineTest, F3_AlarmReopensAJobThatHadEnded) {
  const JobId job = farm_.Submit("a", 1);
  farm_.Join("x");
  farm_.Join("y");
  const Grant grant = *farm_.Acquire("x");
  farm_.Complete("x", grant, "1");
  ASSERT_EQ(farm_.StateOf(job), JobState::kDone);
  EXPECT_EQ(farm_.Complete("y", grant, "2"), Outcome::kConflict);
  EXPECT_NE(farm_.StateOf(job), JobState::kDone);
  EXPECT_EQ(farm_.machine().FindJob(job)->row.ended_unix_ms, 0);
}

TEST_F(MachineTest, F6_SettledKeysAreNeverLeasedAgainAndServeOtherJobs) {
  farm_.Submit("a", 2);
  farm_.Join("w");
  while (const auto grant = farm_.Acquire("w")) farm_.Complete("w", *grant);
  const JobId again = farm_.Submit("a", 2);
  EXPECT_EQ(farm_.StateOf(again), JobState::kDone);
  EXPECT_EQ(farm_.CountsOf(again), (Counts{2, 0, 0, 2, 2, 0}));
  EXPECT_FALSE(farm_.Acquire("w"));
}

TEST_F(MachineTest, F6_ConcurrentJobsShareOneRender) {
  const JobId first = farm_.Submit("a", 1), second = farm_.Submit("a", 1);
  farm_.Join("w");
  farm_.Join("v");
  const Grant grant = *farm_.Acquire("w");
  EXPECT_EQ(farm_.FrameOf(second, 1), S::kRunning);
  EXPECT_FALSE(farm_.Acquire("v"));
  farm_.Command(first, JobCommand::kCancel);
  EXPECT_TRUE(farm_.Renew("w", grant)) << "the other job still wants it";
  EXPECT_EQ(farm_.Complete("w", grant), Outcome::kCommitted);
  EXPECT_EQ(farm_.StateOf(second), JobState::kDone);
}

TEST_F(MachineTest, F6_VerifyRendersTwiceOnTwoWorkers) {
  JobSpec spec;
  spec.verify_share = 1;
  const JobId job = farm_.Submit("a", 1, spec);
  farm_.Join("x");
  farm_.Join("y");
  const Grant first = *farm_.Acquire("x");
  EXPECT_FALSE(farm_.Acquire("x"));
  EXPECT_EQ(farm_.Complete("x", first), Outcome::kCommitted);
  EXPECT_EQ(farm_.Complete("x", first), Outcome::kCommitted) << "asked again: no second proof";
  EXPECT_NE(farm_.StateOf(job), JobState::kDone);
  EXPECT_FALSE(farm_.Acquire("x")) << "the proof is another worker's";
  EXPECT_EQ(farm_.Complete("y", *farm_.Acquire("y")), Outcome::kCommitted);
  EXPECT_EQ(farm_.StateOf(job), JobState::kDone);
}

TEST_F(MachineTest, F7_CoarseToFine) {
  farm_.Submit("a", 5);
  farm_.Join("w");
  std::vector<uint32_t> frames;
  while (const auto grant = farm_.Acquire("w")) {
    frames.push_back(grant->frame);
    farm_.Complete("w", *grant);
  }
  EXPECT_EQ(frames, (std::vector<uint32_t>{1, 5, 3, 2, 4}));
}

TEST_F(MachineTest, F7_PriorityComesFirstThenFairShareByRenderTime) {
  JobSpec one, two, urgent;
  one.project = "one";
  two.project = "two";
  const JobId big = farm_.Submit("a", 100, one);
  farm_.Submit("a2", 100, one);
  const JobId small = farm_.Submit("b", 100, two);
  farm_.Join("w");
  std::map<Digest, int> grants;
  for (int i = 0; i < 40; ++i) {
    const Grant grant = *farm_.Acquire("w");
    ++grants[grant.scene];
    farm_.Complete("w", grant);
  }
  EXPECT_EQ(grants[Name("b")], 20) << "half for each project, though one has two jobs";
  EXPECT_EQ(grants[Name("a")], 20);
  urgent.priority = 10;
  urgent.project = "one";
  farm_.Submit("c", 3, urgent);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(farm_.Acquire("w")->scene, Name("c"));
  farm_.Command(small, JobCommand::kPriority, 20);
  EXPECT_EQ(farm_.Acquire("w")->scene, Name("b"));
  farm_.Command(big, JobCommand::kPause);
  EXPECT_EQ(farm_.StateOf(big), JobState::kPaused);
  farm_.Command(big, JobCommand::kResume);
  EXPECT_EQ(farm_.StateOf(big), JobState::kRunning);
}

TEST_F(MachineTest, F7_AfterJobWaitsForSuccess) {
  const JobId first = farm_.Submit("a", 1);
  JobSpec spec;
  spec.after = first;
  const JobId second = farm_.Submit("b", 1, spec);
  farm_.Join("w");
  const Grant grant = *farm_.Acquire("w");
  EXPECT_EQ(grant.scene, Name("a"));
  EXPECT_FALSE(farm_.Acquire("w"));
  farm_.Complete("w", grant);
  farm_.Complete("w", *farm_.Acquire("w"));
  EXPECT_EQ(farm_.StateOf(second), JobState::kDone);
}

TEST_F(MachineTest, F4_RestartWaitsOneTermAndAdoptsWhatWorkersHold) {
  const JobId job = farm_.Submit("a", 3);
  farm_.Join("w");
  const Grant held = *farm_.Acquire("w");
  farm_.Restart();
  EXPECT_EQ(farm_.StateOf(job), JobState::kQueued);
  farm_.Join("v");
  EXPECT_FALSE(farm_.Acquire("v")) << "somebody may still be rendering";
  EXPECT_EQ(farm_.Join("w", {BenchFarm::HoldingOf(held)}), (std::vector<AttemptId>{held.attempt}));
  EXPECT_EQ(farm_.FrameOf(job, 1), S::kRunning);
  EXPECT_TRUE(farm_.Renew("w", held));
  farm_.Pass(5'000);
  farm_.Renew("w", held);
  farm_.Renew("v", held);  // only to be heard
  farm_.Pass(5'000);
  const auto fresh = farm_.Acquire("v");
  ASSERT_TRUE(fresh);
  EXPECT_EQ(fresh->frame, 3u) << "the held frame is not given out twice";
  EXPECT_EQ(fresh->attempt.epoch, 2u);
  EXPECT_EQ(farm_.Complete("w", held), Outcome::kCommitted);
}

TEST_F(MachineTest, F4_ResultOfAnEarlierEpochCountsEvenBeforeItsFrameIsPlannedAgain) {
  farm_.Planning(false);
  const JobId job = farm_.Submit("a", 1);
  Grant grant{{1, 5}, Name("a"), 1, KeyOf("a", 1), false};  // granted before the crash
  farm_.Restart();
  farm_.Join("w");
  EXPECT_EQ(farm_.Complete("w", grant), Outcome::kCommitted);
  farm_.Restart();
  farm_.Planning(true);
  farm_.Pump();
  EXPECT_EQ(farm_.StateOf(job), JobState::kDone);
}

TEST_F(MachineTest, F4_RestartKeepsResultsFailuresAndCommands) {
  const JobId job = farm_.Submit("a", 5), paused = farm_.Submit("b", 2),
              cancelled = farm_.Submit("c", 2);
  farm_.Join("w");
  farm_.Complete("w", *farm_.Acquire("w"));
  farm_.Fail("w", *farm_.Acquire("w"), true);
  farm_.Command(paused, JobCommand::kPause);
  farm_.Command(cancelled, JobCommand::kCancel);
  const Counts before = farm_.CountsOf(job);
  farm_.Restart();
  EXPECT_EQ(farm_.CountsOf(job), before);
  EXPECT_EQ(farm_.StateOf(paused), JobState::kPaused);
  EXPECT_EQ(farm_.StateOf(cancelled), JobState::kCancelled);
  EXPECT_EQ(farm_.machine().FindJob(job)->render_ms, 100u);
}

TEST_F(MachineTest, F3_AskingAgainGivesTheSameAnswer) {
  farm_.Submit("a", 5);
  farm_.Join("w");
  const AcquireAnswer first = farm_.Ask("w", 1), again = farm_.Ask("w", 1);
  ASSERT_EQ(first.grants.size(), 1u);
  ASSERT_EQ(again.grants.size(), 1u);
  EXPECT_EQ(first.grants[0].attempt, again.grants[0].attempt);
  EXPECT_NE(farm_.Ask("w", 2).grants[0].attempt, first.grants[0].attempt);
  EXPECT_EQ(farm_.Ask("w", 1).refusal->code, Code::kAborted);
}

TEST_F(MachineTest, F9_WaitingCallIsAnsweredWhenWorkComesAndAfterHalfATermAtMost) {
  farm_.Join("w");
  EXPECT_TRUE(farm_.Ask("w", 1, 60'000).session.empty()) << "waits";
  farm_.Submit("a", 1);
  EXPECT_EQ(farm_.TakeAnswer("w").grants.size(), 1u);
  EXPECT_TRUE(farm_.Ask("w", 2, 60'000).session.empty());
  farm_.Pass(4'999);
  EXPECT_TRUE(farm_.TakeAnswer("w").session.empty());
  farm_.Pass(1);
  const AcquireAnswer answer = farm_.TakeAnswer("w");
  EXPECT_EQ(answer.session, "w");
  EXPECT_TRUE(answer.grants.empty());
}

TEST_F(MachineTest, F9_IdleWorkersComeBeforeThoseThatFetchAhead) {
  farm_.Submit("a", 1);
  farm_.Join("busy");
  farm_.Join("idle");
  ASSERT_TRUE(farm_.Acquire("busy"));
  farm_.Ask("busy", 50, 4'000);
  farm_.Ask("idle", 50, 4'000);
  farm_.Submit("b", 1);
  EXPECT_EQ(farm_.TakeAnswer("idle").grants.size(), 1u);
}

TEST_F(MachineTest, F5_LeaveGivesBackAtOnceAndCostsNothing) {
  farm_.Submit("a", 1);
  farm_.Join("w");
  farm_.Join("v");
  const Grant grant = *farm_.Acquire("w");
  farm_.machine().Leave("w", farm_.now());
  farm_.Pump();
  EXPECT_EQ(farm_.Acquire("v")->key, grant.key);
  EXPECT_EQ(farm_.KeyAt(grant.key).row.lost, 0u);
}

TEST_F(MachineTest, F3_DrainedWorkerFinishesAndGetsNothingNew) {
  farm_.Submit("a", 2);
  farm_.Join("w");
  const Grant grant = *farm_.Acquire("w");
  (void)farm_.machine().CommandWorker("w", WorkerCommand::kDrain, farm_.now());
  farm_.Pump();
  EXPECT_TRUE(farm_.Ask("w", 9).drain);
  EXPECT_EQ(farm_.Complete("w", grant), Outcome::kCommitted);
  (void)farm_.machine().CommandWorker("w", WorkerCommand::kRelease, farm_.now());
  farm_.Pump();
  EXPECT_EQ(farm_.Ask("w", 10).grants.size(), 1u);
}

TEST_F(MachineTest, F5_UnusableSceneFailsTheJobWithItsText) {
  const JobId job = farm_.Submit("broken", 3);
  EXPECT_EQ(farm_.StateOf(job), JobState::kFailed);
  EXPECT_EQ(farm_.machine().FindJob(job)->row.error, "this scene is broken");
  EXPECT_EQ(farm_.CountsOf(job), (Counts{3, 0, 0, 0, 0, 3}));
  farm_.Restart();
  EXPECT_EQ(farm_.StateOf(job), JobState::kFailed);
}

TEST_F(MachineTest, F5_FrameWithoutAKeyFailsAlone) {
  const JobId job = farm_.Submit("gappy", 3);
  farm_.Join("w");
  while (const auto grant = farm_.Acquire("w")) farm_.Complete("w", *grant);
  EXPECT_EQ(farm_.StateOf(job), JobState::kFailed);
  EXPECT_EQ(farm_.CountsOf(job), (Counts{3, 0, 0, 2, 0, 1}));
  farm_.Restart();
  EXPECT_EQ(farm_.CountsOf(job), (Counts{3, 0, 0, 2, 0, 1}));
}

TEST(MachineBoundsTest, F8_PlansOnlyAWindowAhead) {
  MachineConfig config;
  config.plan_window = 8;
  BenchFarm farm(config);
  const JobId job = farm.Submit("a", 100);
  const auto planned = [&] {
    int count = 0;
    for (const Frame& frame : farm.machine().FindJob(job)->frames) count += frame.key != nullptr;
    return count;
  };
  EXPECT_EQ(planned(), 8);
  farm.Join("w");
  for (int i = 0; i < 10; ++i) farm.Complete("w", *farm.Acquire("w"));
  EXPECT_LE(planned(), 18);
  while (const auto grant = farm.Acquire("w")) farm.Complete("w", *grant);
  EXPECT_EQ(farm.StateOf(job), JobState::kDone);
}

TEST(MachineBoundsTest, F8_EveryBoundIsANamedError) {
  MachineConfig config;
  config.max_jobs = 2;
  config.max_open_frames = 50;
  config.max_workers = 1;
  config.max_held = 2;
  BenchFarm farm(config);
  EXPECT_EQ(farm.Submit("a", 51), 0u);
  EXPECT_NE(farm.Submit("a", 40), 0u);
  EXPECT_EQ(farm.Submit("b", 11), 0u);
  EXPECT_NE(farm.Submit("b", 10), 0u);
  EXPECT_EQ(farm.Submit("c", 1), 0u);
  farm.Join("w");
  EXPECT_TRUE(farm.Acquire("w") && farm.Acquire("w"));
  EXPECT_FALSE(farm.Acquire("w"));
  JoinCall call;
  call.worker = call.session = "another";
  const auto answer = farm.machine().Join(call, farm.now());
  EXPECT_EQ(std::get<Refusal>(answer).code, Code::kLimit);
}

}  // namespace
}  // namespace fjord::server
