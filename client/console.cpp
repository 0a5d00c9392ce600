#include "client/console.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <mutex>

#include "client/exit_code.h"

namespace fjord::console {
namespace {

std::mutex& Mutex() {
  static std::mutex mutex;
  return mutex;
}

std::string live_line;  // guarded by Mutex()

void ClearLive() {
  if (!live_line.empty()) std::fputs("\r\033[K", stderr);
}

void WriteLine(const std::string& line) {
  ClearLive();
  std::fputs((line + "\n").c_str(), stderr);
  if (!live_line.empty()) std::fputs(live_line.c_str(), stderr);
  std::fflush(stderr);
}

}  // namespace

bool StderrIsTerminal() {
  static const bool terminal = isatty(STDERR_FILENO) == 1;
  return terminal;
}

int TerminalWidth() {
  winsize size{};
  if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) return size.ws_col;
  return 80;
}

void Note(const std::string& line) {
  const std::lock_guard lock(Mutex());
  WriteLine(line);
}

int Fail(const Error& error) {
  const std::lock_guard lock(Mutex());
  WriteLine(error.ToString());
  return ExitCodeOf(error);
}

int Fail(const Errors& errors) {
  int code = kExitFailed;
  for (const Error& error : errors) code = Fail(error);
  return code;
}

void SetLiveLine(const std::string& line) {
  if (!StderrIsTerminal()) return;
  const std::lock_guard lock(Mutex());
  ClearLive();
  live_line = line;
  std::fputs(live_line.c_str(), stderr);
  std::fflush(stderr);
}

Result<> Print(const std::string& text) {
  const std::lock_guard lock(Mutex());
  ClearLive();
  if (std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0)
    return Ok{};
  return MakeError(ErrorCode::kIo, std::string("standard output: ") + std::strerror(errno));
}

}  // namespace fjord::console
