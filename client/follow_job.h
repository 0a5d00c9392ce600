// Follows a job to its end: the live view of `watch` and `submit --wait`.
#pragma once

#include <string>

#include "client/farm_client.h"

namespace fjord {

struct FollowOptions {
  // How long to keep trying when the server is gone: a coordinator that is started again goes on
  // where it was.
  double patience_seconds = 20;
};

// The job as it ended. kUnavailable after a lost connection that did not come back.
Result<v1::Job> FollowJob(FarmClient& client, const std::string& job, const FollowOptions& options);

}  // namespace fjord
