/// \file
/// Line SLAM: an SPmap of the surroundings of the robot, point matching as a safety net, and a graph of local maps.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "server/slam/line_slam_params.hpp"
#include "server/slam/map_backend.hpp"
#include "server/slam/map_tracker.hpp"
#include "server/slam/sp_map.hpp"

namespace seeker::slam {

/// Totals over all scans, for reports.
struct LineSlamCounts {
  std::uint64_t scans = 0;
  std::uint64_t still = 0;       ///< scans that were not used because the robot had not moved
  std::uint64_t stood = 0;       ///< scans of a standing robot whose lines were used
  std::uint64_t lines = 0;       ///< line observations
  std::uint64_t paired = 0;      ///< observations that were associated with a segment
  std::uint64_t searched = 0;    ///< scans after a gap or a poor match, for which a wider search was made
  std::uint64_t unbelieved = 0;  ///< scans whose match was rejected
  std::uint64_t corridor = 0;    ///< scans that do not constrain the pose along one direction
};

/// Predicts by odometry, corrects by lines (SPmap EKF, spec S1.1-S1.10) and by points, closes loops between local maps.
/// A scan costs the same however large the building is; closing a loop costs time in the number of local maps.
///
/// Quality: kLocalised; kDegraded with its cause (corridor, unseen space, odometry jump, a scan that does not fit);
/// kLost after `lost_after` scans that contradict the map, searching on until one fits again.
class LineSlam final : public MapTracker {
 public:
  explicit LineSlam(const LineSlamParams& params = {}, const Pose2& map_T_base = {});

  [[nodiscard]] Status predict(const Pose2& odom_T_base, RobotTime stamp) override;
  [[nodiscard]] Status update(const LaserScan& scan) override;
  [[nodiscard]] PoseEstimate estimate() const override;
  void reset(const Pose2& map_T_base) override;

  [[nodiscard]] std::vector<MapSegment> segments() const override;
  [[nodiscard]] std::uint64_t revision() const override { return revision_; }
  [[nodiscard]] std::optional<LocalBelief> local_belief() const override;
  [[nodiscard]] std::vector<MapPiece> pieces() const override { return backend_.pieces(); }
  [[nodiscard]] LineMap map() const override;
  [[nodiscard]] Status load(const LineMap& map, MapUse use) override;
  [[nodiscard]] Status relocalise(const std::optional<Pose2>& map_T_base) override;
  [[nodiscard]] Status look_where_it_stood(const Pose2& map_T_base) override;
  void for_each_scan(const std::function<void(const LaserScan&, const Pose2&)>& visit) const override;

  [[nodiscard]] const LineSlamCounts& counts() const { return counts_; }
  [[nodiscard]] const LoopCounts& loops() const { return backend_.loops(); }
  [[nodiscard]] const SpMap& local_map() const { return *lines_; }
  /// Number of all stored local maps: those of the map and the robot's own that are not part of it.
  [[nodiscard]] std::size_t local_maps() const { return backend_.maps().size(); }

 private:
  struct Scan;  ///< one scan as the steps below process it

