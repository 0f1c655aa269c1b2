#include "server/localize/database_update.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/server/localize/landmark_room.hpp"

namespace seeker::localize {
namespace {

using ::testing::HasSubstr;
using testing::LandmarkRoom;

/// Drives a circle through a room and gathers what it sees.
class UpdateDrive {
 public:
  UpdateDrive(const LandmarkRoom& survey_room, const UpdateParams& params)
      : database(std::make_shared<LandmarkDatabase>(survey(survey_room, {}, params.database, 2))), update({}, params) {}

  /// How many frames were taken.
  int drive(const LandmarkRoom& room, int frames, std::uint64_t seed = 4) {
    auto localiser = StereoLocaliser::create({}, database, LocaliserParams{});
    Rng rng(seed);
    Rng chance(5);
    const LeverArm arm;
    Pose2 base{5.0, 3.0, 0.0};
    const Matrix3 covariance = Eigen::Vector3d(2.5e-3, 2.5e-3, 9e-4).asDiagonal();  // P0 of spec S2.9
    EXPECT_TRUE(localiser->start_at(base * start_off, start_off == Pose2{} ? 1e-4 * Matrix3::Identity() : covariance));
    int taken = 0;
    for (int i = 0; i < frames; ++i) {
      const Twist2 velocity{0.32, 0.16};
      base = base * integrate(velocity, 0.5);
      localiser->predict(velocity, 0.5);
      Sighting sighting;
      sighting.features = room.view(eye_from_base(base, arm), {}, {}, rng);
      const LocaliserStep& step = localiser->update(sighting.features, chance);
      sighting.map_T_eye = localiser->belief().map_T_eye;
      sighting.pose_covariance = localiser->belief().pose_covariance();
      taken += update.observe(*database, sighting, step) ? 1 : 0;
    }
    return taken;
  }

