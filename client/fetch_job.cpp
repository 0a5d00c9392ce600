#include "client/fetch_job.h"

#include <memory>
#include <utility>

#include "client/frame_folder.h"
#include "client/progress.h"
#include "engine/image/codec.h"
#include "engine/image/picture.h"
#include "fjord/v1/scene.pb.h"

namespace fjord {
namespace {

Result<v1::Scene> GetScene(FarmClient& client, const std::string& digest) {
  const Result<std::string> bytes = client.GetBlob(digest);
  if (!bytes.ok()) return bytes.error();
  v1::Scene scene;
  if (!scene.ParseFromString(*bytes))
    return Invalid("the job's scene on " + client.address() + " cannot be read by this fjord");
  return scene;
}

Result<> FetchFrame(FarmClient& client, const v1::Frame& frame, FrameFolder* folder) {
  const Result<std::string> bytes = client.GetBlob(frame.blob_digest());
  if (!bytes.ok()) return bytes.error();
  const std::string name = "frame " + std::to_string(frame.number());
  const Result<Picture> picture = DecodePicture(*bytes, name);
  if (!picture.ok()) return picture.error();
  if (PixelDigest(*picture).Hex() != frame.pixel_digest()) {
    return MakeError(ErrorCode::kIo,
                     name +
                         ": the picture is not the one that was rendered: its pixel "
                         "digest is another");
  }
  return folder->Add(frame.number(),
                     {{}, frame.pixel_digest(), frame.key(), frame.triangles(), frame.render_ms()},
                     *bytes);
}

Result<> FetchFrames(FarmClient& client, const std::vector<v1::Frame>& frames,
                     const std::atomic<bool>* cancel, FrameFolder* folder, FrameProgress* progress,
                     FetchReport* report) {
  for (const v1::Frame& frame : frames) {
    if (cancel != nullptr && cancel->load()) {
      return MakeError(ErrorCode::kCancelled, "interrupted; the same command continues");
    }
    if (frame.state() != v1::FRAME_DONE) {
      ++report->missing;
    } else if (folder->Has(frame.number(), frame.key(), frame.pixel_digest())) {
      ++report->kept;
      progress->FrameKept();
    } else {
      if (Result<> fetched = FetchFrame(client, frame, folder); !fetched.ok()) return fetched;
      ++report->fetched;
      progress->FrameDone();
    }
  }
  return Ok{};
}

}  // namespace

Result<FetchReport> FetchJob(FarmClient& client, const std::string& job, const std::string& folder,
                             const std::atomic<bool>* cancel) {
  const Result<v1::Job> found = client.GetJob(job);
  if (!found.ok()) return found.error();
  const Result<v1::Scene> scene = GetScene(client, found->scene_digest());
  if (!scene.ok()) return scene.error();
  const Result<std::vector<v1::Frame>> frames = client.ListFrames(job);
  if (!frames.ok()) return frames.error();
  FetchReport report;
  report.name = scene->name();
  report.rate = scene->output().rate();
  report.total = static_cast<uint32_t>(frames->size());
  Result<std::unique_ptr<FrameFolder>> opened =
      FrameFolder::Open(folder, DescribeScene(*scene, "", found->scene_digest()),
                        FileEnding(static_cast<PixelFormat>(scene->output().format())));
  if (!opened.ok()) return opened.error();
  Result<> fetched;
  {
    FrameProgress progress("fetching " + scene->name(), report.total, FrameProgress::Console());
    fetched = FetchFrames(client, *frames, cancel, opened->get(), &progress, &report);
  }
  const Result<> flushed = (*opened)->Flush();
  if (!fetched.ok()) return fetched.error();
  if (!flushed.ok()) return flushed.error();
  return report;
}

}  // namespace fjord
