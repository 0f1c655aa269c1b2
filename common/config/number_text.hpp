/// \file
/// Checks of numbers as they are written on a command line: of any parser, which calls them with the text.
#pragma once

#include <string>

namespace seeker::config {

/// Each answers nothing when the text is a number as it should be, else what it must be. None lets infinity or NaN
/// through: no length, rate or time of a command line is either.
[[nodiscard]] std::string finite_number(const std::string& text);
[[nodiscard]] std::string number_above_zero(const std::string& text);
[[nodiscard]] std::string number_from_zero(const std::string& text);

}  // namespace seeker::config
