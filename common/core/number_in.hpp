/// \file
/// Numbers in text that comes from files, devices and users.
#pragma once

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <system_error>

namespace seeker {

/// Reads `text` as one number, in the same notation in every locale. std::nullopt where it is no number, has characters
/// before or after the number, or does not fit into T. "inf" and "nan" are floating-point numbers here; finite_in()
/// refuses them.
template <class T>
[[nodiscard]] std::optional<T> number_in(std::string_view text) {
  T value{};
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || rest != end) {
    return std::nullopt;
  }
  return value;
}

[[nodiscard]] inline std::optional<double> finite_in(std::string_view text) {
  const std::optional<double> value = number_in<double>(text);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

}  // namespace seeker
