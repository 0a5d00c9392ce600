// Fuzz targets as plain functions. libFuzzer calls them (FJORD_FUZZ, one program each), and the
// ordinary tests replay their seed corpora and seeded mutations of them (replay_test.cpp), so every
// run of the tests runs every harness.
//
// A target takes any bytes; it aborts through FJORD_CHECK or a sanitizer where a promise is broken,
// and never keeps state between calls.
#pragma once

#include <span>
#include <string_view>

namespace fjord::fuzz {

struct Target {
  const char* name;  // also its folder in tests/fuzz/corpus
  void (*run)(std::string_view bytes);
};

std::span<const Target> Targets();

// Keeps libraries from writing a line for every broken message. Call once, first.
void Prepare();

// The targets, a file each.
void RunShape(std::string_view bytes);        // engine/formats: every reader, then every writer
void RunPar(std::string_view bytes);          // engine/formats: .par
void RunSceneText(std::string_view bytes);    // engine/scene: text format or JSON
void RunSceneBinary(std::string_view bytes);  // engine/scene: the wire form
void RunPicture(std::string_view bytes);      // engine/image: PNG and EXR
void RunWire(std::string_view bytes);         // server: every request message, then its validation

}  // namespace fjord::fuzz
