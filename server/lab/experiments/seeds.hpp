/// \file
/// Lists of seeds in the form that people write.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/core/result.hpp"

namespace seeker::lab {

/// Parses "3" or "1-20" or "1-3,7". kInvalidArgument: no number, a descending range, more than 10000 seeds.
[[nodiscard]] Result<std::vector<std::uint64_t>> parse_seeds(const std::string& text);
/// The shortest text that parse_seeds() reads as these seeds; they may be in any order.
[[nodiscard]] std::string print_seeds(std::vector<std::uint64_t> seeds);

}  // namespace seeker::lab
