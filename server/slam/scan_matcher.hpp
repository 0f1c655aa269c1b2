/// \file
/// Matches a scan against reference points: point-to-line ICP with its covariance.
#pragma once

#include <optional>
#include <vector>

#include "server/slam/reference_cloud.hpp"

namespace seeker::slam {

struct MatchParams {
  int max_iterations = 15;
  double first_gate_m = 0.5;       ///< largest distance of correspondences in the first iteration
  double last_gate_m = 0.12;       ///< largest distance of correspondences in the last iteration
  double gate_shrink = 0.6;        ///< per iteration
  double min_normal_cosine = 0.7;  ///< cosine of the largest angle between corresponding normals
  double huber_m = 0.03;           ///< residuals beyond it have a smaller weight (Huber)
  double inlier_m = 0.10;          ///< largest residual of an inlier
  double stop_m = 0.0005;          ///< a step smaller than this has converged
  double stop_rad = 0.0002;
  int min_pairs = 10;
  double degenerate_ratio = 0.03;  ///< share of the normals' scatter below which a direction is not constrained
  double sigma_floor_m = 0.01;     ///< lower limit of the standard deviation of the residuals
  /// Neighbouring points have correlated errors: far fewer than n are independent.
  double covariance_inflation = 10.0;
  double search_m = 1.0;    ///< correlative search: half width of the window
  double search_rad = 0.5;  ///< half width of the window in heading
  double search_step_m = 0.1;
  double search_step_rad = 0.035;
  std::size_t search_points = 60;
  double search_ratio = 0.35;  ///< share of the points that a pose must explain
  /// Additional share for each unit of chi-square between the pose and the expected one.
  double surprise_share = 0.02;
  double max_surprise_share = 0.3;  ///< upper limit of the additional share
  std::size_t search_starts = 3;    ///< number of poses that match_widely() refines
  /// Share of the inliers above which match_widely() keeps the guess along a degenerate direction.
  double kept_share = 0.9;
  double weighed_m = 0.02;  ///< distance from the guess below which weighed() accepts a match unchanged
};

/// A match with its evidence.
struct MatchResult {
  Pose2 map_T_base;
  Matrix3 covariance =
      Matrix3::Zero();  ///< covariance of (x, y, theta) in the frame `map`; very large along a degenerate direction
  int pairs = 0;        ///< number of points with a correspondence
  int inliers = 0;      ///< number of pairs with a small residual
  double inlier_ratio = 0.0;  ///< inliers / points given
  double rms_m = 0.0;         ///< root mean square residual of the inliers
  bool converged = false;
  /// Unit vector along which the scan does not constrain the pose (a corridor).
  std::optional<Point2> degenerate_direction;
};

class ScanMatcher {
 public:
  explicit ScanMatcher(const MatchParams& params = {}) : params_(params) {}

  /// Point-to-line ICP (Censi 2008) from `guess`, with Huber weights and a shrinking gate. Along a degenerate direction
  /// the guess is kept.
  [[nodiscard]] MatchResult match(const ReferenceCloud& reference, const std::vector<OrientedPoint>& points_base,
                                  const Pose2& guess) const;
  /// Checks `found` against the guess by the cost of the points at both: a few points with wrong correspondences, as
  /// along a corridor into unknown space, pull the robot back to where more is known, and the gradient at the match
  /// alone makes it appear certain. Where the points hardly prefer `found`, returns the match that keeps the guess
  /// along that direction.
  [[nodiscard]] MatchResult weighed(const ReferenceCloud& reference, const std::vector<OrientedPoint>& points_base,
                                    const Pose2& guess, MatchResult found) const;
  /// Matching after a gap of up to search_m / search_rad: returns the best of the match `from_guess` and of those from
  /// the poses that a search of the whole window finds on the coarse grid. `covariance` is that of the guess, of (x, y,
  /// theta) in the frame `map`: the less a pose was expected, the more points it must explain. Along a degenerate
  /// direction the guess is kept, as long as it keeps most of the inliers: a search would pull the robot back along a
  /// corridor to where more of it is known.
  [[nodiscard]] MatchResult match_widely(const ReferenceCloud& reference, const std::vector<OrientedPoint>& points_base,
                                         const Pose2& guess, const Matrix3& covariance, MatchResult from_guess) const;
  [[nodiscard]] const MatchParams& params() const { return params_; }

 private:
  [[nodiscard]] MatchResult iterate(const ReferenceCloud& reference, const std::vector<OrientedPoint>& points_base,
                                    const Pose2& guess, const std::optional<Point2>& held) const;
  struct Expected {
    Pose2 map_T_base;
    Matrix3 information;
  };
  [[nodiscard]] std::vector<Pose2> search(const ReferenceCloud& reference,
                                          const std::vector<OrientedPoint>& points_base,
                                          const Expected& expected) const;
  /// Returns `found`, or the match with the guess's position along its degenerate direction.
  [[nodiscard]] MatchResult kept_along(const ReferenceCloud& reference, const std::vector<OrientedPoint>& points_base,
                                       const Pose2& guess, MatchResult found) const;
  /// The share of the points that a pose must explain in addition to the expected one.
  [[nodiscard]] double handicap(const Expected& expected, const Pose2& pose) const;

  MatchParams params_;
};

}  // namespace seeker::slam
