#include "client/movie.h"

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "client/pixels.h"
#include "client/process.h"

namespace fjord {
namespace {

Result<> WriteAll(int fd, const std::vector<uint8_t>& bytes) {
  for (size_t done = 0; done < bytes.size();) {
    const ssize_t wrote = write(fd, bytes.data() + done, bytes.size() - done);
    if (wrote < 0 && errno == EINTR) continue;
    if (wrote < 0) return MakeError(ErrorCode::kIo, std::string("ffmpeg: ") + std::strerror(errno));
    done += static_cast<size_t>(wrote);
  }
  return Ok{};
}

Result<> SendFrames(const std::vector<ListedFrame>& frames, const Picture& first, int fd,
                    const std::atomic<bool>* cancel) {
  for (size_t i = 0; i < frames.size(); ++i) {
    if (cancel != nullptr && cancel->load()) return MakeError(ErrorCode::kCancelled, "interrupted");
    Result<Picture> picture = i == 0 ? Result<Picture>(first) : ReadFrame(frames[i]);
    if (!picture.ok()) return picture.error();
    if (picture->width != first.width || picture->height != first.height) {
      return Invalid("the picture is " + std::to_string(picture->width) + "x" +
                         std::to_string(picture->height) + ", the first one " +
                         std::to_string(first.width) + "x" + std::to_string(first.height) +
                         "; a movie needs one size",
                     {frames[i].file, 0, 0});
    }
    if (Result<> sent = WriteAll(fd, DisplaySamples(*picture)); !sent.ok()) return sent;
  }
  return Ok{};
}

std::vector<std::string> FfmpegCommand(const Picture& first, double rate,
                                       const std::string& output) {
  char frames_a_second[32];
  std::snprintf(frames_a_second, sizeof frames_a_second, "%.6f", rate);
  const std::string size = std::to_string(first.width) + "x" + std::to_string(first.height);
  return {"ffmpeg", "-hide_banner", "-loglevel", "error", "-y", "-f", "rawvideo", "-pixel_format",
          "rgb24", "-video_size", size, "-framerate", frames_a_second, "-i", "pipe:0",
          // even sizes, and the colours of an HD screen
          "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2,scale=out_color_matrix=bt709:out_range=tv", "-c:v",
          "libx264", "-preset", "medium", "-crf", "16", "-pix_fmt", "yuv420p", "-color_primaries",
          "bt709", "-color_trc", "bt709", "-colorspace", "bt709", "-movflags", "+faststart", "-f",
          "mp4", "file:" + output};
}

}  // namespace

Result<MovieReport> MakeMovie(const std::vector<ListedFrame>& frames, double rate,
                              const std::string& output, const std::atomic<bool>* cancel) {
  if (frames.empty()) return Invalid("there are no pictures for a movie");
  const Result<Picture> first = ReadFrame(frames.front());
  if (!first.ok()) return first.error();
  const std::string partial = output + ".partial.tmp";
  // Found out here, because ffmpeg says it less plainly.
  const int probe = open(partial.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (probe < 0) {
    return MakeError(ErrorCode::kIo, std::string("cannot be written: ") + std::strerror(errno),
                     {output, 0, 0});
  }
  close(probe);
  const Result<Pipe> pipe = MakePipe();
  if (!pipe.ok()) return pipe.error();
  signal(SIGPIPE, SIG_IGN);
  const Result<pid_t> child =
      StartChild(FfmpegCommand(*first, rate > 0 ? rate : 24, partial), {pipe->read_end, -1, -1});
  close(pipe->read_end);
  Result<> result;
  if (!child.ok()) {
    result = MakeError(child.error().code,
                       child.error().message + "; install it: apt-get install ffmpeg");
    close(pipe->write_end);
  } else {
    result = SendFrames(frames, *first, pipe->write_end, cancel);
    close(pipe->write_end);
    const int status = WaitForChild(*child);
    if (status != 0 && (result.ok() || result.error().code == ErrorCode::kIo)) {
      result = MakeError(
          ErrorCode::kIo,
          "ffmpeg failed with status " + std::to_string(status) + "; what it said is above",
          {output, 0, 0});
    }
  }
  if (result.ok() && std::rename(partial.c_str(), output.c_str()) != 0)
    result = MakeError(ErrorCode::kIo, std::strerror(errno), {output, 0, 0});
  std::error_code ignored;
  if (!result.ok()) std::filesystem::remove(partial, ignored);
  if (!result.ok()) return result.error();
  return MovieReport{first->alpha};
}

}  // namespace fjord
