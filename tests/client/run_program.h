// Runs the built programs as a user would, and gives back what they said.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace fjord::testing {

struct ProgramRun {
  int code = -1;  // exit status; 128 + signal
  std::string out;
  std::string err;
};

struct ProgramOptions {
  std::string folder;                    // working folder; empty: this one
  std::vector<std::string> environment;  // NAME=VALUE, besides this process's
  uint64_t largest_file = 0;             // > 0: writing beyond so many bytes of a file fails
};

// A folder of its own that goes away at the end of the test.
class ScratchFolder {
 public:
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }
  std::string path() const { return path_.string(); }
  std::string Write(const std::string& name, const std::string& bytes) const;

 private:
  std::filesystem::path path_;
};

// A program that runs beside the test; killed at the end of its life.
class RunningProgram {
 public:
  // argv[0] empty: `fjord`, as a copy of this process.
  RunningProgram(const std::vector<std::string>& argv, const ProgramOptions& options = {});
  ~RunningProgram();
  pid_t pid() const { return pid_; }
  void Signal(int signal) const;
  // Waits for its end.
  ProgramRun Wait();
  // What it has printed so far.
  std::string OutSoFar() const;

 private:
  ScratchFolder folder_;
  pid_t pid_ = -1;
};

ProgramRun RunProgram(const std::vector<std::string>& argv, const ProgramOptions& options = {});

// fjord ARGS... as a copy of this process that runs the command line: the picture libraries, which
// take a quarter of a second to load, are there already. Not in a process that runs gRPC.
ProgramRun RunFjord(std::vector<std::string> arguments, const ProgramOptions& options = {});
// fjord ARGS..., the program itself.
ProgramRun RunFjordAnew(std::vector<std::string> arguments, const ProgramOptions& options = {});

// Waits until `done` says true, a minute at most; the answer is what it said last.
bool WaitUntil(const std::function<bool()>& done);

std::string ReadAll(const std::string& path);
std::string Example(const std::string& name);  // path of a file in examples/

// A scene of `frames` quick, tiny frames.
std::string TinyScene(int frames);

}  // namespace fjord::testing
