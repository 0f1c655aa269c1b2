/// \file
/// Exploring by topology (spec S4.4): a node where the robot stands, goals from its space tree, the main goal first,
/// back along the topology's edges to the closest node with a goal when this one has none.
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
  int max_failures = 2;          ///< drives to one goal that failed: then no way leads there
  double retry_s = 20.0;         ///< after a failed drive other goals are tried first for so long
  double replan_period_s = 2.0;  ///< goals are looked at again this often while driving
  double scan_limit_s = 5.0;     ///< without a scan for longer it gives up
  double takeover_m = 3.0;       ///< of a goal that another robot drives to, by one with so much shorter a way
  double patience_s = 10.0;      ///< waiting for others to take what they are nearer to while none of them drives
};

/// Refuses values that make no sense.
[[nodiscard]] Status validate(const TopologicalParams& params);

/// Drives over planned paths like every other strategy; what differs is where to. A scanner that does not look all
/// round is turned about at the first node, and once more where nothing is left. Against the paper, drives end as near
/// to a goal as the map leads, for a goal may lie beyond what a scanner without return has cleared.
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
  enum class State : std::uint8_t { kChoose, kTurn, kGoal, kWay, kWait, kDone };

  /// Map, passable ways and other robots of one step.
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

  void begin_turn(const Input& input, std::string why);
  void turn(const Input& input, Step& out);

  void look_again(const Input& input, const Scene& scene);
  void create_node(const Input& input, const Scene& scene);
  void note_place(const Input& input, const Scene& scene);
  [[nodiscard]] bool settle_goal(const Scene& scene);
  [[nodiscard]] bool goal_settled(const Scene& scene) const;
  [[nodiscard]] bool another_is_at(const Point2& p_map, const Scene& scene) const;
  [[nodiscard]] std::vector<Point2> given_up(const Input& input) const;
  [[nodiscard]] bool left_out(const Point2& p_map, RobotTime now) const;
  [[nodiscard]] bool resting(RobotTime now) const;
  [[nodiscard]] bool patient(RobotTime now) const;

  explore::ExploreParams params_;
  TopologicalParams topological_;
  TopologyMap map_;
  nav::PlannedDriver driver_;
  State state_ = State::kChoose;
  std::string why_;
  std::string told_;  ///< why of the last decision that was published
  std::optional<PendingGoal> goal_;
  Point2 aim_map_ = Point2::Zero();  ///< of kGoal: the goal, or the nearest place to it that the map leads to
  std::vector<Failure> failures_;
  std::vector<Point2> done_map_;  ///< goals of others that were settled, or looked at from as near as the map leads
  RobotTime since_;               ///< of the present state
  std::optional<RobotTime> all_idle_since_;  ///< of this robot and those that it waits for
  RobotTime considered_;                     ///< when the goal was last looked at again
  std::optional<RobotTime> scan_at_;
  std::optional<std::uint64_t> turned_at_;  ///< the node (0: none) where it looked about
  double turned_rad_ = 0.0;
  double turn_until_rad_ = 0.0;
  double looked_rad_ = 0.0;  ///< of the turn when it last looked
  double heading_rad_ = 0.0;
};

}  // namespace seeker::fleet
