#include <algorithm>
#include <cmath>

#include "server/lab/active_slam/reproduce_active_slam.hpp"
#include "server/lab/experiments/seeds.hpp"

namespace seeker::lab {
namespace {

using api::ExploreStrategy;

std::string of(int part, std::size_t all) { return std::to_string(part) + "/" + std::to_string(all); }

int needed(std::size_t seeds, double share) {
  constexpr double kRounding = 1e-9;
  return static_cast<int>(std::ceil(share * static_cast<double>(seeds) - kRounding));
}

/// The runs of two strategies on the same seed.
struct Pair {
  const ExploreResult* one;
  const ExploreResult* other;
};

std::vector<Pair> pairs_of(const WorldRuns& world, ExploreStrategy one, ExploreStrategy other) {
  std::vector<Pair> pairs;
  for (const ExploreResult& run : world.runs) {
    const ExploreResult* second = world.find(other, run.seed);
    if (run.strategy == to_string(one) && second != nullptr) {
      pairs.push_back({&run, second});
    }
  }
  return pairs;
}

std::vector<std::uint64_t> seeds_of(const std::vector<Pair>& pairs) {
  std::vector<std::uint64_t> seeds;
  seeds.reserve(pairs.size());
  for (const Pair& pair : pairs) {
    seeds.push_back(pair.one->seed);
  }
  return seeds;
}

/// On how many seeds active is better than roaming.
struct Wins {
  int error = 0;
  int mean_trace = 0;
  int final_trace = 0;
  int share = 0;
};

Wins wins_of(const std::vector<Pair>& pairs) {
  Wins wins;
  for (const auto& [active, roam] : pairs) {
    wins.error += active->mean_error_m < roam->mean_error_m ? 1 : 0;
    wins.mean_trace += active->mean_robot_trace < roam->mean_robot_trace ? 1 : 0;
    wins.final_trace += active->final_robot_trace < roam->final_robot_trace ? 1 : 0;
    wins.share += active->wall_share > roam->wall_share ? 1 : 0;
  }
  return wins;
}

/// The full trace grows with the map, so what is compared is the robot's block.
void check_against_roaming(const WorldRuns& world, Report& report) {
  const std::vector<Pair> pairs = pairs_of(world, ExploreStrategy::kActive, ExploreStrategy::kRoam);
  if (pairs.empty()) {
    return;
  }
  const Wins wins = wins_of(pairs);
  const int complete = static_cast<int>(
      std::count_if(pairs.begin(), pairs.end(), [](const Pair& p) { return p.one->wall_share >= kR1WallShare; }));
  const auto majority = static_cast<int>(pairs.size()) / 2 + 1;
  const std::string seeds = print_seeds(seeds_of(pairs));
  report.add({.id = "R1",
              .passed = complete >= majority && wins.error >= majority && wins.final_trace >= majority,
              .figures = {{"world", world.world.name},
                          {"walls_95", of(complete, pairs.size())},
                          {"error_lower", of(wins.error, pairs.size())},
                          {"final_trace_lower", of(wins.final_trace, pairs.size())},
                          {"seeds", seeds}}});
  const int most = needed(pairs.size(), kSeedShare);
  report.add({.id = "S1-ROAM",
              .passed = wins.error >= most && wins.mean_trace >= most && wins.share >= most,
              .figures = {{"world", world.world.name},
                          {"error_lower", of(wins.error, pairs.size())},
                          {"trace_lower", of(wins.mean_trace, pairs.size())},
                          {"walls_more", of(wins.share, pairs.size())},
                          {"needed", std::to_string(most)},
                          {"seeds", seeds}}});
}

std::vector<const ExploreResult*> runs_of(const WorldRuns& world, ExploreStrategy strategy) {
  std::vector<const ExploreResult*> runs;
  for (const ExploreResult& run : world.runs) {
    if (run.strategy == to_string(strategy)) {
      runs.push_back(&run);
    }
  }
  return runs;
}

void check_map(const WorldRuns& world, ExploreStrategy strategy, Report& report) {
  const std::vector<const ExploreResult*> runs = runs_of(world, strategy);
  if (runs.empty()) {
    return;
  }
  int good = 0;
  double share_min = 1.0;
  double error_max_m = 0.0;
  std::vector<std::uint64_t> seeds;
  for (const ExploreResult* run : runs) {
    good += run->wall_share >= kWallShare && run->mean_error_m <= world.world.error_limit_m ? 1 : 0;
    share_min = std::min(share_min, run->wall_share);
    error_max_m = std::max(error_max_m, run->mean_error_m);
    seeds.push_back(run->seed);
  }
  report.add({.id = "S1-MAP",
              .passed = good >= needed(runs.size(), kSeedShare),
              .figures = {{"world", world.world.name},
                          {"strategy", std::string(to_string(strategy))},
                          {"good", of(good, runs.size())},
                          {"walls_min", fixed(share_min, 3)},
                          {"walls_limit", fixed(kWallShare, 2)},
                          {"error_max_m", fixed(error_max_m, 3)},
                          {"error_limit_m", fixed(world.world.error_limit_m, 2)},
                          {"seeds", print_seeds(seeds)}}});
}

void check_contacts(const WorldRuns& world, Report& report) {
  if (world.runs.empty()) {
    return;
  }
  int contacts = 0;
  double clearance_m = world.runs.front().min_clearance_m;
  for (const ExploreResult& run : world.runs) {
    contacts += run.contacts;
    clearance_m = std::min(clearance_m, run.min_clearance_m);
  }
  report.add({.id = "S1-CONTACT",
              .passed = contacts == 0,
              .figures = {{"world", world.world.name},
                          {"contacts", std::to_string(contacts)},
                          {"least_clearance_m", fixed(clearance_m, 3)},
                          {"runs", std::to_string(world.runs.size())}}});
}

/// The condition is about the mean of many seeds, of which the ratio of one scatters by kRatioScatter (twenty seeds of
/// the corridor): few seeds are allowed the standard error of their mean.
double horizon_limit(std::size_t seeds) {
  constexpr double kRatioScatter = 0.033;
  constexpr std::size_t kMany = 10;
  return seeds < kMany ? 1.0 + kRatioScatter / std::sqrt(static_cast<double>(seeds)) : 1.0;
}

/// Path length of the horizon planner until its map holds as much as the best baseline's at its end (to within a per
/// cent), divided by that baseline's path length. The planner then continues to walls that the baselines leave; the
/// whole path length is reported too.
void check_horizon(const WorldRuns& world, Report& report) {
  constexpr double kSameShare = 0.01;
  double horizon_m = 0.0;
  double whole_m = 0.0;
  double best_m = 0.0;
  int same = 0;
  std::vector<std::uint64_t> seeds;
  for (const ExploreResult* horizon : runs_of(world, ExploreStrategy::kHorizon)) {
    const ExploreResult* best = nullptr;
    for (const ExploreStrategy baseline : {ExploreStrategy::kFrontier, ExploreStrategy::kGain}) {
      const ExploreResult* run = world.find(baseline, horizon->seed);
      if (run != nullptr && (best == nullptr || run->path_length_m < best->path_length_m)) {
        best = run;
      }
    }
    if (best != nullptr) {
      same += horizon->wall_share >= best->wall_share - kSameShare ? 1 : 0;
      horizon_m += horizon->path_to_share_m(best->wall_share - kSameShare);
      whole_m += horizon->path_length_m;
      best_m += best->path_length_m;
      seeds.push_back(horizon->seed);
    }
  }
  if (seeds.empty()) {
    return;
  }
  const auto over_best = [best_m](double path_m) { return best_m > 0.0 ? path_m / best_m : 0.0; };
  const double ratio = over_best(horizon_m);
  const double limit = horizon_limit(seeds.size());
  report.add({.id = "S1-HORIZON",
              .passed = best_m > 0.0 && ratio <= limit && same >= needed(seeds.size(), kSeedShare),
              .figures = {{"world", world.world.name},
                          {"path_ratio", fixed(ratio, 3)},
                          {"limit", fixed(limit, 3)},
                          {"whole_path_ratio", fixed(over_best(whole_m), 3)},
                          {"same_map", of(same, seeds.size())},
                          {"seeds", print_seeds(seeds)}}});
}

/// Mean of a figure over the runs.
template <class Value>
double mean_of(const std::vector<const ExploreResult*>& runs, const Value& value) {
  double sum = 0.0;
  for (const ExploreResult* run : runs) {
    sum += value(*run);
  }
  return runs.empty() ? 0.0 : sum / static_cast<double>(runs.size());
}

/// On how many seeds the value of the active run is lower.
template <class Value>
int lower(const std::vector<Pair>& pairs, const Value& value) {
  return static_cast<int>(
      std::count_if(pairs.begin(), pairs.end(), [&](const Pair& p) { return value(*p.one) < value(*p.other); }));
}

double error_m(const ExploreResult& r) { return r.mean_error_m; }
double wall_share(const ExploreResult& r) { return r.wall_share; }
double robot_trace(const ExploreResult& r) { return r.mean_robot_trace; }
double feature_trace(const ExploreResult& r) { return r.mean_feature_trace; }

}  // namespace

const ExploreResult* WorldRuns::find(ExploreStrategy strategy, std::uint64_t seed) const {
  const auto run = std::find_if(runs.begin(), runs.end(), [&](const ExploreResult& r) {
    return r.strategy == to_string(strategy) && r.seed == seed;
  });
  return run == runs.end() ? nullptr : &*run;
}

void check_figures(const WorldRuns& world, bool printed, Report& report) {
  const std::vector<Pair> pairs = pairs_of(world, ExploreStrategy::kActive, ExploreStrategy::kRoam);
  if (pairs.empty()) {
    return;
  }
  const std::vector<const ExploreResult*> active = runs_of(world, ExploreStrategy::kActive);
  const std::vector<const ExploreResult*> roam = runs_of(world, ExploreStrategy::kRoam);
  const auto majority = static_cast<int>(pairs.size()) / 2 + 1;
  const auto add = [&](const char* id, const char* claim, bool passed, auto figures) {
    Check check{.id = id, .passed = passed, .figures = {}, .finding = printed};
    check.figures = {{"robot", printed ? "printed" : "ours"}, {"claim", claim}};
    check.figures.insert(check.figures.end(), figures.begin(), figures.end());
    check.figures.emplace_back("seeds", print_seeds(seeds_of(pairs)));
    report.add(std::move(check));
  };
  using Figures = std::vector<std::pair<std::string, std::string>>;
  const int more = static_cast<int>(pairs.size()) - lower(pairs, wall_share);
  add("R1-FIG4", "roaming_maps_less", more >= majority,
      Figures{{"roam_walls", fixed(mean_of(roam, wall_share), 3)},
              {"active_walls", fixed(mean_of(active, wall_share), 3)},
              {"active_more", of(more, pairs.size())}});
  const auto whole = [](const ExploreResult* run) { return run->wall_share >= kR1WallShare; };
  const auto complete = static_cast<int>(std::count_if(active.begin(), active.end(), whole));
  const double along_wall_m = mean_of(active, [](const ExploreResult& r) { return r.along_wall_m; });
  add("R1-FIG5", "active_maps_all", complete >= majority && along_wall_m > 0.0,
      Figures{{"walls_95", of(complete, active.size())},
              {"along_wall_m", fixed(along_wall_m, 1)},
              {"path_m", fixed(mean_of(active, [](const ExploreResult& r) { return r.path_length_m; }), 1)},
              {"time_s", fixed(mean_of(active, [](const ExploreResult& r) { return r.robot_time_s; }), 0)}});
  add("R1-FIG6", "active_error_lower", lower(pairs, error_m) >= majority,
      Figures{{"active_error_m", fixed(mean_of(active, error_m), 4)},
              {"roam_error_m", fixed(mean_of(roam, error_m), 4)},
              {"lower", of(lower(pairs, error_m), pairs.size())}});
  const int robots = lower(pairs, robot_trace);
  const int features = lower(pairs, feature_trace);
  add("R1-FIG7", "active_trace_lower", robots >= majority && features >= majority,
      Figures{{"active_robot_trace", fixed(mean_of(active, robot_trace), 7)},
              {"roam_robot_trace", fixed(mean_of(roam, robot_trace), 7)},
              {"robot_lower", of(robots, pairs.size())},
              {"feature_lower", of(features, pairs.size())}});
}

void check_explorations(const WorldRuns& world, Report& report) {
  check_against_roaming(world, report);
  check_map(world, ExploreStrategy::kActive, report);
  check_map(world, ExploreStrategy::kHorizon, report);
  check_horizon(world, report);
  check_contacts(world, report);
}

}  // namespace seeker::lab
