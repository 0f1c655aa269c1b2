#include "server/app/estimators/landmark_estimator.hpp"

#include <gtest/gtest.h>

#include "tests/unit/server/localize/landmark_room.hpp"
#include "tests/unit/server/store/temporary_folder.hpp"

namespace seeker::app {
namespace {

namespace room = localize::testing;
using std::chrono::milliseconds;

/// A robot that drives a circle in a surveyed room of made-up landmarks.
class LandmarkEstimatorTest : public ::testing::Test {
 protected:
  LandmarkEstimatorTest() {
    make_estimator();
    tell_odometry();
  }

  void make_estimator(Duration update_period = Duration::zero()) {
    LandmarkEstimatorParams params;
    params.database = "lab";
    params.update_period = update_period;
    // One round of the circle is evidence enough.
    params.update.max_log_odds = 0.5;
    params.update.remove_log_odds = -1.0;
    estimator_.emplace(localize::StereoLocaliser::create(geometry_, database_, params_).value(), database_, params,
                       LandmarkUpdating{library_, geometry_, true}, Rng(1));
  }

  void tell_odometry() {
    drivers::OdometrySample sample;
    sample.stamp = now_;
    sample.odom_T_base = odom_T_map_ * map_T_base_;
    EXPECT_TRUE(estimator_->on_odometry(sample));
  }
  void drive() {
    now_ += milliseconds(100);
    map_T_base_ = map_T_base_ * Pose2{0.02, 0.0, 0.02};
    tell_odometry();
  }
  Result<StereoLook> look() {
    StereoLook look;
    look.stamp = now_;
    const Pose2 map_T_eye = localize::eye_from_base(map_T_base_, params_.arm);
    look.features.features = room_.view(map_T_eye, geometry_, room::ViewNoise{}, rng_);
    return look;
  }
  double error_m() const { return distance_m(estimator_->estimate().map_T_base, map_T_base_); }

