#include "client/commands/commands.h"

namespace fjord {

void AddCommands(CLI::App& app, Run* run) {
  AddRender(app, run);
  AddCheck(app, run);
  AddDigest(app, run);
  AddPresets(app, run);
  AddSheet(app, run);
}

}  // namespace fjord
