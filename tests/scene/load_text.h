// Loading scenes from text in tests, without files but those given.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "engine/scene/load.h"

namespace fjord::testing {

using Files = std::map<std::string, std::string>;

inline LoadResult Load(const std::string& text, const std::vector<Setting>& settings = {},
                       const Files& files = {}) {
  const AssetReader reader = [&](const v1::File& file) -> Result<std::string> {
    const auto found = files.find(file.path());
    if (found == files.end())
      return MakeError(ErrorCode::kNotFound, "there is no file " + file.path());
    return found->second;
  };
  return LoadSceneText(text, "s.scene", reader, settings);
}

// All errors, a line each.
inline std::string ErrorsOf(const LoadResult& result) {
  std::string text;
  for (const Error& error : result.errors) text += error.ToString() + "\n";
  return text;
}

inline std::string ErrorsOf(const std::string& scene, const std::vector<Setting>& settings = {},
                            const Files& files = {}) {
  return ErrorsOf(Load(scene, settings, files));
}

}  // namespace fjord::testing
