// The first byte says which request the others are. What parses is validated; an objection has
// words.
#include <array>

#include "engine/base/check.h"
#include "server/validate.h"
#include "tests/fuzz/harness.h"

namespace fjord::fuzz {
namespace {

template <typename Request>
void Take(std::string_view bytes) {
  Request request;
  if (!request.ParseFromArray(bytes.data(), static_cast<int>(bytes.size()))) return;
  const server::Objection objection = server::Validate(request);
  FJORD_CHECK(!objection || !objection->message.empty());
}

void TakePut(std::string_view bytes) {
  v1::PutBlobRequest request;
  if (!request.ParseFromArray(bytes.data(), static_cast<int>(bytes.size()))) return;
  for (const bool first : {true, false}) (void)server::Validate(request, first);
}

void TakeJobId(std::string_view bytes) { (void)server::ParseJobId(std::string(bytes)); }

}  // namespace

void RunWire(std::string_view bytes) {
  // Append only: the corpus names requests by their place.
  static constexpr std::array<void (*)(std::string_view), 18> kRequests = {
      &Take<v1::SubmitRequest>,
      &Take<v1::GetJobRequest>,
      &Take<v1::ListJobsRequest>,
      &Take<v1::ListFramesRequest>,
      &Take<v1::WatchRequest>,
      &Take<v1::CommandRequest>,
      &Take<v1::ListWorkersRequest>,
      &Take<v1::CommandWorkerRequest>,
      &Take<v1::JoinRequest>,
      &Take<v1::AcquireRequest>,
      &Take<v1::RenewRequest>,
      &Take<v1::CompleteRequest>,
      &Take<v1::FailRequest>,
      &Take<v1::LeaveRequest>,
      &Take<v1::MissingRequest>,
      &Take<v1::GetBlobRequest>,
      &TakePut,
      &TakeJobId};
  if (bytes.empty()) return;
  kRequests[static_cast<unsigned char>(bytes[0]) % kRequests.size()](bytes.substr(1));
}

}  // namespace fjord::fuzz
