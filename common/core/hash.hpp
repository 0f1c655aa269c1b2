/// \file
/// FNV-1a hash of 64 bits, to distinguish values and to find damage. Equal input gives the same hash on every machine.
/// It gives no protection against an attacker.
#pragma once

#include <bit>
#include <cstdint>
#include <string_view>

namespace seeker {

class Fnv1a {
 public:
  void add_byte(std::uint8_t byte) {
    constexpr std::uint64_t kPrime = 0x100000001b3ULL;
    hash_ = (hash_ ^ byte) * kPrime;
  }
  /// Adds the eight bytes of the value, lowest byte first.
  void add(std::uint64_t value) {
    for (unsigned shift = 0; shift < 64U; shift += 8U) {
      add_byte(static_cast<std::uint8_t>(value >> shift));
    }
  }
  void add(std::int64_t value) { add(std::bit_cast<std::uint64_t>(value)); }
  void add(double value) { add(std::bit_cast<std::uint64_t>(value)); }
  /// Adds the bytes of the text and no end mark: a caller that adds several texts separates them.
  void add(std::string_view text) {
    for (const char c : text) {
      add_byte(static_cast<std::uint8_t>(c));
    }
  }
  [[nodiscard]] std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325ULL;
};

}  // namespace seeker
