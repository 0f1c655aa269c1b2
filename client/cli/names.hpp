/// \file
/// Names of an enum's values, as help and messages list them.
#pragma once

#include <string>
#include <vector>

namespace seeker::cli {

/// The to_string() of each of `values`.
template <class Values>
[[nodiscard]] std::vector<std::string> names_of(const Values& values) {
  std::vector<std::string> names;
  names.reserve(values.size());
  for (const auto value : values) {
    names.emplace_back(to_string(value));
  }
  return names;
}

/// The names of `values` in one line: "a, b, c".
template <class Values>
[[nodiscard]] std::string listed(const Values& values) {
  std::string line;
  for (const std::string& name : names_of(values)) {
    line += (line.empty() ? "" : ", ") + name;
  }
  return line;
}

}  // namespace seeker::cli
