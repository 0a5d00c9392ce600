#include "client/local_farm.h"

#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <map>
#include <vector>

#include "client/console.h"
#include "client/files.h"
#include "client/process.h"
#include "engine/base/parallel.h"

namespace fjord {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds kStartLimit{60};
constexpr std::chrono::seconds kStopLimit{10};
// More deaths than this within the window: something is wrong that starting again does not mend.
constexpr int kMostDeaths = 20;
constexpr std::chrono::seconds kDeathWindow{60};

// Beside this program, or where the build puts it, or in PATH.
std::string FindProgram(const std::string& name, const std::string& build_folder) {
  const std::string here = ProgramFolder();
  for (const std::string& path : {here + "/" + name, here + "/../" + build_folder + "/" + name}) {
    if (access(path.c_str(), X_OK) == 0) return path;
  }
  return name;
}

class LocalFarm {
 public:
  explicit LocalFarm(const LocalFarmOptions& options)
      : options_(options),
        workers_(options.workers > 0 ? options.workers : std::max(1, HardwareThreads() / 2)) {
    sigemptyset(&signals_);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGCHLD}) sigaddset(&signals_, signal);
    sigprocmask(SIG_BLOCK, &signals_, &before_);
  }

  ~LocalFarm() {
    Stop();
    sigprocmask(SIG_SETMASK, &before_, nullptr);
  }

  Result<> Run(const std::function<void(const std::string&)>& on_ready) {
    if (Result<> started = StartServer(options_.listen); !started.ok()) return started;
    for (int number = 1; number <= workers_; ++number) {
      if (Result<> started = StartWorker(number); !started.ok()) return started;
    }
    on_ready(address_);
    for (;;) {
      const int signal = sigwaitinfo(&signals_, nullptr);
      if (signal < 0 && errno == EINTR) continue;
      if (signal != SIGCHLD) return Ok{};
      if (Result<> mended = Reap(); !mended.ok()) return mended;
    }
  }

 private:
  // Starts the coordinator and reads its address.
  Result<> StartServer(const std::string& listen) {
    const Result<Pipe> pipe = MakePipe();
    if (!pipe.ok()) return pipe.error();
    std::vector<std::string> command = {FindProgram("fjord-server", "server"), "--listen", listen,
                                        "--data", options_.data};
    if (!options_.budget.empty()) command.insert(command.end(), {"--budget", options_.budget});
    const Result<pid_t> child = StartChild(command, {-1, pipe->write_end, -1});
    close(pipe->write_end);
    if (!child.ok()) {
      close(pipe->read_end);
      return child.error();
    }
    server_ = *child;
    if (output_ >= 0) close(output_);
    output_ = pipe->read_end;
    return ReadAddress();
  }

  Result<> ReadAddress() {
    const std::string head = "listening on ";
    std::string text;
    const auto limit = Clock::now() + kStartLimit;
    while (text.find('\n') == std::string::npos) {
      const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(limit - Clock::now());
      pollfd waiting{output_, POLLIN, 0};
      char chunk[512];
      if (left.count() <= 0 || poll(&waiting, 1, static_cast<int>(left.count())) == 0)
        return MakeError(ErrorCode::kIo, "the coordinator did not start within a minute");
      const ssize_t got = read(output_, chunk, sizeof chunk);
      if (got <= 0 && errno != EINTR)
        return MakeError(ErrorCode::kIo, "the coordinator ended at once; what it said is above");
      if (got > 0) text.append(chunk, static_cast<size_t>(got));
    }
    const size_t begin = text.find(head);
    if (begin == std::string::npos)
      return MakeError(ErrorCode::kIo, "the coordinator did not say where it listens");
    const size_t from = begin + head.size();
    address_ = text.substr(from, text.find('\n', from) - from);
    return Ok{};
  }

  Result<> StartWorker(int number) {
    const int cores = HardwareThreads();
    const int threads = options_.threads > 0 ? options_.threads : std::max(1, cores / workers_);
    char host[256] = "local";
    gethostname(host, sizeof host - 1);
    const std::string name = "worker-" + std::to_string(number);
    const Result<pid_t> child = StartChild(
        {FindProgram("fjord-worker", "worker"), "--server", address_, "--threads",
         std::to_string(threads), "--id", std::string(host) + "-" + std::to_string(number),
         "--stay", "--cache", options_.data + "/" + name},
        {});
    if (!child.ok()) return child.error();
    worker_number_[*child] = number;
    return Ok{};
  }

  // Starts again whatever has died.
  Result<> Reap() {
    int status = 0;
    for (pid_t child = 0; (child = waitpid(-1, &status, WNOHANG)) > 0;) {
      const auto now = Clock::now();
      deaths_.push_back(now);
      std::erase_if(deaths_, [&](const auto& death) { return now - death > kDeathWindow; });
      if (deaths_.size() > kMostDeaths)
        return MakeError(ErrorCode::kInternal,
                         "the farm's programs keep ending; what they said is above");
      const std::string how = WIFSIGNALED(status)
                                  ? std::string("was killed: ") + strsignal(WTERMSIG(status))
                                  : "ended with code " + std::to_string(WEXITSTATUS(status));
      if (child == server_) {
        console::Note("the coordinator " + how + "; starting it again");
        if (Result<> started = StartServer(address_); !started.ok()) return started;
      } else if (const auto worker = worker_number_.find(child); worker != worker_number_.end()) {
        const int number = worker->second;
        worker_number_.erase(worker);
        console::Note("worker " + std::to_string(number) + " " + how + "; starting it again");
        if (Result<> started = StartWorker(number); !started.ok()) return started;
      }
    }
    return Ok{};
  }

  void Stop() {
    std::vector<pid_t> workers;
    for (const auto& [child, number] : worker_number_) workers.push_back(child);
    End(workers);
    if (server_ > 0) End({server_});
    if (output_ >= 0) close(output_);
  }

  static void End(std::vector<pid_t> children) {
    for (const pid_t child : children) kill(child, SIGTERM);
    const auto limit = Clock::now() + kStopLimit;
    sigset_t child_signal;
    sigemptyset(&child_signal);
    sigaddset(&child_signal, SIGCHLD);
    while (!children.empty() && Clock::now() < limit) {
      std::erase_if(children, [](pid_t child) { return waitpid(child, nullptr, WNOHANG) != 0; });
      const timespec pause{0, 50'000'000};
      if (!children.empty()) sigtimedwait(&child_signal, nullptr, &pause);
    }
    for (const pid_t child : children) {
      kill(child, SIGKILL);
      WaitForChild(child);
    }
  }

  const LocalFarmOptions options_;
  const int workers_;
  sigset_t signals_;
  sigset_t before_;
  std::string address_;
  pid_t server_ = -1;
  int output_ = -1;  // the coordinator's stdout
  std::map<pid_t, int> worker_number_;
  std::vector<Clock::time_point> deaths_;
};

}  // namespace

Result<> RunLocalFarm(const LocalFarmOptions& options,
                      const std::function<void(const std::string& address)>& on_ready) {
  if (options.with_parent) prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (Result<> made = MakeFolder(options.data, "--data"); !made.ok()) return made;
  return LocalFarm(options).Run(on_ready);
}

}  // namespace fjord
