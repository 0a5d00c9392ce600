// Ctrl-C and SIGTERM as a flag that work looks at. The first asks the work to end in order; the
// second ends the program at once.
#pragma once

#include <atomic>

namespace fjord {

// From now on SIGINT, SIGTERM and SIGHUP set the flag. The flag lives as long as the program.
const std::atomic<bool>& CatchInterrupts();

}  // namespace fjord
