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
#include "engine/base/printable.h"

namespace fjord {
namespace {

struct Options {
  FarmOptions farm;
  std::vector<std::string> jobs;
  int priority = 0;
};

int RunCommand(const Options& options, v1::CommandRequest::Kind kind) {
  FarmClient client(options.farm.server);
  int code = kExitDone;
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const std::string& named : options.jobs) {
    const Result<std::string> id = FindJob(client, named);
    if (!id.ok()) {
      code = console::Fail(id.error());
      continue;
    }
    v1::CommandRequest request;
    request.set_job_id(*id);
    request.set_kind(kind);
    request.set_priority(options.priority);
    const Result<v1::Job> job = client.Command(request);
    if (!job.ok()) {
      code = console::Fail(job.error());
      continue;
    }
    list.push_back(JobJson(*job));
    if (!options.farm.json)
      console::Note(Printable(job->name()) + "  job " + job->id() + "  " +
                    JobStateName(job->state()));
  }
  if (options.farm.json) {
    const Result<> printed = console::Print((list.size() == 1 ? list[0] : list).dump(1) + "\n");
    if (!printed.ok()) return console::Fail(printed.error());
  }
  return code;
}

void AddOne(CLI::App& app, Run* run, const std::string& name, const std::string& what,
            v1::CommandRequest::Kind kind, const std::string& examples) {
  CLI::App* command = app.add_subcommand(name, what);
  const auto options = std::make_shared<Options>();
  if (kind == v1::CommandRequest::PRIORITY) {
    options->jobs.resize(1);
    command->add_option("JOB", options->jobs[0], "Job id, as submit prints it, or name")
        ->required();
    command->add_option("NUMBER", options->priority, "Higher goes first; -1000..1000")
        ->required()
        ->check(CLI::Range(-1000, 1000));
  } else {
    command->add_option("JOB", options->jobs, "Job ids, as submit prints them, or names")
        ->required();
  }
  AddFarmOptions(command, &options->farm);
  command->footer("Examples:\n" + examples);
  command->callback(
      [options, run, kind] { *run = [options, kind] { return RunCommand(*options, kind); }; });
}

}  // namespace

void AddJobCommands(CLI::App& app, Run* run) {
  AddOne(app, run, "cancel", "End a job; finished frames stay", v1::CommandRequest::CANCEL,
         "  fjord cancel JOB");
  AddOne(app, run, "pause", "Hand out no more frames of a job; what runs is finished",
         v1::CommandRequest::PAUSE, "  fjord pause JOB");
  AddOne(app, run, "resume", "Go on with a paused job", v1::CommandRequest::RESUME,
         "  fjord resume JOB");
  AddOne(app, run, "retry", "Try the failed frames of a job again, or go on with a cancelled job",
         v1::CommandRequest::RETRY, "  fjord retry JOB");
  AddOne(app, run, "delete", "Forget jobs that have ended; their pictures stay for later jobs",
         v1::CommandRequest::DELETE, "  fjord delete JOB\n  fjord delete 3 4 5");
  AddOne(app, run, "priority", "Change the priority of a job", v1::CommandRequest::PRIORITY,
         "  fjord priority JOB 10\n  fjord priority JOB -10");
}

}  // namespace fjord
