/// \file
/// How much a test does, as the environment says.
#pragma once

#include <cstdlib>

namespace seeker::testing {

/// The whole number that the environment variable `name` holds; `otherwise` where there is none of that name.
[[nodiscard]] inline int number_from_environment(const char* name, int otherwise) {
  const char* text = std::getenv(name);
  return text != nullptr ? std::atoi(text) : otherwise;
}

}  // namespace seeker::testing
