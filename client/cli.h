// The command line of `fjord`.
#pragma once

namespace fjord {

// Runs one command; gives the exit code (exit_code.h). Never throws.
int RunCommandLine(int argc, char** argv);

}  // namespace fjord
