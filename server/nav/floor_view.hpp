/// \file
/// The map as planning sees it: occupancy, where the robot may go, what of it is connected.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "common/core/grid.hpp"
#include "common/core/map_move.hpp"
#include "common/core/pose2.hpp"
#include "common/core/result.hpp"
#include "common/core/time.hpp"
#include "server/nav/cost_map.hpp"
#include "server/nav/forbidden_areas.hpp"
#include "server/nav/movers.hpp"
#include "server/nav/occupancy_map.hpp"

namespace seeker::nav {

/// One snapshot, immutable.
struct FloorView {
  Grid<std::uint8_t> occupancy;  ///< cells as in OccupancyTile; what others have seen where the robot has not
  CostMap cost;
  Grid<std::uint8_t> reachable;  ///< floor in coarse cells: 1 = allowed and connected to the robot
  std::uint64_t revision = 0;    ///< of the map it was made from
  RobotTime built;
  /// What the robot has seen itself, where the floor of others was added to it.
  struct Own {
    Grid<std::uint8_t> occupancy;
    Grid<std::uint8_t> reachable;
  };
  std::optional<Own> own = std::nullopt;
};

/// Makes snapshots only when the map has changed and the last one is old enough.
class FloorSource {
 public:
  FloorSource(const CostMapParams& cost, ForbiddenAreas areas, double floor_cell_m, double period_s);

  /// Called once per step with the present map, where other robots are now, and what floor they have seen (cells as
  /// carried() makes them; null: nothing), both in the frame `map`; cheap.
  void attend(const OccupancyMap& map, const Pose2& map_T_base, RobotTime now, std::vector<Mover> movers = {},
              std::shared_ptr<const Grid<std::uint8_t>> others_floor = nullptr);
  /// The newest view, at most `period_s` old; `fresh` asks for one of the present map. kNotReady: no map yet;
  /// kUnreachable: the robot stands walled in.
  [[nodiscard]] Result<std::shared_ptr<const FloorView>> view(bool fresh = false);
  /// The last view that could be made, if any.
  [[nodiscard]] const std::shared_ptr<const FloorView>& last() const { return last_; }
  /// The costs of a view for a way to be planned now: around the other robots that are near. Nothing where none is, for
  /// those farther off will have moved on before the robot gets there.
  [[nodiscard]] std::optional<CostMap> around_movers(const FloorView& view) const;
  /// Obstacles that the map does not show (sonar echoes below the lidar's plane), frame `map`. Other robots are none.
  /// Forgotten when not added again for a minute: who stood in a door has gone on, what stands there is met again.
  void add_obstacle(const Point2& p_map);
  /// Sooner than that, before a way is tried once more: all that were not added again just now.
  void forget_past_obstacles();
  /// Those that are remembered now, frame `map`.
  [[nodiscard]] std::vector<Point2> obstacles_map() const;
  /// Floor connected to the last view's position when nothing is forbidden: what the forbidden areas cost.
  [[nodiscard]] std::optional<Grid<std::uint8_t>> unrestricted_floor() const;
  [[nodiscard]] const ForbiddenAreas& areas() const { return areas_; }
  void transform(const MapMove& move);

 private:
  struct Obstacle {
    Point2 p_map;
    RobotTime noted;  ///< last
  };

  void forget_older_than(double age_s);
  [[nodiscard]] Result<FloorView> build() const;
  [[nodiscard]] Result<FloorView> view_of(Grid<std::uint8_t> occupancy) const;

  CostMapParams cost_;
  ForbiddenAreas areas_;
  double floor_cell_m_;
  double period_s_;
  std::vector<Obstacle> obstacles_;
  std::vector<Mover> movers_;
  std::shared_ptr<const Grid<std::uint8_t>> others_floor_;
  const OccupancyMap* map_ = nullptr;  ///< of the present step only
  Pose2 map_T_base_;
  RobotTime now_;
  bool stale_ = true;
  std::shared_ptr<const FloorView> last_;
};

}  // namespace seeker::nav
