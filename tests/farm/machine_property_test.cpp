// Random stories: whatever happens in whatever order, the invariants hold (BenchFarm audits them
// after every step), nothing that was answered is lost in a restart, and the farm can always be
// brought to an end.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "bench_farm.h"

namespace fjord::server {
namespace {

MachineConfig Small() {
  MachineConfig config;
  config.plan_window = 4;
  config.term_ms = 1'000;
  config.stall_ms = 4'000;
  return config;
}

// Over the whole range from the first story on (RapidCheck would begin small).
template <typename T>
T Pick(T low, T high) {
  return *rc::gen::resize(rc::kNominalSize, rc::gen::inRange<T>(low, high));
}

class Story {
 public:
  explicit Story(bool liars) : liars_(liars) {}

  void Step() {
    const int what = Pick(0, 17);
    switch (what) {
      case 0:
        Submit();
        break;
      case 1:
        Command();
        break;
      case 2:
      case 3:
        Join();
        break;
      case 4:
      case 5:
      case 6:
      case 7:
        Acquire();
        break;
      case 8:
      case 9:
      case 10:
      case 11:
        Complete();
        break;
      case 12:
        if (const Held* held = Any()) farm_.Fail(held->session, held->grant, Pick(0, 8) == 0);
        break;
      case 13:
        if (const Held* held = Any()) farm_.Renew(held->session, held->grant, Pick(0, 4));
        break;
      case 14:
        farm_.Pass(Pick(1, 1'500));
        break;
      case 15:
        Restart();
        break;
      case 16:
        LosePicture();
        break;
    }
    RC_ASSERT(!testing::Test::HasFailure());
    RC_ASSERT(farm_.machine().Audit().empty());
  }

  // Honest workers finish whatever is not paused, cancelled or failed.
  void End() {
    for (const auto& [id, job] : farm_.machine().jobs()) {
      if (job.row.paused) farm_.Command(id, JobCommand::kResume);
    }
    farm_.Pass(1'000);
    for (const char* worker : {"h1", "h2", "h3", "h4"}) farm_.Join(worker);
    for (bool moved = true; moved;) {
      moved = false;
      for (const std::string worker : {"h1", "h2", "h3", "h4"}) {
        while (const auto grant = farm_.Acquire(worker)) {
          farm_.Complete(worker, *grant);
          moved = true;
        }
      }
    }
    for (const auto& [id, job] : farm_.machine().jobs()) {
      RC_ASSERT(job.ended());
    }
  }

 private:
  struct Held {
    std::string session;
    Grant grant;
  };

  std::string Worker() {
    static const char* const kNames[] = {"a", "b", "c", "d"};
    return kNames[Pick(0, 4)];
  }
  const Held* Any() {
    return grants_.empty() ? nullptr : &grants_[Pick<size_t>(0, grants_.size())];
  }
  void Submit() {
    if (farm_.machine().jobs().size() > 6) return;
    JobSpec spec;
    spec.priority = Pick(-1, 2);
    spec.project = Pick(0, 2) == 0 ? "p" : "q";
    spec.verify_share = Pick(0, 3) == 0 ? .5 : 0;
    if (Pick(0, 3) == 0 && !farm_.machine().jobs().empty()) {
      spec.after = farm_.machine().jobs().rbegin()->first;
    }
    if (Pick(0, 3) == 0) spec.frames = *FrameSet::Parse("2-9x3,20");
    spec.frame_limit_ms = Pick(0u, 3u) * 1'000;
    const char* scene = *rc::gen::element("s", "t", "gappy", "broken");
    farm_.Submit(scene, Pick(1u, 9u), spec);
  }
  void Command() {
    if (farm_.machine().jobs().empty()) return;
    const JobId job = Pick<JobId>(1, farm_.machine().jobs().rbegin()->first + 1);
    farm_.Command(job, static_cast<JobCommand>(Pick(1, 7)), Pick(-2, 3));
  }
  void Join() {
    const std::string worker = Worker();
    const std::string process = std::to_string(Pick(0, 2));
    std::vector<Holding> holdings;
    for (const Held& held : grants_) {
      if (held.session.substr(0, 1) == worker && holdings.size() < 3 && Pick(0, 2) == 0) {
        holdings.push_back(BenchFarm::HoldingOf(held.grant));
      }
    }
    if (Pick(0, 3) == 0) return JoinAsTwin(worker, process);
    farm_.Join(worker, holdings, process);
  }
  // Without knowing whether the session before is over: what that one holds stays its own.
  void JoinAsTwin(const std::string& name, const std::string& process) {
    JoinCall call;
    call.worker = name;
    call.session = name + process;
    call.waited_ms = Pick(0, 2'000);
    const server::Worker* known = farm_.machine().roster().FindWorker(name);
    const std::string before = known == nullptr ? "" : known->session;
    const size_t held = farm_.machine().leases().CountHeldBy(before);
    const auto answer = farm_.Join(call);
    RC_ASSERT(std::holds_alternative<Refusal>(answer) ==
              (!before.empty() && before != call.session));
    if (!std::holds_alternative<Refusal>(answer)) return;
    RC_ASSERT(farm_.machine().roster().FindWorker(name)->session == before);
    RC_ASSERT(farm_.machine().leases().CountHeldBy(before) == held);
  }
  void Acquire() {
    const std::string session = Worker() + std::to_string(Pick(0, 2));
    if (const auto grant = farm_.Acquire(session)) grants_.push_back({session, *grant});
  }
  void Complete() {
    const Held* held = Any();
    if (held == nullptr) return;
    // Sometimes another worker delivers it, sometimes a wrong picture.
    const std::string session = Pick(0, 6) == 0 ? Worker() + "0" : held->session;
    const bool lie = liars_ && session[0] == 'd' && Pick(0, 2) == 0;
    const Grant grant = held->grant;
    const auto answer =
        farm_.Deliver(session, BenchFarm::Picture(grant, lie ? "lie " + std::to_string(Pick(0, 2))
                                                             : "picture of " + grant.key.Hex()));
    const Outcome* outcome = std::get_if<Outcome>(&answer);
    if (outcome == nullptr || lie) return;
    if (*outcome == Outcome::kCommitted || *outcome == Outcome::kDuplicate)
      answered_.insert(grant.key);
  }
  // The store has lost it; what was answered of its key rests on nothing any more.
  void LosePicture() {
    if (answered_.empty()) return;
    const Digest key = *std::next(answered_.begin(), Pick<size_t>(0, answered_.size()));
    const Key* known = farm_.machine().FindKey(key);
    if (known == nullptr || known->evidence.empty()) return;  // with a liar
    const Digest blob = known->evidence.front().blob;
    farm_.LoseBlob(blob);
    RC_ASSERT(std::none_of(known->evidence.begin(), known->evidence.end(),
                           [&](const ResultRow& row) { return row.blob == blob; }));
    if (known->evidence.empty()) answered_.erase(key);
  }
  void Restart() {
    std::map<JobId, Counts> before;
    for (const auto& [id, job] : farm_.machine().jobs()) before[id] = job.counts;
    farm_.Restart();
    for (const auto& [id, counts] : before) {
      const Counts after = farm_.CountsOf(id);
      RC_ASSERT(after.total == counts.total);
      RC_ASSERT(after.done == counts.done);
      RC_ASSERT(after.failed == counts.failed);
      RC_ASSERT(after.cached == counts.cached);
    }
    if (liars_) return;
    for (const Digest& key : answered_) {
      const Key* known = farm_.machine().FindKey(key);
      RC_ASSERT(known != nullptr);
      RC_ASSERT(!known->evidence.empty());
    }
  }

  const bool liars_;
  BenchFarm farm_{Small()};
  std::vector<Held> grants_;
  std::set<Digest> answered_;
};

void Tell(bool liars) {
  Story story(liars);
  const int steps = Pick(1, 120);
  for (int i = 0; i < steps; ++i) story.Step();
  story.End();
}

RC_GTEST_PROP(MachineProperty, F3_F4_F6_HonestFarmKeepsItsInvariants, ()) { Tell(false); }
RC_GTEST_PROP(MachineProperty, F3_LiarsAreSurvived, ()) { Tell(true); }

}  // namespace
}  // namespace fjord::server
