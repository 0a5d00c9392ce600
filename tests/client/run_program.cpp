#include "tests/client/run_program.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <thread>

#include "client/cli.h"
#include "engine/image/picture_files.h"

namespace fjord::testing {

namespace fs = std::filesystem;

ScratchFolder::ScratchFolder() {
  std::string pattern = (fs::temp_directory_path() / "fjord test XXXXXX").string();
  path_ = mkdtemp(pattern.data());
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

std::string ScratchFolder::Write(const std::string& name, const std::string& bytes) const {
  const fs::path path = path_ / name;
  fs::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary) << bytes;
  return path.string();
}

RunningProgram::RunningProgram(const std::vector<std::string>& argv,
                               const ProgramOptions& options) {
  std::vector<char*> arguments;
  for (const std::string& argument : argv) arguments.push_back(const_cast<char*>(argument.c_str()));
  arguments.push_back(nullptr);
  const std::string out = folder_ / "out";
  const std::string err = folder_ / "err";
  std::fflush(nullptr);
  pid_ = fork();
  if (pid_ != 0) return;
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  const int flags = O_WRONLY | O_CREAT | O_TRUNC;
  dup2(open("/dev/null", O_RDONLY), 0);
  dup2(open(out.c_str(), flags, 0600), 1);
  dup2(open(err.c_str(), flags, 0600), 2);
  if (!options.folder.empty() && chdir(options.folder.c_str()) != 0) _exit(126);
  for (const std::string& pair : options.environment) putenv(const_cast<char*>(pair.c_str()));
  if (options.largest_file > 0) {
    signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{options.largest_file, options.largest_file};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  if (argv[0].empty()) {
    char name[] = "fjord";
    arguments[0] = name;
    const int code = RunCommandLine(static_cast<int>(argv.size()), arguments.data());
    std::fflush(nullptr);
    _exit(code);
  }
  execvp(arguments[0], arguments.data());
  _exit(127);
}

RunningProgram::~RunningProgram() {
  if (pid_ > 0) {
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
}

void RunningProgram::Signal(int signal) const {
  if (pid_ > 0) kill(pid_, signal);
}

std::string RunningProgram::OutSoFar() const { return ReadAll(folder_ / "out"); }

ProgramRun RunningProgram::Wait() {
  int status = 0;
  waitpid(pid_, &status, 0);
  pid_ = -1;
  return {WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status),
          ReadAll(folder_ / "out"), ReadAll(folder_ / "err")};
}

ProgramRun RunProgram(const std::vector<std::string>& argv, const ProgramOptions& options) {
  return RunningProgram(argv, options).Wait();
}

ProgramRun RunFjord(std::vector<std::string> arguments, const ProgramOptions& options) {
  EXPECT_TRUE(OpenPictureFiles().ok());
  arguments.insert(arguments.begin(), "");
  return RunProgram(arguments, options);
}

ProgramRun RunFjordAnew(std::vector<std::string> arguments, const ProgramOptions& options) {
  arguments.insert(arguments.begin(), FJORD_PROGRAM);
  return RunProgram(arguments, options);
}

bool WaitUntil(const std::function<bool()>& done) {
  const auto limit = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while (!done()) {
    if (std::chrono::steady_clock::now() > limit) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return true;
}

std::string ReadAll(const std::string& path) {
  std::ostringstream bytes;
  bytes << std::ifstream(path, std::ios::binary).rdbuf();
  return bytes.str();
}

std::string Example(const std::string& name) {
  return std::string(FJORD_SOURCE_DIR) + "/examples/" + name;
}

std::string TinyScene(int frames) {
  return "name: \"tiny\"\noutput { width: 48 height: 32 frames: " + std::to_string(frames) +
         " samples: 1 }\n"
         "camera { eye { x: 0 y: -5 z: 3 } look_at {} fov: 40 }\n"
         "objects {\n"
         "  name: \"hill\"\n"
         "  shape { primitive { kind: GRID size { x: 3 y: 3 } segments: 2 rings: 2 } }\n"
         "  fractal { method: \"surface\" seed: 5 H: 0.7 amplitude: 0.2 pixels: 8 }\n"
         "}\n"
         "track { path: \"objects[hill].transform.rotate.z\" key { frame: 1 value: 0 } key { "
         "frame: " +
         std::to_string(std::max(2, frames)) + " value: 90 } }\n";
}

}  // namespace fjord::testing
