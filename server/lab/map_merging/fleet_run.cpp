#include "server/lab/map_merging/fleet_run.hpp"
#include "server/lab/experiments/load_run.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>
#include <utility>

#include "common/config/yaml.hpp"
#include "common/core/angle.hpp"
#include "common/files/files.hpp"
#include "server/app/composition/robot_assembly.hpp"
#include "server/app/runtime/update_hub.hpp"
#include "server/fleet/map_merger.hpp"
#include "server/fleet/topology_map.hpp"
#include "server/lab/experiments/described_json.hpp"
#include "server/lab/experiments/resumable.hpp"
#include "server/lab/experiments/seeds.hpp"
#include "server/lab/experiments/table.hpp"
#include "server/lab/map_merging/fleet_traffic.hpp"
#include "server/lab/map_merging/fleet_watch.hpp"
#include "server/nav/shared_floor.hpp"
#include "server/options/world_options.hpp"

namespace seeker::lab {
namespace {

/// One robot: its loop, the reports of its behaviour, its map ready for being merged.
struct Member {
  std::string id;
  app::UpdateHub hub;
  std::shared_ptr<sim::Simulation> simulation;
  std::shared_ptr<drivers::Clock> clock;
  std::unique_ptr<app::RobotLoop> loop;
  fleet::PreparedMap map;
  Status ran;
};
using Members = std::vector<std::unique_ptr<Member>>;

/// How two robots' maps lie to each other.
struct Relation {
  std::size_t a = 0;
  std::size_t b = 0;
  std::optional<Pose2> a_T_b;
  std::optional<RobotTime> since;
};

constexpr Duration kFloorPeriod = std::chrono::seconds(5);
constexpr Duration kSharePeriod = std::chrono::seconds(1);

/// Floor that is neither unknown nor occupied.
double seen_m2(const std::optional<Grid<std::uint8_t>>& map) {
  if (!map) {
    return 0.0;
  }
  const auto free = std::count_if(map->cells().begin(), map->cells().end(),
                                  [](std::uint8_t cell) { return cell != kUnknownCell && cell < kOccupiedCell / 2; });
  return static_cast<double>(free) * map->frame().resolution_m * map->frame().resolution_m;
}

/// The data that the robots exchange between two ticks.
class Exchange {
 public:
  Exchange(Members& members, const FleetSpec& spec)
      : members_(members), period_(seconds(spec.merge_period_s)), floors_(members.size()) {
    for (std::size_t k = 0; spec.count_traffic && k < members_.size(); ++k) {
      traffic_.emplace_back(members_[k]->id);
    }
    for (std::size_t a = 0; a < members_.size(); ++a) {
      for (std::size_t b = a + 1; b < members_.size(); ++b) {
        relations_.push_back({a, b, {}, {}});
      }
    }
  }

  void between(RobotTime now) {
    if (now >= next_merge_) {
      next_merge_ = now + period_;
      merge(now);
    }
    if (now >= next_floors_) {
      next_floors_ = now + kFloorPeriod;
      carry_floors();
    }
    for (std::size_t k = 0; k < members_.size(); ++k) {
      deliver(k);
    }
    if (now >= next_share_) {
      next_share_ = now + kSharePeriod;
      for (std::size_t k = 0; k < traffic_.size(); ++k) {
        traffic_[k].share(members_[k]->loop->neighbours().own());
      }
    }
  }
  void fill(FleetResult& result) const {
    result.pairs = static_cast<int>(relations_.size());
    result.wrong = wrong_;
    for (std::size_t k = 0; k < traffic_.size(); ++k) {
      const auto robots = static_cast<double>(traffic_.size());
      result.sent_bytes += static_cast<double>(traffic_[k].bytes()) / robots;
      result.seen_m2 += seen_m2(members_[k]->loop->robot_map().occupancy().snapshot()) / robots;
    }
    for (const Relation& relation : relations_) {
      if (relation.a_T_b) {
        const auto [error_m, error_rad] = error_of(relation);
        ++result.merged;
        result.merged_at_s = std::max(result.merged_at_s, to_seconds(*relation.since));
        result.error_m = std::max(result.error_m, error_m);
        result.error_deg = std::max(result.error_deg, rad_to_deg(error_rad));
      }
    }
  }

