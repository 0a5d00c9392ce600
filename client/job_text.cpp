#include "client/job_text.h"

#include "client/exit_code.h"
#include "engine/base/printable.h"

namespace fjord {

const char* JobStateName(v1::JobState state) {
  switch (state) {
    case v1::QUEUED:
      return "queued";
    case v1::RUNNING:
      return "running";
    case v1::PAUSED:
      return "paused";
    case v1::DONE:
      return "done";
    case v1::FAILED:
      return "failed";
    case v1::CANCELLED:
      return "cancelled";
    default:
      return "unknown";
  }
}

const char* FrameStateName(v1::FrameState state) {
  switch (state) {
    case v1::FRAME_WAITING:
      return "waiting";
    case v1::FRAME_RUNNING:
      return "running";
    case v1::FRAME_DONE:
      return "done";
    case v1::FRAME_FAILED:
      return "failed";
    default:
      return "unknown";
  }
}

const char* WorkerStateName(v1::WorkerInfo::State state) {
  switch (state) {
    case v1::WorkerInfo::ALIVE:
      return "alive";
    case v1::WorkerInfo::DRAINING:
      return "draining";
    case v1::WorkerInfo::QUARANTINED:
      return "quarantined";
    case v1::WorkerInfo::GONE:
      return "gone";
    default:
      return "unknown";
  }
}

bool HasEnded(v1::JobState state) {
  return state == v1::DONE || state == v1::FAILED || state == v1::CANCELLED;
}

int ExitCodeOfJob(v1::JobState state) { return state == v1::DONE ? kExitDone : kExitFailed; }

std::string FramesText(const v1::Job& job) {
  std::string text;
  for (const v1::FrameSpan& span : job.span()) {
    text += (text.empty() ? "" : ",") + std::to_string(span.first());
    if (span.last() > span.first()) text += "-" + std::to_string(span.last());
    if (span.step() > 1) text += "x" + std::to_string(span.step());
  }
  if (!text.empty() || job.last_frame() == 0) return text;
  return std::to_string(job.first_frame()) + "-" + std::to_string(job.last_frame());
}

nlohmann::ordered_json JobJson(const v1::Job& job) {
  const v1::FrameCounts& frames = job.frames();
  return {{"id", job.id()},
          {"name", job.name()},
          {"state", JobStateName(job.state())},
          {"frames",
           {{"total", frames.total()},
            {"waiting", frames.waiting()},
            {"running", frames.running()},
            {"done", frames.done()},
            {"cached", frames.cached()},
            {"failed", frames.failed()}}},
          {"project", job.project()},
          {"priority", job.priority()},
          {"first_frame", job.first_frame()},
          {"last_frame", job.last_frame()},
          {"scene_digest", job.scene_digest()},
          {"submitted_unix_ms", job.submitted_unix_ms()},
          {"ended_unix_ms", job.ended_unix_ms()},
          {"render_ms", job.render_ms()},
          {"eta_ms", job.eta_ms()},
          {"error", job.error()},
          {"trouble", job.trouble()},
          {"frame_list", FramesText(job)},
          {"after", job.after_job()},
          {"frame_limit", job.frame_limit_ms() / 1000.}};
}

nlohmann::ordered_json WorkerJson(const v1::WorkerInfo& worker, const std::string& trouble) {
  nlohmann::ordered_json holding = nlohmann::ordered_json::array();
  for (const v1::Holding& held : worker.holding())
    holding.push_back({{"job", held.job_id()}, {"frame", held.frame()}});
  return {{"id", worker.id()},
          {"host", worker.host()},
          {"version", worker.version()},
          {"state", WorkerStateName(worker.state())},
          {"threads", worker.threads()},
          {"tags", std::vector<std::string>(worker.tag().begin(), worker.tag().end())},
          {"holding", std::move(holding)},
          {"frames_done", worker.frames_done()},
          {"render_ms", worker.render_ms()},
          {"trouble", trouble}};
}

std::string Column(const std::string& text, size_t width) {
  std::string column = Printable(text);
  const size_t characters = CharactersIn(column);
  if (characters < width) column.append(width - characters, ' ');
  return column;
}

std::string CountsText(const v1::FrameCounts& frames) {
  std::string text =
      std::to_string(frames.done()) + " of " + std::to_string(frames.total()) + " frames";
  if (frames.cached() > 0) text += ", " + std::to_string(frames.cached()) + " cached";
  if (frames.running() > 0) text += ", " + std::to_string(frames.running()) + " running";
  if (frames.failed() > 0) text += ", " + std::to_string(frames.failed()) + " failed";
  return text;
}

}  // namespace fjord
