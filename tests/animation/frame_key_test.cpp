#include "engine/animation/frame_key.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/descriptor.pb.h>
#include <google/protobuf/dynamic_message.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "engine/animation/walk.h"
#include "engine/fractal/registry.h"

namespace fjord {
namespace {

using google::protobuf::FieldDescriptor;

// The bytes of hexadecimal digits; spaces are skipped.
std::string Bytes(const std::string& hex) {
  std::string bytes, digits;
  for (const char c : hex) {
    if (c == ' ') continue;
    digits += c;
    if (digits.size() == 2) {
      bytes += static_cast<char>(std::stoi(digits, nullptr, 16));
      digits.clear();
    }
  }
  return bytes;
}

const std::string kHead = "fjord-frame 1\ncore 2\n";

std::string KeyBytes(const v1::FrameScene& frame) {
  Result<std::string> bytes = FrameKeyBytes(frame);
  EXPECT_TRUE(bytes.ok()) << (bytes.ok() ? "" : bytes.error().ToString());
  return bytes.ok() ? *bytes : "";
}

v1::FrameScene SmallFrame() {
  v1::FrameScene frame;
  frame.mutable_output()->set_width(2);
  frame.add_ambient(.5);
  frame.add_ambient(0);
  return frame;
}

TEST(FrameKeyTest, EmptyFrameIsTheHeadAlone) { EXPECT_EQ(KeyBytes({}), kHead); }

TEST(FrameKeyTest, DocumentedExample) {
  EXPECT_EQ(KeyBytes(SmallFrame()), kHead + Bytes("00000001 6d 000000000000000d"
                                                  "00000001 75 0000000000000002"
                                                  "00000004 44 0000000000000002"
                                                  "3fe0000000000000 0000000000000000"));
}

TEST(FrameKeyTest, EveryTypeByHand) {
  v1::FrameScene frame;
  frame.mutable_camera()->set_orthographic(true);
  frame.mutable_camera()->set_fov(-2);
  v1::FrameObject* object = frame.add_object();
  object->add_face_size(3);
  object->add_face_vertex(0);
  object->add_face_vertex(258);
  object->add_point(1);
  object->set_closed(true);
  frame.add_object();  // counted though all default
  EXPECT_EQ(KeyBytes(frame), kHead + Bytes("00000002 6d 000000000000001a"
                                           "00000004 75 0000000000000001"
                                           "00000005 64 c000000000000000"
                                           "00000007 4d 0000000000000002"
                                           "0000000000000054"
                                           "00000001 44 0000000000000001 3ff0000000000000"
                                           "00000003 55 0000000000000001 0000000000000003"
                                           "00000004 55 0000000000000002"
                                           "0000000000000000 0000000000000102"
                                           "00000006 75 0000000000000001"
                                           "0000000000000000"));
}

TEST(FrameKeyTest, UsedMethodsAreInTheHeadOnceSorted) {
  v1::FrameScene frame;
  for (const char* name : {"surface", "curve", "surface"}) {
    frame.add_object()->mutable_fractal()->set_method(name);
  }
  const auto line = [](const char* name) {
    const MethodInfo* method = FindFractalMethod(name);
    return "fractal/" + std::string(name) + " " + std::to_string(method->version) + "\n";
  };
  const auto object = [](const std::string& hex_count, const std::string& name) {
    return Bytes("00000000000000" + hex_count) + Bytes("00000009 6d") + std::string(7, '\0') +
           static_cast<char>(13 + name.size()) + Bytes("00000001 73") + std::string(7, '\0') +
           static_cast<char>(name.size()) + name;
  };
  EXPECT_EQ(KeyBytes(frame), kHead + line("curve") + line("surface") +
                                 Bytes("00000007 4d 0000000000000003") + object("21", "surface") +
                                 object("1f", "curve") + object("21", "surface"));
}

TEST(FrameKeyTest, KnownAnswer) {
  // sha256sum of the bytes of docs/frame_key.md, worked out with another program
  EXPECT_EQ(FrameKey(SmallFrame())->Hex(),
            "f56b351a2cc3e70cbc85ecffa1f03c4548e84d6733529460fb38a57905986a47");
}

TEST(FrameKeyTest, ZerosOfBothSignsAndEmptyMessagesAreDefaults) {
  v1::FrameScene frame = SmallFrame();
  frame.mutable_camera()->set_fov(-0.0);
  frame.mutable_sea();
  frame.set_ambient(1, -0.0);
  EXPECT_EQ(KeyBytes(frame), KeyBytes(SmallFrame()));
}

TEST(FrameKeyTest, EveryBitCounts) {
  v1::FrameScene frame = SmallFrame();
  frame.set_ambient(0, std::nextafter(.5, 1));
  EXPECT_NE(*FrameKey(frame), *FrameKey(SmallFrame()));
}

TEST(FrameKeyTest, NanIsRefusedByName) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  v1::FrameScene single, repeated, nested;
  single.mutable_camera()->set_near(nan);
  repeated.add_background(nan);
  nested.add_object()->mutable_material()->add_ramp(nan);
  EXPECT_NE(FrameKey(single).error().message.find("FrameCamera.near"), std::string::npos);
  EXPECT_NE(FrameKey(repeated).error().message.find("FrameScene.background"), std::string::npos);
  EXPECT_EQ(FrameKey(nested).error().code, ErrorCode::kInvalid);
}

TEST(FrameKeyTest, UnknownMethodIsRefused) {
  v1::FrameScene frame;
  frame.add_object()->mutable_fractal()->set_method("no such");
  EXPECT_EQ(FrameKey(frame).error().code, ErrorCode::kInvalid);
}

TEST(FrameKeyTest, FieldsOfANewerVersionAreRefused) {
  v1::FrameScene frame = SmallFrame();
  frame.GetReflection()->MutableUnknownFields(&frame)->AddVarint(77, 1);
  EXPECT_EQ(FrameKey(frame).error().code, ErrorCode::kInvalid);
}

// The same messages from a schema that a later version has added a field of every kind to.
TEST(FrameKeyTest, UnsetNewFieldsNeverChangeAKey) {
  google::protobuf::FileDescriptorProto file;
  v1::FrameScene::descriptor()->file()->CopyTo(&file);
  for (auto& message : *file.mutable_message_type()) {
    const std::vector<google::protobuf::FieldDescriptorProto::Type> types = {
        google::protobuf::FieldDescriptorProto::TYPE_DOUBLE,
        google::protobuf::FieldDescriptorProto::TYPE_BOOL,
        google::protobuf::FieldDescriptorProto::TYPE_UINT64,
        google::protobuf::FieldDescriptorProto::TYPE_STRING,
        google::protobuf::FieldDescriptorProto::TYPE_MESSAGE};
    int number = 500;
    for (const auto type : types) {
      for (const bool repeated : {false, true}) {
        auto& field = *message.add_field();
        field.set_name("later" + std::to_string(number));
        field.set_number(number++);
        field.set_type(type);
        if (type == google::protobuf::FieldDescriptorProto::TYPE_MESSAGE) {
          field.set_type_name(".fjord.v1.FrameLight");
        }
        field.set_label(repeated ? google::protobuf::FieldDescriptorProto::LABEL_REPEATED
                                 : google::protobuf::FieldDescriptorProto::LABEL_OPTIONAL);
      }
    }
  }
  google::protobuf::DescriptorPool pool;
  google::protobuf::FileDescriptorProto parameter;
  v1::Parameter::descriptor()->file()->CopyTo(&parameter);
  ASSERT_NE(pool.BuildFile(parameter), nullptr);
  const auto* built = pool.BuildFile(file);
  ASSERT_NE(built, nullptr);
  google::protobuf::DynamicMessageFactory factory(&pool);
  std::unique_ptr<google::protobuf::Message> later(
      factory.GetPrototype(built->FindMessageTypeByName("FrameScene"))->New());

  v1::FrameScene frame = SmallFrame();
  frame.add_light()->add_color(.25);
  frame.mutable_sea()->set_level(3);
  frame.add_object()->add_point(7);
  ASSERT_TRUE(later->ParseFromString(frame.SerializeAsString()));
  std::string now_bytes, later_bytes;
  ASSERT_TRUE(AppendWalk(frame, now_bytes).ok());
  ASSERT_TRUE(AppendWalk(*later, later_bytes).ok());
  EXPECT_EQ(now_bytes, later_bytes);
}

// frame.proto's own rules, which the walk rests on.
TEST(FrameKeyTest, FrameSchemaHasNoPresenceButMessages) {
  for (const auto* file :
       {v1::FrameScene::descriptor()->file(), v1::Parameter::descriptor()->file()})
    for (int m = 0; m < file->message_type_count(); ++m) {
      for (int f = 0; f < file->message_type(m)->field_count(); ++f) {
        const FieldDescriptor* field = file->message_type(m)->field(f);
        EXPECT_EQ(field->containing_oneof(), nullptr) << field->full_name();
        EXPECT_FALSE(field->is_map()) << field->full_name();
        const auto type = field->cpp_type();
        EXPECT_TRUE(
            type == FieldDescriptor::CPPTYPE_DOUBLE || type == FieldDescriptor::CPPTYPE_BOOL ||
            type == FieldDescriptor::CPPTYPE_UINT32 || type == FieldDescriptor::CPPTYPE_UINT64 ||
            type == FieldDescriptor::CPPTYPE_STRING || type == FieldDescriptor::CPPTYPE_MESSAGE)
            << field->full_name();
      }
    }
}

TEST(FrameKeyTest, BigPackedListsAreExact) {
  v1::FrameScene frame;
  std::string expected = kHead + Bytes("00000003 44 00000000000186a0");
  for (int i = 0; i < 100000; ++i) {
    frame.add_background(i * .125);
    AppendBigEndian(i == 0 ? 0 : std::bit_cast<uint64_t>(i * .125), expected);
  }
  EXPECT_EQ(KeyBytes(frame), expected);
}

}  // namespace
}  // namespace fjord
