/// \file
/// Matches a scan against reference points: point-to-line ICP with its covariance.
#pragma once

#include <optional>
#include <vector>

#include "server/slam/reference_cloud.hpp"

namespace seeker::slam {

struct MatchParams {
  int max_iterations = 15;
  double first_gate_m = 0.5;       ///< correspondences may be so far apart at first,
  double last_gate_m = 0.12;       ///< and so far at the end
  double gate_shrink = 0.6;        ///< per iteration
  double min_normal_cosine = 0.7;  ///< surfaces must face the same way
  double huber_m = 0.03;           ///< residuals beyond it weigh less
  double inlier_m = 0.10;          ///< residual of an inlier
  double stop_m = 0.0005;          ///< converged below this step
  double stop_rad = 0.0002;
  int min_pairs = 10;
  double degenerate_ratio = 0.03;      ///< share of the normals' scatter below which a direction is not seen
  double sigma_floor_m = 0.01;         ///< residual deviation is never believed to be smaller
  double covariance_inflation = 10.0;  ///< neighbouring points share their errors: far fewer than n are independent
  double search_m = 1.0;               ///< correlative search: window to either side
  double search_rad = 0.5;
  double search_step_m = 0.1;
  double search_step_rad = 0.035;
  std::size_t search_points = 60;
  double search_ratio = 0.35;    ///< share of the points that a place must explain
  double surprise_share = 0.02;  ///< ... and so much more for each unit of chi-square it lies off the expected place,
  double max_surprise_share = 0.3;  ///< but no more than this
  std::size_t search_starts = 3;    ///< places that match_widely() looks at closely
  double kept_share = 0.9;          ///< of the inliers: see match_widely()
  double weighed_m = 0.02;          ///< off the guess: nearer matches are not looked at by weighed()
};

/// A match that explains itself.
struct MatchResult {
  Pose2 map_T_base;
  Matrix3 covariance =
      Matrix3::Zero();        ///< of (x, y, theta) in the frame `map`; very large along a degenerate direction
  int pairs = 0;              ///< points with a partner
  int inliers = 0;            ///< pairs with a small residual
  double inlier_ratio = 0.0;  ///< inliers / points given
  double rms_m = 0.0;         ///< of the inliers
  bool converged = false;
  std::optional<Point2> degenerate_direction;  ///< unit vector along which the scan says nothing (a corridor)
};

class ScanMatcher {
 public:
  explicit ScanMatcher(const MatchParams& params = {}) : params_(params) {}

  /// Point-to-line ICP (Censi 2008) from `guess`, Huber weights, shrinking gate. Along a degenerate direction the
  /// guess is kept.
  [[nodiscard]] MatchResult match(const ReferenceCloud& reference, const std::vector<OrientedPoint>& points_base,
                                  const Pose2& guess) const;
  /// `found` with what its points really say of the way from the guess to it, by what they cost at both: a few that
  /// meet a wrong partner, as along a corridor into new space, pull the robot back to where more is known, and the
  /// slope at the match alone makes it look certain. Where they hardly prefer `found`, the match that keeps the guess
  /// along there.
  [[nodiscard]] MatchResult weighed(const ReferenceCloud& reference, const std::vector<OrientedPoint>& points_base,
                                    const Pose2& guess, MatchResult found) const;
  /// After a gap of up to search_m / search_rad: the best of the match `from_guess` and of those from the places that a
  /// search of the whole window finds on the coarse grid. `covariance` of the guess, of (x, y, theta) in the frame
  /// `map`: the less a place was to be expected, the more points it must explain. Along a degenerate direction the
  /// guess is kept here too, as long as it keeps most of the inliers: a search would pull the robot back along a
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
  /// `found`, or the match with the guess's place along its degenerate direction.
  [[nodiscard]] MatchResult kept_along(const ReferenceCloud& reference, const std::vector<OrientedPoint>& points_base,
                                       const Pose2& guess, MatchResult found) const;
  /// Share of the points that a place must explain beyond the expected one.
  [[nodiscard]] double handicap(const Expected& expected, const Pose2& pose) const;

  MatchParams params_;
};

}  // namespace seeker::slam
