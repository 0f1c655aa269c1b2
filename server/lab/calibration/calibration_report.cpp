#include "server/lab/calibration/calibration_report.hpp"

#include <array>
#include <cstdio>

#include "common/core/angle.hpp"
#include "server/lab/experiments/described_json.hpp"

namespace seeker::lab {
namespace {

using Fit = calibration::DriveCalibrationResult;

template <class... Values>
std::string formatted(const char* format, Values... values) {
  std::array<char, 256> text{};
  std::snprintf(text.data(), text.size(), format, values...);
  return text.data();
}

std::string wheels_text(const Fit& fit) {
  const WheelCalibration& wheels = fit.calibration.wheels;
  return formatted("left wheel   %.5f +- %.5f  (true over reported distance)\n", wheels.left_scale,
                   fit.sigma(Fit::kLeft)) +
         formatted("right wheel  %.5f +- %.5f\n", wheels.right_scale, fit.sigma(Fit::kRight)) +
         formatted("track        %.5f +- %.5f  (true over %.4f m)\n", wheels.track_scale, fit.sigma(Fit::kTrack),
                   wheels.track_m);
}

std::string mount_text(const Fit& fit) {
  const Pose2& base_T_laser = fit.calibration.base_T_laser;
  return formatted("x        %.4f +- %.4f m\n", base_T_laser.x_m, fit.sigma(Fit::kX)) +
         formatted("y        %.4f +- %.4f m\n", base_T_laser.y_m, fit.sigma(Fit::kY)) +
         formatted("heading  %.3f +- %.3f deg\n", rad_to_deg(base_T_laser.theta_rad),
                   rad_to_deg(fit.sigma(Fit::kHeading)));
}

void describe_parameter(config::Fields& f, const char* name, double value, double sigma) {
  f.field(name, value);
  f.field(std::string(name) + "_sigma", sigma);
}

void describe_wheels(config::Fields& f, const Fit& fit) {
  WheelCalibration wheels = fit.calibration.wheels;
  f.field("track_m", wheels.track_m);
  describe_parameter(f, "left_scale", wheels.left_scale, fit.sigma(Fit::kLeft));
  describe_parameter(f, "right_scale", wheels.right_scale, fit.sigma(Fit::kRight));
  describe_parameter(f, "track_scale", wheels.track_scale, fit.sigma(Fit::kTrack));
}

void describe_mount(config::Fields& f, const Fit& fit) {
  const Pose2& base_T_laser = fit.calibration.base_T_laser;
  describe_parameter(f, "x_m", base_T_laser.x_m, fit.sigma(Fit::kX));
  describe_parameter(f, "y_m", base_T_laser.y_m, fit.sigma(Fit::kY));
  describe_parameter(f, "heading_deg", rad_to_deg(base_T_laser.theta_rad), rad_to_deg(fit.sigma(Fit::kHeading)));
}

void describe_evidence(config::Fields& f, const CalibratedDrive& drive) {
  Fit fit = drive.fit;
  auto legs = static_cast<std::uint64_t>(fit.legs);
  auto outliers = static_cast<std::uint64_t>(fit.outliers);
  std::uint64_t unmatched = drive.unmatched;
  f.field("legs", legs);
  f.field("outliers", outliers);
  f.field("left_out", unmatched);
  f.field("straights_m", fit.straights_m);
  double rotations_deg = rad_to_deg(fit.rotations_rad);
  f.field("rotations_deg", rotations_deg);
  f.field("rms_before_m", fit.rms_before_m);
  f.field("rms_after_m", fit.rms_after_m);
  double before_deg = rad_to_deg(fit.rms_before_rad);
  f.field("rms_before_deg", before_deg);
  double after_deg = rad_to_deg(fit.rms_after_rad);
  f.field("rms_after_deg", after_deg);
}

}  // namespace

std::string calibration_yaml(const std::filesystem::path& log, const CalibratedDrive& drive,
                             calibration::CalibrationSubject subject) {
  const Fit& fit = drive.fit;
  const std::string comment =
      formatted("# from %zu legs of ", fit.legs) + log.filename().string() +
      formatted(", %.0f m straight and %.0f deg of rotation\n", fit.straights_m, rad_to_deg(fit.rotations_rad));
  if (subject == calibration::CalibrationSubject::kWheels) {
    const WheelCalibration& wheels = fit.calibration.wheels;
    return comment +
           formatted("odometry_calibration:\n  track_m: %.6g\n  left_scale: %.6f\n", wheels.track_m,
                     wheels.left_scale) +
           formatted("  right_scale: %.6f\n  track_scale: %.6f\n", wheels.right_scale, wheels.track_scale);
  }
  const Pose2& base_T_laser = fit.calibration.base_T_laser;
  return comment + formatted("replay:\n  laser:\n    base_T_laser: [%.4f, %.4f, %.3f]   # x m, y m, heading deg\n",
                             base_T_laser.x_m, base_T_laser.y_m, rad_to_deg(base_T_laser.theta_rad));
}

std::string calibration_text(const std::filesystem::path& log, const CalibratedDrive& drive,
                             calibration::CalibrationSubject subject) {
  const Fit& fit = drive.fit;
  const bool wheels = subject == calibration::CalibrationSubject::kWheels;
  return formatted("%zu legs, %.1f m straight, %.0f deg of rotation; ", fit.legs, fit.straights_m,
                   rad_to_deg(fit.rotations_rad)) +
         formatted("%zu outliers, %llu legs left out, read %d times\n", fit.outliers,
                   static_cast<unsigned long long>(drive.unmatched), drive.passes) +
         formatted("odometry against laser, per leg: before %.1f mm %.2f deg, after %.1f mm %.2f deg\n\n",
                   1e3 * fit.rms_before_m, rad_to_deg(fit.rms_before_rad), 1e3 * fit.rms_after_m,
                   rad_to_deg(fit.rms_after_rad)) +
         (wheels ? wheels_text(fit) : mount_text(fit)) + "\nin the robot file" +
         (wheels ? "" : " (with real devices: base_T_laser of the scanner in hardware.lidar)") + ":\n\n" +
         calibration_yaml(log, drive, subject);
}

std::string calibration_json(const std::filesystem::path& log, const CalibratedDrive& drive,
                             calibration::CalibrationSubject subject) {
  return described_lines([&](config::Fields& f) {
    std::string name = log.filename().string();
    f.field("log", name);
    if (subject == calibration::CalibrationSubject::kWheels) {
      describe_wheels(f, drive.fit);
    } else {
      describe_mount(f, drive.fit);
    }
    describe_evidence(f, drive);
  });
}

}  // namespace seeker::lab
