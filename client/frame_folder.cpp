#include "client/frame_folder.h"

#include <utility>

#include "client/console.h"
#include "engine/image/codec.h"
#include "engine/image/picture.h"

namespace fjord {
namespace {

constexpr std::chrono::milliseconds kManifestInterval{200};

bool FileHasPixels(const std::string& path, const std::string& pixel_digest) {
  const Result<std::string> bytes = ReadFile(path);
  if (!bytes.ok()) return false;
  const Result<Picture> picture = DecodePicture(*bytes, path);
  return picture.ok() && PixelDigest(*picture).Hex() == pixel_digest;
}

}  // namespace

FrameFolder::FrameFolder(std::string folder, FolderLock lock, Manifest manifest, std::string ending)
    : folder_(std::move(folder)),
      lock_(std::move(lock)),
      ending_(std::move(ending)),
      manifest_(std::move(manifest)) {}

Result<std::unique_ptr<FrameFolder>> FrameFolder::Open(const std::string& folder, Manifest head,
                                                       std::string ending) {
  if (const Result<> made = MakeFolder(folder); !made.ok()) return made.error();
  Result<FolderLock> lock = FolderLock::Take(folder);
  if (!lock.ok()) return lock.error();
  std::unique_ptr<FrameFolder> opened(
      new FrameFolder(folder, std::move(lock).value(), std::move(head), std::move(ending)));
  const std::string path = folder + "/" + kManifestName;
  if (const Result<std::string> bytes = ReadFile(path); bytes.ok()) {
    Result<Manifest> earlier = ParseManifest(*bytes, path);
    if (!earlier.ok()) {
      console::Note(path + ": note: cannot be read and is written anew");
    } else if (earlier->scene_digest == opened->manifest_.scene_digest) {
      opened->manifest_.frames = std::move(earlier->frames);
    } else if (earlier->name != opened->manifest_.name && !earlier->frames.empty()) {
      return MakeError(ErrorCode::kInvalid,
                       "the folder holds frames of another scene, " + earlier->name +
                           "; name another folder with -o, or remove " + path,
                       {folder, 0, 0});
    } else {
      opened->earlier_ = std::move(earlier).value();
    }
  }
  return opened;
}

std::string FrameFolder::FileName(uint32_t frame) const {
  return FrameFileName(manifest_.name, frame, ending_);
}

bool FrameFolder::Has(uint32_t frame, const std::string& frame_key,
                      const std::string& pixel_digest) {
  ManifestFrame known;
  {
    const std::lock_guard lock(mutex_);
    for (const Manifest* manifest : {&manifest_, &earlier_}) {
      if (const auto it = manifest->frames.find(frame); it != manifest->frames.end()) {
        known = it->second;
        break;
      }
    }
  }
  if (known.file != FileName(frame) || known.frame_key != frame_key) return false;
  if (!pixel_digest.empty() && known.pixel_digest != pixel_digest) return false;
  if (!FileHasPixels(folder_ + "/" + known.file, known.pixel_digest)) return false;
  const std::lock_guard lock(mutex_);
  manifest_.frames[frame] = std::move(known);
  stale_ = true;
  return true;
}

Result<> FrameFolder::Add(uint32_t frame, ManifestFrame entry, std::string_view bytes) {
  entry.file = FileName(frame);
  if (Result<> written = WriteFileAtomically(folder_ + "/" + entry.file, bytes); !written.ok())
    return written.error();
  const std::lock_guard lock(mutex_);
  manifest_.frames[frame] = std::move(entry);
  stale_ = true;
  if (std::chrono::steady_clock::now() - written_ < kManifestInterval) return Ok{};
  return WriteManifest();
}

Result<> FrameFolder::Flush() {
  const std::lock_guard lock(mutex_);
  return stale_ ? WriteManifest() : Result<>(Ok{});
}

Result<> FrameFolder::WriteManifest() {
  Result<> written = WriteFileAtomically(folder_ + "/" + kManifestName, ManifestText(manifest_));
  if (written.ok()) {
    stale_ = false;
    written_ = std::chrono::steady_clock::now();
  }
  return written;
}

}  // namespace fjord
