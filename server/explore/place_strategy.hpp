/// \file
/// Exploring by places: choose one of the openings, drive there over a planned path, look, choose again.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "server/explore/explore_params.hpp"
#include "server/explore/openings.hpp"
#include "server/explore/strategy.hpp"

namespace seeker::explore {

/// What a chooser knows. `openings` are those that may be tried now, cheapest first, at least one.
struct PlaceInput {
  const StrategyInput& robot;
  const nav::FloorView& floor;
  const nav::DistanceField& costs;
  const std::vector<Opening>& openings;
  /// Where the robot is bound for, while it drives; else nothing.
  const Opening* goal = nullptr;
};

struct PlaceChoice {
  std::optional<Opening> opening;  ///< map_T_view may have been moved to a better place; nothing: none is worth it
  ExploreDecision decision;
};

/// One rule of choosing; pure apart from what it remembers between decisions.
class PlaceChooser {
 public:
  PlaceChooser() = default;
  PlaceChooser(const PlaceChooser&) = delete;
  PlaceChooser& operator=(const PlaceChooser&) = delete;
  virtual ~PlaceChooser() = default;

  [[nodiscard]] virtual PlaceChoice choose(const PlaceInput& input) = 0;
  /// Whether ends of walls matter to the rule, or borders of the unknown alone.
  [[nodiscard]] virtual bool wants_wall_ends() const = 0;
  /// Whether another goal may be better while the present one still stands.
  [[nodiscard]] virtual bool changes_its_mind() const = 0;
};

/// A goal that has been seen on the way is dropped; one is kept when the map moves, and the way to it planned again
/// when the goal is next reconsidered: by then the floor has followed the walls. Without a usable map, and before it is
/// over where it began, it turns on the spot once, to let the sensors see.
class PlaceStrategy final : public ExploreStrategy {
 public:
  PlaceStrategy(const ExploreParams& params, std::unique_ptr<PlaceChooser> chooser);

  [[nodiscard]] StrategyStep step(const StrategyInput& input) override;
  void interrupted(RobotTime now) override;
  void try_again(RobotTime now) override;
  void transform(const MapMove& move) override;

 private:
  enum class State : std::uint8_t { kChoose, kDrive, kLook, kWait, kTurn, kDone };

  /// Map, ways and openings of one decision.
  struct Survey {
    std::shared_ptr<const nav::FloorView> floor;
    nav::DistanceField costs;
    std::vector<Opening> open;
    bool resting = false;  ///< some are left out because a drive there failed lately
  };

  [[nodiscard]] Result<Survey> survey(const StrategyInput& input);
  void choose(const StrategyInput& input, StrategyStep& out);
  void go(const StrategyInput& input, PlaceChoice choice, StrategyStep& out);
  void set_out(const StrategyInput& input);
  void drive(const StrategyInput& input, StrategyStep& out);
  void reconsider(const StrategyInput& input, StrategyStep& out);
  void look(const StrategyInput& input, StrategyStep& out);
  void turn(const StrategyInput& input, StrategyStep& out);
  void begin_turn(const StrategyInput& input, std::string why, StrategyStep& out);
  void wait_or_finish(const StrategyInput& input, const Survey& found, StrategyStep& out);
  void finish(std::string why, StrategyStep& out);
  void start_anew();

  ExploreParams params_;
  std::unique_ptr<PlaceChooser> chooser_;
  Openings openings_;
  nav::PlannedDriver driver_;
  State state_ = State::kChoose;
  std::optional<Opening> goal_;
  RobotTime since_;       ///< of the present state
  RobotTime considered_;  ///< when the goal was last looked at again
  std::string why_;       ///< of the present state
  bool turned_ = false;
  std::optional<Point2> began_map_;  ///< where the robot stood at first
  bool looked_round_ = false;        ///< it has left that place, or turned there
  bool corrected_ = false;           ///< the map moved since the present drive was planned
};

[[nodiscard]] std::unique_ptr<PlaceChooser> make_frontier_chooser(const ExploreParams& params);
/// The nearest opening of either kind: where the one-step rule goes when no wall leads on.
[[nodiscard]] std::unique_ptr<PlaceChooser> make_opening_chooser();
[[nodiscard]] std::unique_ptr<PlaceChooser> make_gain_chooser(const ExploreParams& params);
[[nodiscard]] std::unique_ptr<PlaceChooser> make_horizon_chooser(const ExploreParams& params);

}  // namespace seeker::explore
