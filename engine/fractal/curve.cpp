#include "engine/fractal/curve.h"

namespace fjord {

Result<std::unique_ptr<PreparedFractal>> PrepareCurve(CoarseShape, const FractalSettings&,
                                                      const AdaptiveView*) {
  return MakeError(ErrorCode::kInternal, "curve is not built in");
}

}  // namespace fjord
