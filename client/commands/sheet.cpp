#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "client/commands/commands.h"
#include "client/commands/frame_choice.h"
#include "client/console.h"
#include "client/contact_sheet.h"
#include "client/exit_code.h"
#include "engine/image/codec.h"

namespace fjord {
namespace {

struct Options {
  std::string folder;
  std::string output;
  SheetLayout layout;
  FrameChoiceOptions choice;
};

int RunSheet(const Options& options) {
  if (!options.output.ends_with(".png"))
    return console::Fail(
        MakeError(ErrorCode::kUsage, "-o " + options.output + ": a sheet is a .png file"));
  const Result<FrameChoice> choice = options.choice.Read();
  if (!choice.ok()) return console::Fail(choice.error());
  const Result<FrameList> frames = FramesOf(options.folder, *choice, options.output);
  if (!frames.ok()) return console::Fail(frames.error());
  SheetLayout layout = options.layout;
  layout.any_size = choice->allow_mixed;
  const Result<Picture> sheet = MakeContactSheet(frames->frames, layout);
  if (!sheet.ok()) return console::Fail(sheet.error());
  const Result<std::string> bytes = EncodePicture(*sheet, {});
  if (!bytes.ok()) return console::Fail(bytes.error());
  if (const Result<> written = WriteFileAtomically(options.output, *bytes); !written.ok())
    return console::Fail(written.error());
  console::Note(std::to_string(frames->frames.size()) + " frames on " + options.output);
  return kExitDone;
}

}  // namespace

void AddSheet(CLI::App& app, Run* run) {
  CLI::App* command = app.add_subcommand("sheet", "Make a contact sheet of a folder of frames");
  const auto options = std::make_shared<Options>();
  command->add_option("DIR", options->folder, "Folder of frames")->required();
  command->add_option("-o,--output", options->output, "The sheet, a .png file")->required();
  command
      ->add_option("--columns", options->layout.columns, "Thumbnails side by side; default chosen")
      ->check(CLI::Range(1, 100));
  command->add_option("--width", options->layout.width, "Width of the sheet in pixels, about")
      ->check(CLI::Range(64, 16384));
  AddFrameChoice(command, &options->choice);
  command->footer(
      "Examples:\n"
      "  fjord sheet out/taiwan-rising -o contact-sheet.png\n"
      "  fjord sheet out -o sheet.png --columns 8 --width 3840\n"
      "  fjord sheet out -o sheet.png --frames 1-96x8");
  command->callback([options, run] { *run = [options] { return RunSheet(*options); }; });
}

}  // namespace fjord
