#include "client/commands/common.h"

#include <algorithm>
#include <charconv>
#include <cmath>
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

uint32_t ShareOf(uint32_t whole, double share) {
  return static_cast<uint32_t>(std::clamp(std::round(whole * share), 1., 1e6));
}

}  // namespace

Result<FrameSet> ParseFrames(const std::string& text) {
  if (text.empty()) return FrameSet();
  Result<FrameSet> frames = FrameSet::Parse(text);
  if (!frames.ok()) return Usage("--frames " + frames.error().message);
  return frames;
}

void AddFrames(CLI::App* command, std::string* frames) {
  command->add_option("--frames", *frames, "Frames, as 7, 1-48 or 1-10,12,20-40x2; default all");
}

Result<PictureSize> ParseSize(const std::string& text) {
  const auto wrong = [&] {
    return Usage("--size " + text +
                 ": write width and height in pixels, as 960x540, or a share "
                 "of the scene's, as 50%");
  };
  PictureSize size;
  if (text.ends_with('%')) {
    const char* const end = text.data() + text.size() - 1;
    const auto [stopped, error] = std::from_chars(text.data(), end, size.share);
    if (error != std::errc() || stopped != end || !(size.share > 0) || size.share > 1e6)
      return wrong();
    size.share /= 100;
    return size;
  }
  const std::string_view view(text);
  const size_t times = view.find('x');
  if (times == std::string_view::npos || !ParseNumber(view.substr(0, times), &size.width) ||
      !ParseNumber(view.substr(times + 1), &size.height) || size.width == 0 || size.height == 0) {
    return wrong();
  }
  return size;
}

void AddSets(CLI::App* command, SceneChanges* changes) {
  command
      ->add_option("--set", changes->sets, "path=value, instead of what the scene says; repeatable")
      ->allow_extra_args(false);
}

void AddSceneChanges(CLI::App* command, SceneChanges* changes) {
  AddSets(command, changes);
  command->add_option("--size", changes->size,
                      "Picture size instead of the scene's, as 960x540, or of it, as 50%");
  command->add_option("--samples", changes->samples, "Samples a pixel instead of the scene's")
      ->check(CLI::IsMember({1, 4, 16}));
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

Result<FrameSet> WithinAnimation(const FrameSet& frames, uint32_t first, uint32_t last,
                                 const std::string& scene_file) {
  if (frames.empty()) return FrameSet(first, last);
  if (frames.first() < first || frames.last() > last) {
    const std::string asked = (frames.size() == 1 ? "frame " : "frames ") + frames.ToString(8) +
                              (frames.size() == 1 ? " is" : " are");
    return Invalid(asked + " asked for, the animation has " + std::to_string(first) + "-" +
                       std::to_string(last) + "; ask for others, or change output.frames",
                   {scene_file, 0, 0});
  }
  return frames;
}

Result<std::vector<Setting>> SettingsOf(const SceneChanges& changes,
                                        const std::string& scene_file) {
  Result<std::vector<Setting>> settings = ParseSettings(changes.sets);
  if (!settings.ok()) return settings;
  if (changes.samples > 0) settings->push_back({"output.samples", std::to_string(changes.samples)});
  if (changes.size.empty()) return settings;
  Result<PictureSize> size = ParseSize(changes.size);
  if (!size.ok()) return size.error();
  if (size->share > 0) {
    const LoadResult loaded = LoadSceneFile(scene_file, *settings);
    if (!loaded.ok()) return settings;
    size->width = ShareOf(loaded.loaded.scene.output().width(), size->share);
    size->height = ShareOf(loaded.loaded.scene.output().height(), size->share);
  }
  settings->push_back({"output.width", std::to_string(size->width)});
  settings->push_back({"output.height", std::to_string(size->height)});
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
