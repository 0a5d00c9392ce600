// A folder that frames are written into, by `render` and by `fetch`: frames and manifest appear
// whole or not at all, and what a run before has left is recognised by frame key and pixel digest.
//
// I1 A frame is named in manifest.json only after its file is there, complete.
// I2 One process at a time: the folder is locked while this lives.
// Thread-safe.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <string>

#include "client/files.h"
#include "client/manifest.h"
#include "engine/base/frame_set.h"

namespace fjord {

class FrameFolder {
 public:
  struct Order {
    std::string folder;
    Manifest head;       // what is being made
    std::string ending;  // of the frames' files
    bool replace = false;
    // The key that a frame has now; empty: it has none. Asked about frames of another version.
    std::function<Result<std::string>(uint32_t frame)> key_of;
  };
  // Frames of an earlier manifest are taken over where they are what would be made now. kInvalid
  // where the folder holds frames of a scene of another name, or, unless `replace`, of another
  // version of this scene, or pictures that no manifest names.
  static Result<std::unique_ptr<FrameFolder>> Open(Order order);

  // Is this frame there, made under this key, its file's pixels those of the manifest?
  // `pixel_digest` asks for more: it must be these pixels (empty: any).
  bool Has(uint32_t frame, const std::string& frame_key, const std::string& pixel_digest = {});

  // Writes the file, then the manifest (at most a few times a second).
  Result<> Add(uint32_t frame, ManifestFrame entry, std::string_view bytes);

  // Brings the manifest up to date.
  Result<> Flush();

  std::string FileName(uint32_t frame) const;
  const std::string& folder() const { return folder_; }

 private:
  FrameFolder(std::string folder, FolderLock lock, Manifest manifest, std::string ending);
  Result<> TakeOver(const Order& order);
  Result<> TakeOverVersion(const Order& order, const Manifest& earlier);
  FrameSet PicturesHere() const;
  Result<> WriteManifest();  // with mutex_ held

  const std::string folder_;
  const FolderLock lock_;
  const std::string ending_;
  std::mutex mutex_;
  // Guarded by mutex_.
  Manifest manifest_;
  bool stale_ = true;
  std::chrono::steady_clock::time_point written_;
};

}  // namespace fjord
