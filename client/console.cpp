#include "client/console.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <mutex>

#include "client/exit_code.h"
#include "engine/base/printable.h"

namespace fjord::console {
namespace {

std::mutex& Mutex() {
  static std::mutex mutex;
  return mutex;
}

std::vector<std::string> live;  // guarded by Mutex()

// The cursor stands below the live lines.
void ClearLive() {
  if (!live.empty()) std::fprintf(stderr, "\033[%zuA\r\033[J", live.size());
}

void DrawLive() {
  std::string block;
  for (const std::string& line : live) block += line + "\n";
  std::fputs(block.c_str(), stderr);
}

void WriteLine(const std::string& line) {
  ClearLive();
  std::fputs((PrintableLines(line) + "\n").c_str(), stderr);
  DrawLive();
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

void SetLive(const std::vector<std::string>& lines) {
  if (!StderrIsTerminal()) return;
  const std::lock_guard lock(Mutex());
  ClearLive();
  live = lines;
  DrawLive();
  std::fflush(stderr);
}

Result<> Print(const std::string& text) {
  const std::string clean = PrintableLines(text);
  const std::lock_guard lock(Mutex());
  if (std::fwrite(clean.data(), 1, clean.size(), stdout) == clean.size() &&
      std::fflush(stdout) == 0)
    return Ok{};
  return MakeError(ErrorCode::kIo, std::string("standard output: ") + std::strerror(errno));
}

}  // namespace fjord::console
