#include "engine/fractal/coast.h"

namespace fjord {

Result<std::unique_ptr<PreparedFractal>> PrepareCoast(CoarseShape, const FractalSettings&,
                                                      const AdaptiveView*) {
  return MakeError(ErrorCode::kInternal, "coast is not built in");
}

}  // namespace fjord
