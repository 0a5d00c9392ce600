#include "client/fetch_job.h"

#include <map>
#include <memory>
#include <optional>
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

// The picture's bytes; none where the store has lost them. Asking has told the coordinator so.
Result<std::optional<std::string>> GetPicture(FarmClient& client, const v1::Frame& frame) {
  Result<std::string> bytes = client.GetBlob(frame.blob_digest());
  if (!bytes.ok()) {
    if (bytes.error().code == ErrorCode::kNotFound || bytes.error().code == ErrorCode::kIo)
      return std::optional<std::string>();
    return bytes.error();
  }
  const std::string name = "frame " + std::to_string(frame.number());
  const Result<Picture> picture = DecodePicture(*bytes, name);
  if (!picture.ok()) return picture.error();
  if (PixelDigest(*picture).Hex() != frame.pixel_digest()) {
    return MakeError(ErrorCode::kIo,
                     name +
                         ": the picture is not the one that was rendered: its pixel "
                         "digest is another");
  }
  return std::optional<std::string>(std::move(bytes).value());
}

Result<> FetchFrames(FarmClient& client, const std::vector<v1::Frame>& frames,
                     const std::atomic<bool>* cancel, FrameFolder* folder, FrameProgress* progress,
                     FetchReport* report) {
  std::vector<uint32_t> lost;
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
      const Result<std::optional<std::string>> picture = GetPicture(client, frame);
      if (!picture.ok()) return picture.error();
      if (!picture->has_value()) {
        lost.push_back(frame.number());
        continue;
      }
      Result<> added = folder->Add(
          frame.number(),
          {{}, frame.pixel_digest(), frame.key(), frame.triangles(), frame.render_ms()}, **picture);
      if (!added.ok()) return added;
      ++report->fetched;
      progress->FrameDone();
    }
  }
  report->lost = FrameSet::Of(lost);
  return Ok{};
}

// Those of the job that are asked for.
Result<std::vector<v1::Frame>> Choose(std::vector<v1::Frame> frames, const FetchOrder& order,
                                      FetchReport* report) {
  std::vector<uint32_t> numbers;
  for (const v1::Frame& frame : frames) numbers.push_back(frame.number());
  const FrameSet all = FrameSet::Of(numbers);
  report->frames = order.frames.empty() ? all : order.frames;
  std::vector<uint32_t> strangers;
  for (uint32_t index = 0; index < report->frames.size(); ++index) {
    if (!all.Contains(report->frames[index])) strangers.push_back(report->frames[index]);
  }
  if (!strangers.empty()) {
    return Invalid("--frames: job " + order.job + " has frames " + all.ToString(8) + " and not " +
                   FrameSet::Of(strangers).ToString(8));
  }
  std::erase_if(frames,
                [&](const v1::Frame& frame) { return !report->frames.Contains(frame.number()); });
  report->total = report->frames.size();
  return frames;
}

}  // namespace

Result<FetchReport> FetchJob(FarmClient& client, const FetchOrder& order,
                             const std::atomic<bool>* cancel) {
  const Result<v1::Job> found = client.GetJob(order.job);
  if (!found.ok()) return found.error();
  const Result<v1::Scene> scene = GetScene(client, found->scene_digest());
  if (!scene.ok()) return scene.error();
  Result<std::vector<v1::Frame>> listed = client.ListFrames(order.job);
  if (!listed.ok()) return listed.error();
  FetchReport report;
  report.name = scene->name();
  report.rate = scene->output().rate();
  std::map<uint32_t, std::string> keys;
  for (const v1::Frame& frame : *listed) keys[frame.number()] = frame.key();
  const Result<std::vector<v1::Frame>> frames = Choose(std::move(listed).value(), order, &report);
  if (!frames.ok()) return frames.error();
  FrameFolder::Order folder_order{order.folder, DescribeScene(*scene, "", found->scene_digest()),
                                  FileEnding(static_cast<PixelFormat>(scene->output().format())),
                                  order.replace, [&keys](uint32_t number) -> Result<std::string> {
                                    const auto key = keys.find(number);
                                    return key == keys.end() ? std::string() : key->second;
                                  }};
  Result<std::unique_ptr<FrameFolder>> opened = FrameFolder::Open(std::move(folder_order));
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

Result<> RequireAll(const FetchReport& report, const std::string& job) {
  std::string what;
  if (!report.lost.empty()) {
    const bool one = report.lost.size() == 1;
    what = std::string(one ? "the stored picture of frame " : "the stored pictures of frames ") +
           report.lost.ToString(8) + (one ? " was" : " were") +
           " gone or damaged on the coordinator: the farm makes " + (one ? "it" : "them") +
           " again";
  }
  if (report.missing > 0) {
    what += (what.empty() ? "" : "; ") + std::to_string(report.missing) + " of " +
            std::to_string(report.total) + " frames are not done yet or failed";
  }
  if (what.empty()) return Ok{};
  return MakeError(ErrorCode::kNotFound, what + "; see fjord status " + job + ", then fetch again");
}

}  // namespace fjord
