/// \file
/// Names as people sort them: "left_9" before "left_10".
#pragma once

#include <string_view>

namespace seeker {

/// Numbers compare by value, leading zeros apart, all else by character. A strict order of all names: those that differ
/// by leading zeros alone compare as text.
[[nodiscard]] bool natural_less(std::string_view a, std::string_view b);

}  // namespace seeker
