// The header of a .ply file as plain values.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"

namespace fjord::formats {

enum class PlyType : uint8_t { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat, kDouble };

size_t PlyTypeBytes(PlyType type);

struct PlyProperty {
  std::string name;
  bool list = false;
  PlyType count = PlyType::kUint8;  // of a list
  PlyType type = PlyType::kFloat;
};

struct PlyElement {
  std::string name;
  uint64_t count = 0;
  std::vector<PlyProperty> properties;
  int line = 0;
};

enum class PlyEncoding { kAscii, kLittle, kBig };

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::kAscii;
  std::vector<PlyElement> elements;
  size_t bytes = 0;  // where the body starts
  int lines = 0;
};

Result<PlyHeader> ReadPlyHeader(std::string_view bytes, const std::string& name);

}  // namespace fjord::formats
