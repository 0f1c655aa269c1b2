/// \file
/// Reads the little-endian fields of a packet's data, one after the other.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace seeker::p2os {

/// Reads fields until one is not there in full; from then on every field is missing.
class FieldReader {
 public:
  explicit FieldReader(std::span<const std::uint8_t> data) : data_(data) {}

  [[nodiscard]] std::optional<std::uint8_t> u8() {
    const auto value = number(1);
    return value ? std::optional(static_cast<std::uint8_t>(*value)) : std::nullopt;
  }
  [[nodiscard]] std::optional<std::uint16_t> u16() {
    const auto value = number(2);
    return value ? std::optional(static_cast<std::uint16_t>(*value)) : std::nullopt;
  }
  [[nodiscard]] std::optional<std::uint32_t> u32() { return number(4); }
  /// A text that ends with NUL, which is not part of the value.
  [[nodiscard]] std::optional<std::string> text() {
    const auto rest = data_.subspan(at_);
    const auto end = std::find(rest.begin(), rest.end(), std::uint8_t{0});
    if (end == rest.end()) {
      at_ = data_.size();
      return std::nullopt;
    }
    at_ += static_cast<std::size_t>(end - rest.begin()) + 1;
    return std::string(rest.begin(), end);
  }

  [[nodiscard]] std::size_t left_bytes() const { return data_.size() - at_; }

 private:
  [[nodiscard]] std::optional<std::uint32_t> number(std::size_t bytes) {
    if (left_bytes() < bytes) {
      at_ = data_.size();
      return std::nullopt;
    }
    std::uint32_t value = 0;
    for (std::size_t k = 0; k < bytes; ++k) {
      value |= static_cast<std::uint32_t>(data_[at_ + k]) << (8 * k);
    }
    at_ += bytes;
    return value;
  }

  std::span<const std::uint8_t> data_;
  std::size_t at_ = 0;
};

}  // namespace seeker::p2os
