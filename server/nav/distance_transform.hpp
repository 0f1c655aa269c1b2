/// \file
/// Exact Euclidean distance transform.
#pragma once

#include <cstdint>

#include "common/core/grid.hpp"

namespace seeker::nav {

/// Distance from the centre of every cell to the centre of the nearest cell where `seed` is not zero, in cells
/// (Felzenszwalb and Huttenlocher 2012); kFarCells where there is no seed at all. Linear in the number of cells.
[[nodiscard]] Grid<float> distance_transform(const Grid<std::uint8_t>& seed);
inline constexpr float kFarCells = 1.0e6F;

}  // namespace seeker::nav
