/// \file
/// Lists of seeds as people write them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/core/result.hpp"

namespace seeker::lab {

/// "3" or "1-20" or "1-3,7". kInvalidArgument: no number, a range that runs backwards, more than 10000 seeds.
[[nodiscard]] Result<std::vector<std::uint64_t>> parse_seeds(const std::string& text);
/// The shortest text parse_seeds() reads as these seeds; they need not be in order.
[[nodiscard]] std::string print_seeds(std::vector<std::uint64_t> seeds);

}  // namespace seeker::lab
