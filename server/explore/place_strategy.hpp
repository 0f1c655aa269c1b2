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
  /// A place to pass before it, frame `map`; the robot decides again when it is there, and sets out for the opening
  /// itself where no drive leads there.
  std::optional<Point2> via_map = std::nullopt;
  bool others_busy = false;  ///< without an opening: what is left is the share of other robots
  ExploreDecision decision;
};

/// The opening as a candidate of a decision.
[[nodiscard]] DecisionCandidate candidate_of(const Opening& opening, double score);

/// How the robot drives from decision to decision.
struct DriveManner {
  /// Whether it drives on without a stop: it decides with every new map, turns only to what it does not see already,
  /// and begins the next drive in the step that decided.
  bool flowing = false;
  double replan_period_s = 2.0;  ///< period at which goals are reconsidered while driving
  double look_s = 1.0;           ///< duration of one observation
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
  /// Whether the rule leaves to other robots what is their share.
  [[nodiscard]] virtual bool shares() const { return false; }
  /// Nothing: stop at every place, as the parameters of viewpoints say.
  [[nodiscard]] virtual std::optional<DriveManner> manner() const { return std::nullopt; }
};

/// Drives from opening to opening by the rule of a chooser. A goal that was observed during the drive is dropped. When
/// the map is corrected the goal is kept, and the path to it is planned again when the goal is next reconsidered: by
/// then the floor matches the walls. How it drives from one to the next is the chooser's DriveManner. Without a usable
/// map, and before the exploration ends where it began, the robot rotates once on the spot so that its sensors can
/// observe.
class PlaceStrategy final : public ExploreStrategy {
 public:
  PlaceStrategy(const ExploreParams& params, std::unique_ptr<PlaceChooser> chooser);

  [[nodiscard]] StrategyStep step(const StrategyInput& input) override;
  void interrupted(RobotTime now) override;
  void try_again(RobotTime now) override;
  void transform(const MapMove& move) override;
  [[nodiscard]] std::optional<Point2> target_map() const override;
  [[nodiscard]] bool shares() const override { return chooser_->shares(); }

 private:
  enum class State : std::uint8_t { kChoose, kDrive, kLook, kWait, kRotate, kDone };

  /// Map, path costs and openings of one decision.
  struct Survey {
    std::shared_ptr<const nav::FloorView> floor;
    nav::DistanceField costs;
    std::vector<Opening> open;
    bool resting = false;  ///< some openings are left out because a drive there failed lately
  };

  [[nodiscard]] Result<Survey> survey(const StrategyInput& input, bool fresh = false);
  void choose(const StrategyInput& input, StrategyStep& out);
  void choose_from(const StrategyInput& input, const Survey& found, StrategyStep& out);
  void go(const StrategyInput& input, PlaceChoice choice, StrategyStep& out);
  void set_out(const StrategyInput& input);
  void drive(const StrategyInput& input, StrategyStep& out);
  void arrive(const StrategyInput& input);
  void reconsider(const StrategyInput& input, StrategyStep& out);
  void follow_correction(const StrategyInput& input, const Opening& same);
  void look(const StrategyInput& input, StrategyStep& out);
  void rotate(const StrategyInput& input, StrategyStep& out);
  void begin_rotation(const StrategyInput& input, std::string why, StrategyStep& out);
  void wait_or_finish(const StrategyInput& input, const Survey& found, StrategyStep& out);
  void finish(std::string why, StrategyStep& out);
  void start_again();

  ExploreParams params_;
  std::unique_ptr<PlaceChooser> chooser_;
  DriveManner manner_;
  Openings openings_;
  nav::PlannedDriver driver_;
  State state_ = State::kChoose;
  std::optional<Opening> goal_;
  std::optional<Point2> via_map_;  ///< set while the robot drives to a place before its goal
  bool facing_ = false;            ///< whether a drive that flows has arrived and turns to its goal
  std::vector<Point2> left_map_;   ///< openings that the last decision found too small to drive to
  RobotTime since_;                ///< start of the present state
  RobotTime considered_;           ///< when the goal was last reconsidered
  std::string why_;                ///< reason for the present state
  bool rotated_ = false;
  std::optional<Point2> began_map_;  ///< position of the robot at the first step, frame `map`
  bool looked_round_ = false;        ///< whether it has left that place or rotated there
  bool others_busy_ = false;         ///< whether the last decision left all to other robots
  bool corrected_ = false;           ///< whether the map was corrected since the present drive was planned
};

[[nodiscard]] std::unique_ptr<PlaceChooser> make_frontier_chooser(const ExploreParams& params);
/// Chooses the nearest opening of any kind: the rule used after the one-step rule when no wall leads on.
[[nodiscard]] std::unique_ptr<PlaceChooser> make_opening_chooser();
[[nodiscard]] std::unique_ptr<PlaceChooser> make_gain_chooser(const ExploreParams& params);
[[nodiscard]] std::unique_ptr<PlaceChooser> make_horizon_chooser(const ExploreParams& params);
[[nodiscard]] std::unique_ptr<PlaceChooser> make_tour_chooser(const ExploreParams& params);

}  // namespace seeker::explore
