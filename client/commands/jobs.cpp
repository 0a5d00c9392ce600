#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "client/commands/commands.h"
#include "client/commands/farm_options.h"
#include "client/console.h"
#include "client/exit_code.h"
#include "client/farm_client.h"
#include "client/job_text.h"

namespace fjord {
namespace {

int RunJobs(const FarmOptions& options) {
  FarmClient client(options.server);
  std::string trouble;
  const Result<std::vector<v1::Job>> jobs = client.ListJobs(&trouble);
  if (!jobs.ok()) return console::Fail(jobs.error());
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  std::string text;
  for (const v1::Job& job : *jobs) {
    list.push_back(JobJson(job));
    char priority[16];
    std::snprintf(priority, sizeof priority, "%5d", job.priority());
    text += Column(job.id(), 14) + " " + Column(JobStateName(job.state()), 10) + " " + priority +
            "  " + Column(job.name(), 24) + " " + CountsText(job.frames()) +
            (job.after_job().empty() ? "" : ", after job " + job.after_job()) + "\n";
  }
  if (!trouble.empty()) console::Note("trouble: " + trouble);
  if (text.empty()) console::Note("no jobs");
  const Result<> printed = console::Print(options.json ? list.dump(1) + "\n" : text);
  return printed.ok() ? kExitDone : console::Fail(printed.error());
}

}  // namespace

void AddJobs(CLI::App& app, Run* run) {
  CLI::App* command = app.add_subcommand("jobs", "List the jobs of the farm");
  const auto options = std::make_shared<FarmOptions>();
  AddFarmOptions(command, options.get());
  command->footer(
      "A line has id, state, priority, name, frames and the job after which it "
      "runs.\n\nExamples:\n  fjord jobs\n  fjord jobs "
      "--json");
  command->callback([options, run] { *run = [options] { return RunJobs(*options); }; });
}

}  // namespace fjord
