#include "server/localize/survey_adjustment.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/LU>

#include "common/core/angle.hpp"
#include "tests/unit/server/localize/landmark_room.hpp"

namespace seeker::localize {
namespace {

constexpr double kTripod_m = 0.02;
const double kDial_rad = deg_to_rad(0.5);
const StereoGeometry kEyes;

struct PoseError {
  double rms_m = 0.0;
  double rms_rad = 0.0;
  double mean_nees = 0.0;
};

PoseError error_of(const std::vector<Sighting>& sightings) {
  const std::vector<Pose2> truth = testing::survey_truth();
  PoseError error;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const Pose2& pose = sightings[i].map_T_eye;
    const Eigen::Vector3d off(pose.x_m - truth[i].x_m, pose.y_m - truth[i].y_m,
                              wrap_angle(pose.theta_rad - truth[i].theta_rad));
    error.rms_m += off.head<2>().squaredNorm();
    error.rms_rad += off(2) * off(2);
    error.mean_nees += off.dot(sightings[i].pose_covariance.inverse() * off);
  }
  const auto count = static_cast<double>(truth.size());
  return {std::sqrt(error.rms_m / count), std::sqrt(error.rms_rad / count), error.mean_nees / count};
}

std::vector<Sighting> rough_survey(std::uint64_t seed, const testing::ViewNoise& noise = {}) {
  const testing::LandmarkRoom room(seed, 600);
  Rng rng(seed);
  return testing::survey_sightings(room, kEyes, noise, rng, kTripod_m, kDial_rad);
}

TEST(SurveyAdjustment, PosesAgreeBetterWithEachOtherAndWithTheTruth) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    std::vector<Sighting> sightings = rough_survey(seed);
    const PoseError before = error_of(sightings);
    const auto report = adjust_poses(kEyes, {}, sightings);
    ASSERT_TRUE(report) << report.error().message;
    const PoseError after = error_of(sightings);
    EXPECT_GT(report->points, 100);
    EXPECT_LT(report->rms_after_m, report->rms_before_m);
    EXPECT_LT(after.rms_m, 0.5 * before.rms_m);
    EXPECT_LT(after.rms_rad, 0.5 * before.rms_rad);
    EXPECT_LT(after.mean_nees, 6.0) << "3 on average for a covariance that states the error";
  }
}

TEST(SurveyAdjustment, FindsWhatAllDisparitiesErrBy) {
  testing::ViewNoise noise;
  noise.disparity_offset_px = 0.3;
  std::vector<Sighting> sightings = rough_survey(8, noise);
  const double before_px = sightings[0].features[0].disparity_px;
  const auto report = adjust_poses(kEyes, {}, sightings);
  ASSERT_TRUE(report);
  EXPECT_NEAR(report->offset_px, 0.3, 0.06);
  EXPECT_NEAR(sightings[0].features[0].disparity_px, before_px - report->offset_px, 1e-9);
}

TEST(SurveyAdjustment, APoseWithoutDoubtStays) {
  std::vector<Sighting> sightings = rough_survey(4);
  for (Sighting& sighting : sightings) {
    sighting.pose_covariance.setZero();
  }
  const std::vector<Sighting> before = sightings;
  ASSERT_TRUE(adjust_poses(kEyes, {}, sightings));
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    EXPECT_LT(distance_m(sightings[i].map_T_eye, before[i].map_T_eye), 0.001);
  }
}

TEST(SurveyAdjustment, SightingsThatShareNothingKeepTheirPoses) {
  std::vector<Sighting> all = rough_survey(5);
  std::vector<Sighting> opposite = {all[0], all[6]};  // back to back
  const std::vector<Sighting> before = opposite;
  const auto report = adjust_poses(kEyes, {}, opposite);
  ASSERT_TRUE(report);
  EXPECT_EQ(report->points, 0);
  for (std::size_t i = 0; i < opposite.size(); ++i) {
    EXPECT_EQ(opposite[i].map_T_eye, before[i].map_T_eye);
    EXPECT_EQ(opposite[i].pose_covariance, before[i].pose_covariance);
  }
}

TEST(SurveyAdjustment, ThePaperTakesPosesAsTheyAre) {
  std::vector<Sighting> sightings = rough_survey(6);
  const Pose2 before = sightings[7].map_T_eye;
  ASSERT_TRUE(adjust_poses(kEyes, paper_database_params(), sightings));
  EXPECT_EQ(sightings[7].map_T_eye, before);
}

TEST(SurveyAdjustment, KnownLandmarksHoldASurveyThatBeganWrong) {
  const testing::LandmarkRoom room(9, 600);
  const LandmarkDatabase database = testing::survey(room, kEyes, {}, 9);
  std::vector<Sighting> sightings = rough_survey(9);
  const Pose2 off{0.05, -0.04, 0.01};  // of all poses alike, which no shared observation can determine
  std::vector<KnownSight> known;
  for (std::size_t s = 0; s < sightings.size(); ++s) {
    const std::vector<SeenPoint> points = see(kEyes, sightings[s], {}, {});
    for (const Pairing& pair : associate(database, sightings[s].features, points, {})) {
      known.push_back({s, points[pair.point].feature, &database.at(pair.landmark)});
    }
    sightings[s].map_T_eye = off * sightings[s].map_T_eye;
    sightings[s].pose_covariance = Eigen::Vector3d(0.01, 0.01, 0.001).asDiagonal();
  }
  const PoseError before = error_of(sightings);
  ASSERT_TRUE(adjust_poses(kEyes, {}, sightings, known));
  const PoseError after = error_of(sightings);
  EXPECT_GT(before.rms_m, 0.04);
  EXPECT_LT(after.rms_m, 0.02) << "the landmarks themselves were surveyed to 5 mm";
  EXPECT_LT(after.rms_rad, 0.003);
}

TEST(SurveyAdjustment, RefusesAPoseThatIsNone) {
  std::vector<Sighting> sightings = rough_survey(7);
  sightings[3].map_T_eye.x_m = std::nan("");
  const Pose2 before = sightings[7].map_T_eye;
  const auto report = adjust_poses(kEyes, {}, sightings);
  ASSERT_FALSE(report);
  EXPECT_EQ(report.error().code, Errc::kInvalidArgument);
  EXPECT_EQ(sightings[7].map_T_eye, before) << "nothing is changed";
}

TEST(SurveyAdjustment, OdometryHoldsSightingsThatShareNothing) {
  const std::vector<Pose2> truth = testing::survey_truth();
  std::vector<Sighting> all = rough_survey(5);
  std::vector<Sighting> opposite = {all[0], all[6]};  // back to back
  opposite[0].map_T_eye = truth[0];
  opposite[0].pose_covariance.setZero();
  const Matrix3 little = Eigen::Vector3d(1e-6, 1e-6, 1e-6).asDiagonal();
  const SightingsApart rotation{0, 1, {inverse(truth[0]) * truth[6], little}};
  ASSERT_TRUE(adjust_poses(kEyes, {}, opposite, {}, {&rotation, 1}));
  EXPECT_LT(distance_m(opposite[1].map_T_eye, truth[6]), 0.001);
  EXPECT_LT(std::abs(wrap_angle(opposite[1].map_T_eye.theta_rad - truth[6].theta_rad)), 0.001);
  EXPECT_LT(opposite[1].pose_covariance.trace(), 4e-6) << "no more certain than the odometry, and no less";
  EXPECT_GT(opposite[1].pose_covariance.trace(), 2e-6);
}

}  // namespace
}  // namespace seeker::localize
