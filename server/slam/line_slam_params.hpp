/// \file
/// Parameters of line SLAM: one set for every building and every laser.
#pragma once

#include "server/lines/make_extractor.hpp"
#include "server/lines/observation.hpp"
#include "server/slam/jump_witness.hpp"
#include "server/slam/local_cloud.hpp"
#include "server/slam/loop_detector.hpp"
#include "server/slam/odometry_bias.hpp"
#include "server/slam/odometry_scale.hpp"
#include "server/slam/odometry_tracker.hpp"
#include "server/slam/place_claim.hpp"
#include "server/slam/place_recogniser.hpp"
#include "server/slam/rotation_sense.hpp"
#include "server/slam/scan_matcher.hpp"
#include "server/slam/seen_through.hpp"
#include "server/slam/segment_fusion.hpp"
#include "server/slam/sp_params.hpp"
#include "server/slam/unseen_motion.hpp"

namespace seeker::slam {

/// Which points of a scan correct the pose besides its lines.
enum class PointUse : std::uint8_t {
  kOff,       ///< lines alone, as in the paper: no match verifies a scan, bridges a gap or closes a loop
  kNone,      ///< lines only correct the pose; points still verify and bridge gaps
  kLeftover,  ///< points that lie on no line: independent of the lines, so that the covariance stays consistent
  kAll,       ///< every point
};

struct PointNetParams {
  PointUse use = PointUse::kLeftover;
  NormalParams normals;
  MatchParams match;
  LocalCloudParams cloud;
  std::size_t match_points = 180;  ///< number of points of a scan that are matched
  /// Points on no line correct the pose once per this path length or rotation: matches from one place have correlated
  /// errors.
  double leftover_m = 0.05;
  double leftover_rad = 0.1;
  /// When all points place the robot farther than this from its odometry, the pose is corrected before lines are
  /// associated: with so large an error a line may be associated with the wrong wall, or the wrong end of the right
  /// one.
  double first_m = 0.1;
  double first_rad = 0.05;
  double good_ratio = 0.5;     ///< inlier ratio above which no wider search is made
  double accept_ratio = 0.25;  ///< inlier ratio below which the match is rejected
  double gap_m = 0.3;          ///< path length since the last scan beyond which a poor match is searched for
  double gap_rad = 0.2;        ///< rotation since the last scan beyond which a poor match is searched for
  /// Share of points near known ones below which the scan shows unknown space rather than a contradiction.
  double new_space_ratio = 0.5;
  SeenThroughParams through;
  double denied_ratio = 0.1;      ///< share of known points seen through below which a scan does not contradict the map
  double max_correction_m = 1.2;  ///< a match farther from the prediction is rejected
  double max_correction_rad = 0.6;
  double sure_ratio = 0.6;  ///< a match with this share of inliers is accepted in spite of the limits above
  /// Without a gap the following scans must confirm a jump: through a door a scan shows little of what is known, and a
  /// corner of it fits the wrong wall well.
  JumpParams jump;
  double far_m = 2.5;      ///< half width of the second search, after a gap that the first one did not bridge
  double far_rad = 0.8;    ///< half width in heading of the second search
  double far_ratio = 0.5;  ///< share of the points that a pose found by the second search must explain
  std::size_t carried_keyframes = 6;  ///< number of keyframes of one local map that are carried into the next
  double map_sigma_m = 0.005;         ///< error of the keyframes themselves, added to every match
  double map_sigma_rad = 0.002;
};

/// When a local map is full and the next one begins, which bounds the cost of a scan however large the building is.
struct LocalMapParams {
  double max_distance_m = 10.0;  ///< path length driven in a local map
  std::size_t max_segments = 120;
  /// Distance between scans kept for occupancy, loop closure and relocalisation.
  double keyframe_distance_m = 0.25;
  double keyframe_rotation_rad = 0.35;  ///< rotation between these scans
  /// Error of the relation between consecutive local maps, added to the filter's covariance: real scanners are not
  /// mounted quite straight and floors are not quite level, so that a local map is distorted.
  double joint_sigma_m = 0.03;
  double joint_sigma_rad = 0.01;
};

/// When loops between local maps are searched for and which loops are accepted.
struct LoopPolicy {
  LoopParams detector;
  /// Coarse, since the match that follows is exact and a local map is then prepared in few milliseconds.
  PlaceMapParams place{.pyramid = {.resolution_m = 0.08, .reach_m = 0.24}, .free_space = {}};
  double every_m = 2.0;             ///< path length between two searches for loops
  double max_distance_m = 4.0;      ///< largest distance in the graph between the robot and a keyframe of the other map
  int max_candidates = 3;           ///< number of local maps that are compared at each search, nearest first
  std::size_t query_keyframes = 8;  ///< number of newest keyframes that are compared with a whole local map
  /// Points farther from their scanner are not compared: glimpses through doors make places large and hold little
  /// information.
  double view_range_m = 12.0;
  std::size_t cached_places = 16;  ///< number of local maps that are kept ready for comparison
  /// A loop that moves the map by more than its uncertainty says (3 dof, 99 %) waits for others that agree with it.
  double surprise_chi2 = 11.345;
  /// Number of loops that must agree on a surprising one, seen by scans that they do not share.
  std::size_t witnesses = 2;
  std::size_t max_pending = 12;  ///< number of loops that wait for others; the oldest is dropped beyond it
  /// Share of beams at the estimated pose that pass through walls of an older local map or end where it is free, from
  /// which on the map contradicts the scans when no loop is found. On recorded logs hardly any beam does where the pose
  /// is right, and half of them where it is wrong.
  double contradiction = 0.4;
  double kernel_width = 3.0;  ///< residual, in standard deviations, beyond which a loop loses its weight
  double moved_m = 0.01;      ///< displacement of the robot by an optimisation from which on the map has a new epoch
  double moved_rad = 0.002;   ///< rotation of the robot from which on the map has a new epoch
};

/// How a map stops growing where the robot drives through a building that it knows.
struct KnownGroundParams {
  /// Number of stored scans up to which everything is kept. Beyond it a finished local map that shows nothing new is
  /// emptied: its pose and one relation to an older one stay, and the path leads past it.
  std::size_t max_keyframes = 4000;
  /// A scan shows nothing new when an older local map has one from within this distance and rotation.
  double within_m = 0.5;
  double within_rad = 0.5;
  /// Nor does it when the nearest few older local maps show this share of its points, and of the floor before them.
  double known_share = 0.9;
  std::size_t compared_maps = 4;  ///< number of those
  /// Share of beams that the older local map contradicts, from which on the place has changed and the scans are kept.
  double disagreement = 0.1;
};

/// Global relocalisation: localisation in a map without a known initial pose.
struct RelocaliseParams {
  PlaceMapParams map;
  PlaceParams place;
  double every_m = 0.3;              ///< path length between two attempts
  double every_rad = 0.5;            ///< rotation between two attempts
  int every_scans = 20;              ///< number of scans between two attempts
  std::size_t query_keyframes = 12;  ///< number of newest keyframes that form the query together
  double hint_m = 1.0;               ///< half width of the search about a pose named by the user
  double hint_rad = 0.5;             ///< half width in heading of that search
  int hint_tries = 15;               ///< number of attempts after which the whole map is searched
  ClaimParams claim;
  int max_tries = 30;           ///< number of attempts after which the robot is lost: it is not in this map
  double joint_sigma_m = 0.03;  ///< error of the pose found, added to the covariance of the match
  double joint_sigma_rad = 0.01;
  int lost_scans = 40;  ///< number of scans a robot is lost before the whole map is searched
  /// The whole map is also searched when a map that is only read contradicts so many scans in a row, although they
  /// match the robot's own map.
  int contradictions = 5;
};

/// Errors of observed walls that are not noise of the laser: skirting boards, crooked plaster and correlated errors of
/// beams.
inline constexpr lines::ObservationParams kRealWalls{.wall_sigma_m = 0.02, .wall_sigma_rad = 0.02};

struct LineSlamParams {
  OdometryParams odometry;
  OdometryScaleParams odometry_scale;
  OdometryBiasParams odometry_bias;
  UnseenMotionParams unseen;
  RotationSenseParams rotation_sense;
  /// In a robot file the section `lines`, because every estimator that uses lines shares it.
  lines::ExtractorParams extractor;
  lines::ObservationParams observation = kRealWalls;
  SpMapParams lines;
  PointNetParams points;
  LocalMapParams local;
  LoopPolicy loops;
  KnownGroundParams known_ground;
  RelocaliseParams relocalise;
  FusionParams fusion;
  /// Time from one observation to the next, as in the paper's stop-and-go: before it is over, only a scan of a robot
  /// that has come to a stop is used. 0: every scan is.
  double observation_period_s = 0.0;
  double min_move_m = 0.02;        ///< a scan after less motion than this is not used
  double min_rotation_rad = 0.01;  ///< or after less rotation than this
  /// Such a scan is used when more than this share of its ranges changed by more than this and their noise.
  double still_range_m = 0.04;
  double still_share = 0.15;
  /// The same share, of changes beyond the noise, while the wheels have reported no motion so far.
  double silent_share = 0.03;
  /// Number of scans of a standing robot that still correct the lines, since their noise is independent.
  int stand_scans = 30;
  int lost_after = 10;    ///< consecutive scans without an accepted match
  int repeats_fault = 3;  ///< number of equal scans of a moving robot that show that the laser repeats itself
};

}  // namespace seeker::slam
