/// \file
/// Writes the little-endian fields of a packet's data, one after the other.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include "common/core/assert.hpp"

namespace seeker::p2os {

class FieldWriter {
 public:
  void u8(std::uint8_t value) { number(value, 1); }
  void u16(std::uint16_t value) { number(value, 2); }
  void u32(std::uint32_t value) { number(value, 4); }
  /// A text without NUL, and the NUL that ends it.
  void text(std::string_view value) {
    SEEKER_ASSERT(value.find('\0') == std::string_view::npos);
    data_.insert(data_.end(), value.begin(), value.end());
    data_.push_back(0);
  }

  [[nodiscard]] std::vector<std::uint8_t> take() { return std::move(data_); }

 private:
  void number(std::uint32_t value, std::size_t bytes) {
    for (std::size_t k = 0; k < bytes; ++k) {
      data_.push_back(static_cast<std::uint8_t>(value >> (8 * k)));
    }
  }

  std::vector<std::uint8_t> data_;
};

}  // namespace seeker::p2os
