/// \file
/// Strategies that lead the robot over the floor: one interface for the paper's algorithm, the planned one and the
/// baselines.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/core/map_move.hpp"
#include "common/core/pose2.hpp"
#include "common/core/scan.hpp"
#include "common/core/time.hpp"
#include "server/nav/known_floor.hpp"
#include "server/nav/planned_driver.hpp"
#include "server/search/evidence.hpp"
#include "server/search/search_types.hpp"

namespace seeker::search {

/// The inputs of one step of a strategy. `now` is mission time, which stands still while the mission is paused or
/// another activity drives the robot.
struct StrategyInput : nav::DriveInput {
  const EvidenceGrid& evidence;
  double target_size_m = 0.4;  ///< size of the smallest target of the search
  const MapViews& map_views;
  const nav::KnownFloor& known;  ///< floor that could be reached at some time
};

struct StrategyStep {
  Twist2 command;
  bool wants_image = false;  ///< repeated until image_taken()
  bool while_moving = false;
  std::string phase = "cover";
  std::string activity;
  std::vector<SearchEvent> events;
  std::vector<Point2> planned_path;
  bool done = false;     ///< no goal is left
  bool trapped = false;  ///< done because the robot cannot move on; `activity` says why
};

class CoverageStrategy {
 public:
  CoverageStrategy() = default;
  CoverageStrategy(const CoverageStrategy&) = delete;
  CoverageStrategy& operator=(const CoverageStrategy&) = delete;
  virtual ~CoverageStrategy() = default;

  [[nodiscard]] virtual StrategyStep step(const StrategyInput& input) = 0;
  /// The requested picture was taken (or will not come).
  virtual void image_taken(const StrategyInput& input) = 0;
  /// Another activity moved the robot meanwhile: present drives are dropped.
  virtual void interrupted(RobotTime now) = 0;
  virtual void transform(const MapMove& move) = 0;
  /// Goes on from the lists of an earlier run, frame `map`; before the first step. Lists of cells of another size are
  /// ignored.
  virtual void take_back(const GridLists& lists) = 0;
  [[nodiscard]] virtual const GridLists& lists() const = 0;
  /// Why the places of lists().unreachable were given up, as far as the strategy knows; in the same order.
  [[nodiscard]] virtual std::vector<UnreachablePlace> unreachable() const;
};

}  // namespace seeker::search
