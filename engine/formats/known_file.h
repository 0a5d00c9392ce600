// What a file is, told by its content whatever its name, for people who give one where another is
// wanted. Only files that could not be read are asked about: a guess never stands in the way.
#pragma once

#include <string>
#include <string_view>

namespace fjord {

// "this is an STL mesh, not a scene: save it as .obj or .ply, and ..."; empty where the bytes are
// nothing that is known. `name` is the file's.
std::string WhyNotScene(std::string_view bytes, const std::string& name);
// The same of a file that is to be a shape. Nothing of those that ReadShape reads.
std::string WhyNotShape(std::string_view bytes);

// Values of "type" by which map programs mark their JSON.
bool IsGeoJsonType(std::string_view type);

}  // namespace fjord
