// The single readers and writers behind shape_file.h. Readers have checked nothing of their input
// but its size; writers get a shape that CheckWritable has passed.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/formats/shape_file.h"

namespace fjord::formats {

using Comment = std::vector<std::string>;

Result<ShapeFile> ReadStd(std::string_view bytes, const std::string& name);
std::string WriteStd(const ShapeFile& shape, const Comment& comment);

Result<ShapeFile> ReadObj(std::string_view bytes, const std::string& name);
std::string WriteObj(const ShapeFile& shape, const Comment& comment);

bool LooksLikePly(std::string_view bytes);
Result<ShapeFile> ReadPly(std::string_view bytes, const std::string& name);
std::string WritePly(const ShapeFile& shape, const Comment& comment);

Result<ShapeFile> ReadSvg(std::string_view bytes, const std::string& name);
std::string WriteSvg(const ShapeFile& shape, const Comment& comment);

// What a line says at its start, enough to tell the text formats apart.
bool IsStdDataLine(std::string_view line);  // "data" and a number

// kLimit errors that every reader gives in the same words.
Error TooManyVertices(Place place);
Error TooManyIndices(Place place);
Error LineTooLong(Place place);

}  // namespace fjord::formats
