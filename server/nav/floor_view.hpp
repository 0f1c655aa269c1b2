/// \file
/// The map as planning uses it: occupancy, driving costs, and the floor connected to the robot.
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

/// One immutable snapshot of the floor.
struct FloorView {
  Grid<std::uint8_t> occupancy;  ///< cells as in OccupancyTile; observations of other robots where this robot has none
  CostMap cost;
  Grid<std::uint8_t> reachable;  ///< floor in coarse cells: 1 = allowed and connected to the robot
  std::uint64_t revision = 0;    ///< revision of the occupancy map that the snapshot was made from
  RobotTime built;
  /// What the robot has observed itself, when the floor of other robots was added to the snapshot.
  struct Own {
    Grid<std::uint8_t> occupancy;
    Grid<std::uint8_t> reachable;
  };
  std::optional<Own> own = std::nullopt;
};

/// Makes floor snapshots, a new one only when the map has changed and the last one is old enough.
class FloorSource {
 public:
  FloorSource(const CostMapParams& cost, ForbiddenAreas areas, double floor_cell_m, double period_s);

  /// Called once per step with the present map, the present places of other robots, and the floor that those have
  /// observed (cells as carried() makes them; null when there is none), both in the frame `map`. The call is cheap.
  void attend(const OccupancyMap& map, const Pose2& map_T_base, RobotTime now, std::vector<Mover> movers = {},
              std::shared_ptr<const Grid<std::uint8_t>> others_floor = nullptr);
  /// The newest snapshot, at most `period_s` old; `fresh` asks for one of the present map. kNotReady: there is no map
  /// yet. kUnreachable: the robot is enclosed by obstacles.
  [[nodiscard]] Result<std::shared_ptr<const FloorView>> view(bool fresh = false);
  /// The last snapshot that could be made; null before the first.
  [[nodiscard]] const std::shared_ptr<const FloorView>& last() const { return last_; }
  /// The costs of a snapshot for a path to be planned now, with the nearby robots as obstacles. Nothing: no robot is
  /// near. Robots farther off are left out, because they will have moved on before this robot gets there.
  [[nodiscard]] std::optional<CostMap> around_movers(const FloorView& view) const;
  /// Adds an obstacle that the map does not show (for example a sonar echo below the lidar's plane), frame `map`.
  /// Places that another robot may cover are ignored. An obstacle is forgotten when it was not added again for a
  /// minute: a person who stood in a door has moved on, and an object that still stands there is observed again.
  void add_obstacle(const Point2& p_map);
  /// Forgets all obstacles that were not added again within the last moments, before a path is tried once more.
  void forget_past_obstacles();
  /// The obstacles that are remembered now, frame `map`.
  [[nodiscard]] std::vector<Point2> obstacles_map() const;
  /// Floor connected to the robot's position in the last snapshot if no area were forbidden: compared with the
  /// reachable floor it shows what the forbidden areas exclude.
  [[nodiscard]] std::optional<Grid<std::uint8_t>> unrestricted_floor() const;
  [[nodiscard]] const ForbiddenAreas& areas() const { return areas_; }
  void transform(const MapMove& move);

 private:
  struct Obstacle {
    Point2 p_map;
    RobotTime noted;  ///< when it was last added
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
  const OccupancyMap* map_ = nullptr;  ///< valid during the present step only
  Pose2 map_T_base_;
  RobotTime now_;
  bool stale_ = true;
  std::shared_ptr<const FloorView> last_;
};

}  // namespace seeker::nav
