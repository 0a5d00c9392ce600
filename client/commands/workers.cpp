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

struct Options {
  FarmOptions farm;
  std::string worker;
};

std::string Text(const v1::WorkerInfo& worker) {
  char numbers[80];
  std::snprintf(numbers, sizeof numbers, " %3u threads  %6llu frames", worker.threads(),
                static_cast<unsigned long long>(worker.frames_done()));
  std::string text =
      Column(worker.id(), 24) + " " + Column(WorkerStateName(worker.state()), 12) + numbers;
  for (const v1::Holding& held : worker.holding())
    text += "  " + held.job_id() + " frame " + std::to_string(held.frame());
  return text + "\n";
}

int Show(const FarmOptions& options, const nlohmann::ordered_json& json, const std::string& text) {
  const Result<> printed = console::Print(options.json ? json.dump(1) + "\n" : text);
  return printed.ok() ? kExitDone : console::Fail(printed.error());
}

int RunList(const Options& options) {
  FarmClient client(options.farm.server);
  std::string trouble;
  const Result<std::vector<v1::WorkerInfo>> workers = client.ListWorkers(&trouble);
  if (!workers.ok()) return console::Fail(workers.error());
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  std::string text;
  for (const v1::WorkerInfo& worker : *workers) {
    list.push_back(WorkerJson(worker, trouble));
    text += Text(worker);
  }
  if (!trouble.empty()) console::Note("trouble: " + trouble);
  if (text.empty())
    console::Note("no workers; start one with fjord-worker --server " + client.address());
  return Show(options.farm, list, text);
}

int RunCommand(const Options& options, v1::CommandWorkerRequest::Kind kind) {
  FarmClient client(options.farm.server);
  v1::CommandWorkerRequest request;
  request.set_worker_id(options.worker);
  request.set_kind(kind);
  const Result<v1::WorkerInfo> worker = client.CommandWorker(request);
  if (!worker.ok()) return console::Fail(worker.error());
  return Show(options.farm, WorkerJson(*worker), Text(*worker));
}

}  // namespace

void AddWorkers(CLI::App& app, Run* run) {
  CLI::App* command = app.add_subcommand("workers", "List the workers of the farm, or command one");
  const auto options = std::make_shared<Options>();
  AddFarmOptions(command, &options->farm);
  command->fallthrough();
  const auto add = [&](const char* name, const char* what, v1::CommandWorkerRequest::Kind kind) {
    CLI::App* sub = command->add_subcommand(name, what);
    sub->add_option("ID", options->worker, "Worker id, as `fjord workers` prints it")->required();
    sub->fallthrough();
    sub->callback(
        [options, run, kind] { *run = [options, kind] { return RunCommand(*options, kind); }; });
  };
  add("drain", "Let it finish what it holds and give it nothing new",
      v1::CommandWorkerRequest::DRAIN);
  add("quarantine", "Do not trust its pictures", v1::CommandWorkerRequest::QUARANTINE);
  add("release", "Give it work again", v1::CommandWorkerRequest::RELEASE);
  command->footer(
      "Examples:\n"
      "  fjord workers\n"
      "  fjord workers drain node7-1");
  command->callback([options, run, command] {
    if (command->get_subcommands().empty()) *run = [options] { return RunList(*options); };
  });
}

}  // namespace fjord
