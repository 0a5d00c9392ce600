// The range of a number that a person writes, and how numbers are shown to people.
#pragma once

#include <string>

namespace fjord {

// No number of a scene is larger, either way.
inline constexpr double kLargestNumber = 1e12;

struct NumberRange {
  double lowest = -kLargestNumber;
  double highest = kLargestNumber;
  bool above = false;  // lowest itself is not allowed

  // False for NaN.
  bool Holds(double value) const;
  // "0 to 1", "above 0"
  std::string ToString() const;
};

// "1.5", "1000000", "1e+12": the shortest form that reads back, without an exponent where that is
// easy to read.
std::string NumberText(double value);

}  // namespace fjord
