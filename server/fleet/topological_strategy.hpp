/// \file
/// Topological exploration (spec S4.4): a node at the robot's position, goals from its space tree, the main goal first,
/// and the return along the topology's edges to the closest node with a goal when this one has none.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "server/explore/explore_params.hpp"
#include "server/explore/strategy.hpp"
#include "server/fleet/goal_choice.hpp"

namespace seeker::fleet {

struct TopologicalParams {
  TopologyParams map;
  AuctionParams auction;
  int max_failures = 2;          ///< number of failed drives to one goal after which it counts as unreachable
  double retry_s = 20.0;         ///< time after a failed drive during which other goals are preferred
  double replan_period_s = 2.0;  ///< period at which goals are checked again while driving
  double scan_limit_s = 5.0;     ///< time without a scan after which the exploration fails
  /// Difference of the path lengths from which on a goal is taken over from another robot.
  double takeover_m = 3.0;
  double patience_s = 10.0;  ///< waiting time for others to take goals nearer to them while none of them drives
};

/// Refuses invalid values.
[[nodiscard]] Status validate(const TopologicalParams& params);

/// Drives along planned paths like every other strategy; it differs by the choice of goals. A robot whose scanner has a
/// limited field of view rotates at the first node, and once more when no goal is left. Unlike in the paper, drives end
/// as near to a goal as the map leads, since a goal may lie beyond the area cleared by a scanner without returns.
class TopologicalStrategy final : public explore::ExploreStrategy {
 public:
  TopologicalStrategy(const explore::ExploreParams& params, const TopologicalParams& topological);

  [[nodiscard]] explore::StrategyStep step(const explore::StrategyInput& input) override;
  void interrupted(RobotTime now) override;
  void transform(const MapMove& move) override;
  [[nodiscard]] const Topology* topology() const override { return &map_.topology(); }
  [[nodiscard]] std::optional<Point2> target_map() const override;
  [[nodiscard]] std::optional<TopologyMemory> memory() const override;
  void remember(const TopologyMemory& memory) override;

 private:
  using Input = explore::StrategyInput;
  using Step = explore::StrategyStep;
  enum class State : std::uint8_t { kChoose, kRotate, kGoal, kPath, kWait, kDone };

  /// Map, passable corridors and other robots of one step.
  struct Scene {
    std::shared_ptr<const nav::FloorView> floor;
    Corridors corridors;
    const FleetView& fleet;
  };
  /// A goal that a drive has not reached.
  struct Failure {
    Point2 p_map;
    int count = 0;
    RobotTime at;
  };

  [[nodiscard]] std::optional<Scene> look(const Input& input) const;
  void choose(const Input& input, Step& out);
  [[nodiscard]] ChoiceInput question(const Input& input, const Scene& scene) const;
  void wait_or_finish(const Input& input, const GoalChoice& choice, Step& out);
  void wait(const Input& input, std::string why);
  void finish(std::string why, Step& out);

  void go(const Input& input, const Scene& scene, PendingGoal goal);
  void go_to_goal(const Input& input, const Scene& scene);
  [[nodiscard]] std::optional<Point2> nearest_on_line(const Input& input, const nav::CostMap& cost) const;
  [[nodiscard]] std::optional<Point2> nearest_now(const Input& input, const Scene& scene) const;
  [[nodiscard]] double short_of_goal_m() const;
  [[nodiscard]] bool is_nearer(const std::optional<Point2>& aim_map) const;
  void drive(const Input& input, Step& out);
  void pass(const Input& input, const Scene& scene, Step& out);
  void reconsider(const Input& input, const Scene& scene, Step& out);
  void arrived(const Input& input, const Scene& scene, Step& out);
  void failed(const Input& input, const Scene* scene, const std::string& why);
  void drop_goal();
  void change(std::string why, Step& out);

  void begin_rotation(const Input& input, std::string why);
  void rotate(const Input& input, Step& out);

  void look_again(const Input& input, const Scene& scene);
  void create_node(const Input& input, const Scene& scene);
  void note_place(const Input& input, const Scene& scene);
  [[nodiscard]] bool settle_goal(const Scene& scene);
  [[nodiscard]] bool goal_settled(const Scene& scene) const;
  [[nodiscard]] bool another_is_at(const Point2& p_map, const Scene& scene) const;
  [[nodiscard]] std::vector<UnreachablePlace> given_up(const Input& input) const;
  [[nodiscard]] bool left_out(const Point2& p_map, RobotTime now) const;
  [[nodiscard]] bool resting(RobotTime now) const;
  [[nodiscard]] bool patient(RobotTime now) const;

  explore::ExploreParams params_;
  TopologicalParams topological_;
  TopologyMap map_;
  nav::PlannedDriver driver_;
  State state_ = State::kChoose;
  std::string why_;
  std::string published_;  ///< cause of the last published decision
  std::optional<PendingGoal> goal_;
  Point2 aim_map_ = Point2::Zero();  ///< of kGoal: the goal, or the nearest reachable position
  std::vector<Failure> failures_;
  /// Goals of others that were settled, or observed from the nearest reachable position.
  std::vector<Point2> done_map_;
  RobotTime since_;                          ///< begin of the present state
  std::optional<RobotTime> all_idle_since_;  ///< since when this robot and those that it waits for are idle
  RobotTime considered_;                     ///< when the goal was last checked again
  std::optional<RobotTime> scan_at_;
  std::optional<std::uint64_t> rotated_at_;  ///< node (0: none) at which the robot last rotated
  double rotated_rad_ = 0.0;
  double rotate_until_rad_ = 0.0;
  double looked_rad_ = 0.0;  ///< rotation at which it last observed
  double heading_rad_ = 0.0;
};

}  // namespace seeker::fleet
