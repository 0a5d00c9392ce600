#include "engine/animation/walk.h"

#include <google/protobuf/descriptor.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

namespace fjord {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using google::protobuf::Reflection;

void PutBigEndian(uint64_t value, char* place) {
  for (int i = 0; i < 8; ++i) place[i] = static_cast<char>(value >> (56 - 8 * i));
}

uint64_t BitsOf(double value) { return value == 0 ? 0 : std::bit_cast<uint64_t>(value); }

Error NotANumber(const FieldDescriptor& field) {
  return Invalid("field " + field.full_name() + " is NaN, which has no frame key");
}

void AppendHead(const FieldDescriptor& field, char type, std::string& bytes) {
  const auto number = static_cast<uint32_t>(field.number());
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(number >> shift);
  bytes += type;
}

void AppendText(const std::string& text, std::string& bytes) {
  AppendBigEndian(text.size(), bytes);
  bytes += text;
}

// The length goes in front, so its place is kept free and filled in afterwards.
Result<> AppendNested(const Message& message, std::string& bytes) {
  const size_t start = bytes.size();
  bytes.resize(start + 8);
  if (Result<> walked = AppendWalk(message, bytes); !walked) return walked;
  PutBigEndian(bytes.size() - start - 8, bytes.data() + start);
  return {};
}

// The whole list at once; its replacement, GetRepeatedFieldRef, costs a virtual call an element.
const google::protobuf::RepeatedField<double>& Doubles(const Message& message,
                                                       const Reflection& reflection,
                                                       const FieldDescriptor& field) {
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wdeprecated-declarations"
  return reflection.GetRepeatedField<double>(message, &field);
#pragma GCC diagnostic pop
}

// Meshes are long lists of doubles: one growth, no call an element.
Result<> AppendDoubles(const google::protobuf::RepeatedField<double>& values,
                       const FieldDescriptor& field, std::string& bytes) {
  size_t at = bytes.size();
  bytes.resize(at + 8 * static_cast<size_t>(values.size()));
  for (const double value : values) {
    if (value != value) return NotANumber(field);
    PutBigEndian(BitsOf(value), bytes.data() + at);
    at += 8;
  }
  return {};
}

Result<> AppendRepeated(const Message& message, const Reflection& reflection,
                        const FieldDescriptor& field, std::string& bytes) {
  const int count = reflection.FieldSize(message, &field);
  if (count == 0) return {};
  const auto begin = [&](char type) {
    AppendHead(field, type, bytes);
    AppendBigEndian(static_cast<uint64_t>(count), bytes);
  };
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_DOUBLE:
      begin('D');
      return AppendDoubles(Doubles(message, reflection, field), field, bytes);
    case FieldDescriptor::CPPTYPE_UINT32:
      begin('U');
      for (int i = 0; i < count; ++i) {
        AppendBigEndian(reflection.GetRepeatedUInt32(message, &field, i), bytes);
      }
      return {};
    case FieldDescriptor::CPPTYPE_UINT64:
      begin('U');
      for (int i = 0; i < count; ++i) {
        AppendBigEndian(reflection.GetRepeatedUInt64(message, &field, i), bytes);
      }
      return {};
    case FieldDescriptor::CPPTYPE_BOOL:
      begin('U');
      for (int i = 0; i < count; ++i) {
        AppendBigEndian(reflection.GetRepeatedBool(message, &field, i) ? 1 : 0, bytes);
      }
      return {};
    case FieldDescriptor::CPPTYPE_STRING: {
      begin('S');
      std::string scratch;
      for (int i = 0; i < count; ++i) {
        AppendText(reflection.GetRepeatedStringReference(message, &field, i, &scratch), bytes);
      }
      return {};
    }
    case FieldDescriptor::CPPTYPE_MESSAGE:
      begin('M');
      for (int i = 0; i < count; ++i) {
        Result<> nested = AppendNested(reflection.GetRepeatedMessage(message, &field, i), bytes);
        if (!nested) return nested;
      }
      return {};
    default:
      return Invalid("field " + field.full_name() +
                     " has a type that the frame key has no form for");
  }
}

Result<> AppendSingle(const Message& message, const Reflection& reflection,
                      const FieldDescriptor& field, std::string& bytes) {
  const auto whole = [&](uint64_t value) {
    if (value == 0) return;
    AppendHead(field, 'u', bytes);
    AppendBigEndian(value, bytes);
  };
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_DOUBLE: {
      const double value = reflection.GetDouble(message, &field);
      if (value != value) return NotANumber(field);
      if (value == 0) return {};
      AppendHead(field, 'd', bytes);
      AppendBigEndian(BitsOf(value), bytes);
      return {};
    }
    case FieldDescriptor::CPPTYPE_UINT32:
      whole(reflection.GetUInt32(message, &field));
      return {};
    case FieldDescriptor::CPPTYPE_UINT64:
      whole(reflection.GetUInt64(message, &field));
      return {};
    case FieldDescriptor::CPPTYPE_BOOL:
      whole(reflection.GetBool(message, &field) ? 1 : 0);
      return {};
    case FieldDescriptor::CPPTYPE_STRING: {
      std::string scratch;
      const std::string& text = reflection.GetStringReference(message, &field, &scratch);
      if (text.empty()) return {};
      AppendHead(field, 's', bytes);
      AppendText(text, bytes);
      return {};
    }
    case FieldDescriptor::CPPTYPE_MESSAGE: {
      if (!reflection.HasField(message, &field)) return {};
      const size_t start = bytes.size();
      AppendHead(field, 'm', bytes);
      const size_t body = bytes.size() + 8;
      Result<> nested = AppendNested(reflection.GetMessage(message, &field), bytes);
      if (bytes.size() == body) bytes.resize(start);  // all default: as if absent
      return nested;
    }
    default:
      return Invalid("field " + field.full_name() +
                     " has a type that the frame key has no form for");
  }
}

}  // namespace

void AppendBigEndian(uint64_t value, std::string& bytes) {
  bytes.resize(bytes.size() + 8);
  PutBigEndian(value, bytes.data() + bytes.size() - 8);
}

Result<> AppendWalk(const Message& message, std::string& bytes) {
  const google::protobuf::Descriptor& type = *message.GetDescriptor();
  const Reflection& reflection = *message.GetReflection();
  if (!reflection.GetUnknownFields(message).empty()) {
    return Invalid("message " + type.full_name() +
                   " has fields this version does not know; it was made by a newer Fjord");
  }
  std::vector<const FieldDescriptor*> fields;
  fields.reserve(static_cast<size_t>(type.field_count()));
  for (int i = 0; i < type.field_count(); ++i) fields.push_back(type.field(i));
  std::sort(fields.begin(), fields.end(),
            [](const auto* a, const auto* b) { return a->number() < b->number(); });
  for (const FieldDescriptor* field : fields) {
    Result<> walked = field->is_repeated() ? AppendRepeated(message, reflection, *field, bytes)
                                           : AppendSingle(message, reflection, *field, bytes);
    if (!walked) return walked;
  }
  return {};
}

}  // namespace fjord
