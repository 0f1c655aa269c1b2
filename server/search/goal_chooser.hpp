/// \file
/// Choice of the next goal: the rule by which the planned coverage differs from its baselines.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "common/core/map_move.hpp"
#include "server/nav/frontiers.hpp"
#include "server/nav/planner.hpp"
#include "server/search/search_params.hpp"
#include "server/search/strategy.hpp"

namespace seeker::search {

/// A place to drive to.
struct Goal {
  Point2 p_map = Point2::Zero();
  std::string why;                         ///< "unsearched cell", "frontier", "open wall", "spiral", ...
  bool is_frontier = false;                ///< the goal serves the map rather than the search
  double expected_gain = 0.0;              ///< expected new evidence, cells x probability
  std::optional<double> heading_rad = {};  ///< heading of the robot at the goal
  double size_m = 0.0;                     ///< length of a frontier

  friend bool operator==(const Goal&, const Goal&) = default;
};

struct ChooseInput {
  const nav::FloorView& floor;
  const nav::DistanceField& costs;
  const EvidenceGrid& evidence;
  Pose2 map_T_base;
  double target_size_m = 0.4;
  const std::vector<Point2>& unreachable;
  const MapViews& map_views;
};

class GoalChooser {
 public:
  GoalChooser() = default;
  GoalChooser(const GoalChooser&) = delete;
  GoalChooser& operator=(const GoalChooser&) = delete;
  virtual ~GoalChooser() = default;

  /// The next goal. Nothing: no goal is left.
  [[nodiscard]] virtual std::optional<Goal> choose(const ChooseInput& input) = 0;
  /// The goal that choose() would return there; nothing where the rule cannot know it beforehand.
  [[nodiscard]] virtual std::optional<Goal> foresee(const ChooseInput& /*input*/) const { return std::nullopt; }
  /// Records that the robot reached the goal (or came as near as it can) and took its picture.
  virtual void visited(const Goal& goal, const Pose2& map_T_base) = 0;
  /// Checked after every picture taken while driving: false drops the goal for a better one.
  [[nodiscard]] virtual bool still_worth(const Goal& goal, const nav::FloorView& floor, const EvidenceGrid& evidence,
                                         double target_size_m) const = 0;
  virtual void transform(const MapMove& move) = 0;
};

/// Default mode: the best gain over cost among 0.8 m cells of the reachable floor, frontiers, and viewpoints that
/// extend the map.
class PlanChooser final : public GoalChooser {
 public:
  explicit PlanChooser(const PlanParams& params) : params_(params) {}
  [[nodiscard]] std::optional<Goal> choose(const ChooseInput& input) override { return foresee(input); }
  [[nodiscard]] std::optional<Goal> foresee(const ChooseInput& input) const override;
  void visited(const Goal& goal, const Pose2& map_T_base) override;
  [[nodiscard]] bool still_worth(const Goal& goal, const nav::FloorView& floor, const EvidenceGrid& evidence,
                                 double target_size_m) const override;
  void transform(const MapMove& move) override;

 private:
  struct Candidate {
    Goal goal;
    double cost = 0.0;
    double bound = 0.0;  ///< upper bound of the score
  };
  [[nodiscard]] std::vector<Candidate> cells(const ChooseInput& input, const Grid<std::uint8_t>& wanted) const;
  void add_frontiers(const ChooseInput& input, std::vector<Candidate>& candidates) const;
  void add_map_views(const ChooseInput& input, std::vector<Candidate>& candidates) const;

  PlanParams params_;
  std::map<CellIndex, int> visits_;     ///< visits of 0.8 m cells as goals, so that none is tried for ever
  std::vector<Point2> seen_frontiers_;  ///< frontiers that stayed open after a visit
  std::vector<Pose2> seen_views_;       ///< viewpoints for the map that stayed after a visit
};

/// Backtracking spiral algorithm on 0.8 m cells: the robot keeps visited and blocked cells on its reference side and
/// drives in a shrinking spiral; when the spiral ends it drives to the nearest cell that was left out (Gonzalez et al.
/// 2005, BSA).
class SpiralChooser final : public GoalChooser {
 public:
  explicit SpiralChooser(const PlanParams& params) : params_(params) {}
  [[nodiscard]] std::optional<Goal> choose(const ChooseInput& input) override;
  void visited(const Goal& goal, const Pose2& map_T_base) override;
  [[nodiscard]] bool still_worth(const Goal&, const nav::FloorView&, const EvidenceGrid&, double) const override {
    return true;
  }
  void transform(const MapMove& move) override;

 private:
  [[nodiscard]] bool open(const ChooseInput& input, CellIndex cell) const;
  [[nodiscard]] std::optional<CellIndex> spiral_step(const ChooseInput& input, CellIndex here);
  [[nodiscard]] std::optional<CellIndex> backtrack(const ChooseInput& input);
  [[nodiscard]] GridFrame frame() const { return {Point2::Zero(), params_.cell_m}; }

  PlanParams params_;
  std::set<CellIndex> visited_;
  std::optional<CellIndex> last_;
  int direction_ = 0;  ///< 0..3: +x, +y, -x, -y
};

/// Nearest frontier by travel cost (Yamauchi 1997).
class FrontierChooser final : public GoalChooser {
 public:
  explicit FrontierChooser(const PlanParams& params) : params_(params) {}
  [[nodiscard]] std::optional<Goal> choose(const ChooseInput& input) override;
  void visited(const Goal& goal, const Pose2& map_T_base) override;
  [[nodiscard]] bool still_worth(const Goal&, const nav::FloorView&, const EvidenceGrid&, double) const override {
    return true;
  }
  void transform(const MapMove& move) override;

 private:
  PlanParams params_;
  std::vector<Point2> seen_frontiers_;
};

}  // namespace seeker::search
