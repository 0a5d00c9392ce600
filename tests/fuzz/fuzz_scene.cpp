// A scene that loads without an error is complete: its wire form loads again, to the same bytes.
#include "engine/scene/load.h"
#include "tests/fuzz/harness.h"

namespace fjord::fuzz {
namespace {

// A primitive may be as large as memory bears; that is no fault, but nothing to wait for here.
constexpr uint32_t kMostSegments = 200;

// Every file is this one.
Result<std::string> ReadAsset(const v1::File& file) {
  if (file.path() == "missing") return MakeError(ErrorCode::kNotFound, "there is no such file");
  return std::string("data 4 2\n0 0 0\n1 0 0\n1 1 .5\n0 1 0\n3 1 2 3\n3 1 3 4\n");
}

void CheckComplete(const LoadResult& result) {
  if (!result.ok()) {
    for (const Error& error : result.errors) FJORD_CHECK(!error.message.empty());
    return;
  }
  const std::string bytes = SerializeScene(result.loaded.scene);
  const LoadResult again =
      LoadSceneBinary(bytes, "again", [&result](const v1::File& file) -> Result<std::string> {
        const auto found = result.loaded.assets.find(file.digest());
        FJORD_CHECK(found != result.loaded.assets.end(), file.digest());
        return found->second;
      });
  FJORD_CHECK(again.ok(), again.ok() ? "" : again.errors[0].ToString());
  FJORD_CHECK(SerializeScene(again.loaded.scene) == bytes);
}

// Numbers of four digits or more after "segments" or "rings".
bool AsksForMuch(std::string_view bytes) {
  for (const std::string_view word : {"segments", "rings"}) {
    for (size_t at = bytes.find(word); at != bytes.npos; at = bytes.find(word, at + 1)) {
      size_t digits = bytes.find_first_of("0123456789", at);
      uint64_t value = 0;
      for (; digits < bytes.size() && value <= kMostSegments; ++digits) {
        const char c = bytes[digits];
        if ((c >= 'a' && c <= 'f') || c == 'x' || c == 'X') return true;
        if (c < '0' || c > '9') break;
        value = value * 10 + static_cast<uint64_t>(c - '0');
      }
      if (value > kMostSegments) return true;
    }
  }
  return false;
}

bool AsksForMuch(const v1::Shape& shape) {
  return shape.has_primitive() && (shape.primitive().segments() > kMostSegments ||
                                   shape.primitive().rings() > kMostSegments);
}

bool AsksForMuch(const v1::Scene& scene) {
  for (const v1::Object& object : scene.objects()) {
    if (AsksForMuch(object.shape())) return true;
    for (const v1::Key& key : object.key()) {
      if (AsksForMuch(key.shape())) return true;
    }
  }
  return false;
}

}  // namespace

void RunSceneText(std::string_view bytes) {
  if (AsksForMuch(bytes)) return;
  CheckComplete(LoadSceneText(std::string(bytes), "fuzz", &ReadAsset));
}

void RunSceneBinary(std::string_view bytes) {
  v1::Scene scene;
  if (scene.ParseFromArray(bytes.data(), static_cast<int>(bytes.size())) && AsksForMuch(scene)) {
    return;
  }
  CheckComplete(LoadSceneBinary(std::string(bytes), "fuzz", &ReadAsset));
}

}  // namespace fjord::fuzz
