#include "server/lab/active_slam/explore_run.hpp"

#include <chrono>
#include <utility>

#include "common/config/yaml.hpp"
#include "common/core/occupancy_tile.hpp"
#include "server/app/composition/robot_assembly.hpp"
#include "server/app/runtime/update_hub.hpp"

namespace seeker::lab {
namespace {

constexpr const char* kWallPhase = "wall";
constexpr Duration kSamplePeriod = std::chrono::seconds(1);
constexpr double kPathSpacing_m = 0.05;
constexpr double kShareSpacing_m = 1.0;

/// Watches an exploration from outside while it runs.
class Observer {
 public:
  Observer(app::RobotLoop& loop, const sim::Simulation& simulation, std::shared_ptr<const DecisionLog> log,
           ExploreRecord& record, double wall_near_m)
      : loop_(loop), watch_(loop, simulation), log_(std::move(log)), record_(record) {
    walls_.near_m = wall_near_m;
  }

  /// Before every pass of the loop.
  void look() {
    watch_.look();
    const Point2 place = watch_.steps().back().world_T_base.translation();
    if (path_.empty() || (path_.back().p_world - place).norm() >= kPathSpacing_m) {
      path_.push_back({place, log_->phase == kWallPhase});
    }
    if (!sampled_ || loop_.now() - *sampled_ >= kSamplePeriod) {
      sampled_ = loop_.now();
      samples_.push_back(sample());
    }
    if (watch_.truth().path_length_m >= share_at_m_) {
      share_at_m_ += kShareSpacing_m;
      look_at_walls();
    }
  }

  /// What share of the walls the map holds now.
  void look_at_walls() {
    const sim::GroundTruth truth = watch_.truth();
    record_.walls = share_of_walls(loop_.robot_map().segments(), record_.truth_walls, truth.world_T_start, walls_);
    note_share(record_.result, record_.walls.share(), truth.path_length_m);
  }

  void fill() {
    ExploreRecord& record = record_;
    ExploreResult& result = record.result;
    record.truth = watch_.truth();
    result.path_length_m = record.truth.path_length_m;
    result.contacts = record.truth.contacts;
    result.min_clearance_m = record.truth.min_clearance_m;
    result.decisions = log_->decisions;
    result.decide_s = log_->processor_s;
    result.events = static_cast<int>(watch_.events().size());
    result.event_hash = watch_.event_hash();
    samples_.push_back(sample());
    add_curves(samples_, result);
    result.max_error_m = watch_.max_error_m();
    record.topology = loop_.neighbours().own().topology;
    record.events = watch_.events();
    record.samples = std::move(samples_);
    for (std::size_t k = 1; k < path_.size(); ++k) {
      result.along_wall_m += path_[k].along_wall ? (path_[k].p_world - path_[k - 1].p_world).norm() : 0.0;
    }
    record.true_path = std::move(path_);
  }

 private:
  [[nodiscard]] ExploreSample sample() const {
    ExploreSample sample;
    sample.time_s = to_seconds(loop_.now());
    sample.error_m = watch_.error_m();
    sample.robot_trace = loop_.status().pose.covariance.trace();
    sample.full_trace = sample.robot_trace;
    const std::vector<MapSegment> segments = loop_.robot_map().segments();
    for (const MapSegment& segment : segments) {
      const double trace = segment.covariance.trace();
      sample.feature_trace += trace / static_cast<double>(segments.size());
      sample.full_trace += trace;
      sample.map_wall_m += segment.length_m;
    }
    sample.path_m = watch_.truth().path_length_m;
    sample.floor_m2 = free_area_m2(loop_.robot_map().occupancy().snapshot());
    return sample;
  }

