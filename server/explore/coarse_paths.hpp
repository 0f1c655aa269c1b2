/// \file
/// Approximate path lengths between places of the known floor, for planning several drives ahead.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "common/core/grid.hpp"

namespace seeker::explore {

/// Path lengths on the coarse cells of FloorView::reachable.
class CoarsePaths {
 public:
  explicit CoarsePaths(const Grid<std::uint8_t>& floor);

  /// Path lengths in metres from one place to each of the others; infinity where no path is known.
  [[nodiscard]] std::vector<double> lengths_m(const Point2& from_map, std::span<const Point2> to_map) const;

  /// The same, with a guess where no path is known because a passage is narrower than a cell, or only another robot
  /// knows the floor between: half as long again as the straight line.
  [[nodiscard]] std::vector<double> expected_m(const Point2& from_map, std::span<const Point2> to_map) const;

  static constexpr double kNoPath = std::numeric_limits<double>::infinity();

 private:
  using Node = std::uint32_t;  ///< number of a cell of the floor with a margin of one cell around it

  /// Lengths in cells from one node to all; right for `targets` alone, since the search ends when it has reached them.
  [[nodiscard]] std::vector<float> spread(Node start, std::vector<Node> targets) const;
  [[nodiscard]] Node node_of(CellIndex cell) const;
  [[nodiscard]] std::optional<Node> node_at(const Point2& p_map) const;

  static constexpr std::size_t kDirections = 8;  ///< the sides first, then the corners

  Grid<std::uint8_t> floor_;
  std::vector<float> unreached_;              ///< the lengths, by node, before a search
  std::array<int, kDirections> beside_ = {};  ///< from a node to its neighbours
};

}  // namespace seeker::explore
