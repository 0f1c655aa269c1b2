#include "server/lab/calibration/calibrate_drive.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <utility>

namespace seeker::lab {
namespace {

struct LegsOfLog {
  std::vector<calibration::DriveLeg> legs;
  std::uint64_t unmatched = 0;
  drivers::ReplaySummary log;
};

Result<LegsOfLog> legs_of(const std::filesystem::path& log, const drivers::ReplayParams& geometry,
                          slam::PoseTracker& tracker, const calibration::DriveLegParams& params,
                          const calibration::DriveCalibration& predicted) {
  const Result<std::shared_ptr<drivers::ReplaySource>> source = drivers::ReplaySource::open(log, geometry);
  if (!source) {
    return tl::unexpected<Error>(source.error());
  }
  calibration::DriveLegs legs(tracker, params, predicted);
  while ((*source)->advance_one()) {
    if (const std::optional<drivers::OdometrySample> odometry = (*source)->take_odometry()) {
      legs.add(odometry->odom_T_base, odometry->stamp);
    }
    if (const std::optional<LaserScan> scan = (*source)->take_scan()) {
      legs.add(*scan);
    }
  }
  return LegsOfLog{legs.legs(), legs.unmatched(), (*source)->summary()};
}

/// Whether two calibrations are the same within a share of the standard deviations.
bool settled(const calibration::DriveCalibration& before, const calibration::DriveCalibrationResult& now,
             double sigmas) {
  using Fit = calibration::DriveCalibrationResult;
  const WheelCalibration& old = before.wheels;
  const WheelCalibration& wheels = now.calibration.wheels;
  const Eigen::Vector3d moved = offset_of(now.calibration.base_T_laser, before.base_T_laser);
  const auto all = {std::pair{Fit::kLeft, wheels.left_scale - old.left_scale},
                    std::pair{Fit::kRight, wheels.right_scale - old.right_scale},
                    std::pair{Fit::kTrack, wheels.track_scale - old.track_scale},
                    std::pair{Fit::kX, moved[0]},
                    std::pair{Fit::kY, moved[1]},
                    std::pair{Fit::kHeading, moved[2]}};
  return std::all_of(all.begin(), all.end(),
                     [&](const auto& one) { return std::abs(one.second) <= sigmas * now.sigma(one.first); });
}

}  // namespace

Result<CalibratedDrive> calibrate_drive(const std::filesystem::path& log, const drivers::ReplayParams& geometry,
                                        const MakeTracker& make_tracker, const calibration::DriveCalibration& start,
                                        calibration::CalibrationSubject subject, const CalibrateDriveParams& params) {
  CalibratedDrive drive;
  calibration::DriveCalibration predicted = start;
  bool is_settled = false;
  while (drive.passes < params.max_passes && !is_settled) {
    const std::unique_ptr<slam::PoseTracker> tracker = make_tracker();
    const Result<LegsOfLog> legs = legs_of(log, geometry, *tracker, params.legs, predicted);
    if (!legs) {
      return tl::unexpected<Error>(legs.error());
    }
    const Result<calibration::DriveCalibrationResult> fit =
        calibration::calibrate(legs->legs, start, subject, params.fit);
    if (!fit) {
      return fail_with_context(log.string(), fit.error());
    }
    drive = {*fit, legs->unmatched, drive.passes + 1, legs->log};
    is_settled = settled(predicted, *fit, params.settled_sigmas);
    predicted = fit->calibration;
  }
  return drive;
}

}  // namespace seeker::lab
