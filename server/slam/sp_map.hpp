/// \file
/// The SPmap: robot and line segments of one place in one extended Kalman filter (spec S1.1-S1.10; Castellanos &
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

/// Never used twice in one map.
using SegmentId = std::uint64_t;

/// 2 to 4 rows in the order (p_y, p_theta, p_left, p_right) of spec eq (7); a virtual end has no row.
using SegmentCovariance = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 4, 4>;

/// A wall of the map (spec S1.2): frame at the mid-point, x along it, y from free space into the wall; left end at
/// x = -L/2, right end at +L/2.
struct SpSegment {
  SegmentId id = 0;
  Pose2 map_T_segment;
  double length_m = 0.0;
  std::array<bool, 2> real{};   ///< by lines::Side
  int hits = 0;                 ///< scans in which it was paired
  int misses = 0;               ///< scans in a row that looked through it
  std::uint64_t created = 0;    ///< number of the scan (SpMap::scans) that made it
  std::uint64_t last_seen = 0;  ///< number of the scan that saw it last
};

/// What became of one observation.
enum class SpVerdict : std::uint8_t {
  kPaired,     ///< with `segment`
  kNew,        ///< nothing of the map is near: it may become a segment
  kAmbiguous,  ///< fits a segment alone, but not together with the other pairs
  kRejected,   ///< near to a segment but outside its gate, or not a valid observation
};

struct SpMatch {
  SpVerdict verdict = SpVerdict::kNew;
  SegmentId segment = 0;
  double d2 = 0.0;             ///< squared Mahalanobis distance of (y, theta): eq (13); of kRejected the smallest one
  std::array<bool, 2> ends{};  ///< by lines::Side: the ends are used too
};

/// A hypothesis of pairs; matches[i] belongs to observation i.
struct Association {
  std::vector<SpMatch> matches;
  double joint_d2 = 0.0;
  int dof = 0;
  int nodes = 0;        ///< visited by the search; 0 where nothing was ambiguous
  bool capped = false;  ///< the search was cut off: the best set so far
};

/// How well the pairs of the last update hold the robot, apart from any prior: sum of H^T R^-1 H.
struct Observability {
  Matrix3 information = Matrix3::Zero();       ///< of d_R (robot frame)
  double weak_sigma_m = 0.0;                   ///< of the position in the worst direction; infinity: not held at all
  Point2 weak_direction = Point2::UnitX();     ///< that direction, unit vector in the frame `map`
  std::optional<Point2> degenerate_direction;  ///< the same, where weak_sigma_m is over the parameter
};

struct SpMerge {
  SegmentId kept = 0;
  SegmentId gone = 0;
};

/// What one update did.
struct SpUpdateReport {
  int paired = 0;
  int ends = 0;  ///< endpoint rows used
  int ambiguous = 0;
  int rejected = 0;
  int iterations = 0;
  double d2 = 0.0;  ///< innovation of all rows used, and how many
  int dof = 0;
  std::vector<SegmentId> created;
  std::vector<SpMerge> merged;
  std::vector<SegmentId> lost;  ///< forgotten because their ends met
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

  /// The robot moved by `increment` = old_T_new (spec eqs (10), (11)); `covariance` is of d in old_T_new (+) d, that
  /// is in the frame of the new pose. Several increments add up as S1.3 says: C <- J{(-)u} C J{(-)u}^T + C_u.
  void predict(const Pose2& increment, const Matrix3& covariance);

  /// Which segment each observation is (spec S1.6).
  [[nodiscard]] Association associate(const std::vector<lines::SegmentObservation>& observations) const;
  /// One scan: corrects robot and segments by the pairs, lets segments grow, adds new ones, merges.
  /// `association` is of the same observations and of this map since the last update.
  SpUpdateReport update(const std::vector<lines::SegmentObservation>& observations, const Association& association);
  /// Segments that the scan looks through are gone after some scans; their ids. Call it after update().
  std::vector<SegmentId> observe_free_space(const LaserScan& scan);
  /// A measured pose (of a point matcher), `covariance_map` of (x, y, theta) in the frame `map` as in PoseEstimate.
  /// With a degenerate direction (unit vector in `map`) nothing is taken along it. Gives the squared Mahalanobis
  /// distance of what was used. Segments whose ends meet by it are forgotten. The measurement must not rest on the same
  /// scan as an update().
  double observe_pose(const Pose2& map_T_base, const Matrix3& covariance_map,
                      const std::optional<Point2>& degenerate_direction = std::nullopt);
  /// That distance without using the measurement.
  [[nodiscard]] double pose_d2(const Pose2& map_T_base, const Matrix3& covariance_map,
                               const std::optional<Point2>& degenerate_direction = std::nullopt) const;

  /// Puts the robot somewhere, independent of the map: re-entry, relocalisation.
  void set_robot(const Pose2& map_T_base, const Matrix3& covariance);
  /// False: no such segment.
  bool forget(SegmentId id);

  [[nodiscard]] const Pose2& robot() const;
  [[nodiscard]] Matrix3 robot_covariance() const;      ///< of d_R: frame `base`
  [[nodiscard]] Matrix3 robot_covariance_map() const;  ///< of (x, y, theta) in the frame `map`, as in PoseEstimate

  [[nodiscard]] const std::vector<SpSegment>& segments() const;  ///< in the order of their ids
  [[nodiscard]] const SpSegment* find(SegmentId id) const;       ///< null: no such segment
  [[nodiscard]] SegmentCovariance segment_covariance(SegmentId id) const;
  [[nodiscard]] Eigen::MatrixXd segment_robot_covariance(SegmentId id) const;  ///< rows of the segment x 3 of d_R
  /// All of it: 3 rows of d_R, then the rows of every segment in the order of segments().
  [[nodiscard]] Eigen::MatrixXd covariance() const;
  /// The part of it for the robot and these segments, in the order given. Every id must be of this map.
  [[nodiscard]] Eigen::MatrixXd joint_covariance(const std::vector<SegmentId>& ids) const;
  [[nodiscard]] const Observability& observability() const;  ///< of the last update
  [[nodiscard]] std::uint64_t scans() const;                 ///< updates so far
  [[nodiscard]] const SpMapParams& params() const;

 private:
  std::unique_ptr<SpState> state_;
};

/// Covariance of d_R (frame `base`) from that of (x, y, theta) in the frame `map`, and back.
[[nodiscard]] Matrix3 to_base_frame(const Matrix3& covariance_map, const Pose2& map_T_base);
[[nodiscard]] Matrix3 to_map_frame(const Matrix3& covariance_base, const Pose2& map_T_base);

}  // namespace seeker::slam
