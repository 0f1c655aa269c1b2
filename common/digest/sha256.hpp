/// \file
/// SHA-256 (FIPS 180-4), by which pieces of maps and files that travel are named.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "common/core/result.hpp"

namespace seeker::digest {

using Sha256Sum = std::array<std::uint8_t, 32>;
/// The length of a sum as to_hex() writes it.
inline constexpr std::size_t kSha256HexDigits = 2 * std::tuple_size_v<Sha256Sum>;

/// The sum of bytes that come one after the other.
class Sha256 {
 public:
  Sha256();
  Sha256(const Sha256&) = delete;
  Sha256& operator=(const Sha256&) = delete;
  ~Sha256();

  void add(std::span<const std::uint8_t> bytes);
  /// The sum of all that was added; nothing can be added afterwards.
  [[nodiscard]] Sha256Sum finish();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

[[nodiscard]] Sha256Sum sha256_of(std::span<const std::uint8_t> bytes);
/// Of a whole file, which is read in pieces. Errors of files::FileReader.
[[nodiscard]] Result<Sha256Sum> sha256_of_file(const std::filesystem::path& path);

/// Lower-case hexadecimal digits.
[[nodiscard]] std::string to_hex(std::span<const std::uint8_t> bytes);
/// Whether the text is a sum as to_hex() writes it: 64 lower-case hexadecimal digits and nothing else.
[[nodiscard]] bool is_sha256_hex(std::string_view text);

}  // namespace seeker::digest
