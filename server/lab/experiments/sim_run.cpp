#include "server/lab/experiments/sim_run.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>

#include "common/config/yaml.hpp"
#include "common/core/angle.hpp"
#include "server/options/world_options.hpp"

namespace seeker::lab {
namespace {

constexpr const char* kClient = "seeker-lab";
constexpr double kTruePathSpacing_m = 0.05;  ///< of the path kept for pictures

/// The world's file and the one it is based on.
Status add_world(TextHash& hash, const std::filesystem::path& file) {
  const Result<std::string> text = config::read_text_file(file);
  if (!text) {
    return tl::unexpected<Error>(text.error());
  }
  const Result<options::WorldFile> world = options::parse_world(*text, file.string());
  if (!world) {
    return tl::unexpected<Error>(world.error());
  }
  hash.add(*text);
  return world->base.empty() ? Status() : add_world(hash, file.parent_path() / world->base);
}

}  // namespace

Result<app::RobotOptions> sim_options(const SimSpec& spec) {
  std::vector<std::string> overrides = spec.overrides;
  overrides.push_back("sim.world=" + std::filesystem::absolute(spec.world_file).string());
  overrides.push_back("sim.seed=" + std::to_string(spec.seed));
  overrides.push_back(std::string("sim.random_target=") + (spec.random_target ? "true" : "false"));
  overrides.emplace_back("sim.speed=0");
  Result<app::RobotOptions> options = app::load_robot_options(spec.robot_file, overrides);
  if (options && options->driver != app::DriverType::kSim) {
    return fail(Errc::kInvalidArgument, spec.robot_file.string() + ": experiments need 'driver: sim'");
  }
  return options;
}

Result<TextHash> settings_hash(Result<app::RobotOptions> options, const SimSpec& spec) {
  if (!options) {
    return tl::unexpected<Error>(options.error());
  }
  options->sim.world = spec.world_file.filename().string();
  options->sim.seed = 0;
  TextHash hash;
  hash.add(config::print(*options));
  if (const Status ok = add_world(hash, spec.world_file); !ok) {
    return tl::unexpected<Error>(ok.error());
  }
  hash.add(std::to_string(spec.time_limit_s));
  return hash;
}

RunWatch::RunWatch(app::RobotLoop& loop, const sim::Simulation& simulation) : loop_(loop), simulation_(simulation) {
  loop.hooks().on_event = [this](const api::Event& event) { take(event); };
}

void RunWatch::look() {
  const sim::GroundTruth truth = simulation_.truth();
  steps_.push_back({loop_.now(), truth.world_T_base});
  const PoseEstimate believed = loop_.status().pose;
  // A pose is that of its stamp: since then the robot has driven on.
  const Pose2 map_T_base = inverse(truth.world_T_start) * world_T_base_at(believed.stamp);
  error_m_ = distance_m(map_T_base, believed.map_T_base);
  error_rad_ = std::abs(wrap_angle(map_T_base.theta_rad - believed.map_T_base.theta_rad));
  max_error_m_ = std::max(max_error_m_, error_m_);
}

const Pose2& RunWatch::world_T_base_at(RobotTime stamp) const {
  const auto later = std::lower_bound(steps_.begin(), steps_.end(), stamp,
                                      [](const TrueStep& step, RobotTime t) { return step.stamp < t; });
  return later == steps_.end() ? steps_.back().world_T_base : later->world_T_base;
}

std::vector<Pose2> RunWatch::true_path() const {
  std::vector<Pose2> path;
  for (const TrueStep& step : steps_) {
    if (path.empty() || distance_m(path.back(), step.world_T_base) >= kTruePathSpacing_m) {
      path.push_back(step.world_T_base);
    }
  }
  return path;
}

void RunWatch::take(const api::Event& event) {
  if (event.mission.empty()) {
    return;  // links and sessions are no part of a mission's log
  }
  hash_.add(event.kind);
  hash_.add(event.text);
  hash_.add(to_string(event.severity));
  hash_.add(event.mission_time ? std::to_string(event.mission_time->count()) : "");
  events_.push_back(event);
}

Result<double> run_mission(app::RobotLoop& loop, const api::MissionRequest& request,
                           const std::function<void()>& look) {
  const auto started = std::chrono::steady_clock::now();
  loop.start();
  if (const Result<api::MissionId> id = loop.commands().start_mission(request, kClient); !id) {
    return fail_with_context("the mission was refused", id.error());
  }
  while (loop.missions().present()) {
    look();
    loop.tick(started);  // the wall clock decides about links only, and there is none
  }
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
}

std::string log_text(const std::vector<api::Event>& events) {
  std::string text;
  for (const api::Event& event : events) {
    std::array<char, 32> time{};
    std::snprintf(time.data(), time.size(), "%9.1f ", event.mission_time ? to_seconds(*event.mission_time) : 0.0);
    text += time.data() + event.kind + ": " + event.text + "\n";
  }
  return text;
}

}  // namespace seeker::lab
