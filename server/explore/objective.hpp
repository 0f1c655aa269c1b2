/// \file
/// What one alternative is worth: the objective of the active-SLAM paper (spec S1.11, eqs (18)-(22)).
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

/// What is known of robot and walls now. Must not outlive the filter it came from, which joint() reads.
class Belief {
 public:
  /// Robot and walls of the filter; the walls' shapes are in the frame `map`.
  explicit Belief(const slam::LocalBelief& filter);
  /// For estimators that keep no joint covariance: every wall for itself. `covariance_map` as in PoseEstimate; at most
  /// `max_walls` of the segments, nearest to the robot.
  Belief(const Pose2& map_T_base, const Matrix3& covariance_map, const std::vector<MapSegment>& segments,
         std::size_t max_walls);

  [[nodiscard]] const std::vector<SightWall>& walls() const { return walls_; }
  /// Joint covariance of the robot and these walls (indices into walls()), ready for predictions. The
  /// result is a value.
  [[nodiscard]] PredictedBelief joint(const std::vector<std::size_t>& walls) const;

 private:
  const slam::SpMap* filter_ = nullptr;
  std::vector<std::uint64_t> ids_;  ///< in the filter
  std::vector<SightWall> walls_;
  std::vector<Matrix2> covariances_;  ///< without a filter
  std::vector<double> sizes_;         ///< sqrt(det C_i), by wall
  double all_sizes_ = 0.0;
  Matrix3 robot_ = Matrix3::Zero();  ///< of d_R, frame `base`
};

/// Robot and some walls in the future. Moving and observing cost O(n^2) in their rows.
class PredictedBelief {
 public:
  /// Eq (11).
  void move(const PredictedMotion& motion);
  /// The covariance update of S1.7 with nominal observations from `map_T_base`. Sights of walls that are not in the
  /// joint are left out.
  void observe(const Belief& belief, const Pose2& map_T_base, const std::vector<PredictedSight>& sights,
               const SensorModel& sensor);
  /// U of eq (19), over all walls of the belief; those outside the joint as they are.
  [[nodiscard]] double uncertainty() const;
  [[nodiscard]] Matrix3 robot_covariance() const { return p_.topLeftCorner<3, 3>(); }  ///< of d_R, frame `base`

 private:
  friend class Belief;
  struct Block {
    std::size_t wall = 0;
    Eigen::Index at = 0;
    Eigen::Index rows = 2;
  };

  Eigen::MatrixXd p_;
  std::vector<Block> blocks_;
  double other_sizes_ = 0.0;  ///< of the walls outside
};

/// What a look observes of the belief's walls, the nearest ones first, at most `max_observed`.
[[nodiscard]] std::vector<PredictedSight> predict_sights(const Belief& belief, const SightView& view, int max_observed);

/// U_min of eq (18): "the uncertainty of the sensor model". Constant for one map, so that it decides nothing.
[[nodiscard]] double least_uncertainty(const Belief& belief, const SensorModel& sensor);

struct Terms {
  double j1 = 0.0;
  double j21 = 0.0;
  double j22 = 0.0;
  double lg_j1 = 0.0;
  double lg_j21 = 0.0;  ///< of max(j21, log_floor)
  double lg_j22 = 0.0;
  double score = 0.0;  ///< J of eq (22)

  /// Neither a wall nor an end to be gained.
  [[nodiscard]] bool gains_nothing(double log_floor) const { return j21 <= log_floor && j22 <= log_floor; }
};

/// Eqs (18)-(22) from what was predicted. The sums of (20) and (21) run over the walls of the scene, that is around the
/// robot: over a whole building they would sink below the floor of the logarithm with every wall gained.
[[nodiscard]] Terms combine(double least_uncertainty, double uncertainty, const Growth& growth, const SightScene& scene,
                            const OneStepParams& params);

/// Motions from one place, each ending in one look.
[[nodiscard]] std::vector<Terms> evaluate(const Pose2& map_T_base, const std::vector<PredictedMotion>& motions,
                                          const SightScene& scene, const Belief& belief, const OneStepParams& params);

}  // namespace seeker::explore