  Pose2 start_off;  ///< error of the pose that the localiser is given at first
  std::shared_ptr<const LandmarkDatabase> database;
  DatabaseUpdate update;
};

/// Points of the room's first wall between 3 and 7 m: what furniture before it would carry.
bool movable(const testing::RoomPoint& point) {
  return point.p_map.y() < 0.01 && point.p_map.x() > 3.0 && point.p_map.x() < 7.0;
}

LandmarkRoom changed(LandmarkRoom room) {
  std::erase_if(room.points(), movable);
  Rng rng(12);
  for (int i = 0; i < 60; ++i) {
    room.add(2, rng.uniform(3.0, 7.0), rng.uniform(-0.8, 1.4), testing::random_look(rng));
  }
  return room;
}

TEST(DatabaseUpdate, FollowsAChangeOfTheRoom) {
  const LandmarkRoom room(2, 500);
  UpdateDrive drive(room, {});
  EXPECT_GT(drive.drive(changed(room), 180), 150);
  const auto staged = drive.update.stage(*drive.database);
  ASSERT_TRUE(staged) << staged.error().message;
  const UpdateCounts& counts = staged->counts;
  EXPECT_EQ(counts.after,
            counts.before + static_cast<std::size_t>(counts.added) - static_cast<std::size_t>(counts.removed));
  EXPECT_EQ(staged->database.size(), counts.after);
  EXPECT_GT(counts.added, 15);
  EXPECT_GT(counts.removed, 10);
  int gone_that_stood = 0;
  for (const Landmark& landmark : drive.database->landmarks()) {
    const bool removed = staged->database.find(landmark.id) == nullptr;
    gone_that_stood += removed && !movable({landmark.p_map, {}, {}}) ? 1 : 0;
  }
  EXPECT_LT(gone_that_stood, counts.removed / 4) << "what still stands is kept";
}

TEST(DatabaseUpdate, NewLandmarksGetNewIds) {
  const LandmarkRoom room(2, 500);
  UpdateDrive drive(room, {});
  drive.drive(changed(room), 180);
  const auto staged = drive.update.stage(*drive.database);
  ASSERT_TRUE(staged);
  int added = 0;
  for (const Landmark& landmark : staged->database.landmarks()) {
    added += landmark.id >= drive.database->next_id() ? 1 : 0;
  }
  EXPECT_EQ(added, staged->counts.added);
}

TEST(DatabaseUpdate, LeavesTheDatabaseInUseAlone) {
  const LandmarkRoom room(2, 500);
  UpdateDrive drive(room, {});
  const LandmarkDatabase before = *drive.database;
  drive.drive(changed(room), 60);
  ASSERT_TRUE(drive.update.stage(*drive.database));
  EXPECT_TRUE(*drive.database == before);
}

TEST(DatabaseUpdate, OfAnUnchangedRoomRemovesAlmostNothing) {
  const LandmarkRoom room(2, 500);
  UpdateDrive drive(room, {});
  drive.drive(room, 180);
  const auto staged = drive.update.stage(*drive.database);
  ASSERT_TRUE(staged);
  EXPECT_LE(staged->counts.removed, static_cast<int>(drive.database->size()) / 50);
}

TEST(DatabaseUpdate, OfADriveThatBeganUncertainPutsNewLandmarksWhereTheyAre) {
  LandmarkRoom room = changed(LandmarkRoom(2, 500));
  UpdateDrive drive(LandmarkRoom(2, 500), {});
  drive.start_off = {0.0, 0.05, 0.01};
  drive.drive(room, 90);
  const auto staged = drive.update.stage(*drive.database);
  ASSERT_TRUE(staged) << staged.error().message;
  ASSERT_GT(staged->counts.added, 10);
  int near = 0;
  for (const Landmark& landmark : staged->database.landmarks()) {
    if (landmark.id < drive.database->next_id()) {
      continue;
    }
    near += std::any_of(room.points().begin(), room.points().end(),
                        [&](const testing::RoomPoint& point) { return (point.p_map - landmark.p_map).norm() < 0.05; });
  }
  EXPECT_GT(near, 0.9 * staged->counts.added);
}

TEST(DatabaseUpdate, PlacesThatAreNotCertainEnoughAddNoLandmarks) {
  const LandmarkRoom room(2, 500);
  UpdateParams strict;
  strict.max_teaching_sigma_m = 1e-6;
  UpdateDrive drive(room, strict);
  EXPECT_GT(drive.drive(changed(room), 180), 150);
  const auto staged = drive.update.stage(*drive.database);
  ASSERT_TRUE(staged) << staged.error().message;
  EXPECT_EQ(staged->counts.added, 0);
  EXPECT_GT(staged->counts.removed, 10) << "what is gone is seen from there as well";
}

TEST(DatabaseUpdate, OfThePaperCountsMissesInARow) {
  const LandmarkRoom room(2, 500);
  UpdateParams params;
  params.count_misses = true;
  UpdateDrive drive(room, params);
  drive.drive(changed(room), 180);
  const auto staged = drive.update.stage(*drive.database);
  ASSERT_TRUE(staged);
  EXPECT_GT(staged->counts.removed, 10);
  EXPECT_GT(staged->counts.added, 15);
}

TEST(DatabaseUpdate, LearnsNothingWhileTheRobotIsNotLocalised) {
  const LandmarkRoom room(2, 300);
  UpdateDrive drive(room, {});
  Sighting sighting;
  Rng rng(1);
  sighting.features = room.view({5, 5, 0}, {}, {}, rng);
  LocaliserStep step;
  step.corrected = true;
  for (const auto quality :
       {LocalisationQuality::kUnknown, LocalisationQuality::kDegraded, LocalisationQuality::kLost}) {
    step.quality = quality;
    EXPECT_FALSE(drive.update.observe(*drive.database, sighting, step));
  }
  const auto staged = drive.update.stage(*drive.database);
  ASSERT_FALSE(staged);
  EXPECT_EQ(staged.error().code, Errc::kNotReady);
}

TEST(DatabaseUpdate, ThatWouldRemoveMostIsRefused) {
  const LandmarkRoom room(2, 300);
  UpdateParams params;
  params.min_rotation_rad = params.min_move_m = 0.0;
  UpdateDrive drive(room, params);
  LocaliserStep step;
  step.quality = LocalisationQuality::kLocalised;
  step.corrected = true;
  Sighting sighting;
  sighting.map_T_eye = {5, 5, 0};
  // A pose that is wrong: nothing that should be seen is.
  for (const Landmark& landmark : drive.database->landmarks()) {
    step.expected.push_back(landmark.id);
  }
  for (int k = 0; k < 8; ++k) {
    sighting.map_T_eye.theta_rad = k * kPi / 4.0;
    for (int i = 0; i < 20; ++i) {
      EXPECT_TRUE(drive.update.observe(*drive.database, sighting, step));
    }
  }
  const auto staged = drive.update.stage(*drive.database);
  ASSERT_FALSE(staged);
  EXPECT_EQ(staged.error().code, Errc::kRefused);
  EXPECT_THAT(staged.error().message, HasSubstr("survey the building again"));
}

TEST(DatabaseUpdate, ForgetsOnClear) {
  const LandmarkRoom room(2, 300);
  UpdateDrive drive(room, {});
  EXPECT_GT(drive.drive(room, 20), 0);
  drive.update.clear();
  EXPECT_FALSE(drive.update.stage(*drive.database));
}

}  // namespace
}  // namespace seeker::localize
