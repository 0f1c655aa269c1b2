#include "server/lab/calibration/calibration_command.hpp"

#include <memory>
#include <utility>

#include "common/files/files.hpp"
#include "server/app/composition/robot_options.hpp"
#include "server/lab/calibration/calibrate_drive.hpp"
#include "server/lab/calibration/calibration_report.hpp"
#include "server/lab/slam/slam_command.hpp"
#include "server/lab/slam/slam_estimators.hpp"

namespace seeker::lab {

Status run_calibration(const CalibrationOptions& o, slam::CalibrationSubject subject, std::ostream& out) {
  const Result<std::filesystem::path> robot_file = find_robot_file(o.robot, o.config, o.log);
  if (!robot_file) {
    return tl::unexpected<Error>(robot_file.error());
  }
  const Result<app::RobotOptions> options = app::load_robot_options(*robot_file, o.overrides);
  if (!options) {
    return tl::unexpected<Error>(options.error());
  }
  const drivers::ReplayParams& geometry = options->replay.params;
  const std::string estimator = o.estimator.empty() ? name_of(options->estimator) : o.estimator;
  if (const auto tracker = make_tracker(estimator, *options); !tracker) {
    return tl::unexpected<Error>(tracker.error());
  }
  if (estimator == name_of(app::EstimatorType::kOdometry)) {
    return fail(Errc::kInvalidArgument, "the odometry cannot be calibrated by itself; choose another --estimator");
  }
  const Result<CalibratedDrive> drive = calibrate_drive(
      o.log, geometry, [&] { return std::move(*make_tracker(estimator, *options)); },
      {options->loop.odometry_calibration, geometry.base_T_laser}, subject);
  if (!drive) {
    return tl::unexpected<Error>(drive.error());
  }
  out << (o.json ? calibration_json(o.log, *drive, subject) : calibration_text(o.log, *drive, subject));
  return o.out.empty() ? Status{} : files::write_file(o.out, calibration_yaml(o.log, *drive, subject));
}

}  // namespace seeker::lab
