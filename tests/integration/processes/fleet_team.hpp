/// \file
/// Several robots as processes of their own in one hosted world, the first of them leads the fleet.
#pragma once

#include <array>
#include <cmath>
#include <csignal>
#include <limits>
#include <map>
#include <set>
#include <thread>
#include <utility>

#include "common/core/angle.hpp"
#include "common/rpc/fleet_client.hpp"
#include "server/app/state/kept_files.hpp"
#include "server/options/world_options.hpp"
#include "server/store/map_file.hpp"
#include "tests/integration/processes/emulator.hpp"
#include "tests/integration/processes/watcher.hpp"

namespace seeker::testing {

/// Square cells of a map: how much ground counts, not how many segments or scans show it.
class Cells {
 public:
  /// Those that the map's walls run through.
  static Cells of_walls(const LineMap& map) {
    Cells cells;
    for (const MapSegment& segment : map.segments) {
      const Point2 half(0.5 * segment.length_m, 0.0);
      cells.add_line(segment.map_T_segment * Point2(-half), segment.map_T_segment * half);
    }
    return cells;
  }
  /// Those that beams of the kept scans have gone through.
  static Cells of_floor(const LineMap& map) {
    std::map<std::uint32_t, Pose2> map_T_node;
    for (const MapNode& node : map.nodes) {
      map_T_node[node.id] = node.map_T_node;
    }
    Cells cells;
    for (const MapKeyframe& keyframe : map.keyframes) {
      const LaserScan scan = unpack_scan(keyframe);
      const Pose2 map_T_laser = map_T_node.at(keyframe.node) * keyframe.node_T_base * scan.base_T_laser;
      for (std::size_t k = 0; k < scan.ranges_m.size(); ++k) {
        if (std::isfinite(scan.ranges_m[k]) && scan.ranges_m[k] < scan.range_max_m) {
          const double angle_rad = scan.angle_rad(k);
          const auto range_m = static_cast<double>(scan.ranges_m[k]);
          cells.add_line(map_T_laser.translation(),
                         map_T_laser * Point2(range_m * std::cos(angle_rad), range_m * std::sin(angle_rad)));
        }
      }
    }
    return cells;
  }
  /// Share of the cells that have one of the other map's beside them or upon them.
  [[nodiscard]] double share_in(const Cells& other) const {
    const auto found = std::count_if(cells_.begin(), cells_.end(), [&](const Cell& cell) {
      for (int i = -1; i <= 1; ++i) {
        for (int j = -1; j <= 1; ++j) {
          if (other.cells_.contains({cell.first + i, cell.second + j})) {
            return true;
          }
        }
      }
      return false;
    });
    return cells_.empty() ? 0.0 : static_cast<double>(found) / static_cast<double>(cells_.size());
  }
  [[nodiscard]] double length_m() const { return kCell_m * static_cast<double>(cells_.size()); }
  [[nodiscard]] double area_m2() const { return kCell_m * length_m(); }

 private:
  using Cell = std::pair<int, int>;
  static constexpr double kCell_m = 0.2;
  static constexpr double kStep_m = 0.1;
  void add_line(const Point2& from, const Point2& to) {
    const int steps = std::max(1, static_cast<int>(std::ceil((to - from).norm() / kStep_m)));
    for (int k = 0; k <= steps; ++k) {
      const Point2 p = from + (to - from) * (static_cast<double>(k) / steps);
      cells_.insert({static_cast<int>(std::floor(p.x() / kCell_m)), static_cast<int>(std::floor(p.y() / kCell_m))});
    }
  }
  std::set<Cell> cells_;
};

/// What a fleet has at its end.
struct FleetOutcome {
  api::FleetStatus fleet;
  LineMap map;
};

class Team {
 public:
  Team(const std::string& name, const std::filesystem::path& world, std::size_t robots)
      : emulator_(fresh_folder(name + "_world"), world, config(), static_cast<int>(robots), kSpeed),
        world_(options::load_world(world).value()) {
    for (std::size_t k = 0; k < robots; ++k) {
      folders_.push_back(fresh_folder(name + "_r" + std::to_string(k)));
    }
    robots_.resize(robots);
  }

