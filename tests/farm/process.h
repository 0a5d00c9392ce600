// A child process of a test: started with arguments and extra environment, its standard output read
// line by line, ended with the object.
#pragma once

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

namespace fjord::farm_test {

class Process {
 public:
  Process(const std::vector<std::string>& words,
          const std::vector<std::pair<std::string, std::string>>& environment = {},
          const std::string& errors = "") {  // a file for its standard error; empty: this one's
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) std::abort();
    std::vector<char*> arguments;
    for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    std::vector<std::string> all;
    for (char** entry = environ; *entry != nullptr; ++entry) all.emplace_back(*entry);
    for (const auto& [name, value] : environment) all.push_back(name + "=" + value);
    std::vector<char*> pointers;
    for (std::string& entry : all) pointers.push_back(entry.data());
    pointers.push_back(nullptr);
    pid_ = fork();
    if (pid_ == 0) {
      prctl(PR_SET_PDEATHSIG, SIGKILL);
      dup2(ends[1], STDOUT_FILENO);
      if (!errors.empty()) {
        dup2(open(errors.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600), STDERR_FILENO);
      }
      execve(arguments[0], arguments.data(), pointers.data());
      _exit(127);
    }
    close(ends[1]);
    output_ = ends[0];
  }
  ~Process() {
    Kill(SIGKILL);
    Wait();
    close(output_);
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  void Kill(int signal) {
    if (!ended_) kill(pid_, signal);
  }
  // The status of waitpid.
  int Wait() {
    if (!ended_) {
      while (waitpid(pid_, &status_, 0) < 0 && errno == EINTR) {
      }
      ended_ = true;
    }
    return status_;
  }
  pid_t pid() const { return pid_; }
  // Empty: the process ended or closed its output, or said nothing for so long.
  std::string ReadLine(int timeout_ms = 30'000) {
    std::string line;
    pollfd waiting{output_, POLLIN, 0};
    while (poll(&waiting, 1, timeout_ms) > 0) {
      char c = 0;
      if (read(output_, &c, 1) != 1) return "";
      if (c == '\n') return line;
      line += c;
    }
    return "";
  }
  std::string ReadAll() {
    std::string all;
    char buffer[4096];
    for (ssize_t count; (count = read(output_, buffer, sizeof buffer)) > 0;)
      all.append(buffer, count);
    return all;
  }

 private:
  pid_t pid_ = 0;
  int output_ = -1;
  int status_ = 0;
  bool ended_ = false;
};

}  // namespace fjord::farm_test
