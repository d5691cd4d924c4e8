#pragma once

#include <cstdint>
#include <string_view>

namespace pastefit {

/// Random numbers from a named, counter-based stream: the n-th number is a pure function of (seed, name, n),
/// independent of the order of calls. Two names never share numbers. Method: the finaliser of SplitMix64 (Steele, Lea &
/// Flood 2014) applied twice to a mix of key and counter. Not for cryptography.
class RandomStream {
 public:
  constexpr RandomStream(std::uint64_t seed, std::string_view name) : key_(mix(seed ^ mix(hash(name)))) {}

  /// Uniform in [0, 1), 53 random bits.
  constexpr double uniform(std::uint64_t n) const { return static_cast<double>(bits(n) >> 11) * 0x1.0p-53; }
  constexpr double uniform(std::uint64_t n, double lower, double upper) const {
    return lower + (upper - lower) * uniform(n);
  }
  constexpr std::uint64_t bits(std::uint64_t n) const { return mix(key_ + mix(n * 0x9e3779b97f4a7c15u + 1)); }

  /// Standard normal, from the numbers 2n and 2n + 1 (Box-Muller).
  double normal(std::uint64_t n) const;

 private:
  static constexpr std::uint64_t mix(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  static constexpr std::uint64_t hash(std::string_view name) {  // FNV-1a
    std::uint64_t h = 0xcbf29ce484222325u;
    for (const char c : name) h = (h ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
    return h;
  }
  std::uint64_t key_;
};

}  // namespace pastefit
