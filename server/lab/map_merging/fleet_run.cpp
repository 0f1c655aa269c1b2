#include "server/lab/map_merging/fleet_run.hpp"
#include "server/lab/experiments/load_run.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>
#include <utility>

#include "common/config/yaml.hpp"
#include "common/files/files.hpp"
#include "common/image/png.hpp"
#include "server/app/composition/robot_assembly.hpp"
#include "server/lab/experiments/described_json.hpp"
#include "server/lab/experiments/resumable.hpp"
#include "server/lab/experiments/seeds.hpp"
#include "server/lab/experiments/table.hpp"
#include "server/lab/map_merging/fleet_exchange.hpp"
#include "server/lab/map_merging/fleet_watch.hpp"
#include "server/lab/map_merging/reproduce_map_merging.hpp"
#include "server/options/world_options.hpp"

namespace seeker::lab {
namespace {

api::MissionRequest request_of(const FleetSpec& spec) {
  api::ExploreMission explore;
  explore.strategy = spec.strategy;
  api::MissionRequest request;
  request.id = "seed-" + std::to_string(spec.seed);
  request.task = explore;
  request.time_limit = seconds(spec.time_limit_s);
  return request;
}

/// A robot whose devices are those of the shared world.
Result<std::unique_ptr<FleetMember>> seat(const FleetSpec& spec, app::RobotOptions options, std::size_t index,
                                          drivers::SimDevices devices) {
  auto member = std::make_unique<FleetMember>();
  member->id = "robot-" + std::to_string(index + 1);
  options.robot_id = member->id;
  options.sim.seed = spec.seed + index;
  options.fleet.lead = true;  // it takes pictures for its fleet
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
void run_all(const FleetSpec& spec, FleetMembers& members) {
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
  f.field("pictures", result.pictures);
  f.field("alike", result.alike);
  f.field("injected", result.injected);
  f.field("false_rejected", result.false_rejected);
  f.field("false_offered", result.false_offered);
  f.field("false_accepted", result.false_accepted);
}

Result<std::string> settings_of(const FleetSpec& spec) {
  Result<TextHash> hash = settings_hash(sim_options(spec), spec);
  if (!hash) {
    return tl::unexpected<Error>(hash.error());
  }
  hash->add(std::to_string(spec.robots) + " " + std::to_string(spec.merge_period_s) +
            (spec.inject_false_pair ? " false pair" : "") + " " + std::string(to_string(spec.strategy)));
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
  FleetMembers members;
  for (std::size_t k = 0; k < devices->robots.size(); ++k) {
    Result<std::unique_ptr<FleetMember>> member = seat(spec, *options, k, std::move(devices->robots[k]));
    if (!member) {
      return tl::unexpected<Error>(member.error());
    }
    members.push_back(*std::move(member));
  }
  FleetExchange exchange(members, spec, options->fleet.merge);
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
    const std::string label = spec.label.empty() ? "" : "-" + spec.label;
    return out / "runs" / spec.world_file.stem() / ("fleet-" + std::to_string(spec.robots) + label) /
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
    const std::filesystem::path figure = std::filesystem::path(kind.file(spec)).replace_extension(".png");
    if (const Status drawn = image::write_png(figure, merged_figure(*result)); !drawn) {
      return tl::unexpected<Error>(drawn.error());
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