 private:
  void merge(RobotTime now) {
    for (std::size_t k = 0; k < members_.size(); ++k) {
      const auto& member = members_[k];
      if (Result<LineMap> map = member->loop->robot_map().map()) {
        if (!traffic_.empty()) {
          traffic_[k].announce(*map);
        }
        (void)member->map.update(*std::move(map));  // a map without walls yet is not to be merged
      }
    }
    for (Relation& relation : relations_) {
      const fleet::MergeAnswer answer = merger_.merge(members_[relation.a]->map, members_[relation.b]->map);
      if (answer.merged()) {
        relation.a_T_b = answer.hypotheses.front().a_T_b.a_T_b;
        relation.since = relation.since.value_or(now);
        const auto [error_m, error_rad] = error_of(relation);
        wrong_ += error_m > kWrongMerge_m || error_rad > kWrongMerge_rad ? 1 : 0;
      }
    }
  }

  /// Position and angle, against where the robots truly began.
  [[nodiscard]] std::pair<double, double> error_of(const Relation& relation) const {
    const Pose2 world_T_a = members_[relation.a]->simulation->truth().world_T_start;
    const Pose2 world_T_b = members_[relation.b]->simulation->truth().world_T_start;
    const Pose2 truth = inverse(world_T_a) * world_T_b;
    return {distance_m(truth, *relation.a_T_b), std::abs(wrap_angle(truth.theta_rad - relation.a_T_b->theta_rad))};
  }

  void deliver(std::size_t to) {
    FleetView view{members_[to]->id, {}, floors_[to]};
    for (const Relation& relation : relations_) {
      if (relation.a_T_b && (relation.a == to || relation.b == to)) {
        const Pose2 to_T_from = relation.a == to ? *relation.a_T_b : inverse(*relation.a_T_b);
        view.others.push_back(seen_from(to_T_from, *members_[relation.a == to ? relation.b : relation.a]));
      }
    }
    members_[to]->loop->neighbours().set_fleet(std::move(view), members_[to]->loop->now());
  }

  /// To each robot what the others that are merged with it have seen.
  void carry_floors() {
    for (std::size_t to = 0; to < members_.size(); ++to) {
      std::vector<std::pair<Pose2, nav::SharedFloor>> floors;
      for (const Relation& relation : relations_) {
        if (relation.a_T_b && (relation.a == to || relation.b == to)) {
          const Pose2 to_T_from = relation.a == to ? *relation.a_T_b : inverse(*relation.a_T_b);
          const Member& from = *members_[relation.a == to ? relation.b : relation.a];
          if (auto seen = from.loop->robot_map().occupancy().snapshot()) {
            floors.emplace_back(to_T_from, std::make_shared<const Grid<std::uint8_t>>(*std::move(seen)));
          }
        }
      }
      floors_[to] = nav::carried(floors);
      if (!traffic_.empty()) {
        const api::TileUpdate all = members_[to]->loop->robot_map().tiles_since(0);
        traffic_[to].floor(api::within_limits(all.tiles, members_[to]->loop->status().pose.map_T_base.translation()));
      }
    }
  }

  static RobotTopology seen_from(const Pose2& to_T_from, const Member& from) {
    RobotTopology robot = fleet::moved(from.loop->neighbours().own(), to_T_from);
    robot.robot_id = from.id;
    return robot;
  }

