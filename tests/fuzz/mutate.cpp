#include "tests/fuzz/mutate.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "engine/base/random.h"

namespace fjord::fuzz {
namespace {

constexpr size_t kMostBytes = 64 << 10;

constexpr std::array<std::string_view, 26> kBreakers = {"nan",
                                                        "inf",
                                                        "-1",
                                                        "0",
                                                        "1e308",
                                                        "-1e-400",
                                                        "4294967296",
                                                        "9223372036854775808",
                                                        "1e15",
                                                        "\n",
                                                        "\r\n",
                                                        " ",
                                                        "#",
                                                        "\\",
                                                        "\"",
                                                        "{",
                                                        "}",
                                                        "data ",
                                                        "-",
                                                        "[",
                                                        "/",
                                                        "<",
                                                        ">",
                                                        "\xff\xff\xff\xff",
                                                        std::string_view("\0\0\0\0", 4),
                                                        "key { frame: 1 }"};

class Draws {
 public:
  explicit Draws(uint64_t seed) : state_(Mix64(seed + 1)) {}
  size_t Below(size_t n) {
    state_ = Mix64(state_ + 0x9e3779b97f4a7c15u);
    return n == 0 ? 0 : static_cast<size_t>(state_ >> 16) % n;
  }

 private:
  uint64_t state_;
};

void Damage(const std::vector<std::string>& corpus, Draws* draw, std::string* bytes) {
  const size_t at = draw->Below(bytes->size() + 1);
  const size_t length = 1 + draw->Below(draw->Below(4) == 0 ? 64 : 4);
  switch (draw->Below(8)) {
    case 0:
      if (at < bytes->size())
        (*bytes)[at] = static_cast<char>((*bytes)[at] ^ (1 << draw->Below(8)));
      break;
    case 1:
      if (at < bytes->size()) (*bytes)[at] = static_cast<char>(draw->Below(256));
      break;
    case 2:
      bytes->erase(at, length);
      break;
    case 3:
      bytes->insert(at, bytes->substr(draw->Below(bytes->size() + 1), length));
      break;
    case 4:
      bytes->resize(at);
      break;
    case 5:
      bytes->insert(at, kBreakers[draw->Below(kBreakers.size())]);
      break;
    case 6: {  // a breaker in the place of a word
      const size_t end = std::min(bytes->find_first_of(" \n", at), bytes->size());
      bytes->replace(at, end - at, kBreakers[draw->Below(kBreakers.size())]);
      break;
    }
    default: {
      const std::string& other = corpus[draw->Below(corpus.size())];
      const size_t from = draw->Below(other.size() + 1);
      bytes->replace(at, std::string::npos, other, from, std::string::npos);
      break;
    }
  }
}

}  // namespace

std::string Mutate(const std::vector<std::string>& corpus, uint64_t seed) {
  Draws draw(seed);
  std::string bytes = corpus[draw.Below(corpus.size())];
  for (size_t i = 1 + draw.Below(4); i > 0; --i) Damage(corpus, &draw, &bytes);
  bytes.resize(std::min(bytes.size(), kMostBytes));
  return bytes;
}

}  // namespace fjord::fuzz
