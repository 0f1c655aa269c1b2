/// \file
/// Reads and writes a packet's field by its type, for lists of fields that are written once and used in both
/// directions.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>

#include "server/protocols/p2os/field_reader.hpp"
#include "server/protocols/p2os/field_writer.hpp"

namespace seeker::p2os {

/// A text, or an integer of 8, 16 or 32 bits of either sign.
template <class T>
[[nodiscard]] std::optional<T> read_field(FieldReader& in) {
  const auto as_field = [](const auto& value) {
    return value ? std::optional<T>(static_cast<T>(*value)) : std::nullopt;
  };
  if constexpr (std::is_same_v<T, std::string>) {
    return in.text();
  } else if constexpr (sizeof(T) == 1) {
    return as_field(in.u8());
  } else if constexpr (sizeof(T) == 2) {
    return as_field(in.u16());
  } else {
    return as_field(in.u32());
  }
}

template <class T>
void write_field(FieldWriter& out, const T& value) {
  if constexpr (std::is_same_v<T, std::string>) {
    out.text(value);
  } else if constexpr (sizeof(T) == 1) {
    out.u8(static_cast<std::uint8_t>(value));
  } else if constexpr (sizeof(T) == 2) {
    out.u16(static_cast<std::uint16_t>(value));
  } else {
    out.u32(value);
  }
}

}  // namespace seeker::p2os
