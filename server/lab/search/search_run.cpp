#include "server/lab/search/search_run.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

#include "common/core/angle.hpp"
#include "server/app/composition/robot_assembly.hpp"
#include "server/app/loop/robot_loop.hpp"
#include "server/app/runtime/update_hub.hpp"
#include "server/lab/scoring/wall_share.hpp"
#include "server/lab/search/cell_visits.hpp"
#include "server/options/target_options.hpp"
#include "server/sim/placement.hpp"

namespace seeker::lab {
namespace {

constexpr double kNearTarget_m = 1.0;      ///< a detection farther from every target is a false one
constexpr double kNearBearing_deg = 10.0;  ///< the same for one that knows a direction only

FindScore score_of(const api::Detection& detection, const RunWatch& watch) {
  const sim::GroundTruth truth = watch.truth();
  FindScore score;
  score.target = detection.target;
  score.robot_time_s = to_seconds(detection.stamp);
  score.bearing_map_deg = rad_to_deg(detection.bearing_map_rad);
  score.u_px = detection.u_px;
  score.v_px = detection.v_px;
  score.score = detection.score;
  score.range_source = to_string(detection.range_source);
  if (detection.position) {
    const Eigen::SelfAdjointEigenSolver<Matrix2> solver(detection.position_covariance, Eigen::EigenvaluesOnly);
    score.position_sigma_m = std::sqrt(std::max(0.0, solver.eigenvalues().maxCoeff()));
  }
  const Pose2 map_T_base = inverse(truth.world_T_start) * watch.world_T_base_at(detection.stamp);
  for (const sim::TargetTruth& target : truth.targets) {
    if (target.name != detection.target) {
      continue;
    }
    const Point2 p_map = inverse(truth.world_T_start) * target.world_T_target.translation();
    const Point2 offset = p_map - map_T_base.translation();
    score.range_m = offset.norm();
    score.bearing_error_deg =
        rad_to_deg(std::abs(wrap_angle(detection.bearing_map_rad - std::atan2(offset.y(), offset.x()))));
    if (detection.position) {
      score.position_error_m = (*detection.position - p_map).norm();
    }
  }
  return score;
}

bool is_true(const FindScore& score) {
  return score.position_error_m ? *score.position_error_m <= kNearTarget_m
                                : score.range_m > 0.0 && score.bearing_error_deg <= kNearBearing_deg;
}

/// Watches a search from outside while it runs.
class Observer {
 public:
  Observer(app::RobotLoop& loop, const sim::Simulation& simulation) : loop_(loop), watch_(loop, simulation) {
    loop.hooks().on_detection = [this](const api::Detection& detection) { take(detection); };
  }

  /// Before every pass of the loop.
  void look() {
    watch_.look();
    const sim::GroundTruth truth = watch_.truth();
    path_length_m_ = truth.path_length_m;
    visits_.add(truth.world_T_base.translation());
  }

  void fill(RunRecord& record) const {
    RunResult& result = record.result;
    const sim::GroundTruth truth = watch_.truth();
    result.path_length_m = truth.path_length_m;
    result.target_path_m = find_path_m_.value_or(truth.path_length_m);
    result.cells_visited = visits_.visited();
    result.cells_repeated = visits_.repeated();
    result.contacts = truth.contacts;
    result.min_clearance_m = truth.min_clearance_m;
    result.localisation_error_m = watch_.error_m();
    result.localisation_error_deg = rad_to_deg(watch_.error_rad());
    result.max_localisation_error_m = watch_.max_error_m();
    result.first_find = first_;
    result.events = static_cast<int>(watch_.events().size());
    result.event_hash = watch_.event_hash();
    record.events = watch_.events();
    record.true_path = watch_.true_path();
    record.truth = truth;
  }

  [[nodiscard]] FindScore score(const api::Detection& detection) const {
    FindScore score = score_of(detection, watch_);
    const auto& grid = loop_.missions().findings().grid();
    score.cells_searched = grid ? static_cast<int>(grid->lists.searched.size()) : 0;
    return score;
  }

 private:
  void take(const api::Detection& detection) {
    if (!first_) {
      first_ = score(detection);
      find_path_m_ = path_length_m_;
    }
  }

