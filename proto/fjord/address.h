// HOST:PORT, as every program takes it.
#pragma once

#include <string>

namespace fjord {

enum class PortZero { kRefused, kTakesAFreeOne };

// Empty, or what is wrong with the address and how one is written.
inline std::string AddressDefect(const std::string& address, PortZero zero = PortZero::kRefused) {
  const auto wrong = [&](const std::string& what) {
    return "\"" + address + "\" " + what + "; write HOST:PORT, as 127.0.0.1:7433";
  };
  const size_t colon = address.rfind(':');
  if (colon == std::string::npos) return wrong("has no port");
  const std::string host = address.substr(0, colon), port = address.substr(colon + 1);
  if (host.empty()) return wrong("has no host");
  if (host.find(':') != std::string::npos && (host.front() != '[' || host.back() != ']')) {
    return wrong("has more than one colon: an IPv6 address stands in [ ]");
  }
  if (port.empty()) return wrong("has no port");
  int number = 0;
  for (const char c : port) {
    if (c < '0' || c > '9') return wrong("has a port that is no number");
    number = number * 10 + (c - '0');
    if (number > 65535) return wrong("has a port above 65535");
  }
  if (number == 0 && zero == PortZero::kRefused) return wrong("has port 0");
  return "";
}

}  // namespace fjord
