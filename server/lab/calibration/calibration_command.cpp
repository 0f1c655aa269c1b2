#include "server/lab/calibration/calibration_command.hpp"

#include <memory>
#include <utility>

#include "common/files/files.hpp"
#include "server/app/composition/robot_options.hpp"
#include "server/lab/calibration/calibrate_drive.hpp"
#include "server/lab/calibration/calibration_report.hpp"
#include "server/lab/slam/robot_of_log.hpp"
#include "server/lab/slam/slam_estimators.hpp"

namespace seeker::lab {

Status run_calibration(const CalibrationOptions& o, calibration::CalibrationSubject subject, std::ostream& out) {
  const Result<RobotOfLog> robot = robot_of_log(o.robot, o.config, o.log, o.overrides);
  if (!robot) {
    return tl::unexpected<Error>(robot.error());
  }
  const drivers::ReplayParams& geometry = robot->options.replay.params;
  const std::string estimator = o.estimator.empty() ? name_of(robot->options.estimator) : o.estimator;
  if (const auto tracker = make_tracker(estimator, robot->options); !tracker) {
    return tl::unexpected<Error>(tracker.error());
  }
  if (estimator == name_of(app::EstimatorType::kOdometry)) {
    return fail(Errc::kInvalidArgument, "the odometry cannot be calibrated by itself; choose another --estimator");
  }
  const Result<CalibratedDrive> drive = calibrate_drive(
      o.log, geometry, [&] { return std::move(*make_tracker(estimator, robot->options)); },
      {robot->options.loop.odometry_calibration, geometry.base_T_laser}, subject);
  if (!drive) {
    return tl::unexpected<Error>(drive.error());
  }
  out << (o.json ? calibration_json(o.log, *drive, subject) : calibration_text(o.log, *drive, subject));
  return o.out.empty() ? Status{} : files::write_file(o.out, calibration_yaml(o.log, *drive, subject));
}

}  // namespace seeker::lab
