// The options of commands that make something of a folder of frames.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "client/commands/common.h"
#include "client/frame_list.h"

namespace fjord {

struct FrameChoiceOptions {
  std::string frames;
  bool allow_missing = false;
  bool allow_mixed = false;

  Result<FrameChoice> Read() const {
    Result<FrameSet> chosen = ParseFrames(frames);
    if (!chosen.ok()) return chosen.error();
    return FrameChoice{std::move(chosen).value(), allow_missing, allow_mixed};
  }
};

inline void AddFrameChoice(CLI::App* command, FrameChoiceOptions* options) {
  AddFrames(command, &options->frames);
  command->add_flag("--allow-missing", options->allow_missing,
                    "Go without frames that are not there");
  command->add_flag("--allow-mixed", options->allow_mixed,
                    "Take pictures of several sequences, scenes or sizes as they are");
}

}  // namespace fjord
