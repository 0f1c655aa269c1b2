#include <algorithm>
#include <functional>
#include <limits>

#include "server/lab/active_slam/explore_experiment.hpp"
#include "server/lab/efficiency/reproduce_efficiency.hpp"

namespace seeker::lab {
namespace {

using Value = std::function<double(const ExploreResult&)>;

const ExploreResult* run_of(const EfficiencyRuns& world, const std::string& strategy, std::uint64_t seed) {
  const auto found = std::find_if(world.runs.begin(), world.runs.end(), [&](const ExploreResult& run) {
    return run.strategy == strategy && run.seed == seed;
  });
  return found != world.runs.end() ? &*found : nullptr;
}

/// Means of both over the seeds that both strategies were run on.
struct Pair {
  double tour = 0.0;
  double frontier = 0.0;
  std::size_t seeds = 0;
};

Pair means_of(const EfficiencyRuns& world, const Value& value) {
  std::vector<double> tour;
  std::vector<double> frontier;
  for (const ExploreResult& run : world.runs) {
    const ExploreResult* other = run_of(world, "frontier", run.seed);
    if (run.strategy == "tour" && other != nullptr) {
      tour.push_back(value(run));
      frontier.push_back(value(*other));
    }
  }
  return {mean_spread(tour).mean, mean_spread(frontier).mean, tour.size()};
}

void check_share(const EfficiencyRuns& world, const std::string& what, const Value& value, double limit,
                 Report& report) {
  const Pair pair = means_of(world, value);
  if (limit <= 0.0 || pair.seeds == 0 || pair.frontier <= 0.0) {
    return;
  }
  const double share = pair.tour / pair.frontier;
  report.add({"E-" + what,
              share <= limit,
              {{"world", world.world.name},
               {"tour", fixed(pair.tour, 1)},
               {"frontier", fixed(pair.frontier, 1)},
               {"share", fixed(share, 3)},
               {"limit", fixed(limit, 2)},
               {"seeds", std::to_string(pair.seeds)}}});
}

void check_map(const EfficiencyRuns& world, Report& report) {
  double walls = 0.0;
  double error_m = 0.0;
  double count = 0.0;
  for (const ExploreResult& run : world.runs) {
    if (run.strategy == "tour") {
      walls += run.wall_share;
      error_m += run.mean_error_m;
      count += 1.0;
    }
  }
  if (count > 0.0) {
    report.add(
        {"E-WALLS",
         walls / count >= kEfficientWallShare,
         {{"world", world.world.name}, {"mean", fixed(walls / count, 4)}, {"limit", fixed(kEfficientWallShare, 2)}},
         // The limit is set for the judged worlds; what is left elsewhere is told.
         !world.world.judged()});
    report.add({"E-ERROR",
                error_m / count <= kEfficientError_m,
                {{"world", world.world.name},
                 {"mean_m", fixed(error_m / count, 4)},
                 {"limit_m", fixed(kEfficientError_m, 2)}}});
  }
}

}  // namespace

void check_efficiency(const EfficiencyRuns& world, Report& report) {
  check_share(
      world, "PATH", [](const ExploreResult& run) { return run.path_length_m; }, world.world.path_share, report);
  check_share(
      world, "TIME", [](const ExploreResult& run) { return run.robot_time_s; }, world.world.time_share, report);
  check_map(world, report);
  int contacts = 0;
  for (const ExploreResult& run : world.runs) {
    contacts += run.contacts;
  }
  report.add({"E-CONTACT",
              contacts == 0,
              {{"world", world.world.name},
               {"contacts", std::to_string(contacts)},
               {"runs", std::to_string(world.runs.size())}}});
}

}  // namespace seeker::lab
