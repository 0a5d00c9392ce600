// A first scene for a shape that someone has: what `fjord import FILE.std [FILE.par] -o FILE.scene`
// writes.
#pragma once

#include <string>

#include "engine/base/result.h"
#include "engine/formats/par_file.h"
#include "engine/formats/shape_file.h"

namespace fjord {

// A scene in text form that names the file (`shape_path` as it shall stand there, relative to the
// scene), with method, camera and light after the shape and the numbers of `par` (may be null;
// `par_path` then is not used) as fractal knobs; comment lines say where each came from and what
// CheckMesh found. It renders as it is. kInvalid for a shape that has no extent and for a path with
// control characters.
Result<std::string> SceneTextFromShape(const ShapeFile& shape, const std::string& shape_path,
                                       const ParFile* par, const std::string& par_path);

}  // namespace fjord
