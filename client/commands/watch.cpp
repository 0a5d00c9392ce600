#include <memory>
#include <string>

#include "client/commands/commands.h"
#include "client/commands/farm_options.h"
#include "client/console.h"
#include "client/exit_code.h"
#include "client/farm_client.h"
#include "client/find_job.h"
#include "client/follow_job.h"
#include "client/job_text.h"

namespace fjord {
namespace {

struct Options {
  FarmOptions farm;
  std::string job;
};

int RunWatch(const Options& options) {
  FarmClient client(options.farm.server, options.farm.Waiting());
  const Result<std::string> job = FindJob(client, options.job);
  if (!job.ok()) return console::Fail(job.error());
  const Result<v1::Job> ended = FollowJob(client, *job);
  if (!ended.ok()) return console::Fail(ended.error());
  if (options.farm.json) {
    if (const Result<> printed = console::Print(JobJson(*ended).dump(1) + "\n"); !printed.ok())
      return console::Fail(printed.error());
  }
  if (!ended->error().empty()) console::Note("error: " + ended->error());
  return ExitCodeOfJob(ended->state());
}

}  // namespace

void AddWatch(CLI::App& app, Run* run) {
  CLI::App* command = app.add_subcommand("watch", "Follow a job: frames, workers, time left");
  const auto options = std::make_shared<Options>();
  command->add_option("JOB", options->job, "Job id, as submit prints it, or name")->required();
  AddPatience(command, &options->farm);
  AddFarmOptions(command, &options->farm);
  command->footer(
      "Ends with the job: exit code 0 when it is done, 1 when it failed or was cancelled. On a "
      "pipe:\n"
      "plain lines. The map has a cell a frame: . waiting, > running, # done, = cached, x "
      "failed.\n\n"
      "Examples:\n"
      "  fjord watch JOB\n"
      "  fjord watch JOB 2>&1 | tee log");
  command->callback([options, run] { *run = [options] { return RunWatch(*options); }; });
}

}  // namespace fjord
