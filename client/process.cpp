#include "client/process.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

namespace fjord {
namespace {

Error SystemError(const std::string& what) {
  return MakeError(ErrorCode::kIo, what + ": " + std::strerror(errno));
}

// In the child: nothing but async-signal-safe calls.
[[noreturn]] void Become(char** argv, const ChildOptions& options, pid_t parent, int report) {
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) _exit(127);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGCHLD}) {
    struct sigaction action {};
    action.sa_handler = SIG_DFL;
    sigaction(signal, &action, nullptr);
  }
  const int input = options.input >= 0 ? options.input : open("/dev/null", O_RDONLY);
  bool ready = dup2(input, STDIN_FILENO) >= 0;
  if (options.output >= 0) ready = ready && dup2(options.output, STDOUT_FILENO) >= 0;
  if (options.errors >= 0) ready = ready && dup2(options.errors, STDERR_FILENO) >= 0;
  if (ready) execvp(argv[0], argv);
  const int reason = errno;
  const ssize_t written = write(report, &reason, sizeof reason);
  _exit(written == sizeof reason ? 127 : 126);
}

}  // namespace

Result<Pipe> MakePipe() {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) return SystemError("pipe");
  return Pipe{ends[0], ends[1]};
}

Result<pid_t> StartChild(const std::vector<std::string>& argv, const ChildOptions& options) {
  std::vector<char*> arguments;
  for (const std::string& argument : argv) arguments.push_back(const_cast<char*>(argument.c_str()));
  arguments.push_back(nullptr);
  const Result<Pipe> report = MakePipe();
  if (!report.ok()) return report.error();
  const pid_t parent = getpid();
  const pid_t child = fork();
  if (child == 0) Become(arguments.data(), options, parent, report->write_end);
  close(report->write_end);
  int reason = 0;
  ssize_t got = 0;
  if (child > 0) {
    do {
      got = read(report->read_end, &reason, sizeof reason);
    } while (got < 0 && errno == EINTR);
  }
  const int fork_reason = errno;
  close(report->read_end);
  if (child < 0) {
    errno = fork_reason;
    return SystemError("fork");
  }
  if (got == sizeof reason) {
    WaitForChild(child);
    return MakeError(reason == ENOENT ? ErrorCode::kNotFound : ErrorCode::kIo,
                     argv[0] + " cannot be started: " + std::strerror(reason));
  }
  return child;
}

int WaitForChild(pid_t child) {
  int status = 0;
  while (waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) return 127;
  }
  return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}

std::string ProgramFolder() {
  std::error_code error;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", error);
  return error ? "." : self.parent_path().string();
}

}  // namespace fjord
