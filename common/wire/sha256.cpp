#include "common/wire/sha256.hpp"

#include <openssl/sha.h>

namespace seeker::wire {

std::array<std::uint8_t, 32> sha256_of(std::span<const std::uint8_t> bytes) {
  std::array<std::uint8_t, 32> hash{};
  static_assert(SHA256_DIGEST_LENGTH == 32);
  SHA256(bytes.data(), bytes.size(), hash.data());
  return hash;
}

std::string to_hex(std::span<const std::uint8_t> bytes) {
  constexpr const char* kDigits = "0123456789abcdef";
  constexpr unsigned kLowNibble = 0xF;
  std::string text;
  text.reserve(2 * bytes.size());
  for (const std::uint8_t byte : bytes) {
    text += kDigits[byte >> 4U];
    text += kDigits[byte & kLowNibble];
  }
  return text;
}

}  // namespace seeker::wire
