/// \file
/// Positions in sentences: two decimals, the same on every machine.
#pragma once

#include <string>

#include "common/core/pose2.hpp"

namespace seeker {

/// "(1.25, -0.40)"
[[nodiscard]] std::string text(const Point2& p_map);
/// "1.25"
[[nodiscard]] std::string text(double value);

}  // namespace seeker
