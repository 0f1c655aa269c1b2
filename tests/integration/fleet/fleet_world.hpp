/// \file
/// Robots with toy maps, and a main robot over loopback.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <thread>

#include <gtest/gtest.h>

#include "server/app/fleet/fleet_part.hpp"
#include "tests/support/process.hpp"
#include "tests/unit/server/fleet/toy_maps.hpp"

namespace seeker::testing {

using std::chrono::seconds;

inline const std::vector<Point2> kWest{{1.0, 6.0}, {14.0, 6.0}, {2.0, 6.2}};
inline const std::vector<Point2> kEast{{23.0, 6.0}, {8.0, 5.9}, {20.0, 6.0}};

// Another office to the east of that one; a robot that has been in the east of the one and the west of the other.
inline const std::vector<Point2> kBetween{{23.0, 6.0}, {8.0, 5.9}, {38.0, 6.0}, {26.0, 6.2}};
inline const std::vector<Point2> kFarEast{{47.0, 6.0}, {32.0, 5.9}, {44.0, 6.0}};

inline std::vector<Wall> two_offices() {
  std::vector<Wall> walls = fleet::office(1);
  for (Wall wall : fleet::office(12)) {
    wall.first.x() += 24.0;
    wall.second.x() += 24.0;
    walls.push_back(wall);
  }
  return walls;
}
inline LineMap in_two_offices(const std::vector<Point2>& way, std::uint64_t seed) {
  return fleet::toy_map(two_offices(), fleet::drive(way), seed);
}

inline LineMap west(std::uint64_t building = 1) {
  return fleet::toy_map(fleet::office(building), fleet::drive(kWest), 11);
}
inline LineMap east(std::uint64_t building = 1) {
  return fleet::toy_map(fleet::office(building), fleet::drive(kEast), 12);
}
/// Where the map `east` lies in the map `west`.
inline Pose2 west_T_east() { return inverse(fleet::drive(kWest).front()) * fleet::drive(kEast).front(); }

/// A main robot with a folder of its own.
inline app::FleetLeaderParams leader_params(const std::string& folder) {
  app::FleetLeaderParams params;
  params.folder = fresh_folder(folder);
  params.robot_id = "main";
  return params;
}

/// A robot with a toy map, which remembers what its fleet tells it.
class ToyHost {
 public:
  explicit ToyHost(LineMap map, app::OwnTopology topology = std::nullopt, app::OwnSeen seen = {})
      : map_(std::move(map)), topology_(std::move(topology)), seen_(std::move(seen)) {}

  [[nodiscard]] app::FleetHost host() const {
    app::FleetHost host;
    host.give_map = [map = map_](const api::Reply<app::OwnMap>& reply) {
      reply(app::OwnMap{map, Pose2{1.0, 0.0, 0.0}});
    };
    host.give_topology = [topology = topology_](const api::Reply<app::OwnTopology>& reply) {
      reply(app::OwnTopology(topology));
    };
    host.give_seen = [seen = seen_](const api::Reply<app::OwnSeen>& reply) { reply(app::OwnSeen(seen)); };
    host.take_view = [received = heard_](std::optional<FleetView> view) {
      const std::lock_guard lock(received->mutex);
      received->view = std::move(view);
    };
    host.notify_operator = [received = heard_](const std::string& kind, const std::string& text, api::Severity) {
      const std::lock_guard lock(received->mutex);
      received->events.push_back(kind + " " + text);
    };
    host.decided = [received = heard_](const api::AuditRecord& record) {
      const std::lock_guard lock(received->mutex);
      received->decisions.push_back(record);
    };
    return host;
  }
  /// What operators have decided, or were refused.
  [[nodiscard]] std::vector<api::AuditRecord> decisions() const {
    const std::lock_guard lock(heard_->mutex);
    return heard_->decisions;
  }
  [[nodiscard]] std::optional<FleetView> view() const {
    const std::lock_guard lock(heard_->mutex);
    return heard_->view;
  }
  [[nodiscard]] std::vector<std::string> events() const {
    const std::lock_guard lock(heard_->mutex);
    return heard_->events;
  }
  /// Waits until what it knows of the others is as wanted.
  [[nodiscard]] std::optional<FleetView> until(
      const std::function<bool(const std::optional<FleetView>&)>& wanted) const {
    const auto end = std::chrono::steady_clock::now() + seconds(120);
    while (std::chrono::steady_clock::now() < end) {
      if (auto view = this->view(); wanted(view)) {
        return view;
      }
      std::this_thread::yield();
    }
    ADD_FAILURE() << "the robot was never told";
    return std::nullopt;
  }

