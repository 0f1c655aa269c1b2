/// Experiment R2 tells a tracker that knows its errors from one that does not.
#include <gtest/gtest.h>

#include "server/lab/consistency/reproduce_consistency.hpp"
#include "server/lab/consistency/sp_tracker.hpp"
#include "server/options/world_options.hpp"
#include "tests/support/data.hpp"

namespace seeker::lab {
namespace {

/// The SPmap without scans is dead reckoning.
class Blind final : public slam::PoseTracker {
 public:
  explicit Blind(const sim::OdometryModel& believed)
      : tracker_({.lines = {}, .observation = {}, .map = {}, .odometry = believed}) {}
  Status predict(const Pose2& odom_T_base, RobotTime stamp) override { return tracker_.predict(odom_T_base, stamp); }
  Status update(const LaserScan&) override { return {}; }
  PoseEstimate estimate() const override { return tracker_.estimate(); }
  void reset(const Pose2& map_T_base) override { tracker_.reset(map_T_base); }

 private:
  SpTracker tracker_;
};

sim::World hall() {
  sim::World world;
  world.name = "hall";
  world.max_corner = Point2(12.0, 12.0);
  world.starts = {{2.0, 2.0, 0.0}};
  return world;
}

/// Dead reckoning of a robot whose odometry is `factor` times as wrong as the tracker believes.
NeesStudy drive_blind(double factor) {
  ConsistencyParams params;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    params.seeds.push_back(seed);
  }
  params.tour = {{9.0, 2.0}, {9.0, 9.0}};
  params.instant_s = 5.0;
  params.odometry_factor = factor;
  sim::RobotModel model;
  model.lidar.beams = 2;
  const auto make = [](const sim::RobotModel&) {
    return std::make_unique<Blind>(without_systematic_errors({}, 1.0).odometry);
  };
  const Result<NeesStudy> study = study_consistency(hall(), model, make, params);
  EXPECT_TRUE(study) << (study ? "" : study.error().message);
  return study ? *study : NeesStudy{};
}

TEST(R2Consistency, BandOfFiftyRunsIsTheOneOfChiSquare) {
  const auto [low, high] = nees_band(50);
  EXPECT_NEAR(low, 117.985 / 50.0, 0.002);
  EXPECT_NEAR(high, 185.800 / 50.0, 0.002);
}

TEST(R2Consistency, AccuratelyKnownErrorsPass) {
  const NeesStudy study = drive_blind(1.0);
  EXPECT_GE(study.means.size(), 4U);
  EXPECT_GE(study.share_inside(), 0.9);
  EXPECT_TRUE(nees_check("blind", study).passed);
  EXPECT_EQ(study.means.front().runs, 60);
}

TEST(R2Consistency, ErrorsTwiceAsLargeAsBelievedFail) {
  const NeesStudy study = drive_blind(2.0);
  EXPECT_EQ(study.inside, 0);
  EXPECT_GT(study.means.back().nees, 9.0);
  EXPECT_FALSE(nees_check("blind", study).passed);
}

TEST(R2Consistency, ErrorsHalfAsLargeAsBelievedFailToo) { EXPECT_FALSE(nees_check("blind", drive_blind(0.5)).passed); }

/// The mean over runs and instants of a robot whose wheels nobody has calibrated, on the first rooms of the tour.
double nees_of_uneven_wheels(const MakeTracker& make_tracker) {
  ConsistencyParams params;
  params.seeds = {1, 2, 3, 4, 5, 6};
  params.tour = office_tour();
  params.tour.resize(3);
  params.wheels = {.scale_sigma = 0.02, .drift_sigma_rad_per_m = 0.02, .base_sigma = 0.02};
  const Result<sim::World> world = options::load_world(testing::source_file("config/worlds/office-no-target.yaml"));
  EXPECT_TRUE(world) << (world ? "" : world.error().message);
  const Result<NeesStudy> study = study_consistency(*world, {}, make_tracker, params);
  EXPECT_TRUE(study) << (study ? "" : study.error().message);
  double sum = 0.0;
  for (const NeesSample& sample : study->samples) {
    sum += sample.nees;
  }
  return sum / static_cast<double>(study->samples.size());
}

TEST(R2Consistency, WheelsThatNobodyHasCalibratedAreLearntAndTheirUncertaintyIsToldOf) {
  // Chi-square of 18 dof, 99 %, over 6 runs, as if all instants of a run erred alike.
  constexpr double kLow = 1.04;
  constexpr double kHigh = 6.19;
  const double learnt = nees_of_uneven_wheels(learning_tracker());
  EXPECT_GT(learnt, kLow);
  EXPECT_LT(learnt, kHigh);
  EXPECT_GT(nees_of_uneven_wheels(local_maps_tracker()), kHigh) << "which takes them for calibrated";
}

TEST(R2Consistency, ATourThroughAWallIsAnError) {
  ConsistencyParams params;
  params.seeds = {1};
  params.tour = {{20.0, 2.0}};
  params.time_limit_s = 60.0;
  sim::World world = hall();
  sim::Wall wall;
  wall.a = {6.0, 0.0};
  wall.b = {6.0, 12.0};
  world.walls.push_back(wall);
  const Result<NeesStudy> study = study_consistency(world, {}, sp_tracker(), params);
  ASSERT_FALSE(study);
  EXPECT_EQ(study.error().code, Errc::kTimeout);
  EXPECT_NE(study.error().message.find("x = 5."), std::string::npos) << study.error().message;
}

}  // namespace
}  // namespace seeker::lab
