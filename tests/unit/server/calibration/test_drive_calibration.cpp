#include "server/calibration/drive_calibration.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/core/angle.hpp"
#include "common/core/rng.hpp"

namespace seeker::calibration {
namespace {

/// Wheels that differ by 3 %, a track that is 2 % off, and a laser ahead of the base, to the right and turned.
const DriveCalibration kOff{{0.357, 1.02, 0.99, 0.98}, {0.15, -0.05, deg_to_rad(12.0)}};
const Matrix3 kMatch = Eigen::Vector3d(9e-6, 9e-6, 1e-6).asDiagonal();

struct MatchNoise {
  double m = 0.0;
  double rad = 0.0;
};

/// A leg on which the base reports `twist` for each of ten steps.
DriveLeg leg_of(const Twist2& twist, const DriveCalibration& calibration, const MatchNoise& noise, Rng& rng) {
  constexpr int kSteps = 10;
  DriveLeg leg;
  leg.increments.reserve(kSteps);
  Pose2 from_T_to;
  for (int k = 0; k < kSteps; ++k) {
    leg.increments.push_back(integrate(twist, 0.1));
    from_T_to = from_T_to * corrected(leg.increments.back(), calibration.wheels);
  }
  const Pose2 error{rng.normal(noise.m), rng.normal(noise.m), rng.normal(noise.rad)};
  leg.from_T_to = {inverse(calibration.base_T_laser) * from_T_to * calibration.base_T_laser * error, kMatch};
  return leg;
}

/// Straight legs, arcs and turns on the spot, both ways.
std::vector<DriveLeg> mixed_drive(const MatchNoise& noise, std::uint64_t seed) {
  Rng rng(seed);
  constexpr std::size_t kRounds = 40;
  std::vector<DriveLeg> legs;
  legs.reserve(3 * kRounds);
  for (std::size_t k = 0; k < kRounds; ++k) {
    legs.push_back(leg_of({0.5, 0.0}, kOff, noise, rng));
    legs.push_back(leg_of({0.0, k % 2 == 0 ? 0.5 : -0.5}, kOff, noise, rng));
    legs.push_back(leg_of({0.4, rng.uniform(-0.4, 0.4)}, kOff, noise, rng));
  }
  return legs;
}

std::vector<DriveLeg> drive_of(const Twist2& twist) {
  Rng rng(1);
  return std::vector<DriveLeg>(60, leg_of(twist, kOff, {}, rng));
}

TEST(DriveCalibration, FindsTheWheelsExactlyFromMotionsWithoutNoise) {
  const DriveCalibration start{WheelCalibration{}, kOff.base_T_laser};
  const auto fit = calibrate(mixed_drive({}, 1), start, CalibrationSubject::kWheels);
  ASSERT_TRUE(fit) << fit.error().message;
  EXPECT_NEAR(fit->calibration.wheels.left_scale, 1.02, 1e-6);
  EXPECT_NEAR(fit->calibration.wheels.right_scale, 0.99, 1e-6);
  EXPECT_NEAR(fit->calibration.wheels.track_scale, 0.98, 1e-6);
  EXPECT_GT(fit->rms_before_m, 0.005);
  EXPECT_LT(fit->rms_after_m, 1e-6);
}

TEST(DriveCalibration, FindsTheMountExactlyEvenWhereTheWheelsAreOff) {
  DriveCalibrationParams params;
  params.wheel_prior_sigma = 10.0;  // nothing is known of the wheels
  const auto fit = calibrate(mixed_drive({}, 1), {}, CalibrationSubject::kMount, params);
  ASSERT_TRUE(fit) << fit.error().message;
  EXPECT_NEAR(fit->calibration.base_T_laser.x_m, 0.15, 1e-6);
  EXPECT_NEAR(fit->calibration.base_T_laser.y_m, -0.05, 1e-6);
  EXPECT_NEAR(fit->calibration.base_T_laser.theta_rad, deg_to_rad(12.0), 1e-6);
}

TEST(DriveCalibration, StatesDeviationsThatItsErrorsKeepTo) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const auto fit = calibrate(mixed_drive({0.005, 0.002}, seed), {WheelCalibration{}, kOff.base_T_laser},
                               CalibrationSubject::kWheels);
    ASSERT_TRUE(fit) << fit.error().message;
    const WheelCalibration& wheels = fit->calibration.wheels;
    constexpr double kSigmas = 4.0;
    EXPECT_NEAR(wheels.left_scale, 1.02, kSigmas * fit->sigma(DriveCalibrationResult::kLeft)) << seed;
    EXPECT_NEAR(wheels.right_scale, 0.99, kSigmas * fit->sigma(DriveCalibrationResult::kRight)) << seed;
    EXPECT_NEAR(wheels.track_scale, 0.98, kSigmas * fit->sigma(DriveCalibrationResult::kTrack)) << seed;
    EXPECT_LT(fit->sigma(DriveCalibrationResult::kTrack), 0.004);
  }
}

