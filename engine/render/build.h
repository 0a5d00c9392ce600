// From a frame scene to plain values: the one place of the renderer that reads messages (beside
// DescribeFrame). Thread-safe.
#pragma once

#include "engine/asset/asset.h"
#include "engine/base/result.h"
#include "engine/render/built_frame.h"
#include "engine/render/prepared_cache.h"
#include "fjord/v1/frame.pb.h"

namespace fjord {

// Checks what the renderer relies on (sizes, counts, finite numbers) and prepares every object that
// the cache does not hold. `assets`: the lists that the frame names; null where it names none.
Result<BuiltFrame> BuildFrame(const v1::FrameScene& frame, const AssetResolver* assets = nullptr,
                              PreparedCache& cache = PreparedCache::Shared());

// The object's shape made ready again with its fineness `coarser` times as coarse, for quick looks.
Result<std::shared_ptr<const PreparedFractal>> PrepareObject(const BuiltObject& object,
                                                             double coarser);

}  // namespace fjord
