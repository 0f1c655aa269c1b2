/// \file
/// The SPmap: robot and line segments of its surroundings in one extended Kalman filter (spec S1.1-S1.10; Castellanos &
/// Tardos). Values in, values out; every call is deterministic.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "common/core/pose2.hpp"
#include "common/core/scan.hpp"
#include "server/lines/observation.hpp"
#include "server/slam/sp_params.hpp"

namespace seeker::slam {

/// Unique identifier of a segment, never reused in one map.
using SegmentId = std::uint64_t;

/// 2 to 4 rows in the order (p_y, p_theta, p_left, p_right) of spec eq (7); a virtual end has no row.
using SegmentCovariance = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 4, 4>;

/// A wall of the map (spec S1.2): frame at the mid-point, x along it, y from free space into the wall; left end at
/// x = -L/2, right end at +L/2.
struct SpSegment {
  SegmentId id = 0;
  Pose2 map_T_segment;
  double length_m = 0.0;
  std::array<bool, 2> real{};   ///< whether the end is a real one, by lines::Side
  int hits = 0;                 ///< number of scans in which it was paired
  int misses = 0;               ///< number of scans in a row that looked through it
  std::uint64_t created = 0;    ///< number of the scan (SpMap::scans) that created it
  std::uint64_t last_seen = 0;  ///< number of the scan that observed it last
};

/// Result of the association of one observation.
enum class SpVerdict : std::uint8_t {
  kPaired,     ///< paired with `segment`
  kNew,        ///< no segment of the map is near: it may become a new one
  kAmbiguous,  ///< fits a segment alone, but not together with the other pairs
  kRejected,   ///< near a segment but outside its gate, or not a valid observation
};

struct SpMatch {
  SpVerdict verdict = SpVerdict::kNew;
  SegmentId segment = 0;
  double d2 = 0.0;             ///< squared Mahalanobis distance of (y, theta), eq (13); for kRejected the smallest one
  std::array<bool, 2> ends{};  ///< whether the end is used, too, by lines::Side
};

/// A hypothesis of the association; matches[i] belongs to observation i.
struct Association {
  std::vector<SpMatch> matches;
  double joint_d2 = 0.0;
  int dof = 0;
  int nodes = 0;        ///< number of nodes of the search; 0 where the association was unambiguous
  bool capped = false;  ///< the search was terminated early: the best set so far
};

/// How well the pairs of the last update constrain the robot, without any prior: sum of H^T R^-1 H.
struct Observability {
  Matrix3 information = Matrix3::Zero();  ///< information of d_R (robot frame)
  /// Standard deviation of the position in the worst direction; infinity where it is not constrained.
  double weak_sigma_m = 0.0;
  Point2 weak_direction = Point2::UnitX();     ///< that direction, unit vector in the frame `map`
  std::optional<Point2> degenerate_direction;  ///< the worst direction, where weak_sigma_m exceeds the parameter
};

struct SpMerge {
  SegmentId kept = 0;
  SegmentId gone = 0;
};

/// Summary of one update.
struct SpUpdateReport {
  int paired = 0;
  int ends = 0;  ///< number of endpoint rows used
  int ambiguous = 0;
  int rejected = 0;
  int iterations = 0;
  double d2 = 0.0;  ///< squared innovation of all rows used
  int dof = 0;      ///< degrees of freedom of d2
  std::vector<SegmentId> created;
  std::vector<SpMerge> merged;
  std::vector<SegmentId> lost;  ///< removed because their ends met
};

struct SpState;

/// Frame conventions: poses are map_T_base, `map` being the map's own frame. The covariance of the robot is that of
/// d_R of spec eq (4), map_T_base (+) d_R: expressed in the frame `base`, unless a name says `_map`.
class SpMap {
 public:
  SpMap(const Pose2& map_T_base, const Matrix3& covariance, const SpMapParams& params = {});
  SpMap(const SpMap& other);
  SpMap& operator=(const SpMap& other);
  SpMap(SpMap&&) noexcept;
  SpMap& operator=(SpMap&&) noexcept;
  ~SpMap();

