#include "client/commands/commands.h"

namespace fjord {

void AddCommands(CLI::App& app, Run* run) {
  AddRender(app, run);
  AddPreview(app, run);
  AddFractalize(app, run);
  AddCheck(app, run);
  AddMeasure(app, run);
  AddImport(app, run);
  AddDigest(app, run);
  AddPresets(app, run);
  AddSheet(app, run);
  AddMovie(app, run);
  AddSubmit(app, run);
  AddStatus(app, run);
  AddWatch(app, run);
  AddFetch(app, run);
  AddJobs(app, run);
  AddJobCommands(app, run);
  AddWorkers(app, run);
  AddFarm(app, run);
}

}  // namespace fjord
