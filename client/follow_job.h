// Follows a job to its end: the live view of `watch` and `submit --wait`.
#pragma once

#include <string>

#include "client/farm_client.h"

namespace fjord {

// The job as it ended. A coordinator that is started again goes on where it was: a lost connection
// is tried again for the client's patience, then kUnavailable.
Result<v1::Job> FollowJob(FarmClient& client, const std::string& job);

}  // namespace fjord
