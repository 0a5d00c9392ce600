#include <memory>
#include <string>

#include "client/commands/commands.h"
#include "client/commands/common.h"
#include "client/commands/farm_options.h"
#include "client/console.h"
#include "client/exit_code.h"
#include "client/farm_client.h"
#include "client/fetch_job.h"
#include "client/find_job.h"
#include "client/interrupt.h"
#include "client/job_text.h"

namespace fjord {
namespace {

struct Options {
  FarmOptions farm;
  std::string job;
  std::string folder;
  std::string frames;
  bool replace = false;
};

int RunFetch(const Options& options) {
  const Result<FrameSet> frames = ParseFrames(options.frames);
  if (!frames.ok()) return console::Fail(frames.error());
  FarmClient client(options.farm.server, options.farm.Waiting());
  client.StopWaitingOn(&CatchInterrupts());
  const Result<std::string> job = FindJob(client, options.job);
  if (!job.ok()) return console::Fail(job.error());
  const Result<FetchReport> report =
      FetchJob(client, {*job, options.folder, *frames, options.replace}, &CatchInterrupts());
  if (!report.ok()) return console::Fail(report.error());
  if (options.farm.json) {
    const nlohmann::ordered_json json = {{"folder", options.folder},   {"name", report->name},
                                         {"total", report->total},     {"fetched", report->fetched},
                                         {"kept", report->kept},       {"missing", report->missing},
                                         {"lost", report->lost.size()}};
    if (const Result<> printed = console::Print(json.dump(1) + "\n"); !printed.ok())
      return console::Fail(printed.error());
  }
  std::string line = std::to_string(report->fetched) + " frames fetched";
  if (report->kept > 0) line += ", " + std::to_string(report->kept) + " were there already";
  console::Note(line + ": " + options.folder);
  const Result<> whole = RequireAll(*report, *job);
  return whole.ok() ? kExitDone : console::Fail(whole.error());
}

}  // namespace

void AddFetch(CLI::App& app, Run* run) {
  CLI::App* command =
      app.add_subcommand("fetch", "Bring the finished frames of a job into a folder");
  const auto options = std::make_shared<Options>();
  command->add_option("JOB", options->job, "Job id, as submit prints it, or name")->required();
  command->add_option("-o,--output", options->folder, "Folder for frames and manifest.json")
      ->required();
  AddFrames(command, &options->frames);
  command->add_flag("--replace", options->replace,
                    "Where the folder holds frames of an older version of the scene");
  AddPatience(command, &options->farm);
  AddFarmOptions(command, &options->farm);
  command->footer(
      "Frames that are there already are kept; exit code 1 while frames are missing.\n\n"
      "Examples:\n"
      "  fjord fetch JOB -o out\n"
      "  fjord fetch island -o out --frames 1-24,48");
  command->callback([options, run] { *run = [options] { return RunFetch(*options); }; });
}

}  // namespace fjord
