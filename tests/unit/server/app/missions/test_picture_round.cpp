#include "server/app/missions/picture_round.hpp"

#include <gtest/gtest.h>

#include "common/core/angle.hpp"

namespace seeker::app {
namespace {

RoundParams params() {
  RoundParams p;
  p.look.settle_s = 0.3;
  p.look.tries = 2;
  p.picture_timeout_s = 1.0;
  return p;
}

/// Turns as it is told and takes the pictures that are wanted.
class Turning {
 public:
  explicit Turning(int headings) : round(params()) { round.start(situation, headings); }

  void run() {
    for (int k = 0; k < 1200 && round.active(); ++k) {
      Decision decision;
      round.step(situation, decision);
      EXPECT_FALSE(decision.wants_look) << "that is the stereo camera's";
      situation.now += std::chrono::milliseconds(100);
      situation.odom_T_base.theta_rad =
          wrap_angle(situation.odom_T_base.theta_rad + 0.1 * decision.command.omega_rad_s);
      situation.velocity = decision.command;
      left_out += static_cast<int>(decision.events.size());
      if (decision.wants_image && !camera_dead) {
        Recognition recognition;
        recognition.stamp = situation.now;
        recognition.map_T_base = situation.odom_T_base;
        round.take(recognition);
      }
    }
  }

  Situation situation;
  PictureRound round;
  bool camera_dead = false;
  int left_out = 0;
};

TEST(PictureRound, HasOnePictureOfEachHeadingWithItsOwnPose) {
  Turning robot(4);
  robot.run();
  ASSERT_TRUE(robot.round.started());
  const std::vector<Recognition> seen = robot.round.finish();
  EXPECT_FALSE(robot.round.started());
  ASSERT_EQ(seen.size(), 4U);
  for (std::size_t k = 0; k < seen.size(); ++k) {
    EXPECT_NEAR(wrap_angle(seen[k].map_T_base.theta_rad - static_cast<double>(k) * kPi / 2.0), 0.0, 0.06) << k;
  }
  EXPECT_EQ(to_looks(seen)[2].map_T_base, seen[2].map_T_base);
  EXPECT_EQ(to_looks(seen)[2].laser, nullptr);
}

TEST(PictureRound, ADeadCameraEndsItWithoutPictures) {
  Turning robot(3);
  robot.camera_dead = true;
  robot.run();
  EXPECT_FALSE(robot.round.active());
  EXPECT_EQ(robot.left_out, 3);
  EXPECT_TRUE(robot.round.finish().empty());
}

TEST(PictureRound, AnAnswerNobodyWaitsForIsNotTaken) {
  Turning robot(2);
  robot.round.take({});
  EXPECT_EQ(robot.round.index(), 0);
  robot.run();
  robot.round.take({});
  EXPECT_EQ(robot.round.finish().size(), 2U);
}

TEST(PictureRound, ItsPicturesMoveWithTheMap) {
  Turning robot(1);
  robot.run();
  robot.round.map_moved(Pose2{1.0, 2.0, 0.5});
  const Pose2 moved = robot.round.finish().front().map_T_base;
  EXPECT_NEAR(moved.x_m, 1.0, 1e-9);
  EXPECT_NEAR(moved.theta_rad, 0.5, 0.06);
}

TEST(PicturesAround, OverlapByAsMuchAsIsAskedFor) {
  vision::ViewParams view;
  view.photo_fov_rad = deg_to_rad(49.1);
  EXPECT_EQ(pictures_around(view, params()), 12);
  RoundParams wide = params();
  wide.overlap_rad = 0.0;
  EXPECT_EQ(pictures_around(view, wide), 8);
  wide.overlap_rad = deg_to_rad(60.0);
  EXPECT_EQ(pictures_around(view, wide), api::kMaxHeadings) << "never endless";
}

}  // namespace
}  // namespace seeker::app