TEST(DriveCalibration, KeepsToItsResultWhereWheelsSlip) {
  std::vector<DriveLeg> legs = mixed_drive({0.002, 0.001}, 3);
  for (std::size_t k = 0; k < legs.size(); k += 15) {
    legs[k].from_T_to.a_T_b = legs[k].from_T_to.a_T_b * Pose2{-0.2, 0.05, 0.3};
  }
  const auto fit = calibrate(legs, {WheelCalibration{}, kOff.base_T_laser}, CalibrationSubject::kWheels);
  ASSERT_TRUE(fit) << fit.error().message;
  EXPECT_NEAR(fit->calibration.wheels.left_scale, 1.02, 0.003);
  EXPECT_NEAR(fit->calibration.wheels.track_scale, 0.98, 0.003);
  EXPECT_GE(fit->outliers, 8U);
}

TEST(DriveCalibration, RefusesADriveWithoutTurns) {
  for (const CalibrationSubject subject : {CalibrationSubject::kWheels, CalibrationSubject::kMount}) {
    const auto fit = calibrate(drive_of({0.5, 0.0}), {}, subject);
    ASSERT_FALSE(fit);
    EXPECT_EQ(fit.error().code, Errc::kNotReady);
    EXPECT_THAT(fit.error().message, ::testing::HasSubstr("turns on the spot"));
  }
}

TEST(DriveCalibration, RefusesADriveWithoutStraightLegs) {
  for (const CalibrationSubject subject : {CalibrationSubject::kWheels, CalibrationSubject::kMount}) {
    const auto fit = calibrate(drive_of({0.0, 0.5}), {}, subject);
    ASSERT_FALSE(fit);
    EXPECT_THAT(fit.error().message, ::testing::HasSubstr("straight ahead"));
  }
}

TEST(DriveCalibration, RefusesADriveThatIsTooShort) {
  const std::vector<DriveLeg> drive = mixed_drive({}, 1);
  DriveCalibrationParams params;
  params.min_straights_m = 1.0;
  params.min_rotations_rad = 1.0;
  const std::vector<DriveLeg> legs(drive.begin(), drive.begin() + 12);
  EXPECT_THAT(calibrate(legs, {}, CalibrationSubject::kWheels, params).error().message,
              ::testing::HasSubstr("longer drive"));
  EXPECT_FALSE(calibrate({}, {}, CalibrationSubject::kWheels));
}

TEST(DriveCalibration, RefusesMotionsThatDoNotBelongTogether) {
  std::vector<DriveLeg> legs = mixed_drive({}, 1);
  for (DriveLeg& leg : legs) {
    leg.from_T_to.a_T_b.x_m = -leg.from_T_to.a_T_b.x_m;
  }
  EXPECT_FALSE(calibrate(legs, {}, CalibrationSubject::kWheels));
}

}  // namespace
}  // namespace seeker::calibration
