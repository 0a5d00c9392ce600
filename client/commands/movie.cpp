#include "client/movie.h"

#include <stdlib.h>

#include <filesystem>
#include <memory>
#include <string>

#include "client/commands/commands.h"
#include "client/commands/farm_options.h"
#include "client/commands/frame_choice.h"
#include "client/console.h"
#include "client/exit_code.h"
#include "client/farm_client.h"
#include "client/fetch_job.h"
#include "client/find_job.h"
#include "client/interrupt.h"

namespace fjord {
namespace {

namespace fs = std::filesystem;

struct Options {
  FarmOptions farm;
  std::string source;
  std::string output;
  double rate = 0;
  FrameChoiceOptions choice;
};

// A folder that goes away with its frames.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::string pattern = (fs::temp_directory_path() / "fjord-movie-XXXXXX").string();
    if (mkdtemp(pattern.data()) != nullptr) path_ = pattern;
  }
  ~ScratchFolder() {
    std::error_code ignored;
    if (!path_.empty()) fs::remove_all(path_, ignored);
  }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

int MovieOfFolder(const Options& options, const FrameChoice& choice, const std::string& folder) {
  const Result<FrameList> frames = FramesOf(folder, choice);
  if (!frames.ok()) return console::Fail(frames.error());
  const double rate = options.rate > 0 ? options.rate : frames->rate;
  const Result<MovieReport> made =
      MakeMovie(frames->frames, rate, options.output, &CatchInterrupts());
  if (!made.ok()) return console::Fail(made.error());
  if (made->over_black) console::Note("the frames are transparent: laid over black");
  console::Note(std::to_string(frames->frames.size()) + " frames in " + options.output);
  return kExitDone;
}

int RunMovie(const Options& options) {
  if (!options.output.ends_with(".mp4"))
    return console::Fail(
        MakeError(ErrorCode::kUsage, "-o " + options.output + ": a movie is an .mp4 file"));
  const Result<FrameChoice> choice = options.choice.Read();
  if (!choice.ok()) return console::Fail(choice.error());
  std::error_code error;
  if (fs::is_directory(options.source, error))
    return MovieOfFolder(options, *choice, options.source);
  if (options.source.find('/') != std::string::npos) {
    return console::Fail(
        MakeError(ErrorCode::kNotFound, "there is no such folder", {options.source, 0, 0}));
  }
  const ScratchFolder scratch;
  if (scratch.path().empty())
    return console::Fail(MakeError(ErrorCode::kIo, "no temporary folder can be made"));
  FarmClient client(options.farm.server);
  const Result<std::string> job = FindJob(client, options.source);
  if (!job.ok()) return console::Fail(job.error());
  const Result<FetchReport> report =
      FetchJob(client, {*job, scratch.path(), choice->frames, false}, &CatchInterrupts());
  if (!report.ok()) return console::Fail(report.error());
  if (!choice->allow_missing) {
    if (const Result<> whole = RequireAll(*report, *job); !whole.ok())
      return console::Fail(whole.error());
  }
  FrameChoice all = *choice;
  all.frames = report->frames;
  return MovieOfFolder(options, all, scratch.path());
}

}  // namespace

void AddMovie(CLI::App& app, Run* run) {
  CLI::App* command =
      app.add_subcommand("movie", "Make a movie of a folder of frames, or of a job");
  const auto options = std::make_shared<Options>();
  command->add_option("DIR|JOB", options->source, "Folder of frames, or a job id")->required();
  command->add_option("-o,--output", options->output, "The movie, an .mp4 file")->required();
  command->add_option("--rate", options->rate, "Frames a second; default the scene's")
      ->check(CLI::Range(.01, 1000.));
  AddFrameChoice(command, &options->choice);
  AddServer(command, &options->farm);
  command->footer(
      "Needs the program ffmpeg. H.264, 4:2:0, of high quality (crf 16).\n\n"
      "Examples:\n"
      "  fjord movie out -o island.mp4\n"
      "  fjord movie JOB -o island.mp4 --rate 30");
  command->callback([options, run] { *run = [options] { return RunMovie(*options); }; });
}

}  // namespace fjord
