/// \file
/// Line SLAM: the SPmap of the place around the robot, points as its safety net, and a graph of such places.
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

/// Sums over all scans, for reports.
struct LineSlamCounts {
  std::uint64_t scans = 0;
  std::uint64_t still = 0;     ///< the robot had not moved: not used,
  std::uint64_t stood = 0;     ///< but for the lines of these
  std::uint64_t lines = 0;     ///< observations
  std::uint64_t paired = 0;    ///< with a segment
  std::uint64_t searched = 0;  ///< scans after a gap or a poor match
  std::uint64_t unbelieved = 0;
  std::uint64_t corridor = 0;  ///< scans that said nothing along one direction
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
  /// All that are kept: those of the map, and the robot's own that are not part of it.
  [[nodiscard]] std::size_t local_maps() const { return backend_.maps().size(); }

 private:
  struct Scan;  ///< one scan as the steps below see it

  void begin(const Pose2& map_T_base, RobotTime stamp);
  [[nodiscard]] Status check_repeats(const LaserScan& scan);
  /// A mirrored scanner would build a map of a mirrored building.
  [[nodiscard]] Status check_direction();
  /// Since the last scan that was looked at.
  [[nodiscard]] bool odometry_jumped() const;
  [[nodiscard]] bool stands_still(const LaserScan& scan) const;
  /// Since the scan before that was looked at, in the frame of `base` there; covariance in that of `base` now.
  [[nodiscard]] UncertainPose expected_motion(const PoseEstimate& travelled, bool silent, double dt_s);
  void note_way(const Pose2& motion);
  /// One more scan of a stand.
  void look_again(const LaserScan& scan);
  /// Every update of the lines is a new revision of the map.
  SpUpdateReport update_lines(const std::vector<lines::SegmentObservation>& observations,
                              const Association& association);
  void learn_odometry(const MatchResult& match, const Matrix3& covariance);
  void follow(Scan& scan);
  [[nodiscard]] MatchResult match_points(Scan& scan);
  [[nodiscard]] bool believable(const Scan& scan, const MatchResult& match);
  void correct(Scan& scan, const MatchResult& match);
  void use_points(const Scan& scan, const MatchResult& match);
  void use_leftover(const Scan& scan, const Association& association);
  void note_failure(const Scan& scan);
  void note_quality(const MatchResult& match);
  void keep(const Scan& scan, double known);
  /// With `carried` keyframes of the present one, by which the next scans are matched.
  void begin_next_map(RobotTime stamp, std::size_t carried);
  void store_local_map();
  [[nodiscard]] bool map_is_full() const;
  void start_local_map();
  void look_for_robot();
  [[nodiscard]] std::vector<SeenPoints> seen_lately() const;
  /// Of the whole map; one that cannot be searched is not made ready again at every try.
  [[nodiscard]] const Result<PlaceMap>& whole_place();
  /// Of what shows the surroundings of a place.
  [[nodiscard]] const Result<PlaceMap>& place_about(const Pose2& map_T_base);
  [[nodiscard]] Result<PlaceAnswer> find_place(const std::vector<SeenPoints>& seen);
  void forget_places();
  void settle(const PlaceAnswer& answer);
  void append_newest(std::vector<MapSegment>& all) const;

  LineSlamParams params_;
  lines::FastExtractor extractor_;
  ScanMatcher matcher_;
  ScanMatcher far_matcher_;
  OdometryScale odometry_scale_;
  OdometryBias odometry_bias_;
  UnseenMotion unseen_;
  TurnSense turn_sense_;
  JumpWitness jump_;
  OdometryTracker travelled_;     ///< since the last scan: its pose is the increment
  std::unique_ptr<SpMap> lines_;  ///< of the newest local map, in its frame
  LocalCloud cloud_;              ///< in the same frame
  MapBackend backend_;
  LocalisationQuality quality_ = LocalisationQuality::kUnknown;
  std::string cause_;
  std::optional<RobotTime> last_scan_;
  RobotTime used_stamp_;              ///< of the last scan: since then the motion is to be found
  std::vector<float> newest_ranges_;  ///< of the last scan,
  std::vector<float> used_ranges_;    ///< and of the last that was not taken for one more of the same
  int stood_ = 0;                     ///< scans of this stand that were used
  bool repeated_ = false;             ///< the last scan was that before it once more, noise and all
  int repeats_ = 0;                   ///< so often while the robot drove
  int failures_ = 0;
  bool matched_ = false;  ///< the last scan that was looked at fitted the map
  double way_m_ = 0.0;    ///< driven in the newest local map
  double way_since_loops_m_ = 0.0;
  double way_since_kept_m_ = 0.0;         ///< since kept_map_T_node_ was told
  double way_since_leftover_m_ = 0.0;     ///< driven since points on no line were used,
  double turn_since_leftover_rad_ = 0.0;  ///< and turned
  std::uint64_t revision_ = 0;
  std::uint64_t next_id_ = 1;
  // Looking for the robot in a map; the places are there only meanwhile.
  PlaceRecogniser recogniser_;
  std::unique_ptr<Result<PlaceMap>> whole_place_;
  std::unique_ptr<Result<PlaceMap>> near_place_;
  Pose2 near_place_at_;  ///< what near_place_ is about
  std::string search_cause_;
  std::optional<Pose2> hint_map_T_node_;  ///< where the newest local map lies by what somebody has named
  std::optional<Pose2> kept_map_T_node_;  ///< where the newest local map lies if the robot began it where it stood
  Pose2 last_try_;                        ///< node_T_base
  int scans_since_try_ = 0;
  int tries_ = 0;
  PlaceClaim claim_;
  LineSlamCounts counts_;
};

}  // namespace seeker::slam
