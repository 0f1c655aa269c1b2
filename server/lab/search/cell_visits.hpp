/// \file
/// Counts the cells of a fixed grid that a path entered, and returns to them: the same measure for every strategy.
#pragma once

#include <optional>
#include <set>

#include "common/core/grid.hpp"

namespace seeker::lab {

/// Counts entries. A cell counts as entered when the path is at least `margin_m` inside it, so that driving along a
/// border adds no entries.
class CellVisits {
 public:
  explicit CellVisits(double cell_m = 0.8, double margin_m = 0.1)
      : frame_{Point2::Zero(), cell_m}, margin_m_(margin_m) {}

  void add(const Point2& p);
  [[nodiscard]] int visited() const { return static_cast<int>(cells_.size()); }
  [[nodiscard]] int repeated() const { return entries_ - visited(); }

 private:
  GridFrame frame_;
  double margin_m_;
  std::optional<CellIndex> current_;
  std::set<CellIndex> cells_;
  int entries_ = 0;
};

}  // namespace seeker::lab
