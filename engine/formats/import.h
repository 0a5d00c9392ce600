// A first scene for a shape that someone has: what `fjord import FILE.std [FILE.par] -o FILE.scene`
// writes.
#pragma once

#include <optional>
#include <string>

#include "engine/base/result.h"
#include "engine/formats/par_file.h"
#include "engine/formats/shape_file.h"
#include "engine/geometry/up_axis.h"

namespace fjord {

struct ImportOptions {
  UpAxis up = UpAxis::kZ;  // of the file; it becomes z
  // Longest edge of the coarse shape; 0: as it is. Left out: where edges or triangles are so uneven
  // that one shape has two looks, a length that mends it; none where a .par file is given, whose
  // numbers are for the shape as it is.
  std::optional<double> spacing;
};

// A scene in text form that names the file (`shape_path` as it shall stand there, relative to the
// scene), with method, camera and light after the shape and the numbers of `par` (may be null;
// `par_path` then is not used) as fractal knobs; comment lines say where each came from and what
// CheckMesh found. It renders as it is. kInvalid for a shape that has no extent and for a path with
// control characters.
Result<std::string> SceneTextFromShape(const ShapeFile& shape, const std::string& shape_path,
                                       const ParFile* par, const std::string& par_path,
                                       const ImportOptions& options = {});

// Is it thin along y and not along z, so that y may be up in its file?
bool LooksTurned(const ShapeFile& shape);

}  // namespace fjord
