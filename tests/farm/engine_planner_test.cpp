// The planner's engine: what it refuses before anyone renders it.
#include "server/engine_planner.h"

#include <gtest/gtest.h>

#include "engine/animation/estimate.h"
#include "engine/scene/load.h"
#include "server/rpc_status.h"
#include "temp_dir.h"

namespace fjord::server {
namespace {

using farm_test::TempDir;

class EnginePlannerTest : public testing::Test {
 protected:
  // Puts the scene into the store, as a client would.
  Digest Put(const std::string& text) {
    const LoadResult loaded = LoadSceneText(text, "s.scene", {});
    EXPECT_TRUE(loaded.ok());
    const std::string bytes = SerializeScene(loaded.loaded.scene);
    const Digest digest = Sha256Of(bytes);
    EXPECT_TRUE(blobs_->Put(digest, bytes).ok());
    return digest;
  }

  TempDir dir_;
  Result<std::unique_ptr<BlobStore>> opened_ = BlobStore::Open(dir_.path(), 1u << 30);
  BlobStore* blobs_ = opened_->get();
};

constexpr char kHuge[] =
    "output { frames: 3 }\nobjects { name: \"a\" shape { primitive { kind: GRID } } fractal { "
    "epsilon: 1e-9 max_level: 40 } }\n";

TEST_F(EnginePlannerTest, FramesOverTheFarmsBudgetFailBeforeAnyoneRendersThem) {
  const Digest scene = Put(kHuge);
  EnginePlanner planner(*blobs_, kFrameBudget);
  EXPECT_EQ(planner.LastFrame(scene).value(), 3u);
  const auto key = planner.KeyOf(scene, 2);
  ASSERT_FALSE(key.ok());
  EXPECT_EQ(key.error().code, ErrorCode::kLimit);
  EXPECT_NE(key.error().message.find("objects[a]: epsilon 1e-09 would make about"),
            std::string::npos)
      << key.error().message;
  EXPECT_NE(key.error().message.find("the coordinator's --budget lifts it"), std::string::npos);
  EnginePlanner unlimited(*blobs_, kNoBudget);
  EXPECT_TRUE(unlimited.KeyOf(scene, 2).ok());
}

TEST_F(EnginePlannerTest, AStoppedPlannerPreparesNothingMore) {
  const Digest scene = Put(kHuge);
  EnginePlanner planner(*blobs_, kFrameBudget);
  planner.Stop();
  const auto last = planner.LastFrame(scene);
  ASSERT_FALSE(last.ok());
  EXPECT_EQ(last.error().code, ErrorCode::kCancelled);
}

}  // namespace
}  // namespace fjord::server
