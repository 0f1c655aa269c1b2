/// \file
/// Names of an enum's values, as help and messages list them.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "common/api/robot_api.hpp"

namespace seeker::cli {

/// All topics, as the API numbers them.
[[nodiscard]] constexpr std::array<api::Topic, api::kTopicCount> all_topics() {
  std::array<api::Topic, api::kTopicCount> topics{};
  for (std::size_t k = 0; k < topics.size(); ++k) {
    topics[k] = static_cast<api::Topic>(k);
  }
  return topics;
}

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
