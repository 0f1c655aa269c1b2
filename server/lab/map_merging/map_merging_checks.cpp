#include <algorithm>
#include <cmath>

#include "common/core/angle.hpp"
#include "server/lab/active_slam/explore_experiment.hpp"
#include "server/lab/active_slam/reproduce_active_slam.hpp"
#include "server/lab/experiments/seeds.hpp"
#include "server/lab/experiments/table.hpp"
#include "server/lab/map_merging/reproduce_map_merging.hpp"

namespace seeker::lab {
namespace {

constexpr double kSweep_rad = deg_to_rad(0.25);
constexpr double kRounding_m = 1e-6;

/// Spec S4.1 as it is written, beam by beam.
bool blocked(const LaserScan& scan, double angle_rad, double radius_m, double width_m) {
  for (std::size_t beam = 0; beam < scan.ranges_m.size(); ++beam) {
    const auto range_m = static_cast<double>(scan.ranges_m[beam]);
    const double off_rad = scan.base_T_laser.theta_rad + scan.angle_rad(beam) - angle_rad;
    const double along_m = range_m * std::cos(off_rad);
    if (std::isfinite(range_m) && along_m > 0.0 && along_m <= radius_m &&
        std::abs(range_m * std::sin(off_rad)) <= 0.5 * width_m) {
      return true;
    }
  }
  return false;
}

}  // namespace

Check check_tree(const LaserScan& scan, const fleet::SpaceTree& tree, const fleet::SpaceTreeParams& params) {
  int directions = 0;
  int wrong = 0;
  int layers = 0;
  for (const fleet::SpaceSection& section : tree.sections) {
    layers = std::max(layers, section.layer);
    for (double off_rad = kSweep_rad; off_rad < section.span_rad; off_rad += kSweep_rad) {
      ++directions;
      wrong += blocked(scan, section.start_rad + off_rad, section.radius_m - kRounding_m,
                       params.corridor_width_m - kRounding_m)
                   ? 1
                   : 0;
    }
  }
  const auto outside = std::count_if(tree.goals.begin(), tree.goals.end(),
                                     [&](const fleet::SpaceGoal& goal) { return !tree.admits(goal.p_base); });
  return {.id = "S4-TREE",
          .passed = directions > 0 && wrong == 0 && outside == 0 && tree.main_goal.has_value(),
          .figures = {{"sections", std::to_string(tree.sections.size())},
                      {"layers", std::to_string(layers)},
                      {"goals", std::to_string(tree.goals.size())},
                      {"directions", std::to_string(directions)},
                      {"blocked", std::to_string(wrong)},
                      {"goals_outside", std::to_string(outside)}}};
}

Check check_single(const std::vector<ExploreResult>& runs) {
  int good = 0;
  int contacts = 0;
  double share_min = 1.0;
  double error_max_m = 0.0;
  std::vector<double> path_m;
  std::vector<double> time_s;
  std::vector<std::uint64_t> seeds;
  for (const ExploreResult& run : runs) {
    const bool complete = run.outcome == to_string(api::Outcome::kComplete);
    good += complete && run.wall_share >= kArenaWallShare && run.contacts == 0 ? 1 : 0;
    contacts += run.contacts;
    share_min = std::min(share_min, run.wall_share);
    error_max_m = std::max(error_max_m, run.mean_error_m);
    path_m.push_back(run.path_length_m);
    time_s.push_back(run.robot_time_s);
    seeds.push_back(run.seed);
  }
  const int needed = static_cast<int>(std::ceil(kSeedShare * static_cast<double>(runs.size())));
  return {.id = "S4-SINGLE",
          .passed = !runs.empty() && good >= needed,
          .figures = {{"good", std::to_string(good) + "/" + std::to_string(runs.size())},
                      {"walls_min", fixed(share_min, 3)},
                      {"walls_limit", fixed(kArenaWallShare, 2)},
                      {"contacts", std::to_string(contacts)},
                      {"error_max_m", fixed(error_max_m, 3)},
                      {"path_m", fixed(mean_spread(path_m).mean, 1)},
                      {"time_s", fixed(mean_spread(time_s).mean, 0)},
                      {"seeds", print_seeds(seeds)}}};
}

Check check_merges(const std::vector<FleetResult>& runs) {
  int merged = 0;
  int wrong = 0;
  double error_m = 0.0;
  double error_deg = 0.0;
  std::vector<double> at_s;
  std::vector<std::uint64_t> seeds;
  for (const FleetResult& run : runs) {
    const bool all = run.merged == run.pairs && run.error_m <= kMergeError_m && run.error_deg <= kMergeError_deg;
    merged += all ? 1 : 0;
    wrong += run.wrong;
    error_m = std::max(error_m, run.error_m);
    error_deg = std::max(error_deg, run.error_deg);
    if (run.merged > 0) {
      at_s.push_back(run.merged_at_s);
    }
    seeds.push_back(run.seed);
  }
  const int needed = static_cast<int>(std::ceil(kMergeShare * static_cast<double>(runs.size())));
  return {.id = "R8",
          .passed = !runs.empty() && merged >= needed && wrong == 0,
          .figures = {{"merged", std::to_string(merged) + "/" + std::to_string(runs.size())},
                      {"wrong", std::to_string(wrong)},
                      {"error_max_m", fixed(error_m, 3)},
                      {"limit_m", fixed(kMergeError_m, 2)},
                      {"error_max_deg", fixed(error_deg, 2)},
                      {"limit_deg", fixed(kMergeError_deg, 1)},
                      {"merged_at_s", fixed(mean_spread(at_s).mean, 0)},
                      {"seeds", print_seeds(seeds)}}};
}

Check check_trap(const std::vector<FleetResult>& runs) {
  int merged = 0;
  int wrong = 0;
  double error_m = 0.0;
  std::vector<std::uint64_t> seeds;
  for (const FleetResult& run : runs) {
    merged += run.merged == run.pairs ? 1 : 0;
    wrong += run.wrong;
    error_m = std::max(error_m, run.error_m);
    seeds.push_back(run.seed);
  }
  return {.id = "S4-TRAP",
          .passed = !runs.empty() && wrong == 0,
          .figures = {{"wrong", std::to_string(wrong)},
                      {"merged", std::to_string(merged) + "/" + std::to_string(runs.size())},
                      {"error_max_m", fixed(error_m, 3)},
                      {"seeds", print_seeds(seeds)}}};
}

Check check_sharing(const std::vector<FleetResult>& runs, const std::vector<ExploreResult>& single) {
  std::vector<double> ratios;
  int contacts = 0;
  for (const FleetResult& run : runs) {
    const auto alone = std::find_if(single.begin(), single.end(),
                                    [&](const ExploreResult& candidate) { return candidate.seed == run.seed; });
    if (alone != single.end() && alone->robot_time_s > 0.0) {
      ratios.push_back(run.world_time_s / alone->robot_time_s);
    }
    contacts += run.contacts;
  }
  const double mean = mean_spread(ratios).mean;
  const double limit = ratios.size() < kSharedRuns ? kSharedTimeOfFew : kSharedTime;
  return {.id = "S4-SHARE",
          .passed = !ratios.empty() && mean <= limit && contacts == 0,
          .figures = {{"time_ratio", fixed(mean, 3)},
                      {"limit", fixed(limit, 2)},
                      {"contacts", std::to_string(contacts)},
                      {"runs", std::to_string(ratios.size())}}};
}

Check check_printed_merges(const std::vector<FleetResult>& runs) {
  Check check = check_merges(runs);
  check.id = "R8-PRINTED";
  check.finding = true;
  return check;
}

Check check_false_pairs(const std::vector<FleetResult>& runs) {
  int injected = 0;
  int rejected = 0;
  int offered = 0;
  int accepted = 0;
  int wrong = 0;
  bool in_each = !runs.empty();
  for (const FleetResult& run : runs) {
    injected += run.injected;
    rejected += run.false_rejected;
    offered += run.false_offered;
    accepted += run.false_accepted;
    wrong += run.wrong;
    in_each = in_each && run.false_rejected > 0;
  }
  return {.id = "R8-FALSE",
          .passed = in_each && accepted == 0 && wrong == 0,
          .figures = {{"injected", std::to_string(injected)},
                      {"rejected", std::to_string(rejected)},
                      {"offered", std::to_string(offered)},
                      {"accepted", std::to_string(accepted)},
                      {"wrong", std::to_string(wrong)},
                      {"runs", std::to_string(runs.size())}}};
}

Check check_printed_false_pairs(const std::vector<FleetResult>& runs) {
  Check check = check_false_pairs(runs);
  check.id = "R8-PRINTED-FALSE";
  check.finding = true;
  return check;
}

namespace {

/// Merges of one kind of robot.
struct Merges {
  int in_time = 0;  ///< runs that merged within kPosterTime_s and rightly
  int wrong = 0;    ///< runs with a wrong merge at any time
  double error_m = 0.0;
  std::vector<double> at_s;
};

Merges merges_of(const std::vector<FleetResult>& runs) {
  Merges merges;
  for (const FleetResult& run : runs) {
    const bool right = run.merged == run.pairs && run.wrong == 0;
    merges.in_time += right && run.merged_at_s <= kPosterTime_s ? 1 : 0;
    merges.wrong += run.wrong > 0 ? 1 : 0;
    merges.error_m = std::max(merges.error_m, run.error_m);
    if (right) {
      merges.at_s.push_back(run.merged_at_s);
    }
  }
  return merges;
}

}  // namespace

Check check_posters(const std::string& id, const std::vector<FleetResult>& pictures,
                    const std::vector<FleetResult>& laser) {
  const Merges with_pictures = merges_of(pictures);
  const Merges with_laser = merges_of(laser);
  const auto share = [](const Merges& merges, const std::vector<FleetResult>& runs) {
    return std::to_string(merges.in_time) + "/" + std::to_string(runs.size());
  };
  const bool right = !pictures.empty() && with_pictures.wrong == 0 && with_pictures.in_time >= with_laser.in_time;
  const bool all_by_laser = with_laser.in_time == static_cast<int>(laser.size());
  return {.id = id,
          .passed = right && with_pictures.in_time > with_laser.in_time,
          .figures = {{"merged_in_300_s", share(with_pictures, pictures)},
                      {"laser_alone", share(with_laser, laser)},
                      {"wrong", std::to_string(with_pictures.wrong)},
                      {"laser_wrong", std::to_string(with_laser.wrong)},
                      {"error_max_m", fixed(with_pictures.error_m, 3)},
                      {"merged_at_s", fixed(mean_spread(with_pictures.at_s).mean, 0)},
                      {"laser_merged_at_s", fixed(mean_spread(with_laser.at_s).mean, 0)},
                      {"seeds", seeds_text(pictures)}},
          .finding = right && all_by_laser};
}

Check check_keyframes(std::vector<LoadSample> keyframe, std::vector<LoadSample> frame) {
  const std::size_t seconds = std::min(keyframe.size(), frame.size());
  keyframe.resize(seconds);
  frame.resize(seconds);
  double frame_s = 0.0;
  double keyframe_s = 0.0;
  int frame_features = 0;
  int keyframe_features = 0;
  int nodes = 0;
  int pictured = 0;
  int elsewhere = 0;
  for (const LoadSample& sample : frame) {
    frame_s += sample.cpu_s;
    frame_features += sample.features;
  }
  for (const LoadSample& sample : keyframe) {
    keyframe_s += sample.cpu_s;
    keyframe_features += sample.features;
    nodes += sample.node ? 1 : 0;
    pictured += sample.node && sample.features > 0 ? 1 : 0;
    elsewhere += !sample.node && sample.pictures > 0 ? 1 : 0;
  }
  std::stable_sort(keyframe.begin(), keyframe.end(),
                   [](const LoadSample& a, const LoadSample& b) { return a.cpu_s > b.cpu_s; });
  const auto peaks_at_nodes =
      std::count_if(keyframe.begin(), keyframe.begin() + nodes, [](const LoadSample& sample) { return sample.node; });
  const double count = std::max(1.0, static_cast<double>(seconds));
  return {.id = "R9",
          .passed = nodes > 0 && pictured == nodes && elsewhere == 0 && keyframe_features < frame_features,
          .figures = {{"features_keyframe", std::to_string(keyframe_features)},
                      {"features_frame", std::to_string(frame_features)},
                      {"nodes_with_features", std::to_string(pictured) + "/" + std::to_string(nodes)},
                      {"pictures_elsewhere", std::to_string(elsewhere)},
                      {"frame_mean_s", fixed(frame_s / count, 4)},
                      {"keyframe_mean_s", fixed(keyframe_s / count, 4)},
                      {"time_peaks_at_nodes", std::to_string(peaks_at_nodes) + "/" + std::to_string(nodes)},
                      {"seconds", std::to_string(seconds)}}};
}

}  // namespace seeker::lab
