#include "client/cli.h"

#include <exception>
#include <new>
#include <string>

#include "client/commands/commands.h"
#include "client/console.h"
#include "client/exit_code.h"
#include "proto/fjord/protocol.h"

namespace fjord {
namespace {

std::string OnWrongUsage(const CLI::App* app, const CLI::Error& error) {
  const CLI::App* command = app;
  for (const CLI::App* chosen : app->get_subcommands()) command = chosen;
  std::string name = "fjord";
  if (command != app) name += " " + command->get_name();
  return std::string("error: ") + error.what() + "; see " + name + " --help\n";
}

}  // namespace

int RunCommandLine(int argc, char** argv) {
  CLI::App app("Fjord makes animations of fractal natural objects, on one machine or on a farm.",
               "fjord");
  app.set_version_flag("--version", std::string("fjord ") + kVersion);
  app.require_subcommand(1);
  app.failure_message(OnWrongUsage);
  app.footer("Exit codes: 0 done; 1 the scene, job or check failed; 2 wrong usage; 3 no server.");
  Run run;
  AddCommands(app, &run);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kExitDone : kExitUsage;
  }
  try {
    return run();
  } catch (const std::bad_alloc&) {
    return console::Fail(MakeError(ErrorCode::kLimit,
                                   "there is not enough memory for this; ask for less, as with a "
                                   "larger epsilon or pixels"));
  } catch (const std::exception& error) {
    return console::Fail(MakeError(ErrorCode::kInternal, error.what()));
  }
}

}  // namespace fjord
