// Keyed random numbers: a draw is a pure function of (object seed, identity, channel). There is no
// state, no order and no stream, so any vertex can be made alone, anywhere, with the same bits
// (S24).
//
// An identity is 128 bits. A coarse vertex's comes from (seed, number); a midpoint's from its end
// points', the same for (a, b) and (b, a). `lo` alone keys the draws; vertices are welded by
// structure or by all 128 bits, never by `lo` (design D1).
//
// The arithmetic (integers only) is frozen: golden digests of every picture rest on it.
#pragma once

#include <compare>
#include <cstdint>

namespace fjord {

struct Identity {
  uint64_t lo = 0;
  uint64_t hi = 0;
  friend auto operator<=>(const Identity&, const Identity&) = default;
};

// Bijective 64-bit mixing (two xorshift-multiply rounds, three shifts).
constexpr uint64_t Mix64(uint64_t x) {
  x ^= x >> 32;
  x *= 0xd6e8feb86659fd93u;
  x ^= x >> 32;
  x *= 0xd6e8feb86659fd93u;
  x ^= x >> 32;
  return x;
}

// Coarse vertex `number` (from 0) of an object with `seed`.
constexpr Identity CoarseIdentity(uint64_t seed, uint64_t number) {
  const uint64_t s = Mix64(seed + 0x9e3779b97f4a7c15u);
  return {Mix64(s + number * 0xbf58476d1ce4e5b9u + 1),
          Mix64(~s + number * 0x94d049bb133111ebu + 1)};
}

constexpr Identity MidpointIdentity(Identity a, Identity b) {
  return {Mix64(a.lo + b.lo), Mix64((a.hi + b.hi) ^ 0x2545f4914f6cdd1du)};
}

// 64 fresh bits for `channel` of the vertex keyed `lo`. Channel 0 is lo itself (the Gaussian of the
// offset); others are mixed again.
constexpr uint64_t DrawBits(uint64_t lo, uint64_t channel) {
  return channel == 0 ? lo : Mix64(lo + channel * 0x9e3779b97f4a7c15u);
}

inline constexpr int kMaxUniforms = 16;

// Bounded Gaussian after the central limit theorem (S7): the sum of n 16-bit uniforms, scaled to
// mean 0 and standard deviation 1 exactly, so |g| <= GaussianBound(n). n in 1..kMaxUniforms. The
// first four uniforms are the 16-bit pieces of DrawBits(lo, 0) from the low end, the next four
// those of channel 1, and so on; the sum is an integer, converted and scaled once.
double Gaussian(uint64_t lo, int n);

// sqrt(3 n (65535 / 65536 ...)): the largest |Gaussian(., n)|.
double GaussianBound(int n);

// The factor that Gaussian multiplies (2 * sum - n * 65535) by.
double GaussianScale(int n);

// Mean of three 16-bit uniforms minus a half, in -.5 .. .5, from channel 7 (S12).
double TangentDraw(uint64_t lo);

}  // namespace fjord
