// Checks of every request before anything is done with it: sizes, digests, ranges. Plain functions
// of the message alone. An error is INVALID_ARGUMENT (or FAILED_PRECONDITION for another protocol)
// and starts with the name of the field.
#pragma once

#include <optional>

#include "fjord/v1/blobs.pb.h"
#include "fjord/v1/jobs.pb.h"
#include "fjord/v1/leases.pb.h"
#include "server/state/types.h"

namespace fjord::server {

using Objection = std::optional<Refusal>;

inline constexpr size_t kMaxIdBytes = 100;
inline constexpr size_t kMaxNameBytes = 200;
inline constexpr size_t kMaxErrorBytes = 10'000;
inline constexpr int kMaxHoldings = 64;
inline constexpr int kMaxTags = 32;
inline constexpr int kMaxEnded = 16;  // earlier sessions of a worker
inline constexpr uint32_t kMaxFrame = 1'000'000;
inline constexpr uint32_t kMaxFrameLimitMs = 604'800'000;    // a week
inline constexpr uint32_t kDefaultFrameLimitMs = 3'600'000;  // where a client names none

// What people may be shown: UTF-8 without control characters is the messages' own promise; here
// length and emptiness are checked.
Objection Validate(const v1::SubmitRequest& request);
Objection Validate(const v1::GetJobRequest& request);
Objection Validate(const v1::ListJobsRequest& request);
Objection Validate(const v1::ListFramesRequest& request);
Objection Validate(const v1::WatchRequest& request);
Objection Validate(const v1::CommandRequest& request);
Objection Validate(const v1::ListWorkersRequest& request);
Objection Validate(const v1::CommandWorkerRequest& request);
Objection Validate(const v1::JoinRequest& request);
Objection Validate(const v1::AcquireRequest& request);
Objection Validate(const v1::RenewRequest& request);
Objection Validate(const v1::CompleteRequest& request);
Objection Validate(const v1::FailRequest& request);
Objection Validate(const v1::LeaveRequest& request);
Objection Validate(const v1::MissingRequest& request);
// first: the message that names the blob.
Objection Validate(const v1::PutBlobRequest& request, bool first);
Objection Validate(const v1::GetBlobRequest& request);

// The set that the spans of a message mean; none: they mean no set (frame_set.h).
std::optional<FrameSet> FramesOf(const google::protobuf::RepeatedPtrField<v1::FrameSpan>& spans);

// "7" -> 7; none: not a job's id.
std::optional<JobId> ParseJobId(const std::string& text);

}  // namespace fjord::server
