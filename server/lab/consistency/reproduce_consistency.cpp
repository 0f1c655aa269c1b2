#include "server/lab/consistency/reproduce_consistency.hpp"

#include <array>
#include <limits>

#include "common/files/files.hpp"
#include "common/image/png.hpp"
#include "server/lab/consistency/sp_tracker.hpp"
#include "server/options/world_options.hpp"
#include "server/slam/line_slam.hpp"

namespace seeker::lab {
namespace {

struct Case {
  const char* name;
  double odometry_factor;
  UnevenWheels wheels;
  MakeTracker (*tracker)();
  const char* file;
};
/// What wheels that nobody has calibrated are commonly off by.
constexpr UnevenWheels kUneven{.scale_sigma = 0.02, .drift_sigma_rad_per_m = 0.02, .base_sigma = 0.02};
const std::array<Case, 4> kCases = {Case{"odometry", 1.0, {}, &sp_tracker, "r2.csv"},
                                    Case{"odometry-doubled", 2.0, {}, &sp_tracker, "r2-double.csv"},
                                    Case{"local-maps", 1.0, {}, &local_maps_tracker, "r2-local-maps.csv"},
                                    Case{"uneven-wheels", 1.0, kUneven, &learning_tracker, "r2-uneven.csv"}};

slam::LineSlamParams line_slam_params(const sim::RobotModel& model) {
  slam::LineSlamParams params;
  params.extractor.fast.bearing_sigma_rad = model.lidar.sigma_bearing_rad;
  params.odometry.along_sigma_m_per_sqrt_m = model.odometry.sigma_distance;
  params.odometry.across_sigma_m_per_sqrt_m = 0.0;
  params.odometry.theta_sigma_rad_per_sqrt_m = model.odometry.sigma_rotation_per_distance;
  params.odometry.theta_sigma_rad_per_sqrt_rad = model.odometry.sigma_rotation;
  params.odometry_scale.max = 1.0;
  // Walls of the simulator are straight and its scanner is level: what real ones add would hide the filter's own.
  params.observation = {};
  params.local.joint_sigma_m = 0.0;
  params.local.joint_sigma_rad = 0.0;
  params.points.use = slam::PointUse::kNone;
  params.loops.every_m = std::numeric_limits<double>::infinity();
  return params;
}

}  // namespace

std::vector<Point2> office_tour() {
  return {{6.2, 7.1},  {6.2, 9.6},  {6.2, 7.1},  {12.4, 7.1}, {12.4, 4.6}, {12.4, 7.0},
          {17.7, 7.0}, {17.7, 9.6}, {17.7, 7.0}, {22.4, 7.0}, {12.0, 7.1}, {2.0, 7.0}};
}

MakeTracker sp_tracker() {
  return [](const sim::RobotModel& model) {
    SpTrackerParams params;
    params.lines.fast.bearing_sigma_rad = model.lidar.sigma_bearing_rad;
    params.odometry = model.odometry;
    return std::make_unique<SpTracker>(params);
  };
}

MakeTracker local_maps_tracker() {
  return [](const sim::RobotModel& model) {
    slam::LineSlamParams params = line_slam_params(model);
    params.odometry_bias = slam::kCalibratedOdometry;
    return std::make_unique<slam::LineSlam>(params);
  };
}

MakeTracker learning_tracker() {
  return [](const sim::RobotModel& model) { return std::make_unique<slam::LineSlam>(line_slam_params(model)); };
}

Status reproduce_consistency(const ReproduceParams& params, Report& report) {
  std::error_code error;
  std::filesystem::create_directories(params.out, error);
  const Result<sim::World> world = options::load_world(params.config / "worlds" / "office-no-target.yaml");
  if (!world) {
    return tl::unexpected<Error>(world.error());
  }
  std::vector<std::pair<std::string, NeesStudy>> studies;
  for (const Case& one : kCases) {
    ConsistencyParams consistency;
    consistency.seeds = params.seeds;
    consistency.tour = office_tour();
    consistency.odometry_factor = one.odometry_factor;
    consistency.wheels = one.wheels;
    Result<NeesStudy> study = study_consistency(*world, sim::RobotModel{}, one.tracker(), consistency);
    if (!study) {
      return tl::unexpected<Error>(study.error());
    }
    if (Status ok = files::write_file(params.out / one.file, nees_table(*study).csv()); !ok) {
      return ok;
    }
    report.add(nees_check(one.name, *study));
    studies.emplace_back(one.name, std::move(*study));
  }
  const std::string title = "R2: SPmap in the office, " + std::to_string(params.seeds.size()) + " runs";
  return image::write_png(params.out / "r2-nees.png", nees_chart(title, studies));
}

}  // namespace seeker::lab
