// Fjord's own walk over a Protobuf message: the bytes that a frame key digests (docs/frame_key.md).
// Independent of Protobuf's wire format, of field declaration order and of machine byte order.
#pragma once

#include <google/protobuf/message.h>

#include <string>

#include "engine/base/result.h"

namespace fjord {

// Appends the walk of `message` to `bytes`. A field at its default adds nothing, so a new field
// that is not set never changes the bytes. kInvalid, naming the field: NaN, or a field that this
// program does not know.
Result<> AppendWalk(const google::protobuf::Message& message, std::string& bytes);

// u64, high byte first.
void AppendBigEndian(uint64_t value, std::string& bytes);

}  // namespace fjord