  void begin(const Pose2& map_T_base, RobotTime stamp);
  [[nodiscard]] Status check_repeats(const LaserScan& scan);
  /// Detects a mirrored scanner, which would build a map of a mirrored building.
  [[nodiscard]] Status check_direction();
  /// Whether the odometry has jumped since the last scan that was used.
  [[nodiscard]] bool odometry_jumped() const;
  [[nodiscard]] bool stands_still(const LaserScan& scan) const;
  /// Whether the next observation is not due yet: LineSlamParams::observation_period_s.
  [[nodiscard]] bool is_early(const LaserScan& scan);
  /// The motion since the last scan that was used, in the frame of `base` at that scan; its covariance is in the frame
  /// of `base` now.
  [[nodiscard]] UncertainPose expected_motion(const PoseEstimate& travelled, bool silent, double dt_s);
  void note_distance(const Pose2& motion);
  /// Uses the lines of one more scan of a standing robot.
  void look_again(const LaserScan& scan);
  [[nodiscard]] bool uses_points() const { return params_.points.use != PointUse::kOff; }
  /// Updates the lines; every update is a new revision of the map.
  SpUpdateReport update_lines(const std::vector<lines::SegmentObservation>& observations,
                              const Association& association);
  void learn_odometry(const MatchResult& match, const Matrix3& covariance);
  void follow(Scan& scan);
  /// Follows by the lines alone.
  void follow_lines(const std::vector<lines::SegmentObservation>& observations, const LaserScan& scan);
  [[nodiscard]] MatchResult match_points(Scan& scan);
  [[nodiscard]] bool believable(const Scan& scan, const MatchResult& match);
  void correct(Scan& scan, const MatchResult& match);
  void use_points(const Scan& scan, const MatchResult& match);
  void use_leftover(const Scan& scan, const Association& association);
  void note_failure(const Scan& scan);
  void note_quality(const MatchResult& match);
  void keep(const Scan& scan, double known);
  /// Begins the next local map with `carried` keyframes of the present one, against which the next scans are matched.
  void begin_next_map(RobotTime stamp, std::size_t carried);
  void store_local_map();
  [[nodiscard]] bool map_is_full() const;
  void start_local_map();
  /// Searches for the place of a robot that has lost it, where it has.
  void recover_place();
  void look_for_robot();
  [[nodiscard]] std::vector<SeenPoints> seen_lately() const;
  /// The whole map, ready for a search; a map that cannot be searched is not prepared again at every attempt.
  [[nodiscard]] const Result<PlaceMap>& whole_place();
  /// The part of the map that shows the surroundings of a pose, ready for a search.
  [[nodiscard]] const Result<PlaceMap>& place_about(const Pose2& map_T_base);
  [[nodiscard]] Result<PlaceAnswer> find_place(const std::vector<SeenPoints>& seen);
  void forget_places();
  void settle(const PlaceAnswer& answer);
  void append_newest(std::vector<MapSegment>& all) const;

  LineSlamParams params_;
  std::unique_ptr<lines::Extractor> extractor_;
  lines::RangeNoise noise_;  ///< of the last scan whose lines were extracted
  ScanMatcher matcher_;
  ScanMatcher far_matcher_;
  OdometryScale odometry_scale_;
  OdometryBias odometry_bias_;
  UnseenMotion unseen_;
  RotationSense rotation_sense_;
  JumpWitness jump_;
  OdometryTracker travelled_;     ///< dead reckoning since the last scan: its pose is the increment
  std::unique_ptr<SpMap> lines_;  ///< filter of the newest local map, in its frame
  LocalCloud cloud_;              ///< points of the keyframes, in the same frame
  MapBackend backend_;
  LocalisationQuality quality_ = LocalisationQuality::kUnknown;
  std::string cause_;
  std::optional<RobotTime> last_scan_;
  Pose2 at_last_scan_;                ///< motion from the last scan that was used to the last scan
  RobotTime used_stamp_;              ///< time of the last scan that was used, from which on the motion is estimated
  std::vector<float> newest_ranges_;  ///< ranges of the last scan
  std::vector<float> used_ranges_;    ///< ranges of the last scan that was not a repetition
  int stood_ = 0;                     ///< number of scans used since the robot stands still
  bool repeated_ = false;             ///< the last scan equalled the one before it, noise included
  int repeats_ = 0;                   ///< number of such repetitions while the robot drove
  int failures_ = 0;
  bool matched_ = false;     ///< the last scan that was used matched the map
  double distance_m_ = 0.0;  ///< path length driven in the newest local map
  double distance_since_loops_m_ = 0.0;
  double distance_since_kept_m_ = 0.0;        ///< path length since kept_map_T_node_ was given
  double distance_since_leftover_m_ = 0.0;    ///< path length since points on no line were used
  double rotation_since_leftover_rad_ = 0.0;  ///< rotation since points on no line were used
  std::uint64_t revision_ = 0;
  std::uint64_t next_id_ = 1;
  // State of relocalisation; the searchable maps exist only meanwhile.
  PlaceRecogniser recogniser_;
  std::unique_ptr<Result<PlaceMap>> whole_place_;
  std::unique_ptr<Result<PlaceMap>> near_place_;
  Pose2 near_place_at_;  ///< centre of near_place_
  std::string search_cause_;
  /// Pose of the newest local map according to a pose that was named by the user.
  std::optional<Pose2> hint_map_T_node_;
  std::optional<Pose2> kept_map_T_node_;  ///< pose of the newest local map if the robot began it at its stored pose
  Pose2 last_try_;                        ///< pose of the robot at the last attempt, node_T_base
  int scans_since_try_ = 0;
  int tries_ = 0;
  PlaceClaim claim_;
  LineSlamCounts counts_;
};

}  // namespace seeker::slam
