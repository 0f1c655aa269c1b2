#include "server/lab/r2_reproduce.hpp"

#include "common/image/files.hpp"
#include "common/image/png.hpp"
#include "server/lab/r2_tracker.hpp"
#include "server/options/world_options.hpp"

namespace seeker::lab {
namespace {

struct Case {
  const char* name;
  double odometry_factor;
  const char* file;
};
constexpr Case kCases[] = {{"odometry", 1.0, "r2.csv"}, {"odometry-doubled", 2.0, "r2-double.csv"}};

}  // namespace

std::vector<Point2> office_tour() {
  return {{6.2, 7.1},  {6.2, 9.6},  {6.2, 7.1},  {12.4, 7.1}, {12.4, 4.6}, {12.4, 7.0},
          {17.7, 7.0}, {17.7, 9.6}, {17.7, 7.0}, {22.4, 7.0}, {12.0, 7.1}, {2.0, 7.0}};
}

MakeTracker sp_tracker() {
  return [](const sim::RobotModel& model) {
    SpTrackerParams params;
    params.lines.bearing_sigma_rad = model.lidar.sigma_bearing_rad;
    params.odometry = model.odometry;
    return std::make_unique<SpTracker>(params);
  };
}

Status reproduce_r2(const ReproduceParams& params, Report& report) {
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
    Result<NeesStudy> study = study_consistency(*world, sim::RobotModel{}, sp_tracker(), consistency);
    if (!study) {
      return tl::unexpected<Error>(study.error());
    }
    if (Status ok = image::write_file(params.out / one.file, nees_table(*study).csv()); !ok) {
      return ok;
    }
    report.add(nees_check(one.name, *study));
    studies.emplace_back(one.name, std::move(*study));
  }
  const std::string title = "R2: SPmap in the office, " + std::to_string(params.seeds.size()) + " runs";
  return image::write_png(params.out / "r2-nees.png", nees_chart(title, studies));
}

}  // namespace seeker::lab
