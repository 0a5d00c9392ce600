#include "client/frame_folder.h"

#include <filesystem>
#include <utility>
#include <vector>

#include "client/console.h"
#include "engine/image/codec.h"
#include "engine/image/picture.h"

namespace fjord {
namespace {

constexpr std::chrono::milliseconds kManifestInterval{200};
constexpr size_t kMostNamed = 8;  // spans of frames

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

Result<std::unique_ptr<FrameFolder>> FrameFolder::Open(Order order) {
  if (const Result<> made = MakeFolder(order.folder); !made.ok()) return made.error();
  Result<FolderLock> lock = FolderLock::Take(order.folder);
  if (!lock.ok()) return lock.error();
  std::unique_ptr<FrameFolder> opened(
      new FrameFolder(order.folder, std::move(lock).value(), order.head, order.ending));
  if (const Result<> taken = opened->TakeOver(order); !taken.ok()) return taken.error();
  // At once, so that pictures of a run that is killed are known as its own.
  if (const Result<> written = opened->WriteManifest(); !written.ok()) return written.error();
  return opened;
}

Result<> FrameFolder::TakeOver(const Order& order) {
  const Place place{folder_, 0, 0};
  const std::string path = folder_ + "/" + kManifestName;
  const Result<std::string> bytes = ReadFile(path);
  Result<Manifest> earlier =
      bytes.ok() ? ParseManifest(*bytes, path) : Result<Manifest>(bytes.error());
  if (!earlier.ok()) {
    if (bytes.ok()) console::Note(path + ": note: cannot be read and is written anew");
    const FrameSet pictures = PicturesHere();
    if (pictures.empty() || order.replace) return Ok{};
    return Invalid("the folder holds pictures of this name, " + pictures.ToString(kMostNamed) +
                       ", and no manifest.json says what they show; name another folder with -o, "
                       "or write over them with --replace",
                   place);
  }
  if (earlier->scene_digest == manifest_.scene_digest) {
    manifest_.frames = std::move(earlier->frames);
    return Ok{};
  }
  if (earlier->name != manifest_.name && !earlier->frames.empty()) {
    return Invalid("the folder holds frames of another scene, " + earlier->name +
                       "; name another folder with -o, or remove " + path,
                   place);
  }
  return TakeOverVersion(order, *earlier);
}

// A frame that the scene's change has left as it was keeps its key.
Result<> FrameFolder::TakeOverVersion(const Order& order, const Manifest& earlier) {
  std::vector<uint32_t> changed;
  for (const auto& [number, frame] : earlier.frames) {
    const Result<std::string> key = order.key_of(number);
    if (!key.ok()) return key.error();
    if (*key == frame.frame_key && frame.file == FileName(number)) {
      manifest_.frames[number] = frame;
    } else {
      changed.push_back(number);
    }
  }
  if (changed.empty()) return Ok{};
  const FrameSet older = FrameSet::Of(changed);
  const std::string which = (older.size() == 1 ? "frame " : "frames ") +
                            older.ToString(kMostNamed) + " of an older version of the scene";
  if (!order.replace) {
    return Invalid("the folder holds " + which +
                       "; name another folder with -o, or make them again with --replace (what "
                       "has not changed is kept)",
                   {folder_, 0, 0});
  }
  console::Note(folder_ + ": note: " + which + (older.size() == 1 ? " is" : " are") +
                " replaced; until then manifest.json "
                "does not name " +
                (older.size() == 1 ? "it" : "them"));
  return Ok{};
}

FrameSet FrameFolder::PicturesHere() const {
  const std::string head = manifest_.name + ".";
  const std::string tail = "." + ending_;
  std::vector<uint32_t> numbers;
  std::error_code error;
  for (std::filesystem::directory_iterator it(folder_, error), end; !error && it != end;
       it.increment(error)) {
    const std::string name = it->path().filename().string();
    if (!name.starts_with(head) || !name.ends_with(tail) ||
        name.size() <= head.size() + tail.size())
      continue;
    const std::string digits = name.substr(head.size(), name.size() - head.size() - tail.size());
    if (digits.size() > 7 || digits.find_first_not_of("0123456789") != std::string::npos) continue;
    const auto number = static_cast<uint32_t>(std::stoul(digits));
    if (number >= 1 && number <= FrameSet::kMostNumber) numbers.push_back(number);
  }
  return FrameSet::Of(numbers);
}

std::string FrameFolder::FileName(uint32_t frame) const {
  return FrameFileName(manifest_.name, frame, ending_);
}

bool FrameFolder::Has(uint32_t frame, const std::string& frame_key,
                      const std::string& pixel_digest) {
  ManifestFrame known;
  {
    const std::lock_guard lock(mutex_);
    const auto it = manifest_.frames.find(frame);
    if (it != manifest_.frames.end()) known = it->second;
  }
  if (known.file != FileName(frame) || known.frame_key != frame_key) return false;
  if (!pixel_digest.empty() && known.pixel_digest != pixel_digest) return false;
  if (!FileHasPixels(folder_ + "/" + known.file, known.pixel_digest)) return false;
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
