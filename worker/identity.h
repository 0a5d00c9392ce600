// A worker's name that is the same after a restart, though several workers share a machine.
#pragma once

#include <string>

namespace fjord::worker {

// HOST-N with the smallest N that no living process of this user holds. The name is held, by a lock
// in the user's runtime folder, until the process ends.
std::string TakeWorkerId();

}  // namespace fjord::worker