  StereoGeometry geometry_;
  localize::LocaliserParams params_;
  room::LandmarkRoom room_{1, 1500};
  std::shared_ptr<const localize::LandmarkDatabase> database_ =
      std::make_shared<const localize::LandmarkDatabase>(room::survey(room_, geometry_, localize::DatabaseParams{}, 3));
  testing::TemporaryFolder folder_;
  std::shared_ptr<LandmarkLibrary> library_ =
      std::make_shared<LandmarkLibrary>(LandmarkStorage{folder_.path(), "r-1", "1"});
  Rng rng_{7};
  Pose2 map_T_base_{4.0, 5.0, 0.7};
  Pose2 odom_T_map_{-2.0, 1.0, 1.1};
  RobotTime now_ = robot_time_s(1.0);
  std::optional<LandmarkEstimator> estimator_;
};

TEST_F(LandmarkEstimatorTest, KnowsNothingUntilTwoLooksAgree) {
  EXPECT_EQ(estimator_->estimate().quality, LocalisationQuality::kUnknown);
  ASSERT_TRUE(estimator_->wants_look(now_));
  estimator_->look_begun(now_);
  estimator_->on_look(look());
  EXPECT_EQ(estimator_->estimate().quality, LocalisationQuality::kUnknown);
  drive();
  estimator_->look_begun(now_);
  estimator_->on_look(look());
  EXPECT_EQ(estimator_->estimate().quality, LocalisationQuality::kLocalised);
  EXPECT_LT(error_m(), 0.05);
}

TEST_F(LandmarkEstimatorTest, LooksAtItsPeriodAndOneAtATime) {
  ASSERT_TRUE(estimator_->wants_look(now_));
  estimator_->look_begun(now_);
  EXPECT_FALSE(estimator_->wants_look(now_ + std::chrono::seconds(2)));
  estimator_->on_look(look());
  EXPECT_FALSE(estimator_->wants_look(now_ + milliseconds(400)));
  EXPECT_TRUE(estimator_->wants_look(now_ + milliseconds(500)));
}

TEST_F(LandmarkEstimatorTest, ALookThatTakesSomeTicksCorrectsThePoseAsItWasAtTheExposure) {
  for (int k = 0; k < 3; ++k) {
    estimator_->look_begun(now_);
    estimator_->on_look(look());
    drive();
  }
  ASSERT_EQ(estimator_->estimate().quality, LocalisationQuality::kLocalised);
  for (int k = 0; k < 20; ++k) {
    estimator_->look_begun(now_);
    const Result<StereoLook> taken = look();
    for (int ticks = 0; ticks < 5; ++ticks) {
      drive();
      EXPECT_LT(error_m(), 0.05) << "while looking";
    }
    estimator_->on_look(taken);
    EXPECT_LT(error_m(), 0.05);
    EXPECT_EQ(estimator_->estimate().quality, LocalisationQuality::kLocalised);
    EXPECT_EQ(estimator_->estimate().stamp, now_);
  }
}

TEST_F(LandmarkEstimatorTest, BadPicturesAreSaidAndTheCovarianceGrows) {
  ASSERT_TRUE(estimator_->place_at({.stamp = now_,
                                    .map_T_base = map_T_base_,
                                    .covariance = 1e-4 * Matrix3::Identity(),
                                    .quality = LocalisationQuality::kLocalised,
                                    .cause = "",
                                    .map_epoch = 0}));
  const double before = estimator_->estimate().covariance.trace();
  for (int k = 0; k < 100; ++k) {
    drive();
    if (estimator_->wants_look(now_)) {
      estimator_->on_look(fail(Errc::kInvalidArgument, "the left picture is black"));
    }
  }
  EXPECT_GT(estimator_->estimate().covariance.trace(), 2.0 * before);
  EXPECT_NE(estimator_->estimate().quality, LocalisationQuality::kLocalised);
  EXPECT_NE(estimator_->estimate().cause.find("black"), std::string::npos) << estimator_->estimate().cause;
}

TEST_F(LandmarkEstimatorTest, WhatIsGoneLeavesTheDatabaseWhenItMayBeUpdated) {
  ASSERT_TRUE(library_->create("lab", *database_, "", false));
  make_estimator(std::chrono::seconds(20));
  std::erase_if(room_.points(), [](const room::RoomPoint& point) { return point.normal == Point2(-1, 0); });
  std::vector<std::string> news;
  for (int k = 0; k < 420; ++k) {
    drive();
    if (estimator_->wants_look(now_)) {
      estimator_->look_begun(now_);
      estimator_->on_look(look());
    }
    for (std::string& one : estimator_->take_news()) {
      news.push_back(std::move(one));
    }
  }
  ASSERT_FALSE(news.empty());
  EXPECT_EQ(news.front().rfind("the database of landmarks is updated: ", 0), 0U) << news.front();
  const auto kept = library_->load("lab");
  ASSERT_TRUE(kept) << kept.error().message;
  EXPECT_GT(kept->summary.revision, 1U);
  const auto on_the_wall = [](const localize::LandmarkDatabase& database) {
    return std::count_if(database.landmarks().begin(), database.landmarks().end(),
                         [](const localize::Landmark& landmark) { return landmark.p_map.x() > 9.8; });
  };
  EXPECT_LT(on_the_wall(*kept->database), on_the_wall(*database_) / 2);
  EXPECT_EQ(estimator_->estimate().quality, LocalisationQuality::kLocalised);
  EXPECT_LT(error_m(), 0.05);
}

TEST_F(LandmarkEstimatorTest, OdometryThatRunsBackwardsOrHasGapsIsATypedFault) {
  drivers::OdometrySample sample;
  sample.stamp = now_ - milliseconds(100);
  EXPECT_EQ(estimator_->on_odometry(sample).error().code, Errc::kInvalidArgument);
  sample.stamp = now_ + std::chrono::seconds(5);
  EXPECT_EQ(estimator_->on_odometry(sample).error().code, Errc::kTimeout);
  sample.stamp += milliseconds(100);
  EXPECT_TRUE(estimator_->on_odometry(sample));
}

}  // namespace
}  // namespace seeker::app
