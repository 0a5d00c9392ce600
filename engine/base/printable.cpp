#include "engine/base/printable.h"

#include <cstdint>
#include <cstdio>

namespace fjord {
namespace {

constexpr uint32_t kNoCharacter = 0xffffffff;

struct Character {
  uint32_t code = kNoCharacter;  // kNoCharacter: a byte that is no UTF-8
  size_t bytes = 1;
};

bool Continues(std::string_view text, size_t at) {
  return at < text.size() && (static_cast<unsigned char>(text[at]) & 0xc0) == 0x80;
}

Character At(std::string_view text, size_t at) {
  const auto lead = static_cast<unsigned char>(text[at]);
  if (lead < 0x80) return {lead, 1};
  const size_t bytes = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
  if (lead < 0xc2 || lead > 0xf4) return {};
  uint32_t code = lead & (0xffu >> (bytes + 1));
  for (size_t i = 1; i < bytes; ++i) {
    if (!Continues(text, at + i)) return {};
    code = code << 6 | (static_cast<unsigned char>(text[at + i]) & 0x3fu);
  }
  constexpr uint32_t kLeast[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = code >= 0xd800 && code <= 0xdfff;
  if (code < kLeast[bytes] || code > 0x10ffff || surrogate) return {};
  return {code, bytes};
}

// Control characters, line and paragraph ends, what turns the direction of reading, and what
// cannot be seen but for the joiners that scripts need.
bool IsHarmless(uint32_t code) {
  if (code < 0x20 || (code >= 0x7f && code < 0xa0)) return false;
  if (code == 0x61c || code == 0x200b || code == 0x200e || code == 0x200f) return false;
  if (code >= 0x2028 && code <= 0x202e) return false;
  if (code >= 0x2060 && code <= 0x206f) return false;
  if (code == 0xfeff || (code >= 0xfff9 && code <= 0xfffb)) return false;
  return code < 0xe0000 || code > 0xe0fff;
}

std::string Escaped(unsigned int code) {
  char text[16];
  if (code < 0x10000) {
    std::snprintf(text, sizeof text, "\\u%04x", code);
  } else {  // as JSON writes it
    const unsigned int rest = code - 0x10000;
    std::snprintf(text, sizeof text, "\\u%04x\\u%04x", 0xd800 + (rest >> 10),
                  0xdc00 + (rest & 0x3ff));
  }
  return text;
}

std::string Clean(std::string_view text, bool lines) {
  std::string clean;
  clean.reserve(text.size());
  for (size_t at = 0; at < text.size();) {
    const Character next = At(text, at);
    const bool kept = lines && (next.code == '\n' || next.code == '\t');
    if (next.code == kNoCharacter) {
      char byte[8];
      std::snprintf(byte, sizeof byte, "\\x%02x", static_cast<unsigned char>(text[at]));
      clean += byte;
    } else if (kept || IsHarmless(next.code)) {
      clean += text.substr(at, next.bytes);
    } else {
      clean += Escaped(next.code);
    }
    at += next.bytes;
  }
  return clean;
}

}  // namespace

std::string Printable(std::string_view text) { return Clean(text, false); }
std::string PrintableLines(std::string_view text) { return Clean(text, true); }

bool IsPrintable(std::string_view text) {
  for (size_t at = 0; at < text.size();) {
    const Character next = At(text, at);
    if (next.code == kNoCharacter || !IsHarmless(next.code)) return false;
    at += next.bytes;
  }
  return true;
}

size_t CharactersIn(std::string_view text) {
  size_t count = 0;
  for (size_t at = 0; at < text.size(); at += At(text, at).bytes) ++count;
  return count;
}

std::string FirstCharacters(std::string_view text, size_t most) {
  size_t at = 0;
  for (size_t count = 0; count < most && at < text.size(); ++count) at += At(text, at).bytes;
  return std::string(text.substr(0, at));
}

}  // namespace fjord
