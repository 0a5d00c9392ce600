#include "server/validate.h"

#include <algorithm>
#include <set>
#include <vector>

#include "proto/fjord/protocol.h"

namespace fjord::server {
namespace {

// Collects the first objection.
class Check {
 public:
  Check& Text(const char* field, const std::string& text, size_t least, size_t most) {
    if (text.size() < least) return Object(field, "is empty");
    if (text.size() > most) {
      return Object(
          field, "has " + std::to_string(text.size()) + " bytes; at most " + std::to_string(most));
    }
    for (const char c : text) {
      if (static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t') {
        return Object(field, "holds a control character");
      }
    }
    return *this;
  }
  Check& Hex(const char* field, const std::string& text) {
    if (IsDigestHex(text)) return *this;
    return Object(field, "is not a digest of 64 lower-case hex digits");
  }
  Check& Range(const char* field, double value, double least, double most) {
    if (value >= least && value <= most) return *this;
    return Object(field, "is outside " + Text(least) + ".." + Text(most));
  }
  Check& Holds(bool holds, const char* field, const char* otherwise) {
    return holds ? *this : Object(field, otherwise);
  }
  Check& Job(const char* field, const std::string& id) {
    return ParseJobId(id) ? *this
                          : Object(field, "is not a job's id: \"" + id.substr(0, 40) + "\"");
  }
  Check& Protocol(const std::string& protocol) {
    if (!objection_ && !SpeaksOurProtocol(protocol)) {
      objection_ =
          Refusal{Code::kPrecondition, std::string("protocol: this coordinator speaks version ") +
                                           kProtocol + " and not \"" + protocol.substr(0, 40) +
                                           "\": use programs of one release"};
    }
    return *this;
  }
  Check& Unit(const v1::Unit& unit) {
    return Hex("unit.scene_digest", unit.scene_digest())
        .Range("unit.frame", unit.frame(), 1, kMaxFrame)
        .Hex("unit.frame_key", unit.frame_key())
        .Holds(!unit.has_tile(), "unit.tile", "is not given out by this coordinator");
  }
  Check& Attempt(const v1::Attempt& attempt) {
    constexpr auto kMost = static_cast<uint64_t>(INT64_MAX);  // what the journal can hold
    return Holds(attempt.epoch() >= 1 && attempt.epoch() <= kMost, "attempt.epoch",
                 "was never given out")
        .Holds(attempt.sequence() >= 1 && attempt.sequence() <= kMost, "attempt.sequence",
               "was never given out");
  }
  Objection Result() { return std::move(objection_); }

 private:
  Check& Object(const char* field, const std::string& what) {
    if (!objection_) objection_ = Refusal{Code::kInvalid, std::string(field) + ": " + what};
    return *this;
  }
  static std::string Text(double value) { return std::to_string(static_cast<int64_t>(value)); }

