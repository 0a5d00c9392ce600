// The commands of `fjord`, one a file. Each adds itself to the command line with its options and
// examples; when it is chosen it sets *run, which does the work and gives the exit code.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace fjord {

using Run = std::function<int()>;

void AddCommands(CLI::App& app, Run* run);  // all of them

void AddRender(CLI::App& app, Run* run);
void AddPreview(CLI::App& app, Run* run);
void AddFractalize(CLI::App& app, Run* run);
void AddCheck(CLI::App& app, Run* run);
void AddMeasure(CLI::App& app, Run* run);
void AddImport(CLI::App& app, Run* run);
void AddDigest(CLI::App& app, Run* run);
void AddPresets(CLI::App& app, Run* run);
void AddSheet(CLI::App& app, Run* run);
void AddMovie(CLI::App& app, Run* run);

void AddSubmit(CLI::App& app, Run* run);
void AddStatus(CLI::App& app, Run* run);
void AddWatch(CLI::App& app, Run* run);
void AddJobCommands(CLI::App& app, Run* run);  // cancel, pause, resume, retry, priority
void AddJobs(CLI::App& app, Run* run);
void AddWorkers(CLI::App& app, Run* run);
void AddFetch(CLI::App& app, Run* run);
void AddFarm(CLI::App& app, Run* run);

}  // namespace fjord
