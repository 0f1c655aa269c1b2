/// \file
/// The points of the keyframes around the robot, against which a scan is matched.
#pragma once

#include <memory>
#include <vector>

#include "server/slam/oriented_points.hpp"
#include "server/slam/reference_cloud.hpp"

namespace seeker::slam {

struct LocalCloudParams {
  std::size_t keyframe_points = 360;   ///< number of points that a keyframe keeps
  double keyframe_distance_m = 0.5;    ///< a keyframe is added where none is closer than this
  double keyframe_rotation_rad = 0.6;  ///< or has a heading within this angle
  /// Share of known points of a scan below which a keyframe is added at the smaller distances below. Otherwise new
  /// surfaces are associated with old points for as long as the robot is near a keyframe, which holds its estimate back
  /// there.
  double known_share = 0.75;
  double new_view_distance_m = 0.15;
  double new_view_rotation_rad = 0.2;
  std::size_t local_keyframes = 10;  ///< number of keyframes matched against: the cost does not grow with the map
  double local_range_m = 8.0;        ///< largest distance of these keyframes
  double rebuild_m = 0.4;            ///< the local set is chosen again after this motion
  double rebuild_rad = 0.4;          ///< or after this rotation
  std::size_t max_keyframes = 4000;  ///< limit of the stored keyframes; the oldest is dropped beyond it
};

/// True when the two poses differ by more than a limit.
[[nodiscard]] bool moved(const Pose2& from, const Pose2& to, double distance_limit_m, double rotation_limit_rad);

/// Keyframes with their points; the nearest of them form the reference. The cost per scan is O(1) in the size of the
/// map apart from the choice of the nearest.
class LocalCloud {
 public:
  explicit LocalCloud(const LocalCloudParams& params = {}) : params_(params) {}

  [[nodiscard]] bool empty() const { return keyframes_.empty(); }
  [[nodiscard]] std::size_t size() const { return keyframes_.size(); }
  /// True where no keyframe is near with a similar heading. The distance depends on `known`, the share (0 to 1) of the
  /// scan's points that were found in the reference.
  [[nodiscard]] bool needs_keyframe(const Pose2& map_T_base, double known = 1.0) const;
  void add(const Pose2& map_T_base, const std::vector<OrientedPoint>& points_base);
  /// The reference around the pose, updated after motion. Requires a call of add() before.
  [[nodiscard]] const ReferenceCloud& around(const Pose2& map_T_base);
  /// Transforms everything into another frame and keeps at most `limit` keyframes, those nearest to the pose (in the
  /// new frame).
  void move_to(const Pose2& new_T_old, const Pose2& new_T_base, std::size_t limit);
  void clear();

 private:
  struct Keyframe {
    Pose2 map_T_base;
    std::vector<OrientedPoint> points_map;
  };

  /// Keyframes within local_range_m with their distances.
  [[nodiscard]] std::vector<std::pair<double, const Keyframe*>> nearest_first(const Pose2& map_T_base) const;
  void choose(const Pose2& map_T_base);

  LocalCloudParams params_;
  std::vector<Keyframe> keyframes_;
  std::unique_ptr<ReferenceCloud> reference_;
  Pose2 reference_pose_;
};

}  // namespace seeker::slam
