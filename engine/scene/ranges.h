// The range of every plain number of a scene, whatever object it belongs to. What an
// entry of a registry allows for its knobs is in its table.
#pragma once

#include <google/protobuf/descriptor.h>

#include "engine/knobs/range.h"

namespace fjord {

// For a Vec3 field: of each of its numbers. Null: any number up to limits::kLargest.
const NumberRange* RangeOf(const google::protobuf::FieldDescriptor& field);

}  // namespace fjord