  Members& members_;
  Duration period_;
  RobotTime next_merge_;
  RobotTime next_floors_;
  RobotTime next_share_;
  std::vector<std::shared_ptr<const Grid<std::uint8_t>>> floors_;  ///< by member, in its frame `map`
  std::vector<FleetTraffic> traffic_;                              ///< by member; empty where it is not counted
  fleet::MapMerger merger_;
  std::vector<Relation> relations_;
  int wrong_ = 0;
};

api::MissionRequest request_of(const FleetSpec& spec) {
  api::ExploreMission explore;
  explore.strategy = api::ExploreStrategy::kTopological;
  api::MissionRequest request;
  request.id = "seed-" + std::to_string(spec.seed);
  request.task = explore;
  request.time_limit = seconds(spec.time_limit_s);
  return request;
}

/// A robot whose devices are those of the shared world.
Result<std::unique_ptr<Member>> seat(const FleetSpec& spec, app::RobotOptions options, std::size_t index,
                                     drivers::SimDevices devices) {
  auto member = std::make_unique<Member>();
  member->id = "robot-" + std::to_string(index + 1);
  options.robot_id = member->id;
  options.sim.seed = spec.seed + index;
  Result<app::Assembly> assembly = app::assemble(options);
  if (!assembly) {
    return tl::unexpected<Error>(assembly.error());
  }
  app::Devices& parts = assembly->parts.devices;
  member->simulation = devices.simulation;
  parts.base = std::move(devices.base);
  parts.lidar = std::move(devices.lidar);
  parts.sonar = std::move(devices.sonar);
  parts.camera = std::move(devices.camera);
  parts.stereo = std::move(devices.stereo);
  parts.clock = std::move(devices.clock);
  member->clock = parts.clock;
  member->loop = std::make_unique<app::RobotLoop>(options.loop, std::move(assembly->parts), member->hub);
  return member;
}

Result<drivers::SharedDevices> devices_of(const FleetSpec& spec, const app::RobotOptions& options) {
  Result<sim::World> world = options::load_world(spec.world_file);
  if (!world) {
    return tl::unexpected<Error>(world.error());
  }
  if (spec.robots < 2 || static_cast<std::size_t>(spec.robots) > world->starts.size()) {
    return fail(Errc::kInvalidArgument, "world " + world->name + " has " + std::to_string(world->starts.size()) +
                                            " starts; name as many robots, two at least");
  }
  std::vector<sim::RobotPlace> places;
  places.reserve(static_cast<std::size_t>(spec.robots));
  for (int k = 0; k < spec.robots; ++k) {
    places.push_back({options.sim.robot, spec.seed + static_cast<std::uint64_t>(k), static_cast<std::size_t>(k)});
  }
  return drivers::make_shared_devices(std::move(*world), std::move(places), 0.0, options.sim.devices);
}

/// Every loop in a thread of its own, until all have ended.
void run_all(const FleetSpec& spec, Members& members) {
  std::vector<std::thread> threads;
  for (const auto& member : members) {
    threads.emplace_back([&spec, m = member.get()] {
      const Result<double> ran = run_mission(*m->loop, request_of(spec), [] {});
      m->ran = ran ? Status() : Status(tl::unexpected<Error>(ran.error()));
      m->clock->let_go();
    });
  }
  for (std::thread& thread : threads) {
    thread.join();
  }
}

}  // namespace

void describe(config::Fields& f, FleetResult& result) {
  f.field("schema", result.schema);
  f.field("world", result.world);
  f.field("seed", result.seed);
  f.field("settings", result.settings);
  f.field("robots", result.robots);
  f.field("complete", result.complete);
  f.field("world_time_s", result.world_time_s);
  f.field("wall_time_s", result.wall_time_s);
  f.field("path_length_m", result.path_length_m);
  f.field("contacts", result.contacts);
  f.field("robot_contacts", result.robot_contacts);
  f.field("waited_s", result.waited_s);
  f.field("first_end_s", result.first_end_s);
  f.field("pairs", result.pairs);
  f.field("merged", result.merged);
  f.field("wrong", result.wrong);
  f.field("merged_at_s", result.merged_at_s);
  f.field("error_m", result.error_m);
  f.field("error_deg", result.error_deg);
}

Result<std::string> settings_of(const FleetSpec& spec) {
  Result<TextHash> hash = settings_hash(sim_options(spec), spec);
  if (!hash) {
    return tl::unexpected<Error>(hash.error());
  }
  hash->add(std::to_string(spec.robots) + " " + std::to_string(spec.merge_period_s));
  return hash->hex();
}

Result<FleetResult> run_fleet(const FleetSpec& spec) {
  const Result<app::RobotOptions> options = sim_options(spec);
  if (!options) {
    return tl::unexpected<Error>(options.error());
  }
  Result<drivers::SharedDevices> devices = devices_of(spec, *options);
  if (!devices) {
    return tl::unexpected<Error>(devices.error());
  }
  Members members;
  for (std::size_t k = 0; k < devices->robots.size(); ++k) {
    Result<std::unique_ptr<Member>> member = seat(spec, *options, k, std::move(devices->robots[k]));
    if (!member) {
      return tl::unexpected<Error>(member.error());
    }
    members.push_back(*std::move(member));
  }
  Exchange exchange(members, spec);
  FleetWatch watch;
  for (const auto& member : members) {
    watch.add(member->id, *member->loop, *member->simulation);
  }
  devices->barrier->between = [&exchange, &watch](RobotTime now) {
    exchange.between(now);
    watch.look(now);
  };
  const auto started = std::chrono::steady_clock::now();
  run_all(spec, members);

  FleetResult result;
  result.world = devices->world->world().name;
  result.seed = spec.seed;
  result.robots = spec.robots;
  result.world_time_s = to_seconds(devices->world->now());
  result.wall_time_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  for (const auto& member : members) {
    if (!member->ran) {
      return tl::unexpected<Error>(member->ran.error());
    }
    const auto& last = member->loop->missions().last();
    result.complete += last && last->end && last->end->outcome == api::Outcome::kComplete ? 1 : 0;
    result.path_length_m += member->simulation->truth().path_length_m;
    result.contacts += member->simulation->truth().contacts;
  }
  exchange.fill(result);
  result.robot_contacts = watch.robot_touches();
  result.waited_s = watch.waited_s();
  result.first_end_s = watch.first_end_s();
  result.log = watch.log();
  return result;
}

Result<std::vector<FleetResult>> fleet_missing(const std::vector<FleetSpec>& specs, const std::filesystem::path& out,
                                               bool show_progress) {
  RunKind<FleetSpec, FleetResult> kind;
  kind.file = [&](const FleetSpec& spec) {
    return out / "runs" / spec.world_file.stem() / ("fleet-" + std::to_string(spec.robots)) /
           ("seed-" + std::to_string(spec.seed) + ".json");
  };
  kind.settings = [](const FleetSpec& spec) { return settings_of(spec); };
  kind.load = load_run<FleetResult>;
  kind.make = [&](const FleetSpec& spec, const std::string& settings) -> Result<FleetResult> {
    Result<FleetResult> result = run_fleet(spec);
    if (!result) {
      return result;
    }
    result->settings = settings;
    std::error_code error;
    std::filesystem::create_directories(kind.file(spec).parent_path(), error);
    if (const Status kept = files::write_file(kind.file(spec), to_json(*result)); !kept) {
      return tl::unexpected<Error>(kept.error());
    }
    const std::filesystem::path log = std::filesystem::path(kind.file(spec)).replace_extension(".log");
    if (const Status kept = files::write_file(log, result->log); !kept) {
      return tl::unexpected<Error>(kept.error());
    }
    return result;
  };
  kind.progress_line = [](const FleetResult& result) {
    return std::to_string(result.robots) + " robots, seed " + std::to_string(result.seed) + ": " +
           std::to_string(result.merged) + " of " + std::to_string(result.pairs) + " merged, " +
           fixed(result.world_time_s, 0) + " s";
  };
  constexpr int kOneAtATime = 1;  // a run has a thread for each of its robots
  return resume_runs(specs, kind, kOneAtATime, show_progress);
}

}  // namespace seeker::lab
