#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "client/commands/commands.h"
#include "client/console.h"
#include "client/exit_code.h"
#include "client/files.h"
#include "engine/image/codec.h"
#include "engine/image/picture.h"

namespace fjord {
namespace {

struct Options {
  std::vector<std::string> paths;
  bool json = false;
};

int RunDigest(const Options& options) {
  int code = kExitDone;
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const std::string& path : options.paths) {
    const Result<std::vector<std::string>> files = ListPictures(path);
    if (!files.ok()) {
      code = console::Fail(files.error());
      continue;
    }
    for (const std::string& file : *files) {
      const Result<std::string> bytes = ReadFile(file);
      if (!bytes.ok()) {
        code = console::Fail(bytes.error());
        continue;
      }
      const Result<Picture> picture = DecodePicture(*bytes, file);
      if (!picture.ok()) {
        code = console::Fail(picture.error());
        continue;
      }
      const std::string hex = PixelDigest(*picture).Hex();
      if (options.json) {
        list.push_back({{"path", file}, {"pixel_digest", hex}});
      } else if (const Result<> printed = console::Print(hex + "  " + file + "\n"); !printed.ok()) {
        return console::Fail(printed.error());
      }
    }
  }
  if (options.json) {
    if (const Result<> printed = console::Print(list.dump(1) + "\n"); !printed.ok())
      return console::Fail(printed.error());
  }
  return code;
}

}  // namespace

void AddDigest(CLI::App& app, Run* run) {
  CLI::App* command = app.add_subcommand(
      "digest", "Print the digest of the pixels of pictures, as sha256sum prints");
  const auto options = std::make_shared<Options>();
  command->add_option("PATH", options->paths, "Pictures, or folders of them")->required();
  command->add_flag("--json", options->json, "A list as JSON on standard output");
  command->footer(
      "The digest covers size, type and samples, not the file around them. Folders are walked in "
      "name\n"
      "order.\n\n"
      "Examples:\n"
      "  fjord digest out/taiwan.0001.png\n"
      "  diff <(cd a && fjord digest .) <(cd b && fjord digest .)");
  command->callback([options, run] { *run = [options] { return RunDigest(*options); }; });
}

}  // namespace fjord
