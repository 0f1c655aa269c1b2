/// \file
/// A described struct (see config::Fields) as JSON, by nlohmann-json. What it prints, the strict YAML reader reads
/// back.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

#include "common/config/fields.hpp"

namespace seeker::lab {

/// The object that `describe` makes, with its members in the order of the description. Values that are not finite
/// become null: JSON has no others.
[[nodiscard]] nlohmann::ordered_json described(const std::function<void(config::Fields&)>& describe);

/// An object or a list with one member a line, and a newline at the end. Bytes that are not UTF-8 become U+FFFD.
[[nodiscard]] std::string json_lines(const nlohmann::ordered_json& json);

/// json_lines(described(describe)).
[[nodiscard]] std::string described_lines(const std::function<void(config::Fields&)>& describe);

/// The struct as an object.
template <class T>
[[nodiscard]] std::string to_json(T value) {
  return described_lines([&](config::Fields& fields) { describe(fields, value); });
}

}  // namespace seeker::lab
