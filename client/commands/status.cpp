#include <memory>
#include <string>
#include <vector>

#include "client/commands/commands.h"
#include "client/commands/farm_options.h"
#include "client/console.h"
#include "client/exit_code.h"
#include "client/farm_client.h"
#include "client/find_job.h"
#include "client/job_text.h"
#include "client/progress.h"
#include "engine/base/printable.h"

namespace fjord {
namespace {

constexpr size_t kMostErrors = 10;

struct Options {
  FarmOptions farm;
  std::string job;
  bool frames = false;
};

std::string Text(const v1::Job& job, const std::vector<v1::Frame>& frames) {
  std::string text = Printable(job.name()) + "  job " + job.id() + "\n";
  text += "state     " + std::string(JobStateName(job.state())) + ", priority " +
          std::to_string(job.priority()) +
          (job.project().empty() ? "" : ", project " + Printable(job.project())) + "\n";
  text += "frames    " + CountsText(job.frames()) + "  (" + FramesText(job) + ")\n";
  if (!job.after_job().empty()) text += "after     job " + job.after_job() + "\n";
  text += "rendered  " + FormatDuration(static_cast<double>(job.render_ms()) / 1000) +
          " of workers' time\n";
  if (job.eta_ms() > 0) text += "left      " + FormatDuration(job.eta_ms() / 1000.) + "\n";
  if (!job.trouble().empty()) text += "trouble   " + Printable(job.trouble()) + "\n";
  if (!job.error().empty()) text += "error     " + PrintableLines(job.error()) + "\n";
  size_t errors = 0;
  for (const v1::Frame& frame : frames) {
    if (frame.state() == v1::FRAME_FAILED && ++errors <= kMostErrors)
      text +=
          "frame " + std::to_string(frame.number()) + ": " + PrintableLines(frame.error()) + "\n";
  }
  return text;
}

nlohmann::ordered_json FrameJson(const v1::Frame& frame) {
  return {{"frame", frame.number()},
          {"state", FrameStateName(frame.state())},
          {"frame_key", frame.key()},
          {"pixel_digest", frame.pixel_digest()},
          {"triangles_made", frame.triangles()},
          {"ms", frame.render_ms()},
          {"worker", frame.worker()},
          {"cached", frame.cached()},
          {"failures", frame.attempts()},
          {"lost_workers", frame.lost_workers()},
          {"error", frame.error()}};
}

int RunStatus(const Options& options) {
  FarmClient client(options.farm.server, options.farm.Waiting());
  const Result<std::string> id = FindJob(client, options.job);
  if (!id.ok()) return console::Fail(id.error());
  const Result<v1::Job> job = client.GetJob(*id);
  if (!job.ok()) return console::Fail(job.error());
  std::vector<v1::Frame> frames;
  if (options.frames || job->frames().failed() > 0) {
    Result<std::vector<v1::Frame>> listed = client.ListFrames(*id);
    if (!listed.ok()) return console::Fail(listed.error());
    frames = std::move(listed).value();
  }
  nlohmann::ordered_json json = JobJson(*job);
  if (options.frames) {
    json["frame"] = nlohmann::ordered_json::array();
    for (const v1::Frame& frame : frames) json["frame"].push_back(FrameJson(frame));
  }
  const Result<> printed = console::Print(
      options.farm.json ? json.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n"
                        : Text(*job, frames));
  return printed.ok() ? kExitDone : console::Fail(printed.error());
}

}  // namespace

void AddStatus(CLI::App& app, Run* run) {
  CLI::App* command = app.add_subcommand("status", "Show how a job stands");
  const auto options = std::make_shared<Options>();
  command->add_option("JOB", options->job, "Job id, as submit prints it, or name")->required();
  command->add_flag("--frames", options->frames, "With --json: every frame, too");
  AddPatience(command, &options->farm);
  AddFarmOptions(command, &options->farm);
  command->footer(
      "Examples:\n"
      "  fjord status JOB\n"
      "  fjord status JOB --json | jq .frames.done");
  command->callback([options, run] { *run = [options] { return RunStatus(*options); }; });
}

}  // namespace fjord