  /// Starts a robot, or starts it again in the folder it had; those but the first join at `join_port`.
  void start(std::size_t k, std::uint16_t join_port = 0) {
    std::vector<std::string> options = emulator_.robot(static_cast<int>(k));
    const auto set = [&](const std::string& value) { options.insert(options.end(), {"--set", value}); };
    set("fleet.period_s=0.5");
    set("fleet.share_period_s=0.2");
    set("fleet.silence_s=1");  // the world runs many times faster than life, and so does what silence means
    set("loop.map.checkpoint_period_s=10");
    if (k == 0) {
      set("fleet.lead=true");
      set("fleet.port=" + std::to_string(fleet_port_));
    } else {
      set("fleet.join=127.0.0.1:" + std::to_string(join_port != 0 ? join_port : fleet_port_));
    }
    robots_[k].reset();
    robots_[k] = std::make_unique<Daemon>(options, folders_[k], config());
    if (k == 0) {
      const auto text = wait_for_file(folders_[0] / "state" / "r0" / "fleet" / "port", kStart);
      EXPECT_TRUE(text);
      fleet_port_ = text ? static_cast<std::uint16_t>(std::stoi(*text)) : std::uint16_t{0};
    }
  }
  void kill(std::size_t k) { robots_[k]->kill(); }
  /// The world stands still between these: what a robot has kept does not grow old while it is looked at.
  void stop_world() const { emulator_.process->send(SIGSTOP); }
  void let_world_go_on() const { emulator_.process->send(SIGCONT); }
  /// How far robot k is from a place in its map, which begins where the robot did.
  [[nodiscard]] double away_m(std::size_t k, const Pose2& map_T_place) const {
    const std::vector<Point2> path = emulator_.paths()[static_cast<int>(k)];
    return path.empty() ? std::numeric_limits<double>::infinity()
                        : ((world_.starts[k] * map_T_place).translation() - path.back()).norm();
  }
  [[nodiscard]] const Daemon& robot(std::size_t k) const { return *robots_[k]; }
  [[nodiscard]] std::uint16_t fleet_port() const { return fleet_port_; }
  /// Where a restart of the robot takes its map from.
  [[nodiscard]] std::filesystem::path checkpoint(std::size_t k) const {
    return folders_[k] / "state" / "maps" / "checkpoints" / ("r" + std::to_string(k)) / "look-round.seekermap";
  }
  /// Where the main robot keeps what it has received of robot k.
  [[nodiscard]] std::filesystem::path pieces(std::size_t k) const {
    return folders_[0] / "state" / "r0" / "fleet" / ("r" + std::to_string(k));
  }
  /// Where a restart looks for the robot first.
  [[nodiscard]] std::optional<Pose2> kept_place(std::size_t k) const {
    constexpr std::uint32_t kAnyEpoch = 0;  // that of the topology
    std::string ignored;                    // half of it may be there
    return app::read_kept(checkpoint(k).parent_path(), "look-round", kAnyEpoch, ignored).map_T_base;
  }
  void explore(std::size_t k) const {
    std::string output;
    EXPECT_EQ(seeker(robot(k), {"explore", "--strategy", "topological", "--detach", "--id", "look-round"}, &output), 0)
        << output;
  }

  /// Asks the main robot until every other one is as wanted; what it said last.
  [[nodiscard]] api::FleetStatus until(const std::function<bool(const api::FleetMember&)>& wanted) const {
    rpc::FleetClient client({"127.0.0.1", fleet_port_}, kCall);
    const auto end = std::chrono::steady_clock::now() + seconds(120);
    Result<api::FleetStatus> last = fail(Errc::kNotReady, "never asked");
    while (std::chrono::steady_clock::now() < end) {
      last = client.status();
      if (last && last->members.size() == robots_.size() &&
          std::all_of(last->members.begin() + 1, last->members.end(), wanted)) {
        return *last;
      }
      std::this_thread::yield();
    }
    for (const api::FleetMember& member : last ? last->members : std::vector<api::FleetMember>{}) {
      ADD_FAILURE() << member.robot_id << " " << api::to_string(member.state) << ": " << member.reason << "; "
                    << member.pieces_missing << " pieces missing, " << member.pictures << " pictures, of which "
                    << (member.merged_with ? member.merged_with->pictures : 0U) << " confirm the merge";
    }
    EXPECT_TRUE(last) << last.error().message;
    return last ? *last : api::FleetStatus{};
  }
  /// All merged and everything sent: how they lie, and the joint map as `seeker fleet map` writes it.
  [[nodiscard]] FleetOutcome outcome() const {
    FleetOutcome outcome;
    outcome.fleet = until([](const api::FleetMember& member) {
      return member.state == api::FleetState::kMerged && member.main_T_map && member.pieces_missing == 0;
    });
    const std::filesystem::path file = folders_[0] / "joint.seekermap";
    std::string output;
    EXPECT_EQ(seeker(robot(0),
                     {"fleet", "map", file, "--main", "127.0.0.1:" + std::to_string(fleet_port_), "--timeout", "60"},
                     &output),
              0)
        << output;
    Result<store::MapFile> map = store::read_map_file(file);
    EXPECT_TRUE(map) << map.error().message;
    outcome.map = map ? std::move(map->map) : LineMap{};
    return outcome;
  }
  /// Where the map of robot k truly lies in that of the first one.
  [[nodiscard]] Pose2 truth(std::size_t k) const { return inverse(world_.starts[0]) * world_.starts[k]; }
  void expect_near_truth(const api::FleetStatus& fleet, double within_m, double within_deg) const {
    for (std::size_t k = 1; k < fleet.members.size(); ++k) {
      const Pose2 main_T_map = fleet.members[k].main_T_map.value_or(Pose2{});
      EXPECT_LT(distance_m(main_T_map, truth(k)), within_m) << fleet.members[k].robot_id;
      EXPECT_LT(std::abs(rad_to_deg(wrap_angle(main_T_map.theta_rad - truth(k).theta_rad))), within_deg)
          << fleet.members[k].robot_id;
    }
  }

 private:
  /// Faster, and what a robot keeps on a busy disk is a minute old when it is killed: then it is somewhere else.
  static constexpr double kSpeed = 10.0;
  static std::filesystem::path config() { return source_file("config/robots/arena.yaml"); }

  Emulator emulator_;
  sim::World world_;
  std::vector<std::filesystem::path> folders_;
  std::vector<std::unique_ptr<Daemon>> robots_;
  std::uint16_t fleet_port_ = 0;
};

}  // namespace seeker::testing
