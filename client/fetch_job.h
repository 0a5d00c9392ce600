// Brings the finished frames of a job into a folder, as `render` would have written them.
#pragma once

#include <atomic>
#include <string>

#include "client/farm_client.h"

namespace fjord {

struct FetchReport {
  std::string name;
  uint32_t total = 0;
  uint32_t fetched = 0;
  uint32_t kept = 0;     // were there already
  uint32_t missing = 0;  // not done yet, or failed
  double rate = 0;
};

// Every blob is checked against its digest, every picture against its pixel digest. Frames that are
// there already are kept. kCancelled when the flag is set; what came is there. Shows progress on
// stderr.
Result<FetchReport> FetchJob(FarmClient& client, const std::string& job, const std::string& folder,
                             const std::atomic<bool>* cancel);

}  // namespace fjord
