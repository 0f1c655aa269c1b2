/// \file
/// Removal of segments that no longer exist, which a scan shows by beams through them.
#pragma once

#include "server/slam/sp_state.hpp"

namespace seeker::slam {

enum class Sight : std::uint8_t { kNothing, kConfirmed, kDenied };

/// Evaluates the beams at a segment: they pass beyond it (denied), end on it (confirmed), or neither (hidden, out of
/// view).
[[nodiscard]] Sight look_at(const SpState& state, std::size_t segment, const LaserScan& scan);

}  // namespace seeker::slam
