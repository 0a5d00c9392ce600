#include "client/follow_job.h"

#include <chrono>
#include <cstdlib>
#include <thread>

#include "client/console.h"
#include "client/farm_view.h"
#include "client/job_text.h"

namespace fjord {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds kWatchLimit{30};  // then the stream is opened anew
constexpr std::chrono::milliseconds kBeforeRetry{300};
constexpr double kLiveInterval = .1;
constexpr double kPlainInterval = 3;
constexpr double kWorkersInterval = 1;

class Follower {
 public:
  Follower(FarmClient& client, std::string job) : client_(client), job_(std::move(job)) {
    const char* language = std::getenv("LC_ALL");
    if (language == nullptr || *language == 0) language = std::getenv("LC_CTYPE");
    if (language == nullptr || *language == 0) language = std::getenv("LANG");
    const std::string name = language == nullptr ? "" : language;
    style_.unicode =
        name.find("UTF-8") != std::string::npos || name.find("utf8") != std::string::npos;
    style_.color = std::getenv("NO_COLOR") == nullptr;
  }

  ~Follower() { console::SetLive({}); }

  // One stream: until the job has ended, the limit, or an error.
  Result<> Watch() {
    first_ = true;
    return client_.Watch(job_, kWatchLimit,
                         [this](const v1::WatchResponse& message) { return Take(message); });
  }

  bool ended() const { return HasEnded(view_.job().state()); }
  const v1::Job& job() const { return view_.job(); }
  bool heard() const { return heard_; }
  void ForgetHearing() { heard_ = false; }

 private:
  double Seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

  bool Take(const v1::WatchResponse& message) {
    heard_ = true;
    view_.Apply(message, Seconds());
    if (first_) {
      first_ = false;
      if (const auto frames = client_.ListFrames(job_); frames.ok()) view_.SetFrames(*frames);
    }
    Show();
    return true;
  }

  void Show() {
    const double now = Seconds();
    const bool terminal = console::StderrIsTerminal();
    if (!ended() && now - shown_ < (terminal ? kLiveInterval : kPlainInterval)) return;
    shown_ = now;
    if (!terminal || ended()) {
      console::SetLive({});
      console::Note(view_.PlainLine(now));
      return;
    }
    if (now - workers_asked_ > kWorkersInterval) {
      workers_asked_ = now;
      if (auto workers = client_.ListWorkers(); workers.ok())
        view_.SetWorkers(std::move(workers).value());
    }
    style_.width = console::TerminalWidth();
    console::SetLive(view_.Lines(style_, now));
  }

  FarmClient& client_;
  const std::string job_;
  const Clock::time_point start_ = Clock::now();
  FarmView view_;
  ViewStyle style_;
  bool first_ = true;
  bool heard_ = false;
  double shown_ = -1e9;
  double workers_asked_ = -1e9;
};

}  // namespace

Result<v1::Job> FollowJob(FarmClient& client, const std::string& job) {
  Follower follower(client, job);
  Clock::time_point last_heard = Clock::now();
  bool lost = false;
  bool ever = false;
  for (;;) {
    follower.ForgetHearing();
    const Result<> watched = follower.Watch();
    if (follower.ended()) return follower.job();
    if (follower.heard()) {
      last_heard = Clock::now();
      ever = true;
      lost = false;
    }
    if (watched.ok()) continue;
    if (watched.error().code == ErrorCode::kLimit) {  // as a full disk: whoever waits goes on
      if (!lost) console::Note(watched.error().message + "; waiting");
      lost = true;
      std::this_thread::sleep_for(kBeforeRetry);
      continue;
    }
    if (watched.error().code != ErrorCode::kUnavailable || !ever) return watched.error();
    const double silent = std::chrono::duration<double>(Clock::now() - last_heard).count();
    if (silent > client.patience_seconds()) return watched.error();
    if (!lost) console::Note("the connection to " + client.address() + " is lost; trying again");
    lost = true;
    std::this_thread::sleep_for(kBeforeRetry);
  }
}

}  // namespace fjord
