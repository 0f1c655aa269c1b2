/// \file
/// What a test that reads the tree prints when it fails.
#pragma once

#include <string>
#include <vector>

namespace seeker::testing {

/// One finding a line.
[[nodiscard]] inline std::string joined(const std::vector<std::string>& findings) {
  std::string text;
  for (const std::string& finding : findings) {
    text += finding + "\n";
  }
  return text;
}

}  // namespace seeker::testing