  Objection objection_;
};

}  // namespace

std::optional<JobId> ParseJobId(const std::string& text) {
  if (text.empty() || text.size() > 18 || text[0] == '0') return std::nullopt;
  JobId id = 0;
  for (const char c : text) {
    if (c < '0' || c > '9') return std::nullopt;
    id = id * 10 + static_cast<JobId>(c - '0');
  }
  return id;
}

std::optional<FrameSet> FramesOf(const google::protobuf::RepeatedPtrField<v1::FrameSpan>& spans) {
  std::vector<FrameSpan> plain;
  for (const v1::FrameSpan& span : spans) {
    plain.push_back({span.first(), span.last(), std::max(span.step(), 1u)});
  }
  return FrameSet::FromSpans(plain);
}

Objection Validate(const v1::SubmitRequest& request) {
  Check check;
  check.Protocol(request.protocol())
      .Text("request_id", request.request_id(), 1, kMaxIdBytes)
      .Text("name", request.name(), 0, kMaxNameBytes)
      .Text("project", request.project(), 0, kMaxIdBytes)
      .Hex("scene_digest", request.scene_digest())
      .Range("first_frame", request.first_frame(), 0, kMaxFrame)
      .Range("last_frame", request.last_frame(), 0, kMaxFrame)
      .Holds(request.last_frame() == 0 || request.first_frame() <= request.last_frame(),
             "last_frame", "is before first_frame")
      .Range("span", request.span_size(), 0, static_cast<double>(FrameSet::kMostSpans))
      .Holds(request.span().empty() || (request.first_frame() == 0 && request.last_frame() == 0),
             "span", "stands instead of first_frame and last_frame")
      .Holds(request.span_size() > static_cast<int>(FrameSet::kMostSpans) ||
                 FramesOf(request.span()).has_value(),
             "span", "these are not the spans of a set of frames")
      .Range("frame_limit_ms", request.frame_limit_ms(), 0, kMaxFrameLimitMs)
      .Range("priority", request.priority(), -1000, 1000)
      .Range("verify_share", request.verify_share(), 0, 1);
  if (!request.after_job().empty()) check.Job("after_job", request.after_job());
  return check.Result();
}

Objection Validate(const v1::GetJobRequest& request) {
  return Check().Job("job_id", request.job_id()).Result();
}

Objection Validate(const v1::ListJobsRequest& request) {
  Check check;
  check.Range("page_size", request.page_size(), 0, kMaxPage);
  if (!request.page_token().empty()) check.Job("page_token", request.page_token());
  return check.Result();
}

Objection Validate(const v1::ListFramesRequest& request) {
  return Check()
      .Job("job_id", request.job_id())
      .Range("from_frame", request.from_frame(), 0, kMaxFrame)
      .Range("page_size", request.page_size(), 0, kMaxPage)
      .Result();
}

Objection Validate(const v1::WatchRequest& request) {
  return Check().Job("job_id", request.job_id()).Result();
}

Objection Validate(const v1::CommandRequest& request) {
  return Check()
      .Job("job_id", request.job_id())
      .Range("kind", request.kind(), v1::CommandRequest::CANCEL, v1::CommandRequest::DELETE)
      .Range("priority", request.priority(), -1000, 1000)
      .Result();
}

Objection Validate(const v1::ListWorkersRequest&) { return std::nullopt; }

Objection Validate(const v1::CommandWorkerRequest& request) {
  return Check()
      .Text("worker_id", request.worker_id(), 1, kMaxIdBytes)
      .Range("kind", request.kind(), v1::CommandWorkerRequest::DRAIN,
             v1::CommandWorkerRequest::RELEASE)
      .Result();
}

Objection Validate(const v1::JoinRequest& request) {
  Check check;
  check.Protocol(request.protocol())
      .Text("worker_id", request.worker_id(), 1, kMaxIdBytes)
      .Text("session_id", request.session_id(), 1, kMaxIdBytes)
      .Text("host", request.host(), 0, kMaxNameBytes)
      .Text("version", request.version(), 0, kMaxIdBytes)
      .Range("threads", request.threads(), 0, 65536)
      .Range("tag", request.tag_size(), 0, kMaxTags)
      .Range("holding", request.holding_size(), 0, kMaxHoldings)
      .Range("ended", request.ended_size(), 0, kMaxEnded);
  for (const std::string& session : request.ended()) check.Text("ended", session, 1, kMaxIdBytes);
  for (const std::string& tag : request.tag()) check.Text("tag", tag, 1, kMaxIdBytes);
  for (const v1::JoinRequest::Holding& holding : request.holding()) {
    check.Attempt(holding.attempt())
        .Holds(holding.unit_size() == 1, "holding.unit", "must be one unit, as it was granted");
    for (const v1::Unit& unit : holding.unit()) check.Unit(unit);
  }
  return check.Result();
}

Objection Validate(const v1::AcquireRequest& request) {
  return Check()
      .Text("session_id", request.session_id(), 1, kMaxIdBytes)
      .Holds(request.request() >= 1, "request", "counts from 1")
      .Range("want", request.want(), 1, 16)
      .Range("wait_ms", request.wait_ms(), 0, 60'000)
      .Result();
}

Objection Validate(const v1::RenewRequest& request) {
  Check check;
  check.Text("session_id", request.session_id(), 1, kMaxIdBytes)
      .Range("progress", request.progress_size(), 0, kMaxHoldings);
  for (const v1::RenewRequest::Progress& entry : request.progress()) check.Attempt(entry.attempt());
  return check.Result();
}

Objection Validate(const v1::CompleteRequest& request) {
  Check check;
  check.Text("session_id", request.session_id(), 1, kMaxIdBytes)
      .Attempt(request.attempt())
      .Range("result", request.result_size(), 1, 1);
  for (const v1::UnitResult& result : request.result()) {
    check.Unit(result.unit())
        .Hex("result.pixel_digest", result.pixel_digest())
        .Hex("result.blob_digest", result.blob_digest())
        .Holds(result.triangles() <= static_cast<uint64_t>(INT64_MAX), "result.triangles",
               "is absurd");
  }
  return check.Result();
}

Objection Validate(const v1::FailRequest& request) {
  return Check()
      .Text("session_id", request.session_id(), 1, kMaxIdBytes)
      .Attempt(request.attempt())
      .Text("error", request.error(), 0, kMaxErrorBytes)
      .Result();
}

Objection Validate(const v1::LeaveRequest& request) {
  return Check().Text("session_id", request.session_id(), 1, kMaxIdBytes).Result();
}

Objection Validate(const v1::MissingRequest& request) {
  Check check;
  check.Range("digest", request.digest_size(), 0, kMaxMissing);
  for (const std::string& digest : request.digest()) check.Hex("digest", digest);
  return check.Result();
}

Objection Validate(const v1::PutBlobRequest& request, bool first) {
  Check check;
  if (first) {
    check.Hex("digest", request.digest())
        .Range("size", static_cast<double>(request.size()), 0, static_cast<double>(kMaxBlob));
  } else {
    check.Holds(request.digest().empty() && request.size() == 0, "digest",
                "belongs into the first message alone");
  }
  return check.Range("data", static_cast<double>(request.data().size()), 0, kBlobChunk).Result();
}

Objection Validate(const v1::GetBlobRequest& request) {
  return Check().Hex("digest", request.digest()).Result();
}

}  // namespace fjord::server
