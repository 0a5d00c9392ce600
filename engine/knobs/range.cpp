#include "engine/knobs/range.h"

#include <charconv>

namespace fjord {

bool NumberRange::Holds(double value) const {
  return value <= highest && (above ? value > lowest : value >= lowest);
}

std::string NumberRange::ToString() const {
  const std::string low = NumberText(lowest), high = NumberText(highest);
  if (above) return "above " + low + (highest < kLargestNumber ? " and at most " + high : "");
  return low + " to " + high;
}

std::string NumberText(double value) {
  char buffer[32];
  const double size = value < 0 ? -value : value;
  const bool plain = size == 0 || (size >= 1e-4 && size < 1e9);
  const auto [end, code] =
      std::to_chars(buffer, buffer + sizeof buffer, value,
                    plain ? std::chars_format::fixed : std::chars_format::scientific);
  return code == std::errc() ? std::string(buffer, end) : "?";
}

}  // namespace fjord
