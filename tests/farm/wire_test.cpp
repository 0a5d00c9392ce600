// The wire is frozen: names, numbers and types of every message, enumerator and call. A line may be
// added; a line that changes or goes breaks workers and journals that are out there.
//
// After an addition: FJORD_WRITE_GOLDEN=1 ctest -R F3_TheWireIsFrozen, then look at the difference.
#include <google/protobuf/descriptor.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "fjord/v1/blobs.pb.h"
#include "fjord/v1/jobs.pb.h"
#include "fjord/v1/leases.pb.h"

namespace {

using google::protobuf::Descriptor;
using google::protobuf::EnumDescriptor;
using google::protobuf::FileDescriptor;

void Tell(const EnumDescriptor& type, std::ostream& out) {
  for (int i = 0; i < type.value_count(); ++i) {
    out << "enum " << type.full_name() << ' ' << type.value(i)->number() << ' '
        << type.value(i)->name() << '\n';
  }
}

void Tell(const Descriptor& type, std::ostream& out) {
  out << "message " << type.full_name() << '\n';
  for (int i = 0; i < type.field_count(); ++i) {
    const auto& field = *type.field(i);
    out << "field " << type.full_name() << ' ' << field.number() << ' ' << field.name() << ' '
        << (field.is_repeated() ? "repeated " : "")
        << (field.message_type() != nullptr ? field.message_type()->full_name()
            : field.enum_type() != nullptr  ? field.enum_type()->full_name()
                                            : std::string(field.type_name()))
        << '\n';
  }
  for (int i = 0; i < type.enum_type_count(); ++i) Tell(*type.enum_type(i), out);
  for (int i = 0; i < type.nested_type_count(); ++i) Tell(*type.nested_type(i), out);
}

void Tell(const FileDescriptor& file, std::ostream& out) {
  for (int i = 0; i < file.enum_type_count(); ++i) Tell(*file.enum_type(i), out);
  for (int i = 0; i < file.message_type_count(); ++i) Tell(*file.message_type(i), out);
  for (int i = 0; i < file.service_count(); ++i) {
    for (int j = 0; j < file.service(i)->method_count(); ++j) {
      const auto& method = *file.service(i)->method(j);
      out << "rpc " << method.full_name() << ' ' << (method.client_streaming() ? "stream " : "")
          << method.input_type()->full_name() << " > "
          << (method.server_streaming() ? "stream " : "") << method.output_type()->full_name()
          << '\n';
    }
  }
}

TEST(WireTest, F3_TheWireIsFrozen) {
  std::ostringstream actual;
  Tell(*fjord::v1::Job::descriptor()->file(), actual);
  Tell(*fjord::v1::Attempt::descriptor()->file(), actual);
  Tell(*fjord::v1::MissingRequest::descriptor()->file(), actual);
  const std::string path = FJORD_SOURCE_DIR "/tests/farm/wire.golden";
  if (std::getenv("FJORD_WRITE_GOLDEN") != nullptr) std::ofstream(path) << actual.str();
  std::ifstream file(path);
  std::ostringstream golden;
  golden << file.rdbuf();
  EXPECT_EQ(actual.str(), golden.str());
}

}  // namespace
