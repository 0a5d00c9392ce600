#include "client/farm_view.h"

#include <algorithm>
#include <cstdio>

#include "client/job_text.h"
#include "client/progress.h"
#include "engine/base/printable.h"

namespace fjord {
namespace {

constexpr size_t kMapRows = 4;
constexpr size_t kMostWorkers = 8;

uint32_t Rendered(const v1::FrameCounts& frames) {
  return frames.done() - std::min(frames.done(), frames.cached());
}

std::string Cut(const std::string& line, int width) {
  return FirstCharacters(line, static_cast<size_t>(std::max(0, width)));
}

FrameSet FramesOf(const v1::Job& job) {
  std::vector<FrameSpan> spans;
  for (const v1::FrameSpan& span : job.span()) {
    spans.push_back({span.first(), span.last(), std::max(span.step(), 1u)});
  }
  std::optional<FrameSet> frames = FrameSet::FromSpans(spans);
  if (frames && !frames->empty()) return *std::move(frames);
  if (job.first_frame() < 1 || job.last_frame() < job.first_frame()) return {};
  return {job.first_frame(), job.last_frame()};
}

}  // namespace

void FarmView::Put(const v1::Frame& frame) {
  if (frames_.empty()) frames_ = FramesOf(job_);
  const std::optional<uint32_t> index = frames_.IndexOf(frame.number());
  if (!index) return;
  if (cells_.size() != frames_.size()) cells_.assign(frames_.size(), Cell::kWaiting);
  Cell& cell = cells_[*index];
  switch (frame.state()) {
    case v1::FRAME_RUNNING:
      cell = Cell::kRunning;
      break;
    case v1::FRAME_DONE:
      cell = frame.cached() ? Cell::kCached : Cell::kDone;
      break;
    case v1::FRAME_FAILED:
      cell = Cell::kFailed;
      break;
    default:
      cell = Cell::kWaiting;
  }
}

void FarmView::SetFrames(const std::vector<v1::Frame>& frames) {
  for (const v1::Frame& frame : frames) Put(frame);
}

void FarmView::Apply(const v1::WatchResponse& message, double seconds) {
  job_ = message.job();
  workers_alive_ = message.workers();
  if (!begun_) {
    begun_ = true;
    began_ = seconds;
    rendered_at_start_ = Rendered(job_.frames());
  }
  for (const v1::Frame& frame : message.changed()) Put(frame);
}

std::string FarmView::RateText(double seconds) const {
  const v1::FrameCounts& frames = job_.frames();
  const uint32_t left = frames.waiting() + frames.running();
  const double made = Rendered(frames) - static_cast<double>(rendered_at_start_);
  const double elapsed = seconds - began_;
  std::string text;
  if (made > 0 && elapsed > 0) {
    char buffer[48];
    const double rate = made / elapsed;
    std::snprintf(buffer, sizeof buffer, rate >= 1 ? ", %.1f frames/s" : ", %.1f s a frame",
                  rate >= 1 ? rate : 1 / rate);
    text += buffer;
    if (left > 0 && job_.state() == v1::RUNNING && job_.eta_ms() == 0 && job_.trouble().empty())
      text += ", " + FormatDuration(left / rate) + " left";
  }
  if (left > 0 && job_.eta_ms() > 0) text += ", " + FormatDuration(job_.eta_ms() / 1000.) + " left";
  return text;
}

std::string FarmView::PlainLine(double seconds) const {
  return Printable(job_.name()) + ": " + JobStateName(job_.state()) + ", " +
         CountsText(job_.frames()) + RateText(seconds) + ", " + std::to_string(workers_alive_) +
         (workers_alive_ == 1 ? " worker" : " workers") +
         (job_.trouble().empty() ? "" : "; trouble: " + Printable(job_.trouble()));
}

std::vector<std::string> FarmView::FrameMap(const ViewStyle& style, size_t rows) const {
  static const char* const kPlain[] = {".", ">", "#", "=", "x"};
  static const char* const kUnicode[] = {"\u00b7", "\u25b8", "\u2588", "\u2593", "\u2717"};
  static const char* const kColor[] = {"\033[2m", "\033[33m", "\033[32m", "\033[36m", "\033[31m"};
  const size_t columns = static_cast<size_t>(std::max(10, style.width - 1));
  const size_t group = std::max<size_t>(1, (cells_.size() + columns * rows - 1) / (columns * rows));
  std::vector<std::string> lines;
  std::string line;
  size_t in_line = 0;
  int color = -1;
  const auto end_line = [&] {
    if (color >= 0) line += "\033[0m";
    lines.push_back(std::exchange(line, {}));
    in_line = 0;
    color = -1;
  };
  for (size_t i = 0; i < cells_.size(); i += group) {
    // Of a group the cell shows what needs to be seen: a failure, then work, then what is not done.
    Cell shown = cells_[i];
    for (size_t k = i; k < std::min(cells_.size(), i + group); ++k) {
      const auto rank = [](Cell cell) {
        constexpr int kRank[] = {2, 3, 1, 0, 4};
        return kRank[static_cast<size_t>(cell)];
      };
      if (rank(cells_[k]) > rank(shown)) shown = cells_[k];
    }
    const auto index = static_cast<int>(shown);
    if (style.color && color != index) {
      line += std::string("\033[0m") + kColor[index];
      color = index;
    }
    line += (style.unicode ? kUnicode : kPlain)[index];
    if (++in_line == columns) end_line();
  }
  if (in_line > 0) end_line();
  return lines;
}

std::vector<std::string> FarmView::Lines(const ViewStyle& style, double seconds) const {
  const v1::FrameCounts& frames = job_.frames();
  const int width = style.width - 1;
  std::vector<std::string> lines;
  lines.push_back(Cut(Printable(job_.name()) + "  job " + job_.id() + "  " +
                          JobStateName(job_.state()) + "  " + std::to_string(workers_alive_) +
                          (workers_alive_ == 1 ? " worker" : " workers"),
                      width));
  const std::string text = CountsText(frames) + RateText(seconds);
  const int room = std::min(40, width - static_cast<int>(text.size()) - 2);
  const double share =
      frames.total() == 0 ? 0 : static_cast<double>(frames.done()) / frames.total();
  lines.push_back(Cut((room >= 10 ? FormatBar(share, room) + "  " : "") + text, width));
  for (std::string& row : FrameMap(style, kMapRows)) lines.push_back(std::move(row));
  if (!job_.trouble().empty()) lines.push_back(Cut("trouble: " + Printable(job_.trouble()), width));
  size_t shown = 0;
  for (const v1::WorkerInfo& worker : workers_) {
    if (worker.state() == v1::WorkerInfo::GONE) continue;
    if (++shown > kMostWorkers) break;
    std::string line = "  " + Printable(worker.id()) + "  " + WorkerStateName(worker.state()) +
                       "  " + std::to_string(worker.frames_done()) + " frames";
    for (const v1::Holding& held : worker.holding()) {
      line +=
          held.job_id() == job_.id() ? "  frame " + std::to_string(held.frame()) : "  another job";
    }
    lines.push_back(Cut(line, width));
  }
  return lines;
}

}  // namespace fjord
