#include "client/commands/common.h"

#include <charconv>
#include <string_view>
#include <utility>

#include "client/console.h"
#include "engine/base/digest.h"

namespace fjord {
namespace {

bool ParseNumber(std::string_view text, uint32_t* number) {
  const char* end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, *number);
  return error == std::errc() && stopped == end && !text.empty();
}

Error Usage(std::string message) { return MakeError(ErrorCode::kUsage, std::move(message)); }

}  // namespace

Result<FrameRange> ParseFrameRange(const std::string& text) {
  if (text.empty()) return FrameRange{};
  const std::string_view view(text);
  const size_t dash = view.find('-');
  FrameRange range;
  const bool good = dash == std::string_view::npos
                        ? ParseNumber(view, &range.first)
                        : ParseNumber(view.substr(0, dash), &range.first) &&
                              ParseNumber(view.substr(dash + 1), &range.last);
  if (dash == std::string_view::npos) range.last = range.first;
  if (!good || range.first == 0 || range.last < range.first) {
    return Usage("--frames " + text +
                 ": write one frame (7) or a range (1-48); frames count from 1");
  }
  return range;
}

Result<PictureSize> ParseSize(const std::string& text) {
  const std::string_view view(text);
  const size_t times = view.find('x');
  PictureSize size;
  if (times == std::string_view::npos || !ParseNumber(view.substr(0, times), &size.width) ||
      !ParseNumber(view.substr(times + 1), &size.height) || size.width == 0 || size.height == 0) {
    return Usage("--size " + text + ": write width and height in pixels, as 960x540");
  }
  return size;
}

Result<std::vector<Setting>> ParseSettings(const std::vector<std::string>& texts) {
  std::vector<Setting> settings;
  for (const std::string& text : texts) {
    const size_t equals = text.find('=');
    if (equals == 0 || equals == std::string::npos)
      return Usage("--set " + text + ": write path=value, as --set objects[coast].fractal.H=.5");
    settings.push_back({text.substr(0, equals), text.substr(equals + 1)});
  }
  return settings;
}

Result<FrameRange> WithinAnimation(FrameRange range, uint32_t first, uint32_t last,
                                   const std::string& scene_file) {
  if (range.first == 0) return FrameRange{first, last};
  if (range.first < first || range.last > last) {
    const std::string asked =
        range.first == range.last
            ? "frame " + std::to_string(range.first) + " is"
            : "frames " + std::to_string(range.first) + "-" + std::to_string(range.last) + " are";
    return Invalid(asked + " asked for, the animation has " + std::to_string(first) + "-" +
                       std::to_string(last) + "; ask for others, or change output.frames",
                   {scene_file, 0, 0});
  }
  return range;
}

Result<std::vector<Setting>> SettingsOf(const std::vector<std::string>& sets,
                                        const std::string& size) {
  Result<std::vector<Setting>> settings = ParseSettings(sets);
  if (!settings.ok() || size.empty()) return settings;
  const Result<PictureSize> parsed = ParseSize(size);
  if (!parsed.ok()) return parsed.error();
  settings->push_back({"output.width", std::to_string(parsed->width)});
  settings->push_back({"output.height", std::to_string(parsed->height)});
  return settings;
}

Error InScene(Error error, const std::string& scene_file) {
  if (error.place.file.empty()) error.place.file = scene_file;
  return error;
}

Errors OpenScene(const std::string& path, const std::vector<Setting>& settings,
                 OpenedScene* opened) {
  LoadResult loaded = LoadSceneFile(path, settings);
  for (const std::string& note : loaded.notes) console::Note(note);
  if (!loaded.ok()) return std::move(loaded.errors);
  opened->digest = Sha256Of(SerializeScene(loaded.loaded.scene)).Hex();
  Result<std::shared_ptr<const Animation>> animation = Animation::Make(std::move(loaded.loaded));
  if (!animation.ok()) return {InScene(animation.error(), path)};
  opened->animation = std::move(animation).value();
  return {};
}

}  // namespace fjord
