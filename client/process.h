// Child processes without a shell. A child dies with its parent (PR_SET_PDEATHSIG), so nothing is
// left running when a program of ours is killed. Start children from the main thread: the kernel
// counts the starting thread as the parent.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

#include "engine/base/result.h"

namespace fjord {

struct ChildOptions {
  int input = -1;   // becomes stdin; -1: /dev/null
  int output = -1;  // becomes stdout; -1: that of the parent
  int errors = -1;  // becomes stderr; -1: that of the parent
};

// argv[0] is looked up in PATH where it has no slash. kNotFound where there is no such program.
Result<pid_t> StartChild(const std::vector<std::string>& argv, const ChildOptions& options);

// Waits for its end. The exit status, or 128 + signal.
int WaitForChild(pid_t child);

// A pipe whose ends close on exec.
struct Pipe {
  int read_end = -1;
  int write_end = -1;
};
Result<Pipe> MakePipe();

// The folder of the running program.
std::string ProgramFolder();

}  // namespace fjord
