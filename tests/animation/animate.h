// Making animations from text in tests.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "engine/animation/frame_key.h"
#include "engine/animation/inbetween.h"
#include "tests/scene/load_text.h"

namespace fjord::testing {

inline std::shared_ptr<const Animation> Animate(const std::string& text,
                                                const std::vector<Setting>& settings = {},
                                                const Files& files = {}) {
  LoadResult loaded = Load(text, settings, files);
  EXPECT_TRUE(loaded.ok()) << ErrorsOf(loaded);
  Result<std::shared_ptr<const Animation>> animation = Animation::Make(std::move(loaded.loaded));
  EXPECT_TRUE(animation.ok()) << (animation.ok() ? "" : animation.error().ToString());
  return animation.ok() ? *animation : nullptr;
}

inline v1::FrameScene FrameOf(const Animation& animation, uint32_t frame,
                              AssetSet* assets = nullptr) {
  Result<v1::FrameScene> scene = animation.Inbetween(frame, assets);
  EXPECT_TRUE(scene.ok()) << (scene.ok() ? "" : scene.error().ToString());
  return scene.ok() ? *scene : v1::FrameScene();
}

inline std::string KeyOf(const Animation& animation, uint32_t frame) {
  return FrameKey(FrameOf(animation, frame))->Hex();
}

// x y z of point n (from 1) of object o (from 1).
inline Vec3 PointOf(const v1::FrameScene& frame, int o, int n) {
  const auto& values = frame.object(o - 1).point();
  return {values[3 * n - 3], values[3 * n - 2], values[3 * n - 1]};
}

}  // namespace fjord::testing
