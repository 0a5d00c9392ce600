// Jobs and workers as text and JSON, the same in every command.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "fjord/v1/jobs.pb.h"

namespace fjord {

const char* JobStateName(v1::JobState state);              // "running"
const char* FrameStateName(v1::FrameState state);          // "waiting"
const char* WorkerStateName(v1::WorkerInfo::State state);  // "alive"

bool HasEnded(v1::JobState state);
// Exit code of waiting for it: 0 for done.
int ExitCodeOfJob(v1::JobState state);

std::string FramesText(const v1::Job& job);  // "1-10,12,20-40x2"

// The documented form of `status --json`.
nlohmann::ordered_json JobJson(const v1::Job& job);
// trouble: of the whole farm.
nlohmann::ordered_json WorkerJson(const v1::WorkerInfo& worker, const std::string& trouble = {});

// Printable, and padded to so many characters.
std::string Column(const std::string& text, size_t width);

// "37 of 96 frames, 5 cached, 2 running, 1 failed".
std::string CountsText(const v1::FrameCounts& frames);

}  // namespace fjord