  app::RobotLoop& loop_;
  RunWatch watch_;
  std::shared_ptr<const DecisionLog> log_;
  ExploreRecord& record_;
  WallShareParams walls_;
  double share_at_m_ = 0.0;
  std::vector<PathPlace> path_;
  std::vector<ExploreSample> samples_;
  std::optional<RobotTime> sampled_;
};

std::optional<Polygon> in_world(const std::optional<Polygon>& bound, const Pose2& world_T_map) {
  if (!bound) {
    return std::nullopt;
  }
  Polygon moved;
  for (const Point2& p : *bound) {
    moved.push_back(world_T_map * p);
  }
  return moved;
}

/// What the robot left behind, and how it ended.
void fill_map(ExploreRecord& record, const app::RobotLoop& loop) {
  ExploreResult& result = record.result;
  record.segments = loop.robot_map().segments();
  record.believed_path = loop.trajectory().poses();
  result.segments = static_cast<int>(record.segments.size());
  result.map_epoch = static_cast<int>(loop.status().pose.map_epoch);
  const api::MissionEnd end =
      loop.missions().last() ? loop.missions().last()->end.value_or(api::MissionEnd{}) : api::MissionEnd{};
  result.outcome = to_string(end.outcome);
  result.cause = end.cause;
  result.unreachable = static_cast<int>(end.unreachable.size());
  record.unreachable = positions_of(end.unreachable);
}

/// Scores the walls mapped at the end.
void score(ExploreRecord& record) {
  ExploreResult& result = record.result;
  result.reachable_wall_m = record.walls.reachable_m;
  result.mapped_wall_m = record.walls.mapped_m;
  result.wall_share = record.walls.share();
  result.false_wall_m = record.walls.false_m;
  result.map_wall_m = record.walls.map_m;
  result.aligned = record.walls.aligned;
}

api::MissionRequest request_of(const ExploreSpec& spec) {
  api::ExploreMission explore;
  explore.strategy = spec.strategy;
  explore.bound = spec.bound;
  explore.return_to_start = spec.return_to_start;
  api::MissionRequest request;
  request.id = "seed-" + std::to_string(spec.seed);
  request.task = std::move(explore);
  request.time_limit = seconds(spec.time_limit_s);
  return request;
}

}  // namespace

Result<std::string> settings_of(const ExploreSpec& spec) {
  Result<TextHash> hash = settings_hash(sim_options(spec), spec);
  if (!hash) {
    return tl::unexpected<Error>(hash.error());
  }
  hash->add(to_string(spec.strategy));
  for (const Point2& p : spec.bound.value_or(Polygon{})) {
    hash->add(std::to_string(p.x()) + " " + std::to_string(p.y()));
  }
  hash->add(spec.return_to_start ? "return" : "");
  hash->add(std::to_string(spec.wall_near_m));
  return hash->hex();
}

Result<ExploreRecord> run_explore(const ExploreSpec& spec, const ExploreWatcher& watcher) {
  const Result<app::RobotOptions> options = sim_options(spec);
  if (!options) {
    return tl::unexpected<Error>(options.error());
  }
  Result<app::Assembly> assembly = app::assemble(*options);
  if (!assembly) {
    return tl::unexpected<Error>(assembly.error());
  }
  const std::shared_ptr<sim::Simulation> simulation = assembly->simulation;
  const auto log = std::make_shared<DecisionLog>();
  assembly->parts.behaviours = watched(std::move(assembly->parts.behaviours), log);
  ExploreRecord record;
  record.world = simulation->world();
  record.robot_radius_m = options->sim.robot.radius_m;
  record.truth_walls =
      true_walls(record.world, options->sim.robot, in_world(spec.bound, simulation->truth().world_T_start));

  app::UpdateHub hub;
  app::RobotLoop loop(options->loop, std::move(assembly->parts), hub);
  Observer observer(loop, *simulation, log, record, spec.wall_near_m);
  const Result<double> wall_time_s = run_mission(loop, request_of(spec), [&] {
    observer.look();
    if (watcher) {
      watcher(loop, *simulation);
    }
  });
  if (!wall_time_s) {
    return tl::unexpected<Error>(wall_time_s.error());
  }

  ExploreResult& result = record.result;
  result.world = record.world.name;
  result.strategy = to_string(spec.strategy);
  result.seed = spec.seed;
  result.robot_time_s = to_seconds(loop.now());
  result.wall_time_s = *wall_time_s;
  observer.look_at_walls();
  observer.fill();
  fill_map(record, loop);
  score(record);
  return record;
}

}  // namespace seeker::lab