 private:
  struct Heard {
    std::mutex mutex;
    std::optional<FleetView> view;
    std::vector<std::string> events;
    std::vector<api::AuditRecord> decisions;
  };
  LineMap map_;
  app::OwnTopology topology_;
  app::OwnSeen seen_;
  std::shared_ptr<Heard> heard_ = std::make_shared<Heard>();
};

inline app::FleetHost holds(const LineMap& map) { return ToyHost(map).host(); }

/// A robot at one place, on its way to a goal.
inline RobotTopology at_place(const std::string& robot_id, const Point2& p_map) {
  RobotTopology robot;
  robot.robot_id = robot_id;
  robot.map_T_base = {p_map.x(), p_map.y(), 0.0};
  TopologyNode node;
  node.id = 1;
  node.map_T_base = robot.map_T_base;
  node.goals = {{1, p_map + Point2(3.0, 0.0), 8}};
  robot.topology.nodes = {node};
  robot.topology.current = 1;
  robot.target_map = node.goals.front().p_map;
  robot.velocity = Twist2{0.3, 0.0};
  return robot;
}

/// Waits until a robot of the fleet is as wanted; its last description.
inline api::FleetMember until(const app::FleetLeader& leader, const std::string& robot_id,
                              const std::function<bool(const api::FleetMember&)>& wanted) {
  const auto end = std::chrono::steady_clock::now() + seconds(120);
  api::FleetMember last;
  while (std::chrono::steady_clock::now() < end) {
    for (const api::FleetMember& member : leader.status().members) {
      if (member.robot_id == robot_id) {
        last = member;
        if (wanted(member)) {
          return member;
        }
      }
    }
    std::this_thread::yield();
  }
  ADD_FAILURE() << robot_id << " is " << api::to_string(last.state) << ": " << last.reason;
  return last;
}

inline api::FleetMember until(const app::FleetLeader& leader, const std::string& robot_id, api::FleetState state) {
  return until(leader, robot_id, [state](const api::FleetMember& member) { return member.state == state; });
}

/// One occupied cell of 5 cm, with its middle near `p_map`.
inline std::vector<OccupancyTile> floor_with(const Point2& p_map) {
  const GridFrame all{Point2::Zero(), kTileResolution_m};
  const CellIndex cell = all.cell_of(p_map);
  Grid<std::uint8_t> grid({kTileResolution_m * Point2(cell.i, cell.j), kTileResolution_m}, 1, 1, kOccupiedCell);
  return cut(grid);
}

/// A target that a robot has found.
inline api::Detection found_at(std::uint64_t id, const Point2& p_map, const std::string& target = "mug") {
  api::Detection found;
  found.id = id;
  found.target = target;
  found.stamp = RobotTime(seconds(static_cast<int>(id)));
  found.map_T_base = {p_map.x() - 1.0, p_map.y(), 0.0};
  found.position = p_map;
  found.position_covariance = 0.01 * Matrix2::Identity();
  return found;
}

/// Square floor that a robot has searched for a mug; every cell says the same.
inline SearchedFloor searched_at(const Pose2& map_T_grid, int side_cells, std::uint8_t probability) {
  const GridFrame frame{Point2::Zero(), 0.2};
  return {{"mug"}, map_T_grid, std::make_shared<const Grid<std::uint8_t>>(frame, side_cells, side_cells, probability)};
}

/// What a robot that knows its place tells.
inline api::FleetSeen seen_by(const std::string& robot_id, std::vector<api::Detection> found = {},
                              std::optional<SearchedFloor> searched = std::nullopt, std::uint64_t instance = 1) {
  return {robot_id, instance, true, {}, std::move(found), std::move(searched)};
}

/// Where the only occupied cell is.
inline std::optional<Point2> occupied_in(const Grid<std::uint8_t>& floor) {
  for (CellIndex c{0, 0}; c.j < floor.height(); ++c.j) {
    for (c.i = 0; c.i < floor.width(); ++c.i) {
      if (floor[c] == kOccupiedCell) {
        return floor.frame().centre_of(c);
      }
    }
  }
  return std::nullopt;
}

}  // namespace seeker::testing
