// SHA-256 (OpenSSL), whole or in pieces. A digest names a blob, a picture's samples or a frame.
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace fjord {

struct Digest {
  std::array<uint8_t, 32> bytes{};

  std::string Hex() const;  // 64 lower-case digits
  friend auto operator<=>(const Digest&, const Digest&) = default;
};

bool IsDigestHex(std::string_view text);
// None where it is no digest.
std::optional<Digest> ParseDigest(std::string_view text);

// Not for sharing between threads.
class Sha256 {
 public:
  Sha256();
  ~Sha256();
  Sha256(Sha256&&) noexcept;
  Sha256& operator=(Sha256&&) noexcept;

  void Update(std::span<const uint8_t> bytes);
  void Update(std::string_view text);
  // Ends the digest; no Update after it.
  Digest Finish();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

Digest Sha256Of(std::string_view bytes);

}  // namespace fjord
