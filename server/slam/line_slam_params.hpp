/// \file
/// Parameters of line SLAM: one set for every building and every laser.
#pragma once

#include "server/lines/fast_extractor.hpp"
#include "server/lines/observation.hpp"
#include "server/slam/jump_witness.hpp"
#include "server/slam/local_cloud.hpp"
#include "server/slam/loop_detector.hpp"
#include "server/slam/odometry_bias.hpp"
#include "server/slam/odometry_scale.hpp"
#include "server/slam/odometry_tracker.hpp"
#include "server/slam/place_claim.hpp"
#include "server/slam/place_recogniser.hpp"
#include "server/slam/scan_matcher.hpp"
#include "server/slam/seen_through.hpp"
#include "server/slam/segment_fusion.hpp"
#include "server/slam/sp_params.hpp"
#include "server/slam/turn_sense.hpp"
#include "server/slam/unseen_motion.hpp"

namespace seeker::slam {

/// Which points of a scan correct the pose besides its lines.
enum class PointUse : std::uint8_t {
  kNone,      ///< lines only, as the paper has it; points still verify and bridge gaps
  kLeftover,  ///< points that lie on no line: independent of the lines, so the covariance stays honest
  kAll,       ///< every point
};

struct PointNetParams {
  PointUse use = PointUse::kLeftover;
  NormalParams normals;
  MatchParams match;
  LocalCloudParams cloud;
  std::size_t match_points = 180;  ///< points of a scan that are matched
  /// Points on no line correct the pose once in so much way or turn: matches from one place err alike.
  double leftover_m = 0.05;
  double leftover_rad = 0.1;
  /// A robot that all points find farther than this from where the odometry has it is moved there before its lines are
  /// paired: so far off a line may meet the wrong wall, or the wrong end of the right one.
  double first_m = 0.1;
  double first_rad = 0.05;
  double good_ratio = 0.5;     ///< inlier ratio that needs no second look
  double accept_ratio = 0.25;  ///< below it the match is not believed
  double gap_m = 0.3;          ///< way since the last scan beyond which a poor match is searched for
  double gap_rad = 0.2;
  double new_space_ratio = 0.5;  ///< fewer points than this near known ones: unseen space, not a contradiction
  SeenThroughParams through;
  double denied_ratio = 0.1;      ///< a scan that goes through less of what is known contradicts nothing either
  double max_correction_m = 1.2;  ///< a match farther from the prediction is not believed
  double max_correction_rad = 0.6;
  double sure_ratio = 0.6;  ///< ... unless it explains so many points
  /// Without a gap those after it must say the same: through a door a scan shows little of what is known, and a corner
  /// of it fits the wrong wall well.
  JumpParams jump;
  double far_m = 2.5;  ///< half width of the second search, after a gap that the first one did not bridge
  double far_rad = 0.8;
  double far_ratio = 0.5;             ///< share of the points that a place found by it must explain
  std::size_t carried_keyframes = 6;  ///< of one local map into the next
  double map_sigma_m = 0.005;         ///< error of the keyframes themselves, added to every match
  double map_sigma_rad = 0.002;
};

/// When a local map is full and the next one begins: what keeps the cost of a scan flat however large the building.
struct LocalMapParams {
  double max_way_m = 10.0;  ///< driven in it
  std::size_t max_segments = 120;
  double keyframe_distance_m = 0.25;  ///< scans kept for occupancy, loops and relocalisation
  double keyframe_turn_rad = 0.35;
  /// What the way from one to the next may be off, beside the filter's covariance: real scanners are not set quite
  /// straight and floors not quite level, so a local map bends.
  double joint_sigma_m = 0.03;
  double joint_sigma_rad = 0.01;
};

/// When loops between local maps are looked for and what makes one believed.
struct LoopPolicy {
  LoopParams detector;
  /// Coarse: the match that follows is exact, and a local map is made ready in few milliseconds.
  PlaceMapParams place{.pyramid = {.resolution_m = 0.08, .reach_m = 0.24}, .free_space = {}};
  double every_m = 2.0;             ///< looked for after so much way
  double max_distance_m = 4.0;      ///< between the robot and a keyframe of the other map, as the graph has them
  int max_candidates = 3;           ///< local maps looked at each time, nearest first
  std::size_t query_keyframes = 8;  ///< the newest ones, compared with a whole local map
  /// Points farther from their scanner are not compared: glimpses through doors make places large and tell little.
  double view_range_m = 12.0;
  std::size_t cached_places = 16;  ///< local maps that are kept ready for comparison
  /// A loop that moves the map by more than its uncertainty says (3 dof, 99 %) waits for others that agree with it.
  double surprise_chi2 = 11.345;
  std::size_t witnesses = 2;     ///< loops that must agree on a surprise, seen by scans that they do not share
  std::size_t max_pending = 12;  ///< the oldest is forgotten
  /// Share of beams, where the robot is thought to be, that go through walls of an older local map or end where it is
  /// free: from this on, and when no loop is found, the map contradicts the scans. On recorded logs hardly any where
  /// the place is right, half of them where it is wrong.
  double contradiction = 0.4;
  double kernel_width = 3.0;  ///< deviations beyond which a loop loses its say
  double moved_m = 0.01;      ///< the map has a new epoch when the robot moves by more than this
  double moved_rad = 0.002;
};

/// Finding the robot in a map it was not followed in.
struct RelocaliseParams {
  PlaceMapParams map;
  PlaceParams place;
  double every_m = 0.3;              ///< looked for after so much way,
  double every_rad = 0.5;            ///< or turn,
  int every_scans = 20;              ///< or so many scans
  std::size_t query_keyframes = 12;  ///< the newest ones together are the view
  double hint_m = 1.0;               ///< half width of the search about a place that somebody has named
  double hint_rad = 0.5;
  int hint_tries = 15;  ///< after so many the robot is looked for everywhere
  ClaimParams claim;
  int max_tries = 30;           ///< then the robot is lost: it is not in this map
  double joint_sigma_m = 0.03;  ///< of the place found, beside the match's covariance
  double joint_sigma_rad = 0.01;
  int lost_scans = 40;  ///< a robot that is lost for so long is looked for everywhere
  /// So is one that follows its scans well while a map that is only read contradicts them so often in a row.
  int contradictions = 5;
};

/// Errors of observed walls that are not noise of the laser: skirting boards, crooked plaster, beams that err together.
inline constexpr lines::ObservationParams kRealWalls{.wall_sigma_m = 0.02, .wall_sigma_rad = 0.02};

struct LineSlamParams {
  OdometryParams odometry;
  OdometryScaleParams odometry_scale;
  OdometryBiasParams odometry_bias;
  UnseenMotionParams unseen;
  TurnSenseParams turn_sense;
  lines::FastParams extractor;
  lines::ObservationParams observation = kRealWalls;
  SpMapParams lines;
  PointNetParams points;
  LocalMapParams local;
  LoopPolicy loops;
  RelocaliseParams relocalise;
  FusionParams fusion;
  double min_move_m = 0.02;  ///< a scan after less motion than this says nothing new
  double min_turn_rad = 0.01;
  /// ... unless more than this share of its ranges changed by more than this and their noise,
  double still_range_m = 0.04;
  double still_share = 0.15;
  double silent_share = 0.03;  ///< or this share by more than their noise, where the wheels have said nothing so far
  /// So many scans of a stand still correct the lines, since their noise is new each time.
  int stand_scans = 30;
  int lost_after = 10;    ///< consecutive scans without a believed match
  int repeats_fault = 3;  ///< so many equal scans while the robot moves: the laser repeats itself
};

}  // namespace seeker::slam
