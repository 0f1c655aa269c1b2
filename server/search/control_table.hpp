/// \file
/// Heading changes of the fuzzy planner, computed in advance on a grid of inputs (spec S3.2, "Control table"). The
/// robot uses this table.
#pragma once

#include <array>
#include <vector>

#include "common/core/result.hpp"
#include "server/search/fuzzy_planner.hpp"

namespace seeker::search {

/// Nodes of the table. All five distances share one axis.
struct ControlTableParams {
  /// Ascending, within [0, 3] m. The membership functions have corners at 0.4 and 1.0 m: keep both as nodes.
  std::vector<double> distances_m{0.2, 0.4, 0.6, 0.8, 1.0, 3.0};
  double target_step_deg = 30.0;  ///< must divide 360

  /// A table with half the spacing between 0.4 and 1.0 m and of the target: 9^5 x 25 nodes.
  [[nodiscard]] static ControlTableParams fine();
};

/// Table over (L, LF, F, RF, R, target), multilinear between nodes, clamped outside. Immutable, may be shared.
class ControlTable {
 public:
  /// Fills the table with the generated rule base. It refuses axes that do not ascend, a step that does not divide 360
  /// degrees, and more than 16 million nodes.
  [[nodiscard]] static Result<ControlTable> create(const ControlTableParams& params = {});

  /// Heading change u* in rad, or the reason to stop. The target's bearing is wrapped to (-pi, pi].
  [[nodiscard]] HeadingResult look_up(const Sectors& sectors, double target_rad) const;

  [[nodiscard]] std::size_t size() const { return values_.size(); }
  [[nodiscard]] const ControlTableParams& params() const { return params_; }
  [[nodiscard]] int target_nodes() const { return target_nodes_; }
  [[nodiscard]] double target_node_rad(int k) const;

 private:
  ControlTable() = default;
  void fill();

  ControlTableParams params_;
  int target_nodes_ = 0;
  std::vector<float> values_;  ///< row-major, L slowest, target fastest
};

}  // namespace seeker::search
