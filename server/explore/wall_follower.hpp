/// \file
/// Leaves a local trap along the walls, using the map (spec S1.12, steps 1-3).
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
  std::optional<Twist2> control;   ///< nothing: the path along the walls has ended
  std::optional<Point2> goal_map;  ///< the open end that the path leads to
  std::string failure;             ///< why the path has ended
};

/// Follows one wall after the other, at a set distance, towards an open end. The caller closes ends that turn out to
/// lead nowhere (by making them real) and decides when to leave (step 4).
class WallFollower {
 public:
  WallFollower(const OneStepParams& step, const WallParams& params);

  /// Chooses wall and direction; false: there is no wall, or no path along the walls leads to an open end (both costs
  /// are infinite) and WallParams::whole_lap is false.
  [[nodiscard]] bool start(const Pose2& map_T_base, const std::vector<MapSegment>& segments);
  [[nodiscard]] WallChoice decide(const Pose2& map_T_base, const std::vector<MapSegment>& segments,
                                  const ControlCheck& check);
  [[nodiscard]] WallSide side() const { return side_; }
  [[nodiscard]] std::uint64_t followed() const { return followed_; }

 private:
  /// The curve that the robot should follow: a line along a wall, or a circle about an end.
  struct Track {
    Pose2 map_T_line;  ///< frame on the line to follow, x in the direction of travel
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
  /// The segment that continues the followed one. On a whole lap it counts only once the robot is on its free side.
  [[nodiscard]] std::optional<std::size_t> next_segment(const Pose2& map_T_base,
                                                        const std::vector<MapSegment>& segments,
                                                        std::size_t followed) const;
  /// Whether the segment ends ahead without another one that continues it, so that the robot rounds its end.
  [[nodiscard]] bool ends_loose(const Pose2& map_T_base, const std::vector<MapSegment>& segments,
                                std::size_t followed) const;
  /// Whether the robot is back where it first reached the line along a wall.
  [[nodiscard]] bool lap_is_over(const Pose2& map_T_base, const MapSegment& followed);
  /// Why the path along the walls has ended; empty: it goes on. `route` leads to the open end.
  [[nodiscard]] std::string end_of_path(const Pose2& map_T_base, const std::vector<MapSegment>& segments,
                                        std::size_t followed, const std::optional<WallRoute>& route);

  OneStepParams step_;
  WallParams params_;
  WallSide side_ = WallSide::kLeft;
  std::uint64_t followed_ = 0;           ///< id of the followed segment
  std::vector<Point2> places_;           ///< robot positions at the last decisions, frame `map`
  std::optional<Point2> lap_start_map_;  ///< where the lap began; nothing: the robot has not reached its line yet
  bool lap_begun_ = false;               ///< whether the robot has left that place since
};

}  // namespace seeker::explore
