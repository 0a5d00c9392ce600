#include "client/frame_list.h"

#include <algorithm>
#include <filesystem>

#include "client/files.h"
#include "client/manifest.h"

namespace fjord {

Result<FrameList> FramesOf(const std::string& folder, const std::string& leave_out) {
  FrameList list;
  const std::string path = folder + "/" + kManifestName;
  std::error_code error;
  if (std::filesystem::exists(path, error)) {
    const Result<std::string> bytes = ReadFile(path);
    if (!bytes.ok()) return bytes.error();
    const Result<Manifest> manifest = ParseManifest(*bytes, path);
    if (!manifest.ok()) return manifest.error();
    list.rate = manifest->rate;
    for (const auto& [number, frame] : manifest->frames)
      list.files.push_back(folder + "/" + frame.file);
  } else {
    Result<std::vector<std::string>> files = ListPictures(folder);
    if (!files.ok()) return files.error();
    list.files = std::move(files).value();
    std::erase_if(list.files, [&](const std::string& file) {
      std::error_code ignored;
      return std::filesystem::equivalent(file, leave_out, ignored);
    });
  }
  if (list.files.empty()) {
    return Invalid("there are no frames in this folder; render or fetch some first",
                   {folder, 0, 0});
  }
  return list;
}

}  // namespace fjord
