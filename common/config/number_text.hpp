/// \file
/// Checks of numbers on a command line, which a parser calls with the text of each.
#pragma once

#include <string>

namespace seeker::config {

/// Each returns an empty text for a valid number, else one that states what the number must be. Infinity and NaN are
/// refused, since no length, rate or time of a command line may be either.
[[nodiscard]] std::string finite_number(const std::string& text);
[[nodiscard]] std::string number_above_zero(const std::string& text);
[[nodiscard]] std::string number_from_zero(const std::string& text);

}  // namespace seeker::config
