#include <memory>
#include <string>

#include "client/commands/commands.h"
#include "client/console.h"
#include "client/exit_code.h"
#include "client/local_farm.h"
#include "proto/fjord/address.h"
#include "proto/fjord/protocol.h"

namespace fjord {
namespace {

int RunFarm(const LocalFarmOptions& options) {
  if (const std::string defect = AddressDefect(options.listen, PortZero::kTakesAFreeOne);
      !defect.empty())
    return console::Fail(MakeError(ErrorCode::kUsage, "--listen " + defect));
  const Result<> ran = RunLocalFarm(options, [](const std::string& address) {
    const Result<> printed = console::Print("listening on " + address + "\n");
    if (!printed.ok()) console::Fail(printed.error());
  });
  return ran.ok() ? kExitDone : console::Fail(ran.error());
}

}  // namespace

void AddFarm(CLI::App& app, Run* run) {
  CLI::App* command =
      app.add_subcommand("farm", "Run a coordinator and workers on this machine until interrupted");
  const auto options = std::make_shared<LocalFarmOptions>();
  options->data = "fjord-data";
  options->listen = kDefaultServer;
  command->add_option("--workers", options->workers, "How many; default one for every two cores")
      ->check(CLI::Range(1, 1024));
  command
      ->add_option("--threads", options->threads,
                   "Threads of each worker; default the cores shared out")
      ->check(CLI::Range(1, 1024));
  command->add_option("--data", options->data, "Folder for jobs and pictures")
      ->capture_default_str();
  command->add_option("--listen", options->listen, "HOST:PORT; port 0 takes a free one")
      ->capture_default_str();
  command->add_option(
      "--budget", options->budget,
      "Triangles a frame of a job may have, by estimate, or unlimited; default 2e9");
  command->add_flag("--with-parent", options->with_parent, "End when the starting process ends");
  command->footer(
      "Prints the address when it is ready. What dies is started again; a job goes on where it "
      "was.\n\n"
      "Examples:\n"
      "  fjord farm\n"
      "  fjord farm --workers 4 --data ~/fjord --listen 127.0.0.1:0");
  command->callback([options, run] { *run = [options] { return RunFarm(*options); }; });
}

}  // namespace fjord
