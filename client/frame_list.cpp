#include "client/frame_list.h"

#include <algorithm>
#include <filesystem>
#include <optional>

#include "client/console.h"
#include "client/files.h"
#include "client/manifest.h"
#include "client/picture_sequence.h"
#include "engine/image/codec.h"

namespace fjord {
namespace {

namespace fs = std::filesystem;

constexpr size_t kMostNamed = 8;  // spans of missing frames

Error NoFrames(const std::string& folder) {
  return Invalid("there are no frames in this folder; render or fetch some first", {folder, 0, 0});
}

// An error, or a note where the caller does without.
Result<> Object(bool allowed, const std::string& folder, const std::string& what,
                const std::string& remedy) {
  if (!allowed) return Invalid(what + "; " + remedy, {folder, 0, 0});
  console::Note(folder + ": note: " + what);
  return Ok{};
}

Result<FrameList> FramesOfManifest(const std::string& folder, const Manifest& manifest,
                                   const FrameChoice& choice) {
  FrameList list;
  list.rate = manifest.rate;
  if (manifest.frames.empty()) return NoFrames(folder);
  FrameSet wanted = choice.frames;
  if (wanted.empty()) {
    const uint32_t last = std::max(manifest.frames_total, manifest.frames.rbegin()->first);
    wanted = FrameSet(1, last);
  }
  std::vector<uint32_t> missing;
  for (uint32_t index = 0; index < wanted.size(); ++index) {
    const auto frame = manifest.frames.find(wanted[index]);
    std::error_code error;
    if (frame == manifest.frames.end() || !fs::exists(folder + "/" + frame->second.file, error)) {
      missing.push_back(wanted[index]);
      continue;
    }
    list.frames.push_back({folder + "/" + frame->second.file, frame->second.pixel_digest});
  }
  if (choice.allow_mixed) {
    for (ListedFrame& frame : list.frames) frame.pixel_digest.clear();
  }
  if (!missing.empty()) {
    const Result<> said = Object(
        choice.allow_missing, folder, MissingText(FrameSet::Of(missing), manifest.frames_total),
        "render or fetch what is missing, name those that you want with --frames, or go "
        "without with --allow-missing");
    if (!said.ok()) return said.error();
  }
  if (list.frames.empty()) return NoFrames(folder);
  return list;
}

// The sequence that is meant: the only one, or all of them one after the other.
Result<FrameList> FramesOfPictures(const std::string& folder, std::vector<std::string> files,
                                   const FrameChoice& choice) {
  const std::vector<PictureSequence> sequences = SequencesOf(std::move(files));
  if (sequences.empty()) return NoFrames(folder);
  if (sequences.size() > 1) {
    std::string names;
    for (size_t i = 0; i < sequences.size() && i < kMostNamed; ++i) {
      names += (i == 0 ? "" : ", ") + sequences[i].Describe();
    }
    if (sequences.size() > kMostNamed) names += " ...";
    const Result<> said = Object(
        choice.allow_mixed, folder, "these are pictures of more than one sequence: " + names,
        "keep one sequence in a folder, or take all, one after the other, with --allow-mixed");
    if (!said.ok()) return said.error();
  }
  FrameList list;
  for (const PictureSequence& sequence : sequences) {
    if (const std::string twice = sequence.Doubled(); !twice.empty()) {
      const Result<> said = Object(choice.allow_mixed, folder, twice,
                                   "remove one of them, or take both with --allow-mixed");
      if (!said.ok()) return said.error();
    }
    const std::string missing = sequence.Missing(choice.frames, kMostNamed);
    if (!missing.empty()) {
      const Result<> said = Object(choice.allow_missing, folder, missing,
                                   "bring what is missing, or go without with --allow-missing");
      if (!said.ok()) return said.error();
    }
    for (const std::string& file : sequence.Files(choice.frames)) list.frames.push_back({file, {}});
  }
  if (list.frames.empty()) return NoFrames(folder);
  return list;
}

}  // namespace

std::string MissingText(const FrameSet& missing, uint32_t total) {
  return (missing.size() == 1 ? "frame " : "frames ") + missing.ToString(kMostNamed) +
         (total == 0 ? "" : " of " + std::to_string(total)) +
         (missing.size() == 1 ? " is missing" : " are missing");
}

Result<FrameList> FramesOf(const std::string& folder, const FrameChoice& choice,
                           const std::string& leave_out) {
  const std::string path = folder + "/" + kManifestName;
  std::error_code error;
  if (fs::exists(path, error)) {
    const Result<std::string> bytes = ReadFile(path);
    if (!bytes.ok()) return bytes.error();
    const Result<Manifest> manifest = ParseManifest(*bytes, path);
    if (!manifest.ok()) return manifest.error();
    return FramesOfManifest(folder, *manifest, choice);
  }
  Result<std::vector<std::string>> files = ListPictures(folder);
  if (!files.ok()) return files.error();
  std::erase_if(*files, [&](const std::string& file) {
    std::error_code ignored;
    return fs::equivalent(file, leave_out, ignored);
  });
  return FramesOfPictures(folder, std::move(files).value(), choice);
}

Result<Picture> ReadFrame(const ListedFrame& frame) {
  const Result<std::string> bytes = ReadFile(frame.file);
  if (!bytes.ok()) return bytes.error();
  Result<Picture> picture = DecodePicture(*bytes, frame.file);
  if (!picture.ok()) return picture;
  if (!frame.pixel_digest.empty() && PixelDigest(*picture).Hex() != frame.pixel_digest) {
    return Invalid(
        "this is not the picture that manifest.json names: another program or another scene wrote "
        "it; render or fetch it again, or take it as it is with --allow-mixed",
        {frame.file, 0, 0});
  }
  return picture;
}

}  // namespace fjord
