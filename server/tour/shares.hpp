/// \file
/// Which robot visits which place, so that the last of them is done soon.
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace seeker::tour {

/// The legs of several robots' routes, in metres of path.
struct ShareCosts {
  std::vector<std::vector<double>> from_robot;  ///< first leg, by robot and place
  Eigen::MatrixXd between;                      ///< leg from place to place: square, symmetric
  /// Place to which each robot drives, with which its route begins; kNowhere: it drives to none.
  std::vector<std::size_t> bound_for;

  static constexpr std::size_t kNowhere = static_cast<std::size_t>(-1);

  [[nodiscard]] std::size_t robots() const { return from_robot.size(); }
  [[nodiscard]] std::size_t places() const { return static_cast<std::size_t>(between.rows()); }
};

/// The robot of every place. Places go one after the other to the robot whose route then is the shortest, and from the
/// longest route to others as long as that makes the longest route shorter. Robots that know the same costs come to the
/// same answer, so that they need not ask each other. At least one robot; no two may be bound for one place.
[[nodiscard]] std::vector<std::size_t> shared_places(const ShareCosts& costs);

}  // namespace seeker::tour
