// The range of every plain number of a scene, whatever object it belongs to. What a fractal method
// allows for its own knobs is in the method registry.
#pragma once

#include <google/protobuf/descriptor.h>

#include <string>

namespace fjord {

struct NumberRange {
  double lowest;
  double highest;
  bool above;  // lowest itself is not allowed

  bool Holds(double value) const;
  // "0 to 1", "above 0"
  std::string ToString() const;
};

// For a Vec3 field: of each of its numbers. Null: any number up to limits::kLargest.
const NumberRange* RangeOf(const google::protobuf::FieldDescriptor& field);

// "1.5", "1000000", "1e+12": the shortest form that reads back, without an exponent where that is
// easy to read.
std::string NumberText(double value);

}  // namespace fjord
