#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "client/commands/commands.h"
#include "client/commands/common.h"
#include "client/console.h"
#include "client/exit_code.h"
#include "client/frame_folder.h"
#include "client/interrupt.h"
#include "client/local_render.h"
#include "client/look_ahead.h"
#include "engine/animation/frame_key.h"
#include "engine/image/picture.h"

namespace fjord {
namespace {

struct Options {
  std::string scene;
  std::string folder;
  std::string frames;
  SceneChanges changes;
  std::string budget;
  int threads = 0;
  double time_limit = 0;  // seconds a frame; 0: none
  bool replace = false;
  bool json = false;
};

int Report(const Options& options, const LocalRenderReport& report, const FrameSet& frames,
           double seconds) {
  if (options.json) {
    const nlohmann::ordered_json json = {
        {"folder", options.folder},
        {"first", frames.first()},
        {"last", frames.last()},
        {"frames", frames.ToString()},
        {"rendered", report.rendered},
        {"kept", report.kept},
        {"triangles_made", report.triangles_made},
        {"seconds", seconds},
    };
    const Result<> printed = console::Print(json.dump(1) + "\n");
    return printed.ok() ? kExitDone : console::Fail(printed.error());
  }
  std::string line = std::to_string(report.rendered) + " frames rendered";
  if (report.kept > 0) line += ", " + std::to_string(report.kept) + " were there already";
  console::Note(line + ", in " + FormatDuration(seconds) + ": " + options.folder);
  return kExitDone;
}

// Empty where the animation has no such frame.
Result<std::string> KeyNow(const Animation& animation, uint32_t frame) {
  if (frame < animation.first_frame() || frame > animation.last_frame()) return std::string();
  AssetSet assets;
  const Result<v1::FrameScene> scene = animation.Inbetween(frame, &assets);
  if (!scene.ok()) return scene.error();
  const Result<Digest> key = FrameKey(*scene);
  if (!key.ok()) return key.error();
  return key->Hex();
}

int RunRender(const Options& options) {
  Result<FrameSet> frames = ParseFrames(options.frames);
  if (!frames.ok()) return console::Fail(frames.error());
  const Result<std::vector<Setting>> settings = SettingsOf(options.changes, options.scene);
  if (!settings.ok()) return console::Fail(settings.error());
  const Result<double> budget = ParseBudget(options.budget, kFrameBudget);
  if (!budget.ok()) return console::Fail(budget.error());
  OpenedScene scene;
  if (const Errors errors = OpenScene(options.scene, *settings, &scene); !errors.empty())
    return console::Fail(errors);
  const Animation& animation = *scene.animation;
  frames = WithinAnimation(*frames, animation.first_frame(), animation.last_frame(), options.scene);
  if (!frames.ok()) return console::Fail(frames.error());

  const SceneOrigin origin{options.scene, *settings};
  LookAhead ahead;
  if (const Result<> held = LookAtFrames(animation, *frames, *budget, origin, &ahead); !held.ok())
    return console::Fail(held.error());
  if (!ahead.advice.empty()) console::Note(ahead.advice);
  const auto format = static_cast<PixelFormat>(animation.scene().output().format());
  FrameFolder::Order order{options.folder,
                           DescribeScene(animation.scene(), options.scene, scene.digest),
                           FileEnding(format), options.replace,
                           [&animation](uint32_t frame) { return KeyNow(animation, frame); }};
  Result<std::unique_ptr<FrameFolder>> folder = FrameFolder::Open(std::move(order));
  if (!folder.ok()) return console::Fail(folder.error());

  const auto start = std::chrono::steady_clock::now();
  LocalRenderReport report;
  const LocalRenderJob job{
      scene.animation,
      *frames,
      options.threads,
      &CatchInterrupts(),
      options.time_limit,
      [&](const v1::FrameScene& frame, const AssetResolver* assets, uint32_t number) {
        return CheckFrameBudget(animation, frame, assets, number, *budget, Counted::kInView,
                                origin);
      }};
  const uint32_t total = frames->size();
  Result<> rendered;
  {
    FrameProgress progress(animation.scene().name(), total, FrameProgress::Console());
    rendered = RenderLocally(job, folder->get(), &progress, &report);
  }
  if (!rendered.ok() && rendered.error().code == ErrorCode::kCancelled) {
    return console::Fail(MakeError(ErrorCode::kCancelled,
                                   "interrupted; " + std::to_string(report.rendered + report.kept) +
                                       " of " + std::to_string(total) + " frames are in " +
                                       options.folder + ", the same command continues"));
  }
  if (!rendered.ok()) return console::Fail(InScene(rendered.error(), options.scene));
  return Report(options, report, *frames,
                std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
}

}  // namespace

void AddRender(CLI::App& app, Run* run) {
  CLI::App* command = app.add_subcommand("render", "Render a scene on this machine");
  const auto options = std::make_shared<Options>();
  command->add_option("SCENE", options->scene, "Scene file")->required();
  command->add_option("-o,--output", options->folder, "Folder for frames and manifest.json")
      ->required();
  AddFrames(command, &options->frames);
  command->add_option("--threads", options->threads, "Threads on one frame; 0: one a core")
      ->check(CLI::Range(0, 1024));
  AddSceneChanges(command, &options->changes);
  command
      ->add_option("--frame-limit", options->time_limit,
                   "Seconds that one frame may take, else it is an error; 0, the default: any time")
      ->check(CLI::Range(0., kMostFrameSeconds));
  command->add_flag("--replace", options->replace,
                    "Make frames of an older version of the scene in the folder again");
  AddBudget(command, &options->budget);
  command->add_flag("--json", options->json, "A summary as JSON on standard output");
  command->footer(
      "Frames that are there already, made under the same frame key, are kept: after Ctrl-C the "
      "same\n"
      "command continues.\n\n"
      "Examples:\n"
      "  fjord render examples/taiwan-rising.scene -o out\n"
      "  fjord render island.scene -o out --frames 48 --size 1920x1080\n"
      "  fjord render island.scene -o small --frames 1-96x8 --size 50% --samples 1\n"
      "  fjord render island.scene -o rough --set objects[island].fractal.H=.3");
  command->callback([options, run] { *run = [options] { return RunRender(*options); }; });
}

}  // namespace fjord
