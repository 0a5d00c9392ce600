#include "server/submit.h"

#include <vector>

#include "fjord/v1/scene.pb.h"
#include "server/engine_planner.h"
#include "server/rpc_status.h"
#include "server/validate.h"

namespace fjord::server {
namespace {

// Every file a scene names.
std::vector<const v1::File*> FilesOf(const v1::Scene& scene) {
  std::vector<const v1::File*> files;
  const auto add = [&](const v1::Shape& shape) {
    if (shape.has_file()) files.push_back(&shape.file());
    if (shape.heights().has_file()) files.push_back(&shape.heights().file());
  };
  for (const v1::Object& object : scene.objects()) {
    add(object.shape());
    for (const v1::Key& key : object.key()) add(key.shape());
  }
  return files;
}

// What makes two submits the same: all but the request id and the sender's version.
std::string ContentOf(v1::SubmitRequest request) {
  request.clear_request_id();
  request.clear_protocol();
  return Sha256Of(request.SerializeAsString()).Hex();
}

// Which of the scene's frames are asked for.
std::optional<Refusal> ReadFrames(const v1::SubmitRequest& request, uint32_t frames,
                                  FrameSet* chosen) {
  if (request.span().empty()) {
    const uint32_t first = request.first_frame() == 0 ? 1 : request.first_frame();
    const uint32_t last = request.last_frame() == 0 ? frames : request.last_frame();
    if (last > frames || first > last) {
      return Refusal{Code::kInvalid, (first > frames ? "first_frame: " : "last_frame: ") +
                                         std::to_string(first > frames ? first : last) +
                                         " is outside the animation, which has frames 1-" +
                                         std::to_string(frames)};
    }
    *chosen = FrameSet(first, last);
    return std::nullopt;
  }
  *chosen = *FramesOf(request.span());
  if (chosen->last() > frames) {
    return Refusal{Code::kInvalid, "span: " + std::to_string(chosen->last()) +
                                       " is outside the animation, which has frames 1-" +
                                       std::to_string(frames)};
  }
  return std::nullopt;
}

}  // namespace

Answer<JobSpec> ReadSubmission(const v1::SubmitRequest& request, BlobStore& blobs) {
  const Digest digest = *ParseDigest(request.scene_digest());
  const Result<std::string> bytes = blobs.Get(digest, kMaxSceneBytes);
  if (!bytes.ok()) {
    const Code code = bytes.error().code == ErrorCode::kNotFound ? Code::kNotFound
                      : bytes.error().code == ErrorCode::kLimit  ? Code::kInvalid
                                                                 : Code::kUnavailable;
    return Refusal{code, "scene_digest: " + bytes.error().message};
  }
  v1::Scene scene;
  if (!scene.ParseFromString(*bytes)) {
    return Refusal{Code::kInvalid, "scene_digest: blob " + digest.Hex() + " is not a scene"};
  }
  for (const v1::File* file : FilesOf(scene)) {
    const std::optional<Digest> asset = ParseDigest(file->digest());
    if (!asset) {
      return Refusal{Code::kInvalid,
                     "scene: file \"" + file->path() + "\" is named without a digest"};
    }
    if (!blobs.Check(*asset)) {
      return Refusal{Code::kNotFound, "scene: file \"" + file->path() + "\" (" + file->digest() +
                                          ") is not in the store; put it first"};
    }
  }
  const uint32_t frames = scene.output().frames();
  if (frames < 1 || frames > kMaxFrame) {
    return Refusal{Code::kInvalid,
                   "scene: output.frames is " + std::to_string(frames) + ", outside 1..1000000"};
  }
  JobSpec spec;
  if (std::optional<Refusal> refusal = ReadFrames(request, frames, &spec.frames)) {
    return *std::move(refusal);
  }
  spec.request_id = request.request_id();
  spec.content = ContentOf(request);
  spec.name = request.name().empty() ? scene.name() : request.name();
  if (spec.name.size() > kMaxNameBytes) {
    return Refusal{Code::kInvalid, "name: the scene's has " + std::to_string(spec.name.size()) +
                                       " bytes; at most " + std::to_string(kMaxNameBytes)};
  }
  spec.frame_limit_ms =
      request.has_frame_limit_ms() ? request.frame_limit_ms() : kDefaultFrameLimitMs;
  spec.project = request.project();
  spec.scene = digest;
  spec.priority = request.priority();
  spec.verify_share = request.verify_share();
  spec.after = request.after_job().empty() ? 0 : *ParseJobId(request.after_job());
  return spec;
}

}  // namespace fjord::server
