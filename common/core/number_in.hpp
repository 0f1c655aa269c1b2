/// \file
/// Numbers in text that came from outside.
#pragma once

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <system_error>

namespace seeker {

/// The number that `text` is from end to end; nothing where it is none, has something beside it or does not fit into T.
/// The same in every locale. "inf" and "nan" are numbers of floating point: finite_in() is without them.
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