  /// Predicts a motion by `increment` = old_T_new (spec eqs (10), (11)); `covariance` is of d in old_T_new (+) d, that
  /// is in the frame of the new pose. Several increments add up as in S1.3: C <- J{(-)u} C J{(-)u}^T + C_u.
  void predict(const Pose2& increment, const Matrix3& covariance);

  /// Associates each observation with a segment (spec S1.6).
  [[nodiscard]] Association associate(const std::vector<lines::SegmentObservation>& observations) const;
  /// Processes one scan: corrects robot and segments by the pairs, extends segments, adds new ones and merges.
  /// `association` is of the same observations and of this map since the last update.
  SpUpdateReport update(const std::vector<lines::SegmentObservation>& observations, const Association& association);
  /// Removes segments that several scans have looked through and returns their ids. Call it after update().
  std::vector<SegmentId> observe_free_space(const LaserScan& scan);
  /// Applies a measured pose (of a point matcher) with `covariance_map` of (x, y, theta) in the frame `map` as in
  /// PoseEstimate. Along a degenerate direction (unit vector in `map`) the measurement is not used. Returns the squared
  /// Mahalanobis distance of the used part. Segments whose ends meet by it are removed. The measurement must not be
  /// derived from the scan of an update().
  double observe_pose(const Pose2& map_T_base, const Matrix3& covariance_map,
                      const std::optional<Point2>& degenerate_direction = std::nullopt);
  /// The squared Mahalanobis distance of such a measurement, without applying it.
  [[nodiscard]] double pose_d2(const Pose2& map_T_base, const Matrix3& covariance_map,
                               const std::optional<Point2>& degenerate_direction = std::nullopt) const;

  /// Sets the robot's pose independently of the map, for re-entry and relocalisation.
  void set_robot(const Pose2& map_T_base, const Matrix3& covariance);
  /// Removes a segment. False when it does not exist.
  bool forget(SegmentId id);

  [[nodiscard]] const Pose2& robot() const;
  [[nodiscard]] Matrix3 robot_covariance() const;  ///< covariance of d_R: frame `base`
  /// Covariance of (x, y, theta) in the frame `map`, as in PoseEstimate.
  [[nodiscard]] Matrix3 robot_covariance_map() const;

  [[nodiscard]] const std::vector<SpSegment>& segments() const;  ///< in the order of their ids
  [[nodiscard]] const SpSegment* find(SegmentId id) const;       ///< null when it does not exist
  [[nodiscard]] SegmentCovariance segment_covariance(SegmentId id) const;
  [[nodiscard]] Eigen::MatrixXd segment_robot_covariance(SegmentId id) const;  ///< rows of the segment x 3 of d_R
  /// The whole covariance: 3 rows of d_R, then the rows of every segment in the order of segments().
  [[nodiscard]] Eigen::MatrixXd covariance() const;
  /// The covariance of the robot and these segments, in the order given. Every id must be of this map.
  [[nodiscard]] Eigen::MatrixXd joint_covariance(const std::vector<SegmentId>& ids) const;
  [[nodiscard]] const Observability& observability() const;  ///< of the last update
  [[nodiscard]] std::uint64_t scans() const;                 ///< number of updates so far
  [[nodiscard]] const SpMapParams& params() const;

 private:
  std::unique_ptr<SpState> state_;
};

/// Covariance of d_R (frame `base`) from that of (x, y, theta) in the frame `map`, and back.
[[nodiscard]] Matrix3 to_base_frame(const Matrix3& covariance_map, const Pose2& map_T_base);
[[nodiscard]] Matrix3 to_map_frame(const Matrix3& covariance_base, const Pose2& map_T_base);

}  // namespace seeker::slam
