/// \file
/// Value of one alternative: the objective of the active-SLAM paper (spec S1.11, eqs (18)-(22)).
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "server/explore/one_step_params.hpp"
#include "server/explore/segment_sight.hpp"
#include "server/slam/map_tracker.hpp"

namespace seeker::explore {

/// A motion with its noise: covariance of d in `increment` (+) d.
struct PredictedMotion {
  Pose2 increment;
  Matrix3 covariance = Matrix3::Zero();
};

/// A control held for `tau_s`: increments and noise of the control periods add up as in spec S1.3.
[[nodiscard]] PredictedMotion predict_motion(const Twist2& control, double tau_s, const slam::OdometryParams& odometry);

/// One wall as it will be observed.
struct PredictedSight {
  std::size_t wall = 0;  ///< index into Belief::walls()
  SeenPart part;
};

class PredictedBelief;

/// Present estimate of robot and walls. It must not outlive the filter that it was made from, because joint() reads it.
class Belief {
 public:
  /// Robot and walls of the filter; the walls' shapes are in the frame `map`.
  explicit Belief(const slam::LocalBelief& filter);
  /// For estimators without a joint covariance: each wall is independent. `covariance_map` as in PoseEstimate; at most
  /// `max_walls` of the segments are used, those nearest to the robot.
  Belief(const Pose2& map_T_base, const Matrix3& covariance_map, const std::vector<MapSegment>& segments,
         std::size_t max_walls);

  [[nodiscard]] const std::vector<SightWall>& walls() const { return walls_; }
  /// Joint covariance of the robot and these walls (indices into walls()), ready for predictions. The
  /// result is a value.
  [[nodiscard]] PredictedBelief joint(const std::vector<std::size_t>& walls) const;

 private:
  const slam::SpMap* filter_ = nullptr;
  std::vector<std::uint64_t> ids_;  ///< ids in the filter
  std::vector<SightWall> walls_;
  std::vector<Matrix2> covariances_;  ///< covariances of the walls when there is no filter
  std::vector<double> sizes_;         ///< sqrt(det C_i), by wall
  double all_sizes_ = 0.0;
  Matrix3 robot_ = Matrix3::Zero();  ///< covariance of d_R, frame `base`
};

/// Predicted joint covariance of the robot and some walls. Moving and observing cost O(n^2) in the number of rows.
class PredictedBelief {
 public:
  /// Predicts a motion by eq (11).
  void move(const PredictedMotion& motion);
  /// Covariance update of S1.7 with nominal observations from `map_T_base`. Observations of walls outside the joint are
  /// ignored.
  void observe(const Belief& belief, const Pose2& map_T_base, const std::vector<PredictedSight>& sights,
               const SensorModel& sensor);
  /// U of eq (19), over all walls of the belief; walls outside the joint count with their present covariance.
  [[nodiscard]] double uncertainty() const;
  /// Covariance of d_R, frame `base`.
  [[nodiscard]] Matrix3 robot_covariance() const { return p_.topLeftCorner<3, 3>(); }

 private:
  friend class Belief;
  struct Block {
    std::size_t wall = 0;
    Eigen::Index at = 0;
    Eigen::Index rows = 2;
  };

  Eigen::MatrixXd p_;
  std::vector<Block> blocks_;
  double other_sizes_ = 0.0;  ///< sum of sqrt(det C_i) of the walls outside the joint
};

/// The walls of the belief that a view observes, the nearest ones first, at most `max_observed`.
[[nodiscard]] std::vector<PredictedSight> predict_sights(const Belief& belief, const SightView& view, int max_observed);

/// U_min of eq (18): "the uncertainty of the sensor model". It is constant for one map, so that it does not affect
/// decisions.
[[nodiscard]] double least_uncertainty(const Belief& belief, const SensorModel& sensor);

struct Terms {
  double j1 = 0.0;
  double j21 = 0.0;
  double j22 = 0.0;
  double lg_j1 = 0.0;
  double lg_j21 = 0.0;  ///< logarithm of max(j21, log_floor)
  double lg_j22 = 0.0;
  double score = 0.0;  ///< J of eq (22)

  /// Whether neither a wall nor a wall end would be gained.
  [[nodiscard]] bool gains_nothing(double log_floor) const { return j21 <= log_floor && j22 <= log_floor; }
};

/// Eqs (18)-(22) from the predictions. The denominators of (20) and (21) run over the walls of the scene, that is
/// around the robot, or as printed over all of the map (OneStepParams::all_segments).
[[nodiscard]] Terms combine(double least_uncertainty, double uncertainty, const Growth& growth, const SightScene& scene,
                            const OneStepParams& params);

/// Values of several motions from one place, each followed by one observation.
[[nodiscard]] std::vector<Terms> evaluate(const Pose2& map_T_base, const std::vector<PredictedMotion>& motions,
                                          const SightScene& scene, const Belief& belief, const OneStepParams& params);

}  // namespace seeker::explore
