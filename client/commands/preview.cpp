#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "client/commands/commands.h"
#include "client/commands/common.h"
#include "client/console.h"
#include "client/exit_code.h"
#include "engine/image/codec.h"
#include "engine/render/build.h"
#include "engine/render/wireframe.h"

namespace fjord {
namespace {

struct Options {
  std::string scene;
  uint32_t frame = 1;
  std::string output;
  size_t edges = kWireframeCap;
  SceneChanges changes;
};

struct Drawn {
  std::string bytes;
  WireframeStats stats;
};

Result<Drawn> Draw(const BuiltFrame& frame, const Options& options) {
  if (options.output.ends_with(".svg")) {
    Result<WireframeDrawing> drawing = WireframeSvg(frame, options.edges);
    if (!drawing.ok()) return drawing.error();
    return Drawn{std::move(drawing->svg), drawing->stats};
  }
  const Result<WireframePicture> picture = RenderWireframe(frame, options.edges);
  if (!picture.ok()) return picture.error();
  Result<std::string> bytes = EncodePicture(picture->picture, {});
  if (!bytes.ok()) return bytes.error();
  return Drawn{std::move(bytes).value(), picture->stats};
}

int RunPreview(const Options& options) {
  if (!options.output.ends_with(".png") && !options.output.ends_with(".svg")) {
    return console::Fail(MakeError(
        ErrorCode::kUsage, "-o " + options.output + ": a preview is a .png or an .svg file"));
  }
  const Result<std::vector<Setting>> settings = SettingsOf(options.changes, options.scene);
  if (!settings.ok()) return console::Fail(settings.error());
  OpenedScene scene;
  if (const Errors errors = OpenScene(options.scene, *settings, &scene); !errors.empty())
    return console::Fail(errors);
  const Result<FrameSet> within =
      WithinAnimation(FrameSet(options.frame, options.frame), scene.animation->first_frame(),
                      scene.animation->last_frame(), options.scene);
  if (!within.ok()) return console::Fail(within.error());
  AssetSet assets;
  const Result<v1::FrameScene> frame = scene.animation->Inbetween(options.frame, &assets);
  if (!frame.ok()) return console::Fail(InScene(frame.error(), options.scene));
  const Result<BuiltFrame> built = BuildFrame(*frame, &assets);
  if (!built.ok()) return console::Fail(InScene(built.error(), options.scene));
  const Result<Drawn> drawn = Draw(*built, options);
  if (!drawn.ok()) return console::Fail(drawn.error());
  if (const Result<> written = WriteFileAtomically(options.output, drawn->bytes); !written.ok())
    return console::Fail(written.error());
  std::string line = std::to_string(drawn->stats.edges) + " edges";
  if (drawn->stats.longest_only) {
    line += ", the longest in view of the coarse shapes'";
  } else if (drawn->stats.coarser > 1) {
    char factor[32];
    std::snprintf(factor, sizeof factor, "%g", drawn->stats.coarser);
    line += std::string(", ") + factor + " times coarser than the picture, to stay under " +
            std::to_string(options.edges);
  }
  console::Note(line + ": " + options.output);
  return kExitDone;
}

}  // namespace

void AddPreview(CLI::App& app, Run* run) {
  CLI::App* command = app.add_subcommand("preview", "Draw one frame as a wireframe, fast");
  const auto options = std::make_shared<Options>();
  command->add_option("SCENE", options->scene, "Scene file")->required();
  command->add_option("--frame", options->frame, "Frame number, from 1")
      ->required()
      ->check(CLI::Range(1u, 1000000u));
  command->add_option("-o,--output", options->output, "A .png or .svg file")->required();
  command
      ->add_option(
          "--edges", options->edges,
          "Draw no more edges than this: coarser where needed, of coarse shapes the longest")
      ->capture_default_str()
      ->check(CLI::Range(size_t{100}, size_t{100000000}));
  AddSceneChanges(command, &options->changes);
  command->footer(
      "Examples:\n"
      "  fjord preview examples/taiwan-rising.scene --frame 48 -o look.png\n"
      "  fjord preview coast.scene --frame 1 -o coast.svg");
  command->callback([options, run] { *run = [options] { return RunPreview(*options); }; });
}

}  // namespace fjord
