// A unit in a child process. What the child writes to standard output:
//   one '.' for each step of progress, then
//   "\nok PIXEL_DIGEST TRIANGLES MILLISECONDS BYTES\n" and the picture, or "\nerror CODE\nMESSAGE".
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <sstream>
#include <thread>
#include <vector>

#include "engine/base/digest.h"
#include "worker/unit_renderer.h"

extern char** environ;

namespace fjord::worker {
namespace {

constexpr int kLookForCancelMs = 50;

class ChildRenderer : public UnitRenderer {
 public:
  ChildRenderer(std::string program, std::string server, int threads)
      : program_(std::move(program)), server_(std::move(server)), threads_(threads) {}

  Result<RenderedUnit> Render(const UnitOrder& order, std::atomic<uint64_t>& progress,
                              const std::atomic<bool>& cancel) override {
    int pipe_ends[2];
    if (pipe2(pipe_ends, O_CLOEXEC) != 0) {
      return MakeError(ErrorCode::kUnavailable, std::string("no pipe: ") + strerror(errno));
    }
    pid_t child = 0;
    const int failed = Spawn(order, pipe_ends[1], &child);
    close(pipe_ends[1]);
    if (failed != 0) {
      close(pipe_ends[0]);
      return MakeError(ErrorCode::kUnavailable, "cannot run " + program_ + ": " + strerror(failed));
    }
    const std::string answer = Listen(pipe_ends[0], child, progress, cancel);
    close(pipe_ends[0]);
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    if (cancel.load()) return MakeError(ErrorCode::kCancelled, "cancelled");
    if (WIFSIGNALED(status)) {
      return MakeError(ErrorCode::kInternal,
                       "the process that rendered this frame alone died of signal " +
                           std::to_string(WTERMSIG(status)) + " (" + strsignal(WTERMSIG(status)) +
                           ")");
    }
    return Parse(answer, WEXITSTATUS(status));
  }

 private:
  int Spawn(const UnitOrder& order, int output, pid_t* child) const {
    std::vector<std::string> words = {program_,
                                      "--server",
                                      server_,
                                      "--threads",
                                      std::to_string(threads_),
                                      "--render-unit",
                                      order.scene,
                                      std::to_string(order.frame),
                                      order.frame_key};
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_adddup2(&files, output, STDOUT_FILENO);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    sigset_t none;
    sigemptyset(&none);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK);
    const int failed =
        posix_spawn(child, program_.c_str(), &files, &attributes, arguments.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&files);
    return failed;
  }

  // Until the child closes its output.
  static std::string Listen(int input, pid_t child, std::atomic<uint64_t>& progress,
                            const std::atomic<bool>& cancel) {
    std::string answer;
    bool in_answer = false;
    char buffer[1 << 16];
    while (true) {
      if (cancel.load()) kill(child, SIGKILL);
      pollfd waiting{input, POLLIN, 0};
      if (poll(&waiting, 1, kLookForCancelMs) == 0) continue;
      const ssize_t count = read(input, buffer, sizeof buffer);
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) return answer;
      progress.fetch_add(1, std::memory_order_relaxed);
      std::string_view bytes(buffer, static_cast<size_t>(count));
      if (!in_answer) {
        const size_t begin = bytes.find('\n');
        if (begin == std::string_view::npos) continue;
        bytes.remove_prefix(begin + 1);
        in_answer = true;
      }
      answer += bytes;
    }
  }

  static Result<RenderedUnit> Parse(const std::string& answer, int exit_code) {
    const size_t end = answer.find('\n');
    std::istringstream head(answer.substr(0, end));
    std::string word;
    head >> word;
    RenderedUnit unit;
    size_t bytes = 0;
    if (word == "ok" && head >> unit.pixel_digest >> unit.triangles >> unit.render_ms >> bytes &&
        end != std::string::npos && answer.size() - end - 1 == bytes) {
      unit.picture = answer.substr(end + 1);
      unit.blob_digest = Sha256Of(unit.picture).Hex();
      return unit;
    }
    int code = 0;
    if (word == "error" && head >> code && end != std::string::npos) {
      return MakeError(static_cast<ErrorCode>(code), answer.substr(end + 1));
    }
    return MakeError(ErrorCode::kInternal,
                     "the process that rendered this frame alone ended with code " +
                         std::to_string(exit_code) + " and without an answer");
  }

  const std::string program_;
  const std::string server_;
  const int threads_;
};

}  // namespace

std::unique_ptr<UnitRenderer> MakeChildRenderer(std::string program, std::string server,
                                                int threads) {
  return std::make_unique<ChildRenderer>(std::move(program), std::move(server), threads);
}

int RenderForParent(UnitRenderer& renderer, const UnitOrder& order) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  std::atomic<uint64_t> progress{0};
  std::atomic<bool> cancel{false}, done{false};
  std::thread ticker([&] {
    for (uint64_t seen = 0; !done.load();) {
      std::this_thread::sleep_for(std::chrono::milliseconds(kLookForCancelMs));
      if (const uint64_t now = progress.load(); now != seen) {
        seen = now;
        if (write(STDOUT_FILENO, ".", 1) != 1) _exit(1);
      }
    }
  });
  const Result<RenderedUnit> unit = renderer.Render(order, progress, cancel);
  done = true;
  ticker.join();
  if (!unit.ok()) {
    std::printf("\nerror %d\n%s", static_cast<int>(unit.error().code),
                unit.error().message.c_str());
    return std::fflush(stdout) == 0 ? 1 : 2;
  }
  std::printf("\nok %s %llu %u %zu\n", unit->pixel_digest.c_str(),
              static_cast<unsigned long long>(unit->triangles), unit->render_ms,
              unit->picture.size());
  std::fwrite(unit->picture.data(), 1, unit->picture.size(), stdout);
  return std::fflush(stdout) == 0 ? 0 : 2;
}

}  // namespace fjord::worker
