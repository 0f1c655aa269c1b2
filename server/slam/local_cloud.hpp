/// \file
/// The points of the keyframes around the robot: what a scan is matched against.
#pragma once

#include <memory>
#include <vector>

#include "server/slam/oriented_points.hpp"
#include "server/slam/reference_cloud.hpp"

namespace seeker::slam {

struct LocalCloudParams {
  std::size_t keyframe_points = 360;  ///< points a keyframe keeps
  double keyframe_distance_m = 0.5;   ///< a new keyframe where none is nearer than this
  double keyframe_turn_rad = 0.6;     ///< or looks the same way to within this
  /// Nearer than that, too, where a scan shows so much that no keyframe has: share of its points that are known. Else
  /// what is new meets old points for as long as the robot is near a keyframe, and holds it back there.
  double known_share = 0.75;
  double new_view_distance_m = 0.15;
  double new_view_turn_rad = 0.2;
  std::size_t local_keyframes = 10;  ///< keyframes matched against: cost does not grow with the map
  double local_range_m = 8.0;        ///< none of them farther away
  double rebuild_m = 0.4;            ///< the local set is chosen anew after so much motion
  double rebuild_rad = 0.4;
  std::size_t max_keyframes = 4000;  ///< the oldest is forgotten beyond it
};

/// True when the two poses differ by more than a limit.
[[nodiscard]] bool moved(const Pose2& from, const Pose2& to, double distance_limit_m, double turn_limit_rad);

/// Keyframes with their points; the nearest of them form the reference. O(1) per scan in the size of the map apart from
/// the choice of the nearest.
class LocalCloud {
 public:
  explicit LocalCloud(const LocalCloudParams& params = {}) : params_(params) {}

  [[nodiscard]] bool empty() const { return keyframes_.empty(); }
  [[nodiscard]] std::size_t size() const { return keyframes_.size(); }
  /// True where no keyframe is near and looks the same way, as near as is asked for where only `known` (0 to 1) of the
  /// scan's points were found in the reference.
  [[nodiscard]] bool needs_keyframe(const Pose2& map_T_base, double known = 1.0) const;
  void add(const Pose2& map_T_base, const std::vector<OrientedPoint>& points_base);
  /// The reference around the pose; call after motion. Not before the first add().
  [[nodiscard]] const ReferenceCloud& around(const Pose2& map_T_base);
  /// Expresses everything in another frame and keeps at most `limit` keyframes, those nearest to the pose (in the new
  /// frame).
  void move_to(const Pose2& new_T_old, const Pose2& new_T_base, std::size_t limit);
  void clear();

 private:
  struct Keyframe {
    Pose2 map_T_base;
    std::vector<OrientedPoint> points_map;
  };

  /// Those within local_range_m.
  [[nodiscard]] std::vector<std::pair<double, const Keyframe*>> nearest_first(const Pose2& map_T_base) const;
  void choose(const Pose2& map_T_base);

  LocalCloudParams params_;
  std::vector<Keyframe> keyframes_;
  std::unique_ptr<ReferenceCloud> reference_;
  Pose2 reference_pose_;
};

}  // namespace seeker::slam
