/// \file
/// Segments that are no longer there: a scan that looks through them says so.
#pragma once

#include "server/slam/sp_state.hpp"

namespace seeker::slam {

enum class Sight : std::uint8_t { kNothing, kConfirmed, kDenied };

/// What the beams say of a segment: they pass beyond it (denied), end on it, or say nothing (hidden, out of view).
[[nodiscard]] Sight look_at(const SpState& state, std::size_t segment, const LaserScan& scan);

}  // namespace seeker::slam
