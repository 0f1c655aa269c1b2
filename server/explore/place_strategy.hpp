/// \file
/// Exploration by places: choose one of the openings, drive there over a planned path, observe, and choose again.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "server/explore/explore_params.hpp"
#include "server/explore/openings.hpp"
#include "server/explore/strategy.hpp"

namespace seeker::explore {

/// The inputs of a choice. `openings` are those that may be tried now, in order of rising path cost; there is at least
/// one.
struct PlaceInput {
  const StrategyInput& robot;
  const nav::FloorView& floor;
  const nav::DistanceField& costs;
  const std::vector<Opening>& openings;
  /// The present goal while the robot drives; null otherwise.
  const Opening* goal = nullptr;
};

struct PlaceChoice {
  /// Map_T_view may have been moved to a better viewpoint; nothing: no opening is worth a drive.
  std::optional<Opening> opening;
  ExploreDecision decision;
};

/// One rule for choosing a place. Its only state is what it remembers between decisions.
class PlaceChooser {
 public:
  PlaceChooser() = default;
  PlaceChooser(const PlaceChooser&) = delete;
  PlaceChooser& operator=(const PlaceChooser&) = delete;
  virtual ~PlaceChooser() = default;

  [[nodiscard]] virtual PlaceChoice choose(const PlaceInput& input) = 0;
  /// Whether the rule uses ends of walls, or frontiers alone.
  [[nodiscard]] virtual bool wants_wall_ends() const = 0;
  /// Whether another goal may become better while the present one is still open.
  [[nodiscard]] virtual bool changes_its_mind() const = 0;
};

/// Drives from opening to opening by the rule of a chooser. A goal that was observed during the drive is dropped. When
/// the map is corrected the goal is kept, and the path to it is planned again when the goal is next reconsidered: by
/// then the floor matches the walls. Without a usable map, and before the exploration ends where it began, the robot
/// rotates once on the spot so that its sensors can observe.
class PlaceStrategy final : public ExploreStrategy {
 public:
  PlaceStrategy(const ExploreParams& params, std::unique_ptr<PlaceChooser> chooser);

  [[nodiscard]] StrategyStep step(const StrategyInput& input) override;
  void interrupted(RobotTime now) override;
  void try_again(RobotTime now) override;
  void transform(const MapMove& move) override;

 private:
  enum class State : std::uint8_t { kChoose, kDrive, kLook, kWait, kRotate, kDone };

  /// Map, path costs and openings of one decision.
  struct Survey {
    std::shared_ptr<const nav::FloorView> floor;
    nav::DistanceField costs;
    std::vector<Opening> open;
    bool resting = false;  ///< some openings are left out because a drive there failed lately
  };

  [[nodiscard]] Result<Survey> survey(const StrategyInput& input);
  void choose(const StrategyInput& input, StrategyStep& out);
  void go(const StrategyInput& input, PlaceChoice choice, StrategyStep& out);
  void set_out(const StrategyInput& input);
  void drive(const StrategyInput& input, StrategyStep& out);
  void reconsider(const StrategyInput& input, StrategyStep& out);
  void look(const StrategyInput& input, StrategyStep& out);
  void rotate(const StrategyInput& input, StrategyStep& out);
  void begin_rotation(const StrategyInput& input, std::string why, StrategyStep& out);
  void wait_or_finish(const StrategyInput& input, const Survey& found, StrategyStep& out);
  void finish(std::string why, StrategyStep& out);
  void start_again();

  ExploreParams params_;
  std::unique_ptr<PlaceChooser> chooser_;
  Openings openings_;
  nav::PlannedDriver driver_;
  State state_ = State::kChoose;
  std::optional<Opening> goal_;
  RobotTime since_;       ///< start of the present state
  RobotTime considered_;  ///< when the goal was last reconsidered
  std::string why_;       ///< reason for the present state
  bool rotated_ = false;
  std::optional<Point2> began_map_;  ///< position of the robot at the first step, frame `map`
  bool looked_round_ = false;        ///< whether it has left that place or rotated there
  bool corrected_ = false;           ///< whether the map was corrected since the present drive was planned
};

[[nodiscard]] std::unique_ptr<PlaceChooser> make_frontier_chooser(const ExploreParams& params);
/// Chooses the nearest opening of any kind: the rule used after the one-step rule when no wall leads on.
[[nodiscard]] std::unique_ptr<PlaceChooser> make_opening_chooser();
[[nodiscard]] std::unique_ptr<PlaceChooser> make_gain_chooser(const ExploreParams& params);
[[nodiscard]] std::unique_ptr<PlaceChooser> make_horizon_chooser(const ExploreParams& params);

}  // namespace seeker::explore
