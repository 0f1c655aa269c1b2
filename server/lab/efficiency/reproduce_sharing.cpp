#include "server/lab/efficiency/reproduce_sharing.hpp"

#include <algorithm>
#include <iterator>

#include "server/lab/active_slam/explore_experiment.hpp"
#include "server/lab/experiments/seeds.hpp"

namespace seeker::lab {
namespace {

template <typename Run, typename Value>
MeanSpread spread_of(const std::vector<Run>& runs, Value value) {
  std::vector<double> all;
  std::transform(runs.begin(), runs.end(), std::back_inserter(all), value);
  return mean_spread(all);
}

std::string cell(const MeanSpread& spread) { return fixed(spread.mean, 0) + " +- " + fixed(spread.sigma, 0); }

MeanSpread time_alone(const SharingRuns& world) {
  return spread_of(world.alone, [](const ExploreResult& run) { return run.robot_time_s; });
}

MeanSpread time_of(const std::vector<FleetResult>& fleet) {
  return spread_of(fleet, [](const FleetResult& run) { return run.world_time_s; });
}

template <typename Run, typename Value>
int sum_of(const std::vector<Run>& runs, Value value) {
  int sum = 0;
  for (const Run& run : runs) {
    sum += value(run);
  }
  return sum;
}

std::vector<std::string> row_alone(const SharingRuns& world) {
  const auto complete = std::count_if(world.alone.begin(), world.alone.end(), [](const ExploreResult& run) {
    return run.outcome == to_string(api::Outcome::kComplete);
  });
  return {world.world.name,
          "1",
          std::to_string(world.alone.size()),
          cell(time_alone(world)),
          fixed(1.0, 2),
          cell(spread_of(world.alone, [](const ExploreResult& run) { return run.path_length_m; })),
          "-",
          "-",
          "0",
          std::to_string(sum_of(world.alone, [](const ExploreResult& run) { return run.contacts; })),
          std::to_string(complete) + "/" + std::to_string(world.alone.size())};
}

std::vector<std::string> row_of(const SharingRuns& world, const std::vector<FleetResult>& fleet) {
  const auto all_complete =
      std::count_if(fleet.begin(), fleet.end(), [](const FleetResult& run) { return run.complete == run.robots; });
  return {world.world.name,
          std::to_string(fleet.front().robots),
          std::to_string(fleet.size()),
          cell(time_of(fleet)),
          fixed(time_of(fleet).mean / time_alone(world).mean, 2),
          cell(spread_of(fleet, [](const FleetResult& run) { return run.path_length_m; })),
          cell(spread_of(fleet, [](const FleetResult& run) { return run.merged_at_s; })),
          cell(spread_of(fleet, [](const FleetResult& run) { return run.waited_s; })),
          std::to_string(sum_of(fleet, [](const FleetResult& run) { return run.wrong; })),
          std::to_string(sum_of(fleet, [](const FleetResult& run) { return run.contacts + run.robot_contacts; })),
          std::to_string(all_complete) + "/" + std::to_string(fleet.size())};
}

Status run_world(const ReproduceParams& params, SharingRuns& world) {
  ExploreSpec alone;
  alone.robot_file = params.config / "robots" / (world.world.robot + ".yaml");
  alone.world_file = params.config / "worlds" / (world.world.name + ".yaml");
  alone.overrides = params.overrides;
  alone.strategy = api::ExploreStrategy::kTour;
  const std::vector<ExploreSpec> specs = with_seeds(alone, params.seeds);
  Result<std::vector<ExploreResult>> runs = explore_missing(specs, params.out, params.jobs, params.show_progress);
  if (!runs) {
    return tl::unexpected<Error>(runs.error());
  }
  world.alone = std::move(*runs);
  const int most = params.smallest ? 2 : world.world.most_robots;
  for (int robots = 2; robots <= most; ++robots) {
    std::vector<FleetSpec> fleets;
    for (const ExploreSpec& one : specs) {
      FleetSpec& fleet = fleets.emplace_back();
      static_cast<SimSpec&>(fleet) = one;
      fleet.strategy = one.strategy;
      fleet.robots = robots;
    }
    Result<std::vector<FleetResult>> results = fleet_missing(fleets, params.out, params.show_progress);
    if (!results) {
      return tl::unexpected<Error>(results.error());
    }
    world.fleets.push_back(std::move(*results));
  }
  return {};
}

}  // namespace

const std::vector<SharingWorld>& sharing_worlds() {
  static const std::vector<SharingWorld> worlds = {{"arena-20", "arena", 4}, {"office", "arena", 3}};
  return worlds;
}

Table sharing_table(const std::vector<SharingRuns>& worlds) {
  Table table({"world", "robots", "seeds", "time, s", "share", "path of all, m", "merged at, s", "waited, s", "wrong",
               "contacts", "complete"});
  for (const SharingRuns& world : worlds) {
    table.add(row_alone(world));
    for (const std::vector<FleetResult>& fleet : world.fleets) {
      table.add(row_of(world, fleet));
    }
  }
  return table;
}

void check_sharing(const SharingRuns& world, Report& report) {
  const double alone_s = time_alone(world).mean;
  const double two_s = time_of(world.fleets.front()).mean;
  const double limit = world.alone.size() < kManyRuns ? kTwoRobotsShareOfFew : kTwoRobotsShare;
  report.add({"E-TWO",
              two_s <= limit * alone_s,
              {{"world", world.world.name},
               {"one_s", fixed(alone_s, 1)},
               {"two_s", fixed(two_s, 1)},
               {"share", fixed(two_s / alone_s, 3)},
               {"limit", fixed(limit, 2)},
               {"seeds", std::to_string(world.alone.size())}}});
  int wrong = 0;
  int contacts = sum_of(world.alone, [](const ExploreResult& run) { return run.contacts; });
  for (const std::vector<FleetResult>& fleet : world.fleets) {
    wrong += sum_of(fleet, [](const FleetResult& run) { return run.wrong; });
    contacts += sum_of(fleet, [](const FleetResult& run) { return run.contacts + run.robot_contacts; });
  }
  report.add({"E-WRONG", wrong == 0, {{"world", world.world.name}, {"wrong", std::to_string(wrong)}}});
  report.add({"E-CONTACT", contacts == 0, {{"world", world.world.name}, {"contacts", std::to_string(contacts)}}});
}

Status reproduce_sharing(const ReproduceParams& params, Report& report) {
  std::error_code error;
  std::filesystem::create_directories(params.out, error);
  std::vector<SharingRuns> worlds;
  for (const SharingWorld& world : sharing_worlds()) {
    const bool left_out = params.smallest && params.worlds.empty() && &world != &sharing_worlds().front();
    if (!params.takes_world(world.name) || left_out) {
      continue;
    }
    SharingRuns& runs = worlds.emplace_back();
    runs.world = world;
    if (Status ok = run_world(params, runs); !ok) {
      return ok;
    }
    check_sharing(runs, report);
    if (Status ok = write_table(params.out, sharing_table(worlds)); !ok) {
      return ok;
    }
  }
  return {};
}

}  // namespace seeker::lab
