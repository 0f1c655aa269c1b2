/// \file
/// Out of a local trap along the walls, by the map (spec S1.12, steps 1-3).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "server/explore/control_check.hpp"
#include "server/explore/one_step_params.hpp"
#include "server/explore/strategy.hpp"
#include "server/explore/wall_graph.hpp"

namespace seeker::explore {

struct WallChoice {
  ExploreDecision decision;
  std::optional<Twist2> control;   ///< nothing: the way along the walls has ended
  std::optional<Point2> goal_map;  ///< the open end it leads to
  std::string failure;             ///< why it has ended
};

/// Follows one wall after the other, at a distance, towards an open end. The caller closes ends that turn out to lead
/// nowhere (by making them real) and decides when to leave (step 4).
class WallFollower {
 public:
  WallFollower(const OneStepParams& step, const WallParams& params);

  /// Chooses wall and direction; false: no way along the walls leads to an open end (both costs are infinite).
  [[nodiscard]] bool start(const Pose2& map_T_base, const std::vector<MapSegment>& segments);
  [[nodiscard]] WallChoice decide(const Pose2& map_T_base, const std::vector<MapSegment>& segments,
                                  const ControlCheck& check);
  [[nodiscard]] WallSide side() const { return side_; }
  [[nodiscard]] std::uint64_t followed() const { return followed_; }

 private:
  /// Where the robot should be: on a line along a wall, or on a circle about an end.
  struct Track {
    Pose2 map_T_line;  ///< x in the direction of travel, on the line that is to be followed
    std::optional<Point2> pivot_map;
  };

  [[nodiscard]] std::optional<std::size_t> find_followed(const Pose2& map_T_base,
                                                         const std::vector<MapSegment>& segments) const;
  [[nodiscard]] std::size_t switch_segment(const Pose2& map_T_base, const std::vector<MapSegment>& segments,
                                           std::size_t followed) const;
  [[nodiscard]] Track track_of(const Pose2& map_T_base, const std::vector<MapSegment>& segments,
                               std::size_t followed) const;
  [[nodiscard]] double error(const Track& track, const Pose2& map_T_base) const;
  [[nodiscard]] double heading_error_rad(const Track& track, const Pose2& map_T_base) const;
  void choose_control(const Track& track, const Pose2& map_T_base, const ControlCheck& check, WallChoice& choice) const;
  [[nodiscard]] bool gets_nowhere(const Pose2& map_T_base);

  OneStepParams step_;
  WallParams params_;
  WallSide side_ = WallSide::kLeft;
  std::uint64_t followed_ = 0;  ///< id of a segment
  std::vector<Point2> places_;  ///< of the last decisions, frame `map`
};

}  // namespace seeker::explore