  app::RobotLoop& loop_;
  RunWatch watch_;
  CellVisits visits_;
  std::optional<FindScore> first_;
  std::optional<double> find_path_m_;
  double path_length_m_ = 0.0;
};

void fill_mission(RunRecord& record, const app::RobotLoop& loop, const Observer& observer) {
  RunResult& result = record.result;
  if (loop.missions().last()) {
    record.status = *loop.missions().last();
  }
  const api::MissionEnd end = record.status.end.value_or(api::MissionEnd{});
  result.outcome = to_string(end.outcome);
  result.cause = end.cause;
  record.detections = loop.missions().detections();
  for (const api::Detection& detection : record.detections) {
    const FindScore score = observer.score(detection);
    if (is_true(score)) {
      result.last_find = score;
    } else {
      ++result.false_finds;
    }
  }
  result.found = end.outcome == api::Outcome::kTargetFound && result.last_find.has_value();
  record.grid = loop.missions().findings().grid();
  record.occupancy = loop.robot_map().occupancy().snapshot();
  record.trajectory = loop.trajectory().poses();
}

void fill_coverage(RunRecord& record) {
  if (!record.grid) {
    return;
  }
  RunResult& result = record.result;
  const api::GridLists& lists = record.grid->lists;
  const api::CoverageSummary& summary = record.grid->evidence.summary;
  result.cells_searched = static_cast<int>(lists.searched.size());
  result.cells_unsearched = static_cast<int>(lists.unsearched.size());
  result.cells_unreachable = static_cast<int>(lists.unreachable.size());
  result.reachable_area_m2 = summary.reachable_area_m2;
  result.true_reachable_area_m2 = sim::reachable_area_m2(record.world, record.robot_radius_m);
  result.covered_share = summary.reachable_area_m2 > 0.0 ? summary.covered_area_m2 / summary.reachable_area_m2 : 0.0;
  result.covered_true_share =
      result.true_reachable_area_m2 > 0.0 ? summary.covered_area_m2 / result.true_reachable_area_m2 : 0.0;
  result.mean_probability = summary.mean_probability;
  result.gaps = summary.gaps;
}

/// How far the target is from where the map shows it, once the map is laid on the building's walls.
void fill_aligned(RunRecord& record, const app::RobotLoop& loop, const sim::RobotModel& robot) {
  if (!record.result.last_find) {
    return;
  }
  FindScore& find = *record.result.last_find;
  const TrueWalls walls = true_walls(record.world, robot, std::nullopt);
  const std::optional<Pose2> world_T_map = align_walls(loop.robot_map().segments(), walls, record.truth.world_T_start);
  for (const api::Detection& detection : record.detections) {
    for (const sim::TargetTruth& target : record.truth.targets) {
      if (world_T_map && detection.position && detection.target == find.target && target.name == find.target) {
        const Point2 p_world = *world_T_map * *detection.position;
        find.aligned_error_m = (p_world - target.world_T_target.translation()).norm();
      }
    }
  }
}

Result<api::MissionRequest> request_of(const RunSpec& spec, const sim::World& world) {
  const Result<api::TargetSpec> target = target_of(world, spec);
  if (!target) {
    return tl::unexpected<Error>(target.error());
  }
  api::SearchMission search;
  search.targets = {*target};
  search.mode = spec.strategy == search::Strategy::kPaper ? api::SearchMode::kPaper : api::SearchMode::kPlan;
  search.on_found = spec.on_found;
  search.explore = spec.explore;
  api::MissionRequest request;
  request.id = "seed-" + std::to_string(spec.seed);
  request.task = std::move(search);
  request.time_limit = seconds(spec.time_limit_s);
  return request;
}

}  // namespace

Result<app::RobotOptions> options_of(const RunSpec& spec) {
  Result<app::RobotOptions> options = sim_options(spec);
  if (options) {
    options->search.strategy = spec.strategy;
  }
  return options;
}

Result<std::string> settings_of(const RunSpec& spec) {
  Result<TextHash> hash = settings_hash(options_of(spec), spec);
  if (!hash) {
    return tl::unexpected<Error>(hash.error());
  }
  hash->add(to_string(spec.strategy));
  hash->add(to_string(spec.on_found));
  hash->add(spec.explore ? "explore" : "");
  return hash->hex();
}

Result<api::TargetSpec> target_of(const sim::World& world, const RunSpec& spec) {
  const std::string name = world.targets.empty() ? "cross" : world.targets.front().name;
  const std::filesystem::path folder =
      spec.target_folder.empty() ? std::filesystem::absolute(spec.world_file).parent_path().parent_path() / "targets"
                                 : spec.target_folder;
  const std::filesystem::path file = folder / (name + ".yaml");
  Result<options::TargetDescription> target = options::load_target(file);
  if (!target) {
    return tl::unexpected<Error>(target.error());
  }
  return api::TargetSpec{.name = target->file.name,
                         .picture = std::move(target->picture),
                         .width_m = target->file.width_m,
                         .height_m = target->file.height_m,
                         .depth_m = target->file.depth_m,
                         .recogniser = target->file.recogniser == to_string(api::RecogniserKind::kFeatures)
                                           ? api::RecogniserKind::kFeatures
                                           : api::RecogniserKind::kTemplate};
}

Result<RunRecord> run_search(const RunSpec& spec) {
  const Result<app::RobotOptions> options = options_of(spec);
  if (!options) {
    return tl::unexpected<Error>(options.error());
  }
  Result<app::Assembly> assembly = app::assemble(*options);
  if (!assembly) {
    return tl::unexpected<Error>(assembly.error());
  }
  const std::shared_ptr<sim::Simulation> simulation = assembly->simulation;
  RunRecord record;
  record.world = simulation->world();
  record.robot_radius_m = options->sim.robot.radius_m;
  const Result<api::MissionRequest> request = request_of(spec, record.world);
  if (!request) {
    return tl::unexpected<Error>(request.error());
  }

  app::UpdateHub hub;
  app::RobotLoop loop(options->loop, std::move(assembly->parts), hub);
  Observer observer(loop, *simulation);
  const Result<double> wall_time_s = run_mission(loop, *request, [&observer] { observer.look(); });
  if (!wall_time_s) {
    return tl::unexpected<Error>(wall_time_s.error());
  }

  RunResult& result = record.result;
  result.world = record.world.name;
  result.strategy = to_string(spec.strategy);
  result.seed = spec.seed;
  result.robot_time_s = to_seconds(loop.now());
  result.wall_time_s = *wall_time_s;
  observer.fill(record);
  fill_mission(record, loop, observer);
  fill_coverage(record);
  if (spec.explore) {
    fill_aligned(record, loop, options->sim.robot);
  }
  return record;
}

}  // namespace seeker::lab
